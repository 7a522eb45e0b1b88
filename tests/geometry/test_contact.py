from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.contact.pairs import distances, find_contacts, touching
from cadgraph.geometry.kernels.tree import build_forest
from cadgraph.model.scene import Scene
from geometry import peers

EPS = 0.01


def scene_of(*meshes):
    return Scene.from_meshes(meshes)


def pairs_of(contacts):
    return [tuple(map(int, pair)) for pair in contacts.pairs]


def mixed_meshes(seed, n=30, size=1.0):
    """Parts of many kinds, aspect ratios and sizes in random poses, long bars askew among them."""
    random = np.random.default_rng(seed)
    meshes = []
    for _ in range(n):
        s = size * 10 ** random.uniform(-1.5, 0)
        mesh = [
            lambda s=s: shapes.box((s, s * 0.2, s * 0.1)),
            lambda s=s: shapes.cylinder(s * 0.1, s, 12),
            lambda s=s: shapes.tube(s * 0.5, s * 0.4, s * 0.3, 16),
            lambda s=s: shapes.sphere(s * 0.5, 12, 8),
            lambda: shapes.cylinder(0.01 * size, 4 * size, 8),
        ][random.integers(5)]()
        turn = Rotation.random(random_state=int(random.integers(1 << 30))).as_matrix()
        meshes.append(shapes.moved(mesh, turn, random.uniform(-1, 1, 3) * size))
    return meshes


class TestLimit:
    def box_pair(self, gap):
        return scene_of(shapes.box((1, 1, 1)), shapes.box((1, 1, 1), (1 + gap, 0, 0)))

    @pytest.mark.parametrize("gap", [0.0, 0.005, EPS, EPS + 0.9e-9])
    def test_gap_up_to_the_limit_is_near(self, gap):
        found = find_contacts(self.box_pair(gap), EPS)
        assert pairs_of(found) == [(0, 1)]
        assert found.distance[0] == pytest.approx(gap, abs=1e-12)
        assert pairs_of(find_contacts(self.box_pair(gap), EPS)) == [tuple(p) for p in touching(self.box_pair(gap), EPS)]

    @pytest.mark.parametrize("gap", [EPS + 1.1e-9, EPS + 1e-6, 0.5])
    def test_gap_over_the_limit_is_not_near(self, gap):
        assert len(find_contacts(self.box_pair(gap), EPS).pairs) == 0
        assert len(touching(self.box_pair(gap), EPS)) == 0

    @pytest.mark.parametrize(("gap", "expected"), [(0.9e-9, 0.0), (1.1e-9, 1.1e-9)])
    def test_a_billionth_of_a_metre_is_zero(self, gap, expected):
        assert find_contacts(self.box_pair(gap), EPS).distance[0] == pytest.approx(expected, abs=1e-15)

    def test_limit_of_zero_finds_what_touches(self):
        assert pairs_of(find_contacts(self.box_pair(0.0), 0.0)) == [(0, 1)]
        assert pairs_of(find_contacts(self.box_pair(1e-8), 0.0)) == []

    @pytest.mark.parametrize("eps", [-0.01, np.nan, np.inf])
    def test_impossible_limit_is_refused(self, eps):
        with pytest.raises(ValueError, match="eps"):
            find_contacts(self.box_pair(0), eps)

    def test_no_workers_is_refused(self):
        with pytest.raises(ValueError, match="workers"):
            find_contacts(self.box_pair(0), workers=0)


class TestTouch:
    @pytest.mark.parametrize(
        "center", [(1, 1, 1), (1, 1, 0), (1, 0, 0), (1, 0.5, 0.5), (0.25, 0.25, 0.25)],
        ids=["corner", "edge", "face", "part of a face", "overlap"],
    )  # fmt: skip
    def test_boxes_that_meet_are_at_distance_zero(self, center):
        found = find_contacts(scene_of(shapes.box(), shapes.box((1, 1, 1), center)), EPS)
        assert found.distance.tolist() == [0.0]

    def test_piercing_bar_is_at_distance_zero(self):
        found = find_contacts(scene_of(shapes.box((1, 1, 0.001)), shapes.box((0.01, 0.01, 3))), 0.0)
        assert found.distance.tolist() == [0.0]

    def test_mesh_inside_another_without_touching_is_not_near(self):
        assert len(find_contacts(scene_of(shapes.sphere(1.0), shapes.sphere(0.5)), EPS).pairs) == 0

    def test_mesh_inside_another_close_to_its_wall_is_near(self):
        found = find_contacts(scene_of(shapes.box((1, 1, 1)), shapes.box((0.99, 0.99, 0.99))), EPS)
        assert found.distance[0] == pytest.approx(0.005)

    def test_closest_points_lie_on_first_and_second(self):
        found = find_contacts(scene_of(shapes.sphere(0.5), shapes.sphere(0.5), shapes.box((1, 1, 1), (0, 0, 1.004))))
        assert pairs_of(found) == [(0, 1), (0, 2), (1, 2)]
        np.testing.assert_allclose(found.points[1], [[0, 0, 0.5], [0, 0, 0.504]], atol=1e-12)


