from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.environment import HANDS, make_skid
from cadgraph.errors import CadGraphError
from cadgraph.geometry.contact import find_contacts
from cadgraph.geometry.properties import measure
from cadgraph.geometry.shape import find_shapes
from cadgraph.load import load
from cadgraph.parts import Parts
from cadgraph.scene import Scene
from cadgraph.stages.label.facts import find_facts
from cadgraph.stages.label.rules import GeometryLabeler
from cadgraph.vocabulary import Vocabulary, default_vocabulary

VOCABULARY = default_vocabulary()
DATA = Path(__file__).parents[2].parent / "shared" / "data"
TO_X = Rotation.from_euler("y", 90, degrees=True).as_matrix()


def parts_of(scene):
    n = scene.n_meshes
    properties = measure(scene)
    ids = np.arange(n)
    return Parts(
        scene,
        tuple((i,) for i in range(n)),
        ids,
        properties,
        find_shapes(scene, properties).shape,
        np.zeros(n, np.bool_),
    )


def labels_of(*meshes):
    scene = meshes[0] if meshes and isinstance(meshes[0], Scene) else Scene.from_meshes(meshes)
    return GeometryLabeler().label(parts_of(scene), find_contacts(scene, 0.01), VOCABULARY)


def names_of(*meshes):
    return [label and label.name for label in labels_of(*meshes)]


def groups_of(*meshes):
    return [label and label.group for label in labels_of(*meshes)]


def facts_of(mesh):
    return find_facts(parts_of(Scene.from_meshes([mesh])))[0]


def joined(*meshes):
    starts = np.cumsum([0] + [len(v) for v, _ in meshes[:-1]])
    return np.vstack([v for v, _ in meshes]), np.vstack([f + s for (_, f), s in zip(meshes, starts, strict=True)])


def along_x(mesh, x=0.0, y=0.0, z=0.0):
    return shapes.moved(mesh, TO_X, (x, y, z))


def pipe(x0, x1, outer=0.03, inner=0.026, sides=24):
    return along_x(shapes.tube(outer, inner, x1 - x0, sides), (x0 + x1) / 2)


def flange(x, radius=0.08, thickness=0.02, inner=0.026, sides=24):
    return along_x(shapes.tube(radius, inner, thickness, sides), x)


def bolts(x, n, length=0.06):
    shapes_ = []
    for k in range(n):
        angle = 2 * np.pi * k / 4 + 0.5
        shapes_.append(along_x(shapes.cylinder(0.006, length, 12), x, 0.065 * np.cos(angle), 0.065 * np.sin(angle)))
    return shapes_


def joint(n_bolts=4):
    """Pipe, flange, gasket, flange, pipe along x, then bolts."""
    gasket = flange(0.0, 0.055, 0.002, 0.03)
    pieces = [pipe(-0.421, -0.021), flange(-0.011), gasket, flange(0.011), pipe(0.021, 0.421)]
    return [*pieces, *bolts(0.0, n_bolts)]


def gauge(case=0.063, foot=0.03, depth=0.03):
    """Stem and case over a pipe along x."""
    stem = shapes.moved(shapes.cylinder(0.006, 0.05, 12), translation=(0, 0, foot + 0.025))
    turn = Rotation.from_euler("x", 90, degrees=True).as_matrix()
    return stem, shapes.moved(shapes.cylinder(case / 2, depth, 24), turn, (0, 0, foot + 0.0495 + case / 2))


def valve(x=0.0, handle=True):
    """A body between x - 0.1 and x + 0.1 with a stem and a lever."""
    body = joined(
        *(along_x(shapes.cylinder(0.07, 0.02, 24), x + side * 0.09) for side in (-1, 1)),
        along_x(shapes.cylinder(0.045, 0.17, 24), x),
        shapes.moved(shapes.cylinder(0.02, 0.08, 16), translation=(x, 0, 0.04)),
    )  # fmt: skip
    stem = shapes.moved(shapes.cylinder(0.008, 0.03, 12), translation=(x, 0, 0.094))
    lever = shapes.box((0.2, 0.02, 0.006), (x + 0.08, 0, 0.112))
    return [body, stem, lever] if handle else [body]


def line_with_valve(handle=True):
    ends = [pipe(-0.62, -0.121), flange(-0.111, 0.07), flange(0.111, 0.07), pipe(0.121, 0.62)]
    return [*valve(handle=handle), *ends]


