import threading

import numpy as np
import pytest

import shapes
from cadgraph.geometry.visibility import rays
from cadgraph.geometry.visibility.rays import ray_tree


@pytest.fixture(params=["direct", "wrapped"])
def tree_of(request, monkeypatch):
    """Builds trees in one of the two ways, with either of which a machine may have to do."""
    if request.param == "wrapped":
        monkeypatch.setattr(rays, "_files", list)
        rays._library.cache_clear()
    elif rays._library() is None:
        pytest.skip("the library of rays lies somewhere else on this system")
    yield ray_tree
    rays._library.cache_clear()


def heap_of_triangles(n=300, seed=0):
    rng = np.random.default_rng(seed)
    middles = rng.uniform(-1, 1, (n, 1, 3))
    corners = (middles + rng.normal(0, 0.15, (n, 3, 3))).reshape(-1, 3).astype(np.float32)
    return corners, np.arange(3 * n, dtype=np.int32).reshape(-1, 3)


def some_rays(n=500, seed=1):
    rng = np.random.default_rng(seed)
    origins = rng.uniform(-2, 2, (n, 3))
    directions = rng.uniform(-1, 1, (n, 3)) - origins
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return origins.astype(np.float32), directions.astype(np.float32)


def by_hand(corners, faces, origins, directions):
    """``(n, m)`` distance along each ray to each triangle (infinite: missed), and the weights of its corners."""
    a, b, c = (corners.astype(np.float64)[faces[:, i]][None] for i in range(3))
    origins, directions = origins.astype(np.float64)[:, None], directions.astype(np.float64)[:, None]
    p = np.cross(directions, c - a)
    volume = ((b - a) * p).sum(-1)
    to = origins - a
    u = (to * p).sum(-1) / volume
    q = np.cross(to, b - a)
    v = (directions * q).sum(-1) / volume
    distance = ((c - a) * q).sum(-1) / volume
    is_hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (distance > 0)
    return np.where(is_hit, distance, np.inf), u, v


def test_rays_meet_what_a_test_of_all_triangles_says(tree_of):
    corners, faces = heap_of_triangles()
    origins, directions = some_rays()
    found = tree_of(corners, faces).first(origins, directions)
    distance, u, v = by_hand(corners, faces, origins, directions)
    nearest, rows = distance.argmin(axis=1), np.arange(len(origins))
    is_hit = np.isfinite(distance[rows, nearest])
    assert 100 < is_hit.sum() < 400
    np.testing.assert_array_equal(found.face, np.where(is_hit, nearest, -1))
    met = rows[is_hit], nearest[is_hit]
    np.testing.assert_allclose(found.distance[is_hit], distance[met], rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(found.u[is_hit], u[met], atol=1e-3)
    np.testing.assert_allclose(found.v[is_hit], v[met], atol=1e-3)
    a, b, c = (corners[faces[nearest[is_hit], i]] for i in range(3))
    across = np.cross(found.normal[is_hit], np.cross(b - a, c - a))
    np.testing.assert_allclose(across, 0, atol=1e-4)


def test_rays_are_blocked_before_their_length_alone(tree_of):
    corners, faces = heap_of_triangles()
    origins, directions = some_rays()
    nearest = by_hand(corners, faces, origins, directions)[0].min(axis=1)
    lengths = np.linspace(0.1, 2.0, len(origins)).astype(np.float32)
    answer = tree_of(corners, faces).blocked(origins, directions, lengths)
    assert 20 < answer.sum() < 300
    np.testing.assert_array_equal(answer, nearest < lengths)


def test_both_ways_agree_to_the_bit():
    if rays._library() is None:
        pytest.skip("the library of rays lies somewhere else on this system")
    corners, faces = heap_of_triangles(2000, seed=5)
    origins, directions = some_rays(3000, seed=6)
    found = ray_tree(corners, faces).first(origins, directions)
    other = rays._Wrapped(corners, faces).first(origins, directions)
    is_hit = found.face >= 0
    np.testing.assert_array_equal(found.face, other.face)
    for own, others in zip(found[1:], other[1:], strict=True):
        np.testing.assert_array_equal(own[is_hit], others[is_hit])


def test_no_rays_and_no_triangles(tree_of):
    corners, faces = heap_of_triangles(5)
    none = np.zeros((0, 3), np.float32)
    tree = tree_of(corners, faces)
    assert len(tree.first(none, none).face) == 0
    assert len(tree.blocked(none, none, np.zeros(0, np.float32))) == 0
    empty = tree_of(none, np.zeros((0, 3), np.int32))
    assert empty.first(*some_rays(3)).face.tolist() == [-1, -1, -1]


def test_one_origin_may_stand_for_many(tree_of):
    vertices, faces = shapes.box()
    towards = np.array([[0, 0, -1], [0, 0, 1], [1, 0, 0]], np.float32)
    eye = np.broadcast_to(np.array([0.1, 0.2, 3], np.float32), towards.shape)
    found = tree_of(vertices.astype(np.float32), faces.astype(np.int32)).first(eye, towards)
    assert (found.face >= 0).tolist() == [True, False, False]


def test_threads_get_the_same_as_one_alone(tree_of):
    corners, faces = heap_of_triangles(1000)
    origins, directions = some_rays(20_000)
    tree = tree_of(corners, faces)
    alone = tree.first(origins, directions).face
    answers = {}

    def cast(number):
        answers[number] = tree.first(origins, directions).face

    threads = [threading.Thread(target=cast, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for answer in answers.values():
        np.testing.assert_array_equal(answer, alone)
    assert len(answers) == 4


def test_what_is_no_library_or_one_of_another_version_is_passed_over(monkeypatch, tmp_path):
    with monkeypatch.context() as patch:
        (tmp_path / "libembree4.so").write_bytes(b"not a library")
        patch.setattr(rays, "_files", lambda: [tmp_path / "libembree4.so"])
        rays._library.cache_clear()
        assert rays._library() is None
    monkeypatch.setattr(rays, "_VERSIONS", range(0))
    rays._library.cache_clear()
    assert rays._library() is None
    rays._library.cache_clear()
