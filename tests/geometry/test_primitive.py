import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
import tubes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.primitive import KINDS, MAX_RESIDUAL, N_SLICES, SURFACES, fit_primitives
from cadgraph.model.scene import Scene


def fitted(*meshes, **options):
    scene = Scene.from_meshes(meshes)
    return fit_primitives(scene, measure(scene), **options)


def joined(*meshes):
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


def around(mesh, radius, n):
    angles = np.arange(n) * 2 * np.pi / n
    return [shapes.moved(mesh, translation=(radius * np.cos(a), radius * np.sin(a), 0)) for a in angles]


def angle_profile():
    outline = np.array([(0, 0), (0.1, 0), (0.1, 0.01), (0.01, 0.01), (0.01, 0.1), (0, 0.1)])
    vertices = np.concatenate([np.column_stack([outline, np.full(6, h)]) for h in (0, 1)])
    walls = [f for i in range(6) for j in [(i + 1) % 6] for f in ([i, j, 6 + j], [i, 6 + j, 6 + i])]
    cap = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
    return vertices, np.array(walls + [f[::-1] for f in cap] + [[i + 6 for i in f] for f in cap])


def handwheel(spokes):
    arms = [
        tubes.pipe(np.outer([0.02, 0.15], [np.cos(a), np.sin(a), 0]), 0.006, 12)
        for a in np.arange(spokes) * 2 * np.pi / spokes
    ]
    return joined(tubes.elbow(0.15, 0.01, 2 * np.pi, 60, 12), shapes.cylinder(0.03, 0.04), *arms)


