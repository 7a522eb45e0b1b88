import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadplants.solids.polygon import circle, rounded_rectangle, section_channel, section_i, triangulate


def area(points):
    x, y = points.T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def filled(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    u, v = b - a, c - a
    return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2


@given(
    st.integers(8, 48),
    st.integers(1, 12),
    st.integers(5, 16),
    st.floats(0.2, 0.8),
)
def test_drilled_disc_is_filled_exactly_once(sides, n_holes, hole_sides, share):
    pitch = 0.7
    room = min(pitch * np.sin(np.pi / n_holes) if n_holes > 1 else 0.2, 0.7 - 0.45, np.cos(np.pi / sides) - 0.7)
    holes = [circle(0.4, sides)]
    for k in range(n_holes):
        angle = (2 * k + 1) * np.pi / n_holes
        holes.append(circle(room * share, hole_sides, (pitch * np.cos(angle), pitch * np.sin(angle))))
    rim = circle(1.0, sides)
    faces = triangulate(rim, tuple(holes))
    points = np.concatenate([rim, *holes])
    parts = filled(points, faces)
    assert (parts > 0).all()
    assert parts.sum() == pytest.approx(area(rim) - sum(area(hole) for hole in holes))
    assert len(faces) == len(points) + 2 * len(holes) - 2


@pytest.mark.parametrize("outline", [section_i(0.2, 0.1, 0.006, 0.009), section_channel(0.08, 0.04, 0.006, 0.007)])
def test_concave_section_is_filled(outline):
    faces = triangulate(outline)
    assert filled(outline, faces).sum() == pytest.approx(area(outline))


def test_rounded_rectangle_without_radius_has_four_corners():
    assert len(rounded_rectangle(2.0, 1.0, 0.0)) == 4
    assert area(rounded_rectangle(2.0, 1.0, 0.0)) == pytest.approx(2.0)


def test_hole_outside_its_outline_is_an_error():
    with pytest.raises(ValueError, match="outside"):
        triangulate(circle(1.0, 12), (circle(0.1, 8, (3.0, 0.0)),))


def test_outline_that_crosses_itself_is_an_error():
    with pytest.raises(ValueError, match="crosses"):
        triangulate(np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]))
