import numpy as np
import pytest

import playing
import shapes
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.color import source_colors
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.scene import Scene
from cadgraph.simulate.play.posing import Posing


def test_angles_count_anticlockwise_seen_against_the_axis():
    scene = playing.scene()
    posed = Posing(scene, playing.graph()).turned({"V_001": 90.0})
    lever = scene.paths.index("/lever")
    before, after = scene.mesh(lever)[0], posed.mesh(lever)[0]
    # From +x to +y, seen from above.
    assert np.allclose(after, np.stack([-before[:, 1], before[:, 0], before[:, 2]], axis=1), atol=1e-12)
    others = [k for k in range(scene.n_meshes) if k != lever]
    assert all(np.array_equal(scene.mesh(k)[0], posed.mesh(k)[0]) for k in others)


def test_only_the_named_pieces_of_a_mesh_turn():
    first, second = shapes.box(center=(0.0, 0.0, 0.0)), shapes.box((0.3, 0.1, 0.1), (0.0, 0.0, 1.0))
    points = np.concatenate([first[0], second[0]])
    faces = np.concatenate([np.asarray(first[1]), np.asarray(second[1]) + len(first[0])])
    graph = playing.graph()
    valve = graph.unit("V-001")
    moving = playing.LEVER.model_copy(update={"meshes": ("/body",), "pieces": (1,)})
    nodes = [n.model_copy(update={"mechanism": moving}) if n is valve else n for n in graph.document.nodes]
    graph = type(graph)(graph.document.model_copy(update={"nodes": tuple(nodes)}))
    scene = Scene.from_meshes([(points, faces)], ["/body"])
    moved = (Posing(scene, graph).turned({"V_001": 90.0}).vertices != points).any(axis=1)
    assert moved.tolist() == [False] * len(first[0]) + [True] * len(second[0])


def test_a_picture_of_what_was_moved_is_that_of_the_moved_scene():
    scene = playing.scene()
    posing = Posing(scene, playing.graph())
    posed = posing.turned({"V_001": -60.0})
    camera = frame(scene.vertices, (0.5, -1.0, 0.7), (160, 120))
    look = Look(samples=2, sky_rays=0)
    paint = Paint(source_colors(scene))
    quick = Renderer(scene).moved(posed, posing.movers["V_001"].meshes).picture(camera, paint, look)
    whole = Renderer(posed).picture(camera, paint, look)
    as_drawn = Renderer(scene).picture(camera, paint, look)
    assert np.abs(np.asarray(quick, int) - np.asarray(whole, int)).max() <= 2
    assert np.abs(np.asarray(quick, int) - np.asarray(as_drawn, int)).max() > 50


def test_a_picture_of_another_scene_is_refused():
    with pytest.raises(ValueError, match="not the same scene"):
        Renderer(playing.scene()).moved(playing.scene().select([0, 1]), [0])
