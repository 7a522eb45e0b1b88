import numpy as np
import pytest

import shapes
from cadgraph.draw.render import fineness
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.coarse import coarsened
from cadgraph.draw.render.fineness import Fineness
from cadgraph.draw.render.picture import Paint, Renderer
from cadgraph.model.scene import MeshArrays, Placement, Scene

BALL, BAR = shapes.sphere(0.5, sides=96, rings=48), shapes.box(size=(8, 0.1, 0.1))
SCENE = Scene.from_meshes([BALL, BAR])
BOTH = np.arange(2)


def moved(mesh, shift):
    return np.asarray(mesh[0]) + shift, mesh[1]


def test_fewer_triangles_that_lie_within_a_cell_of_the_mesh():
    coarse = coarsened(SCENE, BOTH, 0.1, 100.0)
    ball = coarse.origin < len(BALL[1])
    assert 50 < ball.sum() < len(BALL[1]) / 4
    radius = np.linalg.norm(coarse.vertices[coarse.faces[ball]], axis=-1)
    assert radius.max() <= 0.5 + 1e-9
    assert radius.min() > 0.5 - 0.1


def test_what_is_thinner_than_a_cell_stays_as_thick():
    coarse = coarsened(SCENE, BOTH, 1.0, 100.0)
    bar = coarse.vertices[coarse.faces[coarse.origin >= len(BALL[1])]].reshape(-1, 3)
    np.testing.assert_allclose(np.ptp(bar, axis=0), (8, 0.1, 0.1))


def test_what_is_large_and_what_fits_no_grid_stays_as_it_is():
    for cell, most in ((0.1, 0.05), (1e-12, 100.0)):
        coarse = coarsened(SCENE, BOTH, cell, most)
        np.testing.assert_array_equal(coarse.origin, np.arange(SCENE.n_triangles))
        np.testing.assert_array_equal(coarse.vertices[coarse.faces], SCENE.triangles())


def test_faces_without_a_place_are_left_out():
    vertices = np.array(BALL[0], np.float64)
    vertices[0] = np.nan
    coarse = coarsened(Scene.from_meshes([(vertices, BALL[1])]), np.array([0]), 1e-12, 100.0)
    without = np.flatnonzero((np.asarray(BALL[1]) != 0).all(axis=1))
    np.testing.assert_array_equal(coarse.origin, without)


def test_shapes_that_are_shared_lie_where_their_meshes_do():
    turn = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    placement = Placement(
        np.array([1, 0, 1]), np.array([turn, np.eye(3), turn]), np.array([[0.0, 0, 3], [1, 2, 3], [9, 0, 0]])
    )
    paths, colors = ("/a", "/b", "/c"), np.full((3, 3), np.nan, np.float32)
    shared = Scene(MeshArrays.of([BALL, BAR]), paths, colors, placement=placement)
    apart = Scene(MeshArrays(shared.vertices, shared.faces, shared.vertex_offsets, shared.face_offsets), paths, colors)
    one, other = (coarsened(scene, np.array([0, 1]), 1e-12, 100.0) for scene in (shared, apart))
    np.testing.assert_array_equal(one.origin, other.origin)
    np.testing.assert_allclose(one.vertices[one.faces], other.vertices[other.faces], atol=1e-12)


def test_few_triangles_are_drawn_as_they_are():
    assert Fineness(SCENE).steps(None, None) == (0.0, 0.0)
    assert Fineness(SCENE).wanted(frame(BALL[0], (0, -1, 0), (96, 64)), None, 1.0) == 0.0


def test_cells_are_finer_for_a_picture_from_nearby(monkeypatch):
    monkeypatch.setattr(fineness, "_MANY", 0)
    many = Fineness(Scene.from_meshes([moved(BALL, (x, 0, 0)) for x in range(40)]))
    far, near = (many.wanted(frame(BALL[0] * size, (0, -1, 0), (960, 640)), None, 1.0) for size in (40, 2))
    assert far > 5 * near > 0
    assert many.steps(None, near)[0] < many.steps(None, far)[0] <= many.usual(None)
    assert 0 < len(many.in_sight(frame(BALL[0], (0, -1, 0), (96, 64)))) < 40


def test_picture_of_very_many_triangles_looks_the_same_and_is_the_same_from_run_to_run(monkeypatch):
    scene = Scene.from_meshes([moved(BALL, (x, y, 0)) for x in range(6) for y in range(6)])
    ghosts = np.arange(36) % 5 == 0
    camera = frame(scene.vertices, (0.4, -1, 0.5), (320, 200))
    whole = np.asarray(Renderer(scene).picture(camera), np.int64)
    monkeypatch.setattr(fineness, "_MANY", 0)
    images = [np.asarray(Renderer(scene, threads).picture(camera), np.int64) for threads in (1, 3)]
    np.testing.assert_array_equal(*images)
    assert np.abs(images[0] - whole).mean() < 0.6
    Renderer(scene).picture(camera, Paint(np.full((36, 3), 0.5, np.float32), ghosted=ghosts))


def test_a_picture_does_not_depend_on_those_before_it(monkeypatch):
    monkeypatch.setattr(fineness, "_MANY", 0)
    scene = Scene.from_meshes([moved(BALL, (x, 0, 0)) for x in range(8)])
    far, near = frame(scene.vertices, (0, -1, 0.3), (200, 120)), frame(BALL[0], (0, -1, 0.3), (200, 120))
    renderer = Renderer(scene)
    renderer.picture(far)
    assert renderer.picture(near).tobytes() == Renderer(scene).picture(near).tobytes()


@pytest.mark.parametrize("cell", [0.05, 0.3])
def test_nothing_is_torn_open(cell):
    coarse = coarsened(SCENE, np.array([0]), cell, 100.0)
    edges = np.sort(np.concatenate([coarse.faces[:, [0, 1]], coarse.faces[:, [1, 2]], coarse.faces[:, [2, 0]]]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] % 2 == 0).all()
