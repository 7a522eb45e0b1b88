"""Every mouth of a fitting has an end of its line, however it was cut into triangles.

Not covered:

- elbows with straight legs, whose ends are right, but whose line may be up to 6 % short, since the bend is taken to
  fill the shorter leg;
- bends of so few segments that these leave the arc by more than a quarter of the pipe's radius (a return bend of twelve
  diameters in four pieces): the sweep finds ends between the segments;
- faces that are rounded so coarsely that neighbouring triangles of a flat face turn by more than a degree (0.1 mm at 64
  sides of DN 80), as these are no flat faces any more.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import fittings
import plates
import shapes
import tubes
from cadgraph.geometry.line.mouths import (
    Mouth,
    are_on_one_axis,
    join_mouths,
    mouths_of,
    run_inward,
    turned_outward,
)
from cadgraph.geometry.line.part_lines import lines_of_parts
from cadgraph.model.scene import Scene
from cadgraph.model.shapes import Disc
from cadplants import STYLES
from cadplants.model.standards import PIPES, TEE_CENTER_TO_END
from cadplants.parts.piping import tee
from fittings import CAPS, MESHERS, Fitting, Outlet, X
from piping import turned

NAN = float("nan")


def line_of(mesh):
    parts = plates.parts_of(Scene.from_meshes([mesh]))
    return lines_of_parts(parts.scene, parts.properties, parts, [0]).get(0)


def faults(fitting, line):
    """What is wrong with a line: ends off their mouths (share of the diameter), and what it does not cover."""
    if line is None:
        return ["no line"]
    found = [] if len(line.ends) == len(fitting.mouths) else [f"{len(line.ends)} ends"]
    for k, mouth in enumerate(fitting.mouths):
        end = min(line.ends, key=lambda end: np.linalg.norm(end.point - mouth.point))
        off = np.linalg.norm(end.point - mouth.point) / (2 * mouth.radius)
        if off > 0.02:
            found.append(f"mouth {k}: {off:.3f} diameters off")
        elif end.direction @ mouth.direction < np.cos(np.radians(3)):
            found.append(f"mouth {k}: looks to {end.direction}, not {mouth.direction}")
        elif abs(end.radius / mouth.radius - 1) > 0.02:
            found.append(f"mouth {k}: radius {end.radius} for {mouth.radius}")
    if line.length < 0.98 * fitting.length:
        found.append(f"{line.length / fitting.length:.1%} of the length")
    return found


walls = st.sampled_from([None, 0.08, 0.2])
sides = st.sampled_from([6, 7, 8, 10, 12, 16, 24, 32, 48, 64])
caps = st.sampled_from(CAPS)
radii = st.floats(0.011, 0.25)


@st.composite
def pipes(draw):
    radius, length = draw(radii), draw(st.floats(1.0, 200.0))
    rings = draw(st.integers(2, 4))
    points = np.linspace(0, length * radius, rings)[:, None] * X
    return fittings.straight(points, [radius] * rings, draw(sides), draw(walls), draw(caps))


@st.composite
def reducers(draw):
    """Cones and reducers with spigots, from a few long triangles, concentric or eccentric."""
    radius, share = draw(radii), draw(st.floats(0.4, 0.9))
    length, spigot = draw(st.floats(1.5, 4.0)) * radius, draw(st.sampled_from([0.0, 0.09]))
    rise = draw(st.sampled_from([0.0, 1.0])) * radius * (1 - share) * np.array([0.0, 0.0, 1.0])
    n, less = draw(sides), draw(st.sampled_from([0, 4]))
    points = [0 * X, spigot * length * X, (1 - spigot) * length * X + rise, length * X + rise]
    widths = [radius, radius, share * radius, share * radius]
    if not spigot:
        points, widths = [points[0], points[-1]], [widths[0], widths[-1]]
    return fittings.straight(points, widths, n, draw(walls), draw(caps), last_sides=max(6, n - less))


@st.composite
def bends(draw):
    """Elbows of any angle and return bends, of few segments or many."""
    radius, angle = draw(radii), draw(st.floats(15.0, 180.0))
    reach = draw(st.floats(1.5, 6.0)) * radius
    # No segment leaves the arc by more than a quarter of the pipe's radius, nor turns by more than 45 degrees.
    widest = min(45.0, 2 * np.degrees(np.arccos(1 - 0.25 * radius / reach)))
    steps = draw(st.integers(max(2, int(np.ceil(angle / widest))), 24))
    return fittings.bend(radius, reach, np.radians(angle), steps, draw(sides), draw(walls), draw(caps))


@st.composite
def branched(draw, kind):
    """Tees, laterals and crosses, with the branch welded in or its primitives stuck into each other."""
    run, share = draw(radii), draw(st.floats(0.2, 0.97))
    angle = draw(st.floats(40.0, 70.0)) if kind == "lateral" else 90.0
    share = min(share, 0.9) if kind == "lateral" else share
    # The run and the branch reach beyond where they meet.
    foot = share / np.sin(np.radians(angle)) + 1 / np.tan(np.radians(angle))
    half = (max(foot, 1.0) + draw(st.floats(0.4, 2.0))) * run
    reach = (1 / np.sin(np.radians(angle)) + share / np.tan(np.radians(angle)) + draw(st.floats(0.4, 2.0))) * run
    turn = draw(st.floats(-np.pi, np.pi))
    outlets = [Outlet(half, share * run, reach, np.radians(angle), turn)]
    if kind == "cross":
        outlets.append(Outlet(half, share * run, reach, np.radians(angle), turn + np.pi))
    if draw(st.booleans()):
        return fittings.stuck(run, 2 * half, outlets, draw(sides), draw(caps))
    n, rings = draw(st.sampled_from([12, 16, 24, 32, 64])), draw(st.integers(0, 4))
    return fittings.branched(run, 2 * half, outlets, n, draw(walls), draw(caps), rings)


FAMILIES = {
    "pipe": pipes(), "reducer": reducers(), "bend": bends(), "tee": branched("tee"), "lateral": branched("lateral"),
    "cross": branched("cross"),
}  # fmt: skip


@pytest.mark.parametrize("mesher", MESHERS)
@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=12)
@given(data=st.data(), seed=st.integers(0, 2**31))
def test_every_mouth_has_its_end_in_any_triangles(family, mesher, data, seed):
    fitting, random = data.draw(FAMILIES[family]), np.random.default_rng(seed)
    mesh = MESHERS[mesher](fitting.mesh, random)
    assert faults(fitting, line_of(mesh)) == []


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=25)
@given(data=st.data(), seed=st.integers(0, 2**31), mirrored=st.booleans(), names=st.permutations(sorted(MESHERS)))
def test_every_mouth_has_its_end_wherever_the_fitting_lies(family, data, seed, mirrored, names):
    fitting, random = data.draw(FAMILIES[family]), np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed).as_matrix()
    if mirrored:
        turn = turn @ np.diag([1.0, 1.0, -1.0])
    there = fittings.placed(fitting, turn, random.uniform(-100, 100, 3))
    mesh = there.mesh
    for name in names[:2]:
        mesh = MESHERS[name](mesh, random)
    assert faults(there, line_of(mesh)) == []


@pytest.mark.parametrize("mesher", MESHERS)
@pytest.mark.parametrize("n", [6, 8])
@pytest.mark.parametrize("rise", [0.0, 0.0254], ids=["concentric", "eccentric"])
def test_a_cone_as_long_as_it_is_wide_ends_at_both_its_faces(rise, n, mesher):
    # Six sides make it look like a flange, and no corner lies behind the middle of its narrow face.
    cone = fittings.straight([0 * X, np.array([0.5, 0, rise])], [0.25, 0.2246 if rise else 0.125], n)
    for seed in range(4):
        assert faults(cone, line_of(MESHERS[mesher](cone.mesh, np.random.default_rng(seed)))) == []


@pytest.mark.parametrize("mesher", MESHERS)
@pytest.mark.parametrize("hollow", [True, False], ids=["hollow", "solid"])
@pytest.mark.parametrize(("dn", "branch"), [(100, 80), (100, 100), (80, 25)])
def test_a_coarse_tee_of_the_generator_has_three_ends(dn, branch, hollow, mesher):
    style = replace(STYLES["bim"], fittings="long", hollow=hollow)
    (component,) = tee(dn, branch, style).assembly.components
    reach, run, side = TEE_CENTER_TO_END[dn], PIPES[dn].radius, PIPES[branch].radius
    mouths = (
        fittings.Mouth(0 * X, -X, run),
        fittings.Mouth(2 * reach * X, X, run),
        fittings.Mouth(np.array([reach, 0, reach]), np.array([0, 0, 1.0]), side),
    )
    mesh = component.solid.vertices, component.solid.faces
    fitting = Fitting(mesh, mouths, 3 * reach)
    assert faults(fitting, line_of(MESHERS[mesher](mesh, np.random.default_rng(0)))) == []


@pytest.mark.parametrize("mesher", MESHERS)
@pytest.mark.parametrize("hollow", [True, False], ids=["hollow", "solid"])
def test_a_cap_has_a_second_end_where_it_is_closed(hollow, mesher):
    outer = [(0.05 * np.cos(a), 0.02 + 0.03 * np.sin(a)) for a in np.linspace(0, np.pi / 2, 7)[:-1]]
    inner = [(0.9 * r, 0.9 * z) for r, z in outer[::-1]]
    profile = [(0.05, 0), *outer, (0, 0.05), *([(0, 0.045), *inner, (0.045, 0)] if hollow else [(0, 0)])]
    cap = shapes.lathe(profile, 24, closed=hollow)
    line = line_of(MESHERS[mesher](cap if hollow else fittings.merged(cap), np.random.default_rng(0)))
    mouth, far = sorted(line.ends, key=lambda end: end.point[2])
    np.testing.assert_allclose(mouth.point, 0, atol=1e-3)
    assert mouth.direction[2] < -0.99
    assert mouth.radius == pytest.approx(0.05, rel=0.02)
    assert far.point[2] == pytest.approx(0.05, abs=2e-3)


def olet(sides=24, run=0.1):
    """A snout whose foot follows a pipe along x below it."""
    low = fittings.ring(np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.02, sides)
    low[:, 2] = np.sqrt(run**2 - low[:, 1] ** 2)
    high = fittings.ring(np.array([0, 0, 0.14]), np.array([0.0, 0.0, 1.0]), 0.015, sides)
    return Fitting(
        fittings.swept([low, high]), (fittings.Mouth(np.array([0, 0, 0.14]), np.array([0.0, 0.0, 1.0]), 0.015),), 0.04
    )


@pytest.mark.parametrize("mesher", MESHERS)
@pytest.mark.parametrize("n", [8, 24])
def test_an_olet_has_its_mouth_and_an_end_at_its_saddle(mesher, n):
    line = line_of(MESHERS[mesher](olet(n).mesh, np.random.default_rng(0)))
    low, high = sorted(line.ends, key=lambda end: end.point[2])
    np.testing.assert_allclose(high.point, [0, 0, 0.14], atol=6e-4)
    assert high.direction[2] > 0.99
    assert high.radius == pytest.approx(0.015, rel=0.02)
    assert low.direction[2] < -0.99
    assert 0.097 < low.point[2] < 0.101


NONE = np.zeros((0, 3, 3))


def disc(x, sense=1.0, outer=0.05, inner=0.0, at=(0.0, 0.0)):
    return Disc(np.array([x, *at]), sense * X, outer, inner, 24, 1.0)


def test_mouths_come_widest_first_and_tell_a_bore():
    found = mouths_of([disc(0, -1, 0.04, 0.036), disc(1, 1, 0.05, 0.0), disc(2, 1, 0.03, 0.0299)], NONE)
    assert [mouth.radius for mouth in found] == [0.05, 0.04, 0.03]
    np.testing.assert_array_equal([mouth.bore for mouth in found], [NAN, 0.036, NAN])


@pytest.mark.parametrize(("bolts", "left"), [(2, 4), (3, 2), (8, 2)])
def test_three_bolts_alike_around_a_face_are_no_mouths(bolts, left):
    around = [disc(0.03, 1, 0.008, at=(0.07 * np.cos(a), 0.07 * np.sin(a))) for a in np.arange(bolts) * 0.7]
    assert len(mouths_of([disc(0, -1, 0.1), disc(0.02, 1, 0.1), *around], NONE)) == left


@pytest.mark.parametrize(("off", "expected"), [(0.0019, True), (0.0021, False)])
def test_mouths_are_on_one_axis_up_to_a_share_of_the_radius(off, expected):
    one, other = Mouth(0 * X, -X, 0.06, NAN), Mouth(np.array([1.0, off, 0]), X, 0.05, NAN)
    assert are_on_one_axis([one, other]) is expected


def test_faces_that_look_into_their_part_are_turned():
    vertices, faces = shapes.cylinder(0.05, 0.2)
    up = np.array([0, 0, 1.0])
    discs = [Disc(np.array([0, 0, z]), up, 0.05, 0.0, 24, 1.0) for z in (-0.1, 0.0, 0.1)]
    turned = turned_outward(discs, vertices[faces])
    # What has surface on both sides stays as it is.
    assert [disc.normal[2] for disc in turned] == [-1.0, 1.0, 1.0]


def test_the_narrow_face_of_a_steep_cone_is_turned_by_what_is_nearest_to_its_axis():
    vertices, faces = fittings.straight([0 * X, 0.5 * X], [0.25, 0.125], 6, caps="corner").mesh
    (turned,) = turned_outward([Disc(0.5 * X, -X, 0.125, 0.0, 6, 1.0)], vertices[faces])
    assert turned.normal[0] == 1.0


def test_fewer_than_two_mouths_can_not_be_joined():
    triangles = (lambda mesh: mesh[0][mesh[1]])(shapes.cylinder())
    assert join_mouths([], triangles) is None
    assert join_mouths([Mouth(0 * X, X, 1.0, NAN)], triangles) is None


@pytest.mark.parametrize(
    "second",
    [
        Mouth(X, -X, 0.05, NAN),  # faces that look at each other
        Mouth(np.array([0.0, 0.08, 0]), -X, 0.05, NAN),  # two legs that lie in each other
        Mouth(np.array([0.3, -0.3, 0]), np.array([0, 1.0, 0]), 0.05, NAN),  # axes that meet before a mouth
        Mouth(np.array([0.3, 0.3, 0.06]), np.array([0, 1.0, 0]), 0.05, NAN),  # axes that miss each other
    ],
    ids=["facing", "too near", "before", "missed"],
)
def test_mouths_between_which_no_tube_can_run_are_not_joined(second):
    pipe = fittings.straight([0 * X, X], [0.05, 0.05], 24)
    assert join_mouths([Mouth(0 * X, -X, 0.05, NAN), second], pipe.mesh[0][pipe.mesh[1]]) is None


def test_a_surface_that_does_not_run_between_the_mouths_is_not_theirs():
    body, box = fittings.straight([0 * X, X], [0.05, 0.05], 24), shapes.box((0.5, 0.5, 0.5), (0.5, 0, 0))
    mouths = [Mouth(0 * X, -X, 0.05, NAN), Mouth(X, X, 0.05, NAN)]
    alone, beset = body.mesh, fittings.merged(body.mesh, box)
    assert join_mouths(mouths, alone[0][alone[1]]).share == pytest.approx(1.0)
    assert join_mouths(mouths, beset[0][beset[1]]) is None


@pytest.mark.parametrize(("shift", "found"), [(0.0, True), (0.009, True), (0.011, False)])
def test_the_axis_behind_an_only_mouth_runs_in_the_middle_of_the_surface(shift, found):
    vertices, faces = shapes.cylinder(0.05, 0.1, 48)
    mouth = Mouth(np.array([shift, 0, 0.05]), np.array([0, 0, 1.0]), 0.05, NAN)
    assert (run_inward(mouth, vertices[faces]) is not None) is found


def flange(at, way, radius=0.11, thick=0.022):
    """A solid disc whose front is at a point and looks that way."""
    middle = np.asarray(at, float) - thick / 2 * np.asarray(way, float)
    return turned(shapes.cylinder(radius, thick), middle, way)


def test_a_bend_stuck_into_its_flanges_runs_from_front_to_front():
    angles = np.linspace(0, np.pi / 2, 7)
    arc = [(0.13 * (1 - np.sin(a)), 0.13 * (1 - np.cos(a)), 0) for a in angles]
    bend = tubes.pipe([(0.15, 0, 0), *arc, (0, 0.15, 0)], 0.057, 16, caps=True)
    mesh = fittings.merged(bend, flange((0.15, 0, 0), X), flange((0, 0.15, 0), (0, 1, 0)))
    line = line_of(mesh)
    assert sorted(np.round(end.direction, 6).tolist() for end in line.ends) == [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
    assert [end.radius for end in line.ends] == pytest.approx([0.11, 0.11], rel=0.01)


def test_a_branch_as_short_as_the_flanges_of_its_run_are_wide_is_one():
    run = turned(shapes.cylinder(0.057, 0.2), 0 * X, X)
    leg = turned(shapes.cylinder(0.057, 0.1), (0, 0.05, 0), (0, 1, 0))
    plates_at = [flange(0.1 * X, X), flange(-0.1 * X, -X), flange((0, 0.1, 0), (0, 1, 0))]
    line = line_of(fittings.merged(run, leg, *plates_at))
    assert len(line.ends) == 3
    assert len(line.junctions) == 1