def plant():
    """A line with a joint, a valve and a gauge."""
    shift = [shapes.moved(mesh, translation=(1.041, 0, 0)) for mesh in joint()[1:]]
    first = [*line_with_valve()[:-1], pipe(0.121, 1.02)]
    return [*first, *shift, *(shapes.moved(mesh, translation=(0.5, 0, 0)) for mesh in gauge())]


# --- shapes ---


@pytest.mark.parametrize("sides", [6, 8, 12, 32, 64])
@pytest.mark.parametrize("mesh", [lambda n: shapes.cylinder(0.03, 0.4, n), lambda n: shapes.tube(0.03, 0.026, 0.4, n)])
def test_tubes_and_bars_are_measured_at_any_number_of_sides(mesh, sides):
    facts = facts_of(mesh(sides))
    assert facts.round
    assert not facts.bent
    assert facts.tube == pytest.approx(0.4, rel=0.02)
    assert sorted(round(port.outer, 6) for port in facts.ports) == [0.03, 0.03]


def test_open_tube_has_the_rims_as_ports():
    facts = facts_of(shapes.lathe([(0.03, 0.0), (0.03, 0.4)], 16))
    assert len(facts.ports) == 2
    assert facts.tube == pytest.approx(0.4, rel=0.02)


def test_square_bar_is_not_round():
    facts = facts_of(shapes.box((0.05, 0.05, 1.0)))
    assert not facts.round
    assert facts.ports == ()
    assert facts.tube == 0


def test_spokes_are_counted():
    turns = [2 * np.pi * k / 5 for k in range(5)]
    arms = [
        shapes.moved(
            shapes.moved(shapes.cylinder(0.004, 0.07, 8), TO_X, (0.05, 0, 0)),
            Rotation.from_euler("z", turn).as_matrix(),
        )
        for turn in turns
    ]
    circle = np.arange(10) * 2 * np.pi / 10
    rim = shapes.lathe([(0.09 + 0.008 * np.cos(a), 0.008 * np.sin(a)) for a in circle], 32, closed=True)
    assert facts_of(joined(rim, shapes.tube(0.018, 0.007, 0.02), *arms)).spokes == 5


# --- one part, no parts ---


def test_no_parts_give_no_labels():
    assert labels_of(Scene.from_meshes([])) == []


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.box(),
        shapes.sphere(0.1),
        shapes.cylinder(0.03, 0.5),  # a solid rod may be anything
        shapes.cylinder(0.05, 0.03),  # a disc too
        shapes.tube(0.2, 0.19, 0.2),
        (np.zeros((0, 3)), np.zeros((0, 3), int)),
        (np.zeros((3, 3)), np.array([[0, 1, 2]])),
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0, 1, 2]])),
    ],
)
def test_what_could_be_anything_stays_without_a_label(mesh):
    assert labels_of(mesh) == [None]


@pytest.mark.parametrize(("widths", "name"), [(3.1, "pipe"), (2.9, None)])
def test_long_hollow_tube_alone_is_a_pipe(widths, name):
    assert names_of(shapes.tube(0.03, 0.026, 0.06 * widths)) == [name]


@pytest.mark.parametrize(("width", "name"), [(0.074, "washer"), (0.076, None)])
def test_flat_ring_up_to_washer_size_is_a_washer(width, name):
    assert names_of(shapes.tube(width / 2, width / 4, 0.007)) == [name]


# --- joints ---


def test_joint_is_named_piece_by_piece():
    assert names_of(*joint()) == ["pipe", "flange", "gasket", "flange", "pipe", *["stud"] * 4]


@pytest.mark.parametrize(("n", "name"), [(3, "stud"), (2, None)])
def test_three_alike_on_a_circle_are_fasteners(n, name):
    assert names_of(*joint(n))[5:] == [name] * n


@pytest.mark.parametrize(("ratio", "name"), [(1.25, "flange"), (1.15, None)])
def test_flange_is_wider_than_its_pipe(ratio, name):
    assert names_of(pipe(-0.4, 0.0), flange(0.0105, 0.03 * ratio, 0.018))[1] == name


@pytest.mark.parametrize(("thickness", "name"), [(0.004, "gasket"), (0.012, None)])
def test_gasket_is_thin(thickness, name):
    half = thickness / 2
    ends = [flange(-half - 0.01), flange(half + 0.01), pipe(-0.4 - half, -half - 0.02), pipe(half + 0.02, 0.4 + half)]
    assert names_of(flange(0.0, 0.055, thickness, 0.03), *ends)[0] == name


@pytest.mark.parametrize(("gap", "found"), [(0.004, True), (0.02, False)])
def test_flange_and_pipe_meet_across_small_gaps_only(gap, found):
    assert (names_of(pipe(-0.4, 0.0), flange(gap + 0.01))[1] == "flange") is found


