import numpy as np
import pytest
from PIL import Image

import shapes
from cadgraph.draw.render.annotation import LegendEntry, Mark, Segment, Tag, annotate
from cadgraph.draw.render.camera import frame

VERTICES = shapes.box()[0]
CAMERA = frame(VERTICES, (0, -1, 0.001), (320, 200))
WHITE = Image.new("RGB", (320, 200), "white")


def changed(image):
    return (np.asarray(image) != 255).any(axis=2)


def test_nothing_to_draw_changes_nothing():
    assert annotate(WHITE, CAMERA).image.tobytes() == WHITE.tobytes()


def test_segment_is_drawn_where_its_points_are():
    image = annotate(WHITE, CAMERA, segments=[Segment((-0.5, 0, 0), (0.5, 0, 0), "#ff0000")]).image
    drawn = np.asarray(image).astype(int)
    for x in (-0.4, 0, 0.4):
        column, row = CAMERA.project([[x, 0, 0]])[0][0].astype(int)
        assert drawn[row, column, 0] > drawn[row, column, 1] + 100
    assert changed(WHITE).sum() == 0


def test_mark_is_a_ball_of_its_radius():
    image = annotate(WHITE, CAMERA, marks=[Mark((0, 0, 0), "#ff0000", radius=20)]).image
    rows, columns = np.nonzero(changed(image))
    scale = max(0.5, 200 / 800)
    assert np.ptp(rows) == pytest.approx(2 * 20 * scale, abs=2)
    assert (rows.mean(), columns.mean()) == pytest.approx(CAMERA.project([[0, 0, 0]])[0][0][::-1], abs=1)


def test_tags_stay_inside_the_picture():
    tags = [Tag(tuple(v), f"V-{i:03d}") for i, v in enumerate(VERTICES)]
    image = annotate(WHITE, CAMERA, tags=tags).image
    assert changed(image).any()
    assert not changed(image)[:2].any()


def test_what_lies_behind_the_camera_is_left_out():
    camera = frame(VERTICES, (0, -1, 0), (320, 200))
    behind = tuple(camera.eye - 3 * camera.forward)
    image = annotate(
        WHITE, camera, segments=[Segment(behind, (0, 0, 0))], marks=[Mark(behind)], tags=[Tag(behind, "V-001")]
    ).image
    assert image.tobytes() == WHITE.tobytes()


def test_legend_is_drawn_in_the_lower_left():
    image = annotate(WHITE, CAMERA, legend=[LegendEntry("#8a45e6", "pipe"), LegendEntry("#d3d8de", "none", True)]).image
    rows, columns = np.nonzero(changed(image))
    assert rows.min() > 100
    assert columns.max() < 160


def test_same_bytes_from_run_to_run():
    def draw():
        return annotate(
            WHITE, CAMERA, segments=[Segment((0, 0, 0), (0.5, 0, 0.5))], marks=[Mark((0, 0, 0))],
            tags=[Tag((0, 0, 0), "V-001")], legend=[LegendEntry("#8a45e6", "pipe")],
        ).image.tobytes()  # fmt: skip

    assert draw() == draw()


def test_tags_that_stand_in_the_way_are_left_out_of_a_crowded_picture_and_counted():
    tags = [Tag((x / 20, 0, z / 20), f"V-{x}{z}") for x in range(-9, 10, 3) for z in range(-9, 10, 3)]
    marks = [Mark(tag.point) for tag in tags]
    everything = annotate(WHITE, CAMERA, tags=tags, marks=marks)
    calm = annotate(WHITE, CAMERA, tags=tags, marks=marks, clutter=3.0)
    assert 0 < calm.tagged < everything.tagged
    assert annotate(WHITE, CAMERA, tags=tags[:1], clutter=3.0).tagged == 1


def test_of_marks_on_the_same_dots_the_nearest_shows():
    marks = [Mark((0, 0, 0), "#ff0000"), *(Mark((0, 1e-6 * k, 0), "#00ff00") for k in range(1, 9))]
    both = annotate(WHITE, CAMERA, marks=marks).image
    alone = annotate(WHITE, CAMERA, marks=[marks[0], marks[1]]).image
    assert np.abs(np.asarray(both).astype(int) - np.asarray(alone)).max() <= 2
