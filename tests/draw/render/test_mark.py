import numpy as np
import pytest

import shapes
from cadgraph.draw.render.color import from_hex
from cadgraph.draw.render.mark import MARKS, choose_mark
from cadgraph.model.scene import Scene


def painted(*colors):
    linear = [from_hex(color) if color else np.full(3, np.nan) for color in colors]
    return Scene.from_meshes([shapes.box() for _ in colors], colors=linear)


@pytest.mark.parametrize("mark", MARKS, ids=lambda mark: mark.name)
def test_a_colour_that_the_scene_has_is_not_taken(mark):
    assert choose_mark(painted(None, mark.color)).name != mark.name


def test_the_colour_left_over_is_taken():
    for left in MARKS:
        others = [mark.color for mark in MARKS if mark != left]
        assert choose_mark(painted(None, *others)) == left


def test_scenes_without_colours_have_a_mark():
    assert choose_mark(painted(None, None)) in MARKS
    assert choose_mark(Scene.from_meshes([])) in MARKS


def test_neither_order_nor_noise_matter():
    colors = ["#1f77b4", "#d62728", "#888888", "#e0c020"]
    scene = painted(*colors)
    assert choose_mark(painted(*colors[::-1])) == choose_mark(scene)
    noisy = Scene.from_meshes([shapes.box()] * 4, colors=scene.colors * (1 + 1e-6))
    assert choose_mark(noisy) == choose_mark(scene)
