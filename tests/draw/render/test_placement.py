import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.draw.render.placement import place_boxes

AREA = (0.0, 0.0, 400.0, 300.0)
spots = st.lists(st.tuples(st.floats(0, 400), st.floats(0, 300)), max_size=25)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


@given(spots)
def test_boxes_stay_inside_and_never_overlap(anchors):
    boxes = place_boxes(anchors, [(50, 18)] * len(anchors), AREA)
    placed = boxes[np.isfinite(boxes).all(axis=1)]
    assert (placed[:, :2] >= 0).all()
    assert (placed[:, 2:] <= (400, 300)).all()
    assert not any(overlap(a, b) for i, a in enumerate(placed) for b in placed[:i])


def test_box_keeps_off_its_anchor_and_off_what_is_taken():
    taken = (0, 0, 400, 140)
    (box,) = place_boxes([(200, 150)], [(50, 18)], AREA, taken=[taken])
    assert not overlap(box, taken)
    assert not overlap(box, (200, 150, 200, 150))


def test_anchor_without_a_place_gets_no_box():
    boxes = place_boxes([(np.nan, np.nan), (50, 50)], [(50, 18)] * 2, AREA)
    assert np.isnan(boxes[0]).all()
    assert np.isfinite(boxes[1]).all()


def test_box_that_finds_no_room_is_left_out():
    assert np.isnan(place_boxes([(50, 50)], [(500, 18)], AREA)).all()


def test_no_anchors():
    assert place_boxes([], np.zeros((0, 2)), AREA).shape == (0, 4)
