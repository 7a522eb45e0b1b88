import numpy as np
import pytest

import shapes
from cadgraph.draw.render.picture import Renderer
from cadgraph.draw.render.views import ELEVATION, three_quarter_view
from cadgraph.model.scene import Scene


def test_view_is_from_above_and_oblique():
    renderer = Renderer(Scene.from_meshes([shapes.box((4, 1, 1))]))
    direction = three_quarter_view(renderer)
    assert direction[2] == pytest.approx(np.sin(ELEVATION))
    assert abs(direction[0]) > 0.2
    assert direction[1] < -0.2


def test_side_that_shows_more_meshes_wins():
    wall = shapes.box((4, 0.1, 3))
    hidden = [shapes.box((0.3, 0.3, 0.3), (x, 1, z)) for x in (-1, 0, 1) for z in (-1, 0, 1)]
    renderer = Renderer(Scene.from_meshes([wall, *hidden]))
    assert three_quarter_view(renderer)[1] > 0
    assert three_quarter_view(renderer, [0])[1] < 0


def test_meshes_alone_are_seen_from_the_front_whatever_hides_them():
    wall = shapes.box((4, 0.1, 3))
    renderer = Renderer(Scene.from_meshes([wall, shapes.box((1, 1, 1), (0, 1, 0))]))
    assert three_quarter_view(renderer, [1])[1] > 0
    assert three_quarter_view(renderer, [1], alone=True)[1] < 0


def test_another_side_is_chosen_when_asked():
    renderer = Renderer(Scene.from_meshes([shapes.box((4, 1, 1))]))
    first = three_quarter_view(renderer)
    second = three_quarter_view(renderer, unlike=first)
    assert first[:2] @ second[:2] < 0


def test_view_turns_with_the_scene():
    c, s = np.cos(0.3), np.sin(0.3)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    straight = three_quarter_view(Renderer(Scene.from_meshes([shapes.box((4, 1, 1))])))
    turned = three_quarter_view(Renderer(Scene.from_meshes([shapes.moved(shapes.box((4, 1, 1)), turn)])))
    # A box looks alike from its four corners, and either may win by rounding; the angle to its sides is the same.
    back = turn.T @ turned
    np.testing.assert_allclose(np.abs(back), np.abs(straight), atol=0.02)