class TestDegenerate:
    def test_empty_scene_has_no_contacts(self):
        found = find_contacts(scene_of())
        assert found.pairs.shape == (0, 2)
        assert found.distance.shape == (0,)
        assert found.points.shape == (0, 2, 3)

    def test_one_mesh_has_no_contacts(self):
        assert len(find_contacts(scene_of(shapes.box())).pairs) == 0

    def test_meshes_without_valid_faces_take_part_in_nothing(self):
        nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
        points_only = (np.zeros((4, 3)), np.zeros((0, 3), int))
        not_finite = (np.full((3, 3), np.nan), np.array([[0, 1, 2]]))
        out_of_range = (np.zeros((3, 3)), np.array([[0, 1, 3], [-1, 0, 1]]))
        scene = scene_of(nothing, shapes.box(), points_only, not_finite, out_of_range, shapes.box())
        assert pairs_of(find_contacts(scene)) == [(1, 5)]
        assert np.isinf(distances(scene, [(0, 1), (3, 1), (1, 4)])[0]).all()
        assert build_forest(scene).counts.tolist() == [0, 12, 0, 0, 0, 12]

    @pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
    def test_faces_with_a_corner_that_is_not_finite_are_left_out(self, value):
        vertices, faces = shapes.box()
        vertices = np.vstack([vertices, [[value, 0, 0], [0.5, 5, 0]]])
        damaged = (vertices, np.vstack([faces, [[0, 1, 8], [9, 8, 9]]]))
        scene = scene_of(damaged, shapes.box((1, 1, 1), (1.005, 0, 0)), shapes.box((1, 1, 1), (0, 5.5, 0)))
        found = find_contacts(scene)
        assert pairs_of(found) == [(0, 1)]
        assert found.distance[0] == pytest.approx(0.005)

    def test_faces_without_area_count_as_the_segments_and_points_that_they_are(self):
        segment = (np.array([[0, 0, -1.0], [0, 0, 1], [0, 0, 0]]), np.array([[0, 1, 2]]))
        point = (np.array([[0, 0, 0.505]]), np.array([[0, 0, 0]]))
        found = find_contacts(scene_of(shapes.box(), segment, point))
        assert pairs_of(found) == [(0, 1), (0, 2), (1, 2)]
        np.testing.assert_allclose(found.distance, [0, 0.005, 0], atol=1e-12)

    def test_duplicate_vertices_change_nothing(self):
        vertices, faces = shapes.sphere(0.5)
        soup = (vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
        other = shapes.box((1, 1, 1), (0, 0, 1.003))
        assert (
            find_contacts(scene_of(soup, other)).distance == find_contacts(scene_of((vertices, faces), other)).distance
        )

    def test_huge_coordinates_do_not_crash(self):
        wild = (np.array([[1e300, 0, 0], [0, 1e300, 0], [0, 0, -1e300]]), np.array([[0, 1, 2]]))
        find_contacts(scene_of(wild, shapes.box(), wild))

    def test_coordinates_of_a_national_grid_keep_the_limit_exact(self):
        # 2.4e7 m: what float64 resolves there is 4e-9 m, so gaps are chosen on that grid
        far = np.array([2.4e7, 1.2e7, 0.0])
        step = 2.0**-28
        near, beyond = np.floor(EPS / step) * step, np.ceil(EPS / step + 1) * step
        for gap, expected in ((near, 1), (beyond, 0)):
            meshes = [shapes.box(), shapes.box((1, 1, 1), (1 + gap, 0, 0))]
            scene = scene_of(*(shapes.moved(mesh, translation=far) for mesh in meshes))
            assert len(find_contacts(scene).pairs) == expected


class TestPeers:
    @pytest.mark.parametrize("seed", range(3))
    @pytest.mark.parametrize("peer", [peers.coal_distance, peers.fcl_distance])
    def test_random_scene_has_the_pairs_and_distances_of_a_peer(self, seed, peer):
        meshes = mixed_meshes(seed)
        eps = 0.05
        found = find_contacts(scene_of(*meshes), eps)
        distance = peer(meshes)
        expected = {(i, j): distance(i, j) for i, j in combinations(range(len(meshes)), 2)}
        near = {pair: d for pair, d in expected.items() if d <= eps}
        assert pairs_of(found) == list(near)
        np.testing.assert_allclose(found.distance, list(near.values()), atol=1e-9)

    @pytest.mark.slow
    def test_small_scene_has_the_pairs_and_distances_of_brute_force(self):
        meshes = mixed_meshes(11, 9, size=0.5)
        expected = [peers.brute_force(meshes[i], meshes[j]) for i, j in combinations(range(9), 2)]
        found, points = distances(scene_of(*meshes), list(combinations(range(9), 2)))
        np.testing.assert_allclose(found, expected, atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(points[:, 1] - points[:, 0], axis=1), expected, atol=1e-9)

    def test_scene_of_degenerate_faces_has_the_distances_of_brute_force(self):
        random = np.random.default_rng(4)
        meshes = []
        for _ in range(12):
            vertices = random.normal(size=(12, 3))
            vertices[6:] = np.repeat(vertices[:3], 2, axis=0)
            meshes.append((vertices, random.integers(0, 12, (14, 3))))
        expected = [peers.brute_force(meshes[i], meshes[j]) for i, j in combinations(range(12), 2)]
        found, _ = distances(scene_of(*meshes), list(combinations(range(12), 2)))
        np.testing.assert_allclose(found, expected, atol=1e-9)


class TestSameOutput:
    @pytest.mark.parametrize("workers", [1, 2, 5])
    def test_any_number_of_workers_gives_the_same_bytes(self, workers):
        scene = scene_of(*mixed_meshes(1, 60))
        reference, found = find_contacts(scene, 0.05, workers=3), find_contacts(scene, 0.05, workers=workers)
        for name in ("pairs", "distance", "points"):
            assert getattr(found, name).tobytes() == getattr(reference, name).tobytes()

    @pytest.mark.slow
    def test_input_is_unmodified_and_may_be_read_only(self):
        scene = scene_of(*mixed_meshes(2, 10))
        before = find_contacts(scene)
        for array in (scene.vertices, scene.faces, scene.vertex_offsets, scene.face_offsets):
            array.flags.writeable = False
        assert find_contacts(scene).distance.tobytes() == before.distance.tobytes()

    @settings(max_examples=15, deadline=None)
    @given(st.integers(0, 1 << 30))
    def test_order_of_meshes_changes_nothing(self, seed):
        meshes = mixed_meshes(seed, 20)
        order = np.random.default_rng(seed).permutation(len(meshes))
        found, shuffled = (
            find_contacts(scene_of(*meshes), 0.05),
            find_contacts(scene_of(*(meshes[i] for i in order)), 0.05),
        )
        there = np.sort(order[shuffled.pairs], axis=1)
        rows = np.lexsort((there[:, 1], there[:, 0]))
        np.testing.assert_array_equal(there[rows], found.pairs)
        np.testing.assert_allclose(shuffled.distance[rows], found.distance, atol=1e-12)

    @settings(max_examples=15, deadline=None)
    @given(st.integers(0, 1 << 30))
    def test_rigid_motion_changes_nothing(self, seed):
        meshes = mixed_meshes(seed, 20)
        turn, shift = Rotation.random(random_state=seed).as_matrix(), np.random.default_rng(seed).uniform(-50, 50, 3)
        moved = [shapes.moved(mesh, turn, shift) for mesh in meshes]
        found, after = find_contacts(scene_of(*meshes), 0.05), find_contacts(scene_of(*moved), 0.05)
        np.testing.assert_array_equal(after.pairs, found.pairs)
        np.testing.assert_allclose(after.distance, found.distance, atol=1e-9)

    @settings(max_examples=10, deadline=None)
    @given(st.integers(0, 1 << 30), st.floats(0, 0.2))
    def test_yes_or_no_finds_the_same_pairs(self, seed, eps):
        scene = scene_of(*mixed_meshes(seed, 20))
        np.testing.assert_array_equal(touching(scene, eps), find_contacts(scene, eps).pairs)


class TestGivenPairs:
    def test_distances_follow_the_pairs_in_either_order(self):
        scene = scene_of(shapes.box(), shapes.box((1, 1, 1), (3, 0, 0)), shapes.box((1, 1, 1), (0, 6, 0)))
        found, points = distances(scene, [(1, 0), (0, 2), (1, 0)])
        np.testing.assert_allclose(found, [2, 5, 2])
        np.testing.assert_allclose(points[0, :, 0], [2.5, 0.5])

    @pytest.mark.parametrize(("limit", "expected"), [(2.0, 2.0), (1.9999, np.inf)])
    def test_distance_beyond_the_limit_is_infinite(self, limit, expected):
        scene = scene_of(shapes.box(), shapes.box((1, 1, 1), (3, 0, 0)))
        found, points = distances(scene, [(0, 1)], limit)
        assert found[0] == expected
        assert np.isnan(points).all() == np.isinf(expected)

    def test_unknown_mesh_is_refused(self):
        with pytest.raises(ValueError, match="the scene has 1"):
            distances(scene_of(shapes.box()), [(0, 1)])

    def test_no_pairs_give_no_distances(self):
        assert distances(scene_of(shapes.box()), [])[0].shape == (0,)

    def test_masks_keep_the_pairs_between_them(self):
        scene = scene_of(*(shapes.box((1, 1, 1), (x, 0, 0)) for x in range(4)))
        small = np.array([True, False, False, True])
        assert pairs_of(find_contacts(scene, between=(small, ~small))) == [(0, 1), (2, 3)]


class TestHostile:
    """Small versions of what broke other designs; the benchmarks hold the large ones."""

    def test_diagonal_slivers(self):
        random = np.random.default_rng(3)
        bars = []
        for _ in range(30):
            turn = Rotation.random(random_state=int(random.integers(1 << 30))).as_matrix()
            bars.append(shapes.moved(shapes.tube(0.05, 0.04, 16, 16), turn, random.uniform(-2, 2, 3)))
        found = find_contacts(scene_of(*bars))
        distance = peers.coal_distance(bars)
        assert pairs_of(found) == [p for p in combinations(range(30), 2) if distance(*p) <= EPS]

    def test_crossed_slivers_within_one_mesh_against_small_parts(self):
        # one truss of bars in all directions has no axes of its own
        random = np.random.default_rng(5)
        bars = [
            shapes.moved(shapes.box((16, 0.02, 0.02)), Rotation.random(random_state=k).as_matrix()) for k in range(12)
        ]
        start = np.cumsum([0] + [len(v) for v, _ in bars[:-1]])
        truss = np.vstack([v for v, _ in bars]), np.vstack([f + s for (_, f), s in zip(bars, start, strict=True)])
        small = [shapes.box((0.2, 0.2, 0.2), random.uniform(-2, 2, 3)) for _ in range(60)]
        found = find_contacts(scene_of(truss, *small))
        distance = peers.coal_distance([truss, *small])
        assert pairs_of(found) == [p for p in combinations(range(61), 2) if distance(*p) <= EPS]

    def test_plate_under_many_bolts(self):
        n = 40
        x, y = np.meshgrid(np.linspace(0, 4, n + 1), np.linspace(0, 4, n + 1), indexing="ij")
        plate = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
        at = np.arange(n * (n + 1)).reshape(n, n + 1)[:, :n].ravel()
        faces = np.concatenate(
            [np.column_stack([at, at + n + 1, at + 1]), np.column_stack([at + 1, at + n + 1, at + n + 2])]
        )
        random = np.random.default_rng(0)
        gaps = np.where(random.uniform(size=50) < 0.5, 0.008, 0.012)
        bolts = [
            shapes.moved(shapes.cylinder(0.01, 0.05, 12), translation=(*random.uniform(0.1, 3.9, 2), 0.025 + gap))
            for gap in gaps
        ]
        found = find_contacts(scene_of((plate, faces), *bolts), between=(np.arange(51) == 0, np.arange(51) > 0))
        np.testing.assert_array_equal(found.pairs[:, 1], 1 + np.flatnonzero(gaps < EPS))
        np.testing.assert_allclose(found.distance, 0.008, atol=1e-12)

    @pytest.mark.parametrize(("gap", "expected"), [(0.0099, 1), (0.0101, 0)])
    def test_concentric_spheres_just_within_and_beyond_the_limit(self, gap, expected):
        # the corners of the inner one are closest to the faces of the outer one, so the gap is set by these
        inner, outer = shapes.sphere(1.0, 48, 24), shapes.sphere(2.0, 48, 24)
        corners = outer[0][outer[1]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        least = np.abs((corners[:, 0] * normal).sum(1) / np.linalg.norm(normal, axis=1)).min()
        inner = inner[0] * (least - gap), inner[1]
        turned = shapes.moved(inner, Rotation.from_rotvec([0.3, 0.2, 0.1]).as_matrix())
        exact = peers.coal_distance([turned, outer])(0, 1)
        found = find_contacts(scene_of(turned, outer))
        assert exact >= gap - 1e-9
        assert len(found.pairs) == (exact <= EPS)
        if expected:
            assert len(found.pairs) == 1

    def test_bin_of_bolts(self):
        random = np.random.default_rng(9)
        bolts = [
            shapes.moved(
                shapes.cylinder(0.008, 0.06, 10),
                Rotation.random(random_state=k).as_matrix(),
                random.uniform(0, 0.25, 3),
            )
            for k in range(60)
        ]
        found = find_contacts(scene_of(*bolts))
        distance = peers.coal_distance(bolts)
        assert pairs_of(found) == [p for p in combinations(range(60), 2) if distance(*p) <= EPS]
