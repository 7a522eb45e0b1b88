import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
import tubes
from cadgraph.geometry.line.centreline import Centreline, NotTube
from cadgraph.geometry.line.trace import trace_centrelines
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene

QUARTER = 0.15 * np.pi / 2
S_BEND = tubes.follow(
    [[0, 0, 0], [1, 0, 0]], tubes.arc(0.15, np.pi / 2, 12), tubes.arc(0.15, -np.pi / 2, 12), [[0, 0, 0], [0.5, 0, 0]]
)
SPOOL = [(0.04, 0), (0.1, 0), (0.1, 0.02), (0.05, 0.02), (0.05, 1.0), (0.1, 1.0), (0.1, 1.02), (0.04, 1.02)]


def traced(*meshes, **options):
    scene = Scene.from_meshes(meshes)
    return trace_centrelines(scene, measure(scene), **options)


def line(mesh):
    result = traced(mesh)[0]
    assert isinstance(result, Centreline), result
    return result


def joined(*meshes):
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


@pytest.mark.parametrize("sides", [6, 7, 8, 12, 16, 33, 64])
@pytest.mark.parametrize("kind", ["open", "capped", "hollow", "soup"])
def test_straight_pipe_is_exact(sides, kind):
    path = [[0.3, 0.2, 0.1], [1.5, 1.2, -0.7]]
    mesh = tubes.pipe(path, 0.05, sides, bore=0.04 if kind == "hollow" else None, caps=kind == "capped")
    found = line(tubes.soup(mesh) if kind == "soup" else mesh)
    assert len(found.branches) == 1
    assert found.length == pytest.approx(np.linalg.norm(np.subtract(*path)), rel=1e-6)
    branch = found.branches[0]
    np.testing.assert_allclose(branch.radius, 0.05, rtol=1e-6)
    np.testing.assert_allclose(branch.bore, 0.04 if kind == "hollow" else np.nan, rtol=1e-6)
    ends = sorted((end.point for end in found.ends), key=lambda p: p[0])
    np.testing.assert_allclose(ends, path, atol=1e-7)
    for end in found.ends:
        outward = end.point - np.mean(path, axis=0)
        assert end.direction @ outward / np.linalg.norm(outward) == pytest.approx(1.0)
        assert end.radius == pytest.approx(0.05)
    assert not found.junctions
    assert found.share == pytest.approx(1.0)


@pytest.mark.parametrize("length", [0.002, 0.02, 0.1, 20.0])
def test_length_over_diameter_does_not_matter(length):
    assert line(shapes.tube(0.05, 0.03, length)).length == pytest.approx(length, rel=1e-6)


@pytest.mark.parametrize("sides", [6, 8, 16, 64])
@pytest.mark.parametrize("segments", [4, 12, 30])
@pytest.mark.parametrize("bore", [None, 0.045])
def test_elbow_has_the_length_of_its_arc(sides, segments, bore):
    found = line(tubes.elbow(0.15, 0.05, np.pi / 2, segments, sides, bore))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(QUARTER, rel=0.01)
    np.testing.assert_allclose(found.branches[0].radius, 0.05, rtol=0.05)
    for end in found.ends:
        first = end.point[1] < 0.05
        np.testing.assert_allclose(end.point, [0.15, 0, 0] if first else [0, 0.15, 0], atol=1e-3)
        assert end.direction @ ([0, -1, 0] if first else [-1, 0, 0]) > np.cos(np.radians(1))


@pytest.mark.parametrize("mesh", [
    tubes.pipe(S_BEND, 0.05, 16), tubes.pipe(S_BEND, 0.05, 8, caps=True),
    tubes.soup(tubes.pipe(S_BEND, 0.05, 16, bore=0.045)),
])  # fmt: skip
def test_s_bend_is_one_branch(mesh):
    found = line(mesh)
    assert len(found.branches) == 1
    assert found.length == pytest.approx(1.5 + 2 * QUARTER, rel=0.005)


def test_u_bend_does_not_jump_to_its_other_leg():
    path = tubes.follow([[0, 0, 0], [1, 0, 0]], tubes.arc(0.08, np.pi, 24), [[0, 0, 0], [1, 0, 0]])
    found = line(tubes.pipe(path, 0.05, 16))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(2 + 0.08 * np.pi, rel=0.005)
    assert len(found.ends) == 2


@pytest.mark.parametrize(("pitch", "radius", "tube"), [(0.15, 0.3, 0.05), (0.02, 0.05, 0.005)])
def test_spiral_is_followed_all_the_way(pitch, radius, tube):
    found = line(tubes.pipe(tubes.helix(radius, pitch, 5), tube, 12, caps=True))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(5 * np.hypot(2 * np.pi * radius, pitch), rel=0.01)


