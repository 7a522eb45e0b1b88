import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.draw.render.color import NEUTRAL, distinct_colors, from_hex, source_colors, to_hex, to_linear, to_srgb
from cadgraph.model.scene import Scene


@given(st.lists(st.floats(0, 1), min_size=3, max_size=3))
def test_srgb_round_trip(color):
    np.testing.assert_allclose(to_srgb(to_linear(color)), color, atol=1e-5)


@given(st.integers(0, 0xFFFFFF))
def test_hex_round_trip(number):
    assert to_hex(from_hex(f"#{number:06x}")) == f"#{number:06x}"


def test_text_that_is_no_colour_is_an_error():
    with pytest.raises(ValueError, match="not a colour"):
        from_hex("red")


def test_mesh_without_colour_is_neutral_and_extremes_are_pulled_in():
    triangle = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    scene = Scene.from_meshes([triangle] * 3, colors=[[np.nan] * 3, [0, 0, 0], [1, 1, 1]])
    colors = source_colors(scene)
    assert to_hex(colors[0]) == NEUTRAL
    assert colors[1].min() > 0
    assert colors[2].max() < 1
    assert np.isnan(scene.colors[0]).all()


def test_distinct_colours_differ():
    colors = to_srgb(distinct_colors(12))
    apart = np.linalg.norm(colors[:, None] - colors[None], axis=-1) + np.eye(12)
    assert apart.min() > 0.12
    assert distinct_colors(0).shape == (0, 3)