SPOOL = [(0.04, 0), (0.1, 0), (0.1, 0.02), (0.05, 0.02), (0.05, 1.0), (0.1, 1.0), (0.1, 1.02), (0.04, 1.02)]
NAMED = {
    "sheet": (shapes.box((1, 2, 0)), "plane"),
    "box": (shapes.box((1, 2, 3)), "box"),
    "cube": (shapes.box(), "box"),
    "plate": (shapes.box((2, 1, 0.004)), "box"),
    "sphere": (shapes.sphere(), "sphere"),
    "6-sided rod": (shapes.cylinder(0.05, 0.3, 6), "cylinder"),
    "rod": (shapes.cylinder(0.05, 0.3), "cylinder"),
    "disc": (shapes.cylinder(0.1, 0.005), "cylinder"),
    "tube": (shapes.tube(0.05, 0.04, 0.3), "cylinder"),
    "6-sided tube": (shapes.tube(0.05, 0.04, 0.3, 6), "cylinder"),
    "thin washer": (shapes.tube(0.1, 0.05, 0.001), "cylinder"),
    "open pipe": (tubes.pipe([[0, 0, 0], [0, 0, 1]], 0.05, 12), "cylinder"),
    "soup": (tubes.soup(shapes.tube(0.05, 0.04, 0.3)), "cylinder"),
    "frustum": (shapes.lathe([(0, 0), (0.1, 0), (0.05, 0.2), (0, 0.2)]), "cone"),
    "sharp cone": (shapes.lathe([(0, 0), (0.1, 0), (0, 0.2)]), "cone"),
    "hollow reducer": (shapes.lathe([(0.04, 0), (0.05, 0), (0.03, 0.1), (0.02, 0.1)], closed=True), "cone"),
    "ring": (tubes.elbow(0.2, 0.03, 2 * np.pi, 40, 24), "torus"),
    "square tube": (shapes.tube(0.1, 0.09, 2, 4), "extrusion"),
    "angle profile": (angle_profile(), "extrusion"),
    "spool": (shapes.lathe(SPOOL, 24, closed=True), "revolved"),
    "elbow": (tubes.elbow(0.2, 0.03, np.pi / 2, 24, 24), None),
    "mitre": (tubes.pipe([[0, 0, 0], [1, 0, 0], [1, 1, 0]], 0.05), None),
    "handwheel": (handwheel(5), None),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", NAMED)
def test_simple_part_has_its_kind_in_any_pose(name, seed):
    mesh, kind = NAMED[name]
    turn = np.eye(3) if seed == 0 else Rotation.random(random_state=seed).as_matrix()
    found = fitted(shapes.moved(mesh, turn, (seed * 2.0, -1.0, 3.0)))
    assert found.name(0) == kind
    if kind is not None:
        assert found.residual[0, KINDS.index(kind)] <= MAX_RESIDUAL


@pytest.mark.parametrize("sides", [6, 8, 12, 24, 64])
def test_tube_has_its_dimensions(sides):
    turn = Rotation.random(random_state=1).as_matrix()
    found = fitted(shapes.moved(shapes.tube(0.05, 0.04, 0.3, sides), turn, (1, 2, 3)))
    assert found.residual[0, KINDS.index("cylinder")] < 1e-9
    assert found.radius[0] == pytest.approx(0.05)
    assert found.bore[0] == pytest.approx(0.04)
    assert found.height[0] == pytest.approx(0.3)
    assert found.wall[0] == pytest.approx(0.01)
    assert found.hollow[0]
    assert found.sides[0].tolist() == [sides, sides]
    assert abs(found.axis[0] @ turn[:, 2]) == pytest.approx(1.0)
    np.testing.assert_allclose(found.center[0], [1, 2, 3], atol=1e-9)
    np.testing.assert_allclose(found.outer[0], 0.05, rtol=1e-6)
    np.testing.assert_allclose(found.inner[0], 0.04, rtol=1e-6)
    assert found.shares[0, SURFACES.index("cylindrical")] > 0.9


def test_solid_rod_has_no_bore():
    found = fitted(shapes.cylinder(0.05, 0.3))
    assert not found.hollow[0]
    assert found.bore[0] == 0
    assert np.isnan(found.wall[0])
    np.testing.assert_array_equal(found.inner[0], 0)


def test_pot_is_not_hollow_all_the_way():
    pot = shapes.lathe([(0, 0), (0.1, 0), (0.1, 0.3), (0.08, 0.3), (0.08, 0.1), (0, 0.1)])
    found = fitted(pot)
    assert not found.hollow[0]
    assert np.count_nonzero(found.inner[0] > 0) == pytest.approx(N_SLICES * 2 / 3, abs=1)


def test_cone_has_both_radii():
    found = fitted(NAMED["frustum"][0])
    assert sorted(found.taper[0].round(9)) == [0.05, 0.1]
    assert found.shares[0, SURFACES.index("conical")] > 0.6


def test_ring_has_both_radii():
    found = fitted(NAMED["ring"][0])
    assert found.major[0] == pytest.approx(0.2, rel=1e-6)
    assert found.minor[0] == pytest.approx(0.03, rel=1e-6)
    assert found.shares[0, SURFACES.index("toroidal")] > 0.9


def test_sphere_has_its_radius():
    found = fitted(shapes.moved(shapes.sphere(0.25), translation=(5, 5, 5)))
    assert found.minor[0] == pytest.approx(0.25)
    assert found.shares[0, SURFACES.index("spherical")] > 0.7


def test_spool_shows_its_profile():
    found = fitted(NAMED["spool"][0])
    assert found.outer[0, 0] == pytest.approx(0.1)
    assert found.outer[0, N_SLICES // 2] == pytest.approx(0.05)
    np.testing.assert_allclose(found.inner[0], 0.04)
    assert found.wall[0] == pytest.approx(0.01)


@pytest.mark.parametrize("spokes", [3, 4, 5, 6])
def test_handwheel_has_the_order_of_its_spokes(spokes):
    assert fitted(handwheel(spokes)).order[0] == spokes


@pytest.mark.parametrize("holes", [4, 6, 8, 12])
def test_flange_has_the_order_of_its_holes(holes):
    flange = joined(shapes.tube(0.1, 0.05, 0.02, 48), *around(shapes.cylinder(0.009, 0.021, 12), 0.08, holes))
    found = fitted(flange)
    assert found.order[0] == holes
    assert found.hollow[0]
    assert found.residual[0, KINDS.index("revolved")] == np.inf


@pytest.mark.parametrize(("mesh", "order"), [
    (shapes.cylinder(sides=40), 0), (shapes.sphere(sides=40), 0), (shapes.box((1, 1, 3)), 4),
    (shapes.box((1, 2, 3)), 2), (angle_profile(), 1), (shapes.cylinder(0.1, 0.3, 5), 5),
])  # fmt: skip
def test_order_of_simple_parts(mesh, order):
    assert fitted(shapes.moved(mesh, Rotation.random(random_state=2).as_matrix())).order[0] == order


@pytest.mark.parametrize(("sides", "kind"), [(5, "extrusion"), (6, "cylinder")])
def test_round_starts_at_six_sides(sides, kind):
    assert fitted(shapes.cylinder(0.1, 0.3, sides)).name(0) == kind


@pytest.mark.parametrize(("thickness", "kind"), [(0.0009, "plane"), (0.0011, "box")])
def test_plane_is_thinner_than_any_box(thickness, kind):
    assert fitted(shapes.box((1.0, 1.0, thickness))).name(0) == kind


def test_faces_turned_inward_change_nothing():
    vertices, faces = shapes.tube(0.05, 0.04, 0.3)
    found = fitted((vertices, faces[:, ::-1]))
    assert found.hollow[0]
    assert found.bore[0] == pytest.approx(0.04)


def test_shares_add_up():
    found = fitted(*(mesh for mesh, _ in NAMED.values()))
    np.testing.assert_allclose(found.shares.sum(axis=1), 1.0, atol=1e-9)
    assert (found.shares >= -1e-12).all()


def test_nothing_to_fit_has_no_kind():
    empty = (np.zeros((0, 3)), np.zeros((0, 3)))
    point = (np.zeros((3, 3)), [[0, 1, 2]])
    bad = (np.full((3, 3), np.nan), [[0, 1, 2]])
    found = fitted(empty, point, bad)
    assert found.kind.tolist() == [-1, -1, -1]
    assert found.name(0) is None
    assert np.isinf(found.residual).all()
    assert len(fitted().kind) == 0


def test_single_triangle_is_a_plane():
    assert fitted((np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]])).name(0) == "plane"


