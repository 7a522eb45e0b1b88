from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.contact.pairs import find_contacts, find_contacts_placed
from cadgraph.model.scene import Scene

PROTOTYPES = [
    shapes.box((0.2, 0.1, 0.05)),
    shapes.tube(0.2, 0.15, 0.1, 16),
    shapes.cylinder(0.02, 1.0, 12),
    (np.zeros((0, 3)), np.zeros((0, 3), int)),
    shapes.moved(shapes.tube(0.05, 0.04, 2.0, 16), Rotation.from_rotvec([0.5, 0.4, 0.3]).as_matrix(), (3, 2, 1)),
]


def poses_of(seed, n=40, mirrored=False):
    random = np.random.default_rng(seed)
    poses = np.tile(np.eye(4), (n, 1, 1))
    poses[:, :3, :3] = Rotation.random(n, random_state=seed).as_matrix()
    if mirrored:
        poses[::2, :3, 0] *= -1
    poses[:, :3, 3] = random.uniform(-0.8, 0.8, (n, 3))
    poses[4::5, :3, 3] -= np.einsum("nij,j->ni", poses[4::5, :3, :3], [3, 2, 1])
    return np.arange(n) % len(PROTOTYPES), poses


def written_out(kind, poses):
    return Scene.from_meshes(
        [shapes.moved(PROTOTYPES[k], pose[:3, :3], pose[:3, 3]) for k, pose in zip(kind, poses, strict=True)]
    )


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 1 << 30), st.booleans())
def test_placed_shapes_have_the_contacts_of_the_same_scene_written_out(seed, mirrored):
    kind, poses = poses_of(seed, mirrored=mirrored)
    found = find_contacts_placed(Scene.from_meshes(PROTOTYPES), kind, poses, 0.05)
    expected = find_contacts(written_out(kind, poses), 0.05)
    np.testing.assert_array_equal(found.pairs, expected.pairs)
    np.testing.assert_allclose(found.distance, expected.distance, atol=1e-9)
    apart = np.linalg.norm(found.points[:, 1] - found.points[:, 0], axis=1)
    np.testing.assert_allclose(apart, found.distance, atol=1e-9)


def test_identity_placement_is_the_scene_itself():
    meshes = [shapes.box(), shapes.box((1, 1, 1), (1.004, 0, 0)), shapes.sphere(0.5)]
    scene = Scene.from_meshes(meshes)
    found = find_contacts_placed(scene, [0, 1, 2], np.tile(np.eye(4), (3, 1, 1)))
    expected = find_contacts(scene)
    np.testing.assert_array_equal(found.pairs, expected.pairs)
    np.testing.assert_allclose(found.distance, expected.distance, atol=1e-12)


@pytest.mark.parametrize("workers", [1, 4])
def test_workers_change_nothing(workers):
    kind, poses = poses_of(3)
    prototypes = Scene.from_meshes(PROTOTYPES)
    one, many = (find_contacts_placed(prototypes, kind, poses, 0.05, workers=w) for w in (2, workers))
    assert one.points.tobytes() == many.points.tobytes()


def test_nothing_placed_has_no_contacts():
    assert find_contacts_placed(Scene.from_meshes(PROTOTYPES), [], np.zeros((0, 4, 4))).pairs.shape == (0, 2)


@pytest.mark.parametrize(
    ("kind", "pose", "message"),
    [
        ([0], 2 * np.eye(4)[None], "not rigid"),
        ([0], np.full((1, 4, 4), np.nan), "not rigid"),
        ([7], np.eye(4)[None], "there are 5"),
        ([0, 1], np.eye(4)[None], "as many transforms"),
    ],
)
def test_impossible_placements_are_refused(kind, pose, message):
    with pytest.raises(ValueError, match=message):
        find_contacts_placed(Scene.from_meshes(PROTOTYPES), kind, pose)