# --- devices ---


def test_valve_with_a_lever_is_one_valve():
    labels = labels_of(*line_with_valve())
    assert [label.name for label in labels] == ["valve body", "valve stem", "lever", "pipe", "flange", "flange", "pipe"]
    assert all(
        label.source == "geometry" and 0.5 <= label.confidence <= 1 and label.evidence["why"] for label in labels
    )


def test_body_without_a_handle_is_less_sure():
    with_handle, without = labels_of(*line_with_valve())[0], labels_of(*line_with_valve(handle=False))[0]
    assert without.group == "Valve assembly"
    assert without.confidence < with_handle.confidence


def test_lever_without_a_valve_is_not_named():
    assert names_of(shapes.box((0.2, 0.02, 0.006))) == [None]


@pytest.mark.parametrize(("case", "name"), [(0.063, "gauge case"), (0.27, "gauge case"), (0.28, None), (0.035, None)])
def test_gauge_case_has_a_standard_size(case, name):
    assert names_of(pipe(-0.4, 0.4), *gauge(case, depth=0.5 * case))[2] == name


def test_gauge_stands_on_piping_only():
    assert groups_of(pipe(-0.4, 0.4), *gauge()) == ["Pipe assembly", "Gauge assembly", "Gauge assembly"]
    assert groups_of(shapes.box((0.8, 0.06, 0.06)), *gauge()) == [None, None, None]


def test_labels_that_the_vocabulary_lacks_are_left_out():
    scene = Scene.from_meshes(joint())
    small = Vocabulary({"Pipe assembly": VOCABULARY.groups["Pipe assembly"]})
    labels = GeometryLabeler().label(parts_of(scene), find_contacts(scene, 0.01), small)
    assert [label is not None for label in labels] == [True] * 5 + [False] * 4


# --- the whole ---


def test_labels_are_repeatable_and_leave_the_parts_alone():
    scene = Scene.from_meshes(plant())
    parts, contacts = parts_of(scene), find_contacts(scene, 0.01)
    arrays = [scene.vertices, scene.faces, contacts.points, parts.properties.obb_axes, parts.properties.area]
    before = [array.copy() for array in arrays]
    first = GeometryLabeler().label(parts, contacts, VOCABULARY)
    assert GeometryLabeler().label(parts, contacts, VOCABULARY) == first
    assert all(np.array_equal(a, b) for a, b in zip(arrays, before, strict=True))


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_labels_do_not_depend_on_pose_or_order(seed):
    rng = np.random.default_rng(seed)
    meshes = plant()
    expected = names_of(*meshes)
    assert expected.count(None) == 0
    rotation, order = Rotation.random(random_state=seed).as_matrix(), rng.permutation(len(meshes))
    shift = rng.uniform(-50, 50, 3)
    found = names_of(*(shapes.moved(meshes[i], rotation, shift) for i in order))
    assert found == [expected[i] for i in order]


@pytest.mark.parametrize("hand", ["plant-design", "bim", "game"])
def test_all_valves_and_gauges_of_a_skid_are_found_and_nothing_else(hand):
    skid = make_skid(3, HANDS[hand])
    for component, label in zip(skid.components, labels_of(skid.scene()), strict=True):
        assert label is None or label.group == component.group
        if component.group in ("Valve assembly", "Gauge assembly", "Pipe assembly"):
            assert label is not None


def test_colors_and_paths_are_no_evidence():
    scene = Scene.from_meshes(joint())
    renamed = replace(scene, paths=tuple(f"/valve_{i}" for i in range(scene.n_meshes)), colors=scene.colors * 0)
    assert labels_of(renamed) == labels_of(scene)


@pytest.mark.parametrize(
    "name", ["ballvalves/ballDN15.stp", "ballvalves/ballDN50flg.step", "butterflyvalves/DN80.step"]
)
def test_real_valves_are_valves(name):
    pytest.importorskip("cascadio")
    path = DATA / "step" / "valves" / name
    if not path.exists():
        pytest.skip("the real CAD files are not here")
    assert set(groups_of(load(path))) == {"Valve assembly"}


def test_a_scene_that_is_no_plant_gets_no_devices():
    path = DATA / "usd" / "McUsd" / "McUsd.usda"
    if not path.exists():
        pytest.skip("the real CAD files are not here")
    try:
        scene = load(path)
    except CadGraphError as error:
        pytest.skip(str(error))
    assert {"Valve assembly", "Gauge assembly"}.isdisjoint(groups_of(scene))
