from dataclasses import replace

import numpy as np
import pytest

from cadgraph.geometry.mesh.pieces import pieces_of
from cadgraph.model.labels import Label
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.model.parts import Network, Opening, UnitParts
from cadgraph.model.places import UnitAccess
from cadgraph.model.scene import Scene
from cadgraph.pipeline import analyse
from cadgraph.stages.mechanisms import find_mechanisms, report_not_movable
from cadplants import STYLES
from cadplants.model.plant import Assembly
from cadplants.parts.gauge import pressure_gauge
from cadplants.parts.operator import handwheel
from cadplants.parts.valve import VALVES, valve_length
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import box, cylinder
from cadplants.solids.transforms import at, spun

GRAINS = {"one": STYLES["bim"], "few": STYLES["game"], "pieces": STYLES["plant-design"]}
ASKEW = at(3.0, -2.0, 1.0) @ spun("z", 0.7) @ spun("x", 0.4) @ spun("y", 1.1)
HERE = UnitAccess(None, None, 0.0, "floor")


def motion(assembly, openings=(), named=True, kind=None, unit_type="valve", access=HERE):
    """What moves at the only unit of an assembly; its scene, and the components by mesh."""
    components = [c for c in assembly.components if c.unit]
    paths = [f"/m{k:03d}" for k in range(len(components))]
    scene = Scene.from_meshes([(c.vertices, c.faces) for c in components], paths)
    analysis = analyse(scene)
    parts = analysis.parts
    labels = [Label(group="Valve assembly", name=components[m[0]].name, source="author") for m in parts.meshes]
    unit = UnitParts(unit_type, "X-1", tuple(range(parts.n_parts)), kind, tuple(openings))
    network = Network((unit,))
    found = find_mechanisms(analysis.scene, parts, labels if named else [None] * parts.n_parts, network, [access])
    return found[0], report_not_movable(analysis.scene, parts, network.units, found), analysis.scene


def valve(kind, style, pose=ASKEW, dn=50, **options):
    """A valve, and the openings at its faces."""
    built = VALVES[kind]("V", dn, style, **options)
    way = pose[:3, 0]
    points = (pose[:3, 3], pose[:3, 3] + valve_length(kind, dn) * way)
    openings = [Opening(tuple(p), tuple(sign * way), 0.0525) for sign, p in zip((-1, 1), points, strict=True)]
    return built.assembly.placed(pose), openings


def errors(found, assembly):
    """How far an axis is from the true one: degrees, and mm."""
    component = next(c for c in assembly.components if c.turns is not None)
    true = component.turns.placed(component.pose)
    axis = np.array(true.axis)
    apart = np.array(found.pivot) - true.point
    angle = np.degrees(np.arccos(np.clip(axis @ found.axis, -1, 1)))
    return angle, 1000 * np.linalg.norm(apart - (apart @ axis) * axis)


@pytest.mark.parametrize("named", [True, False], ids=["named", "unnamed"])
@pytest.mark.parametrize("grain", GRAINS)
@pytest.mark.parametrize(
    ("kind", "options", "moves"),
    [
        ("gate", {}, "handwheel"),
        ("globe", {"wheel": "plate"}, "handwheel"),
        ("ball", {"turn": np.pi / 2}, "lever"),
        ("ball", {"lever": "straight"}, "lever"),
        ("butterfly", {"gearbox": True}, "gear operator"),
    ],
    ids=["gate", "globe", "ball shut", "ball", "butterfly"],
)
def test_axes_are_found_by_shape_in_any_pose_and_however_finely_it_is_modelled(kind, options, moves, grain, named):
    assembly, openings = valve(kind, GRAINS[grain], **options)
    found, unmovable, _ = motion(assembly, openings, named)
    angle, apart = errors(found.mechanism, assembly)
    assert (found.mechanism.kind, unmovable) == (moves, [])
    assert angle < 0.1
    assert apart < 1.0
    assert bool(found.mechanism.pieces) == (grain == "one")
    assert found.affordances == (("pull",) if moves == "lever" else ("turn",))


