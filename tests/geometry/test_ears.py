import pytest

from cadgraph.geometry.mesh.ears import clip_ears, double_area

ARROW = [(0.0, 0.0), (2.0, -1.0), (0.0, 3.0), (-2.0, -1.0)]


def test_a_concave_outline_is_tiled():
    triangles, n_forced = clip_ears(ARROW, range(4), 1e-12)
    areas = [double_area(*(ARROW[i] for i in triangle)) for triangle in triangles]
    assert n_forced == 0
    assert len(triangles) == 2
    assert min(areas) > 0
    assert sum(areas) == pytest.approx(12.0)


def test_going_round_keeps_a_regular_outline_in_even_triangles():
    octagon = [(1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (3.0, 2.0), (2.0, 3.0), (1.0, 3.0), (0.0, 2.0), (0.0, 1.0)]
    triangles, _ = clip_ears(octagon, range(8), 1e-12, skip=1)
    uses = [sum(corner in triangle for triangle in triangles) for corner in range(8)]
    assert max(uses) < 6  # a fan would use one corner six times


def test_corners_that_are_no_ears_are_counted():
    bow = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)]  # clockwise: nothing turns left
    triangles, n_forced = clip_ears(bow, range(4), 1e-12)
    assert len(triangles) == 2
    assert n_forced == 1