def test_ring_is_closed():
    found = line(tubes.elbow(0.2, 0.02, 2 * np.pi, 48))
    assert found.branches[0].closed
    assert not found.ends
    assert found.length == pytest.approx(0.4 * np.pi, rel=0.01)


@pytest.mark.parametrize("angle", [40, 60, 90])
@pytest.mark.parametrize("bore", [None, 0.04])
def test_mitred_corner_joins_two_legs(angle, bore):
    turn = np.radians(angle)
    path = [[0, 0, 0], [1, 0, 0], [1 + np.cos(turn), np.sin(turn), 0]]
    found = line(tubes.pipe(path, 0.05, 16, bore=bore))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(2.0, rel=0.005)
    assert len(found.ends) == 2


def test_many_mitres_make_one_branch():
    path = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0], [2, 1, 1]]
    found = line(tubes.pipe(path, 0.05, 12, caps=True))
    assert len(found.branches) == 1
    np.testing.assert_allclose(np.sort(found.branches[0].points, axis=0), np.sort(path, axis=0), atol=1e-4)


def test_reducer_changes_radius():
    found = line(tubes.pipe([[0, 0, 0], [0.2, 0, 0], [0.4, 0, 0], [0.6, 0, 0]], [0.05, 0.05, 0.03, 0.03], 24))
    assert found.length == pytest.approx(0.6, rel=1e-6)
    assert sorted(round(end.radius, 6) for end in found.ends) == [0.03, 0.05]


def test_flanged_spool_keeps_its_bore_and_shows_its_flanges():
    found = line(shapes.lathe(SPOOL, 24, closed=True))
    assert found.length == pytest.approx(1.02, rel=1e-6)
    branch = found.branches[0]
    np.testing.assert_allclose(branch.bore, 0.04, rtol=1e-6)
    assert branch.radius.max() == pytest.approx(0.1)
    assert branch.radius.min() == pytest.approx(0.05)


def test_solid_spool_is_followed_through_its_flanges():
    solid = [(0, 0), *SPOOL[1:-1], (0, 1.02)]
    found = line(shapes.lathe(solid, 24))
    assert found.length == pytest.approx(1.02, rel=1e-6)
    assert np.isnan(found.branches[0].bore).all()


def test_faces_turned_inward_change_nothing():
    vertices, faces = shapes.tube(0.05, 0.04, 1.0)
    found = line((vertices, faces[:, ::-1]))
    np.testing.assert_allclose(found.branches[0].radius, 0.05)
    np.testing.assert_allclose(found.branches[0].bore, 0.04)


@pytest.mark.parametrize(("run", "branch"), [(0.1, 0.1), (0.1, 0.07), (0.1, 0.04)])
def test_tee_has_one_junction_of_three(run, branch):
    found = line(tubes.tee(run, branch))
    assert len(found.junctions) == 1
    assert len(found.branches) == 3
    assert found.junctions[0].branches == (0, 1, 2)
    np.testing.assert_allclose(found.junctions[0].point, 0, atol=0.05 * run)
    assert len(found.ends) == 3
    assert sorted(round(end.radius, 3) for end in found.ends) == sorted([branch, run, run])
    for b in found.branches:
        assert b.length == pytest.approx(1.0, rel=0.01)


@pytest.mark.parametrize("branch", [0.1, 0.06])
def test_cross_has_one_junction_of_four(branch):
    found = line(tubes.tee(0.1, branch, both=True))
    assert [junction.branches for junction in found.junctions] == [(0, 1, 2, 3)]
    assert len(found.ends) == 4


@pytest.mark.parametrize("foot", [0.0, 0.05, 0.095])
def test_branch_that_only_pierces_or_touches_the_run_makes_a_junction(foot):
    run = tubes.pipe([[-1, 0, 0], [1, 0, 0]], 0.1, 24, bore=0.09)
    found = line(joined(run, tubes.pipe([[0, 0, foot], [0, 0, 1]], 0.06, 24, bore=0.05)))
    assert len(found.junctions) == 1
    assert len(found.branches) == 3


def test_parallel_tubes_stay_apart():
    found = line(joined(tubes.pipe([[-1, 0, 0], [1, 0, 0]], 0.1), tubes.pipe([[-1, 0, 0.5], [1, 0, 0.5]], 0.06)))
    assert len(found.branches) == 2
    assert not found.junctions
    assert len(found.ends) == 4


