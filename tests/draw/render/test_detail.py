import numpy as np

import shapes
from cadgraph.draw.render.detail import find_detail
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.target import Target
from cadgraph.model.scene import Scene

LIKE = np.array([0.5, -0.7, 0.5])


def detail_of(mesh):
    scene = Scene.from_meshes([mesh])
    return find_detail(PairRenderer(scene), Target.of(scene, 0), LIKE, (128, 128)), scene


def test_what_is_hollow_is_cut_open_along_its_axis():
    detail, _ = detail_of(shapes.tube(0.1, 0.08, 0.5))
    assert detail.kind == "cut"
    assert detail.closed
    assert abs(detail.cut[2]) < 1e-6
    assert -detail.camera.forward @ detail.cut[:3] > 0.8


def test_what_is_solid_is_not():
    detail, _ = detail_of(shapes.cylinder(0.1, 0.5))
    assert detail.kind == "end"
    assert detail.cut is None
    assert abs(detail.camera.forward[2]) > 0.8


def test_what_is_flat_is_seen_on_its_broad_side():
    detail, _ = detail_of(shapes.box((0.4, 0.3, 0.01)))
    assert detail.kind == "side"
    assert detail.camera.forward[2] < -0.9


def test_a_bar_shows_its_end_close_up():
    detail, scene = detail_of(shapes.box((6, 0.1, 0.05)))
    assert detail.kind == "end"
    places = detail.camera.project(scene.vertices)[0]
    assert np.isfinite(places).all(axis=1).sum() >= 4
    assert abs(detail.camera.forward[0]) > 0.8
    at_end = places[np.abs(scene.vertices[:, 0] - np.sign(-detail.camera.forward[0]) * 3) < 0.01]
    assert np.ptp(at_end, axis=0).max() > 50


def test_the_picture_is_not_empty():
    for mesh in (
        shapes.tube(0.1, 0.08, 0.5),
        shapes.sphere(0.1),
        shapes.box((6, 0.1, 0.05)),
        shapes.box((1, 1, 0.002)),
    ):
        detail, scene = detail_of(mesh)
        image = np.asarray(PairRenderer(scene, plain=True).alone(0, detail.camera, detail.cut)).astype(int)
        assert (np.abs(image - image[:, :1]).max(axis=2) > 20).mean() > 0.1


def test_a_cut_between_the_pieces_of_a_part_is_none():
    pieces = [shapes.moved(shapes.cylinder(0.01, 0.1), translation=(x, y, 0)) for x in (-0.1, 0.1) for y in (-0.1, 0.1)]
    vertices = np.concatenate([v for v, _ in pieces])
    faces = np.concatenate([np.asarray(f) + i * len(pieces[0][0]) for i, (_, f) in enumerate(pieces)])
    detail, _ = detail_of((vertices, faces))
    assert detail.kind != "cut"


def test_a_bent_tube_is_cut_along_its_bend():
    leg = shapes.tube(0.02, 0.015, 0.3)
    across = shapes.moved(leg, np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]), (0.15, 0, 0.15))
    mesh = np.concatenate([leg[0], across[0]]), np.concatenate([leg[1], np.asarray(across[1]) + len(leg[0])])
    detail, _ = detail_of(mesh)
    assert detail.kind == "cut"
    assert abs(detail.cut[1]) > 0.99


def test_the_depth_is_that_of_what_is_shown():
    detail, scene = detail_of(shapes.box((6, 0.1, 0.05)))
    end = scene.vertices[np.sign(scene.vertices[:, 0]) == np.sign(-detail.camera.forward[0])]
    assert abs(((end - detail.camera.eye) @ detail.camera.forward).mean() - detail.depth) < 0.2