@pytest.mark.parametrize(
    ("turn", "open_", "shut"),
    [
        (0.0, 0.0, -90.0), (np.pi / 2, 90.0, 0.0), (-np.pi / 4, 45.0, -45.0), (np.pi / 4, -45.0, 45.0),
        # Drawn a little beyond a stop: as it is drawn belongs to its stroke.
        (0.1, 0.0, -90.0), (np.pi / 2 - 0.1, 90.0, 0.0),
    ],
)  # fmt: skip
def test_a_lever_is_open_along_the_line_and_clockwise_shuts_it_unless_it_is_drawn_the_other_way(turn, open_, shut):
    assembly, openings = valve("ball", GRAINS["pieces"], turn=turn)
    found = motion(assembly, openings)[0].mechanism
    assert (found.open, found.shut) == pytest.approx((open_, shut), abs=1e-3)
    assert found.limits == (min(found.open, found.shut), max(found.open, found.shut))


def test_a_wheel_of_a_gate_valve_has_as_many_turns_as_its_size_asks_for_and_says_that_this_is_assumed():
    assembly, openings = valve("gate", GRAINS["pieces"])
    found = motion(assembly, openings, kind="gate valve")[0].mechanism
    assert found.limits == (-3600.0, 0.0)
    assert "assumed: 10 turns" in found.sources["limits"]


def test_hub_and_spokes_turn_with_their_rim_and_the_stem_does_not():
    assembly, openings = valve("gate", GRAINS["pieces"], pose=np.eye(4))
    wheel = next(c for c in assembly.components if c.name == "handwheel")
    rim, hub, *spokes = pieces_of_wheel(wheel)
    others = [c for c in assembly.components if c.name != "handwheel"]
    split = [
        replace(wheel, solid=solid, name=name)
        for solid, name in ((rim, "handwheel"), (hub, "valve stem"), *((spoke, "handwheel") for spoke in spokes))
    ]
    whole = Assembly((*others, *split), (), assembly.units)
    found, _, scene = motion(whole, openings)
    moving = {int(path[2:]) for path in (scene.paths[m] for m in found.mechanism.meshes)}
    assert moving == set(range(len(others), len(others) + len(split)))
    assert found.mechanism.meshes[0] == len(others), "the largest first"


def pieces_of_wheel(wheel):
    piece = pieces_of(wheel.solid.vertices, wheel.solid.faces)
    return [replace(wheel.solid, faces=wheel.solid.faces[piece == k]) for k in range(piece.max() + 1)]


def test_pieces_are_numbered_by_their_first_triangles_and_are_those_of_the_wheel():
    assembly, openings = valve("gate", GRAINS["one"], pose=np.eye(4))
    found, _, scene = motion(assembly, openings)
    vertices, faces = scene.mesh(0)
    piece = pieces_of(vertices, faces)
    first = [int(np.flatnonzero(piece == k)[0]) for k in range(piece.max() + 1)]
    assert first == sorted(first)
    moving = vertices[np.unique(faces[np.isin(piece, found.mechanism.pieces)])]
    axis, pivot = np.array(found.mechanism.axis), np.array(found.mechanism.pivot)
    away = np.linalg.norm(moving - pivot - ((moving - pivot) @ axis)[:, None] * axis, axis=1)
    rim = found.mechanism.radius + found.mechanism.thickness
    assert away.max() == pytest.approx(rim, abs=1e-3)
    assert np.abs((moving - pivot) @ axis).max() < 0.3 * rim, "the stem stays"