def test_handwheel_is_a_loop_with_spokes_and_a_hub():
    angles = np.linspace(0, 2 * np.pi, 49)
    rim = tubes.pipe(np.column_stack([0.15 * np.cos(angles), 0.15 * np.sin(angles), 0 * angles]), 0.01, 12)
    spokes = [tubes.pipe(np.outer([0.02, 0.15], [np.cos(a), np.sin(a), 0]), 0.006, 12) for a in (0.0, 2.1, 4.2)]
    found = line(joined(rim, shapes.cylinder(0.03, 0.04), *spokes))
    assert sorted(len(junction.branches) for junction in found.junctions) == [3, 3, 3, 5]
    assert len(found.ends) == 2


@pytest.mark.parametrize("sigma", [0.001, 0.003, 0.01])
def test_noise_on_the_vertices_does_little(sigma):
    vertices, faces = tubes.pipe(S_BEND, 0.05, 16)
    noise = np.random.default_rng(0).normal(size=vertices.shape) * sigma * 0.05
    found = line((vertices + noise, faces))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(1.5 + 2 * QUARTER, rel=0.01)


@pytest.mark.parametrize("seed", range(3))
def test_triangles_as_they_come_do_little(seed):
    found = line(tubes.scattered(0.05, 0.5, sides=32, n=3000, seed=seed))
    assert len(found.branches) == 1
    assert found.length == pytest.approx(0.5, rel=0.005)
    np.testing.assert_allclose(found.branches[0].radius, 0.05, rtol=0.01)


@pytest.mark.parametrize("mesh", [
    shapes.box((1, 2, 3)), shapes.tube(0.1, 0.09, 2.0, 4), shapes.box((1, 1, 0.01)),
    (np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]),
])  # fmt: skip
def test_part_without_round_sections_is_no_tube(mesh):
    result = traced(mesh)[0]
    assert isinstance(result, NotTube)
    assert "round" in result.reason


def test_sphere_is_no_tube():
    result = traced(shapes.sphere())[0]
    assert isinstance(result, NotTube)
    assert "radius changes" in result.reason


def test_pipe_on_a_large_plate_is_no_tube():
    result = traced(
        joined(shapes.box((2, 2, 0.01)), shapes.moved(shapes.cylinder(0.05, 0.5), translation=(0, 0, 0.3)))
    )[0]
    assert isinstance(result, NotTube)
    assert "surface runs along" in result.reason
    assert 0 < result.share < 0.7


def test_meshes_without_area_are_no_tubes():
    empty = (np.zeros((0, 3)), np.zeros((0, 3)))
    point = (np.zeros((3, 3)), [[0, 1, 2]])
    assert [r.reason for r in traced(empty, point)] == ["it has no area"] * 2
    assert traced() == ()


def test_bad_faces_are_left_out():
    vertices, faces = shapes.tube(0.05, 0.04, 1.0)
    vertices = np.concatenate([vertices, [[np.nan] * 3]])
    faces = np.concatenate([faces, [[0, 1, len(vertices) - 1], [0, 1, 9999], [0, 0, 1]]])
    assert line((vertices, faces)).length == pytest.approx(1.0)


def test_any_number_of_workers_gives_the_same():
    meshes = [shapes.tube(), tubes.pipe(S_BEND, 0.05), tubes.tee(0.1, 0.06), shapes.box()] * 3
    one, many = traced(*meshes, workers=1), traced(*meshes, workers=5)
    for a, b in zip(one, many, strict=True):
        assert repr(a) == repr(b)


def test_input_is_not_modified():
    scene = Scene.from_meshes([tubes.tee(0.1, 0.1), tubes.pipe(S_BEND, 0.05)])
    vertices, faces = scene.vertices.copy(), scene.faces.copy()
    trace_centrelines(scene, measure(scene))
    np.testing.assert_array_equal(scene.vertices, vertices)
    np.testing.assert_array_equal(scene.faces, faces)


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**31),
    shift=st.tuples(*[st.floats(-1000, 1000)] * 3),
    scale=st.floats(0.01, 100),
    name=st.sampled_from(["s", "tee", "elbow", "spool"]),
)
def test_rigid_motion_and_scale_change_no_length(seed, shift, scale, name):
    mesh, length = {
        "s": (tubes.pipe(S_BEND, 0.05, 16), 1.5 + 2 * QUARTER),
        "tee": (tubes.tee(0.1, 0.06), 3.0),
        "elbow": (tubes.pipe(tubes.arc(0.15, np.pi / 2, 8), 0.05, 6), QUARTER),
        "spool": (shapes.lathe(SPOOL, 24, closed=True), 1.02),
    }[name]
    moved = shapes.moved((mesh[0] * scale, mesh[1]), Rotation.random(random_state=seed).as_matrix(), shift)
    found = line(moved)
    assert found.length == pytest.approx(length * scale, rel=0.01)
    assert len(found.branches) == (3 if name == "tee" else 1)