def test_bad_faces_are_left_out():
    vertices, faces = shapes.tube(0.05, 0.04, 0.3)
    vertices = np.concatenate([vertices, [[np.nan] * 3]])
    faces = np.concatenate([faces, [[0, 1, len(vertices) - 1], [0, 1, 9999], [0, 0, 1]]])
    assert fitted((vertices, faces)).name(0) == "cylinder"


def test_any_number_of_workers_gives_the_same_bytes():
    meshes = [mesh for mesh, _ in NAMED.values()]
    one, many = fitted(*meshes, workers=1), fitted(*meshes, workers=5)
    for name in vars(one):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes()


def test_input_is_not_modified():
    scene = Scene.from_meshes([mesh for mesh, _ in NAMED.values()])
    properties = measure(scene)
    vertices, box = scene.vertices.copy(), properties.obb_center.copy()
    fit_primitives(scene, properties)
    np.testing.assert_array_equal(scene.vertices, vertices)
    np.testing.assert_array_equal(properties.obb_center, box)


@settings(max_examples=30, deadline=None)
@given(
    name=st.sampled_from(sorted(NAMED)),
    seed=st.integers(0, 2**31),
    shift=st.tuples(*[st.floats(-100, 100)] * 3),
    scale=st.floats(0.05, 20),
)
def test_rigid_motion_and_scale_change_no_kind(name, seed, shift, scale):
    (vertices, faces), kind = NAMED[name]
    moved = shapes.moved((vertices * scale, faces), Rotation.random(random_state=seed).as_matrix(), shift)
    found = fitted((vertices, faces), moved)
    assert found.name(1) == kind
    assert found.order[0] == found.order[1]
    np.testing.assert_allclose(found.radius[1], scale * found.radius[0], rtol=1e-6)
    np.testing.assert_allclose(found.height[1], scale * found.height[0], rtol=1e-6, atol=1e-9 * scale)