@pytest.mark.parametrize(
    ("kind", "reason"), [("check valve", ""), ("relief valve", ""), (None, "no wheel or lever was found")]
)
def test_valves_that_the_flow_moves_need_no_wheel_and_others_say_that_none_was_found(kind, reason):
    assembly, openings = valve("check", GRAINS["pieces"])
    found, unmovable, _ = motion(assembly, openings, kind=kind)
    assert (found.mechanism, found.why_not) == (None, reason)
    assert [(d.code, d.message) for d in unmovable] == ([(NOT_MOVABLE, f"X-1: {reason}")] if reason else [])


def test_a_wheel_that_is_one_surface_with_its_body_can_not_be_moved():
    solid = merge([box((0.2, 0.1, 0.1)), cylinder(0.01, 0.05, 0.2, 12)])
    welded = replace(solid, faces=np.vstack([solid.faces, [[0, len(solid.vertices) - 1, 1]]]))
    assembly, openings = valve("gate", GRAINS["one"], pose=np.eye(4))
    one = Assembly((replace(assembly.components[0], solid=welded),), (), assembly.units)
    found, _, _ = motion(one, openings, kind="gate valve")
    assert found.mechanism is None
    assert found.why_not == "its wheel is one surface with its body"


def test_a_ring_about_the_line_is_no_wheel():
    assembly, openings = valve("check", GRAINS["pieces"], pose=np.eye(4))
    ring = moved(handwheel(0.12, 0.008, 4, 0.07, 0.01, 0.06, 32), spun("y", np.pi / 2))
    more = replace(assembly.components[0], solid=ring, name="")
    found, _, _ = motion(Assembly((*assembly.components, more), (), assembly.units), openings, named=False)
    assert found.mechanism is None


def gauge(style, needle=2.2):
    """A gauge that stands upright and looks to -y, with what is known of its face."""
    assembly = pressure_gauge("G", style, 100, needle=needle)
    points = np.concatenate([c.vertices for c in assembly.components if c.name != "gauge stem"])
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    face = (float(middle[0]), float(points[:, 1].min()), 0.075 + 0.05)
    return assembly, UnitAccess(0, None, 1.0, "floor", (0.0, -1.0, 0.0), 0.9, None, face, 0.055)


@pytest.mark.parametrize("needle", [0.0, 0.9, 2.2])
def test_a_needle_goes_from_where_it_is_drawn_to_both_ends_of_the_scale(needle):
    assembly, access = gauge(GRAINS["pieces"], needle)
    found, _, scene = motion(assembly, unit_type="gauge", access=access)
    angle, apart = errors(found.mechanism, assembly)
    assert angle < 0.1
    assert apart < 0.1
    assert [assembly.components[int(scene.paths[m][2:])].name for m in found.mechanism.meshes] == ["gauge needle"]
    assert (found.mechanism.open, found.mechanism.shut, found.affordances) == (None, None, ("read",))
    # Seen from the front the needle's 0 is at three o'clock, its angles anticlockwise; twelve is at 90 degrees.
    drawn = np.degrees(needle) - 90.0
    low, high = found.mechanism.limits
    assert (high + drawn, low + drawn) == pytest.approx((135.0, -135.0), abs=1e-3)


def test_a_gauge_without_a_needle_has_a_dial_to_draw_one_on():
    assembly, access = gauge(GRAINS["few"])
    found, _, _ = motion(assembly, unit_type="gauge", access=access)
    assert found.mechanism is None
    assert found.affordances == ("read",)
    case = next(c for c in assembly.components if c.turns is not None)
    true = case.turns.placed(case.pose)
    assert found.dial.normal == pytest.approx((0.0, -1.0, 0.0), abs=1e-6)
    assert found.dial.up == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)
    assert (found.dial.center[0], found.dial.center[2]) == pytest.approx((true.point[0], true.point[2]), abs=1e-3)


def test_what_has_no_face_is_not_read():
    assembly, _ = gauge(GRAINS["pieces"])
    found, _, _ = motion(assembly, unit_type="gauge")
    assert (found.mechanism, found.dial, found.affordances) == (None, None, ())
