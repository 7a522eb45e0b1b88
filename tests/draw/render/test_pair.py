import numpy as np
import pytest

import shapes
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.scalebar import draw_scale_bar, length_text, round_length
from cadgraph.model.scene import Scene

SIZE = (96, 96)
SCENE = Scene.from_meshes(
    [shapes.box((0.2, 0.2, 0.2)), shapes.box((0.2, 0.05, 0.5), (0.1, -0.3, 0)), shapes.box((4, 4, 0.1), (0, 0, -0.3))],
    colors=[[0.1, 0.1, 0.6], [0.05, 0.5, 0.05], [0.4, 0.4, 0.4]],
)


def camera_of(direction=(0.1, -1, 0.2), size=SIZE, margin=0.25):
    return frame(SCENE.mesh(0)[0], direction, size, margin=margin)


def pixels(image):
    return np.asarray(image).astype(int)


def magenta(image):
    red, green, blue = pixels(image).reshape(-1, 3).T
    return ((red > green + 120) & (blue > green + 60)).sum()


def test_both_pictures_have_the_size_of_the_camera():
    pair = PairRenderer(SCENE).pair(0, camera_of())
    assert pair.context.size == pair.alone.size == SIZE
    assert pair.context.mode == "RGB"


def test_the_second_picture_shows_the_target_alone():
    alone = pixels(PairRenderer(SCENE, plain=True).pair(0, camera_of()).alone)
    red, green, blue = alone.reshape(-1, 3).T
    assert ((blue > red + 60) & (blue > green + 60)).sum() > 500
    assert not (green > blue + 40).any()


def test_share_that_is_in_sight():
    renderer = PairRenderer(SCENE, plain=True)
    hidden = renderer.pair(0, camera_of())
    assert 0.2 < hidden.visible < 0.8
    assert renderer.pair(0, camera_of(), [1]).visible > 0.95
    assert renderer.pair(0, camera_of((0, 1, 0.2))).visible > 0.95


def test_what_is_cut_away_is_not_drawn():
    renderer = PairRenderer(SCENE, plain=True)
    red, green, blue = pixels(renderer.pair(0, camera_of(), [1]).context).reshape(-1, 3).T
    assert not ((green > blue + 40) & (green > red + 40)).any()


def test_a_target_right_behind_what_is_cut_away_is_still_drawn():
    scene = Scene.from_meshes([shapes.box((0.2, 0.2, 0.2)), shapes.box((0.4, 0.2, 0.4), (0, -0.2, 0))])
    camera = frame(scene.mesh(0)[0], (0, -1, 0.001), SIZE, margin=0.25)
    assert PairRenderer(scene, plain=True).pair(0, camera, [1]).visible > 0.95


def test_the_mark_is_only_in_the_first_picture_and_only_where_asked():
    marked = PairRenderer(SCENE).pair(0, camera_of())
    assert magenta(marked.context) > 50
    assert magenta(marked.alone) == 0
    assert magenta(PairRenderer(SCENE, plain=True).pair(0, camera_of()).context) == 0


def test_same_bytes_from_run_to_run_and_after_other_pairs():
    renderer = PairRenderer(SCENE)
    first = renderer.pair(0, camera_of()).context.tobytes()
    renderer.pair(2, frame(SCENE.mesh(2)[0], (1, 1, 1), SIZE))
    assert renderer.pair(0, camera_of()).context.tobytes() == first
    assert PairRenderer(SCENE).pair(0, camera_of()).context.tobytes() == first


def test_edges_are_anti_aliased():
    alone = PairRenderer(SCENE, plain=True).pair(0, camera_of((1, -2, 1))).alone
    values = pixels(alone)[:, :, 2]
    sharp = np.unique(values).size
    assert sharp > 20


def test_the_mark_has_the_colour_that_was_chosen_and_the_others_lose_theirs():
    image = pixels(PairRenderer(SCENE, mark="#ff7a00").pair(0, camera_of()).context).reshape(-1, 3)
    red, green, blue = image.T
    assert ((red > green + 60) & (green > blue + 40)).sum() > 300
    plain = pixels(PairRenderer(SCENE, plain=True).pair(0, camera_of()).context).reshape(-1, 3)
    assert (plain[:, 1] - plain[:, 0]).max() > 60
    others = image[red <= green + 20]
    assert (others[:, 1] - others[:, 0]).max() < 30


def test_what_is_cut_away_is_left_as_a_ghost():
    camera = camera_of()
    renderer = PairRenderer(SCENE)
    without = PairRenderer(SCENE.select([0, 2])).pair(0, camera).context
    ghosted = renderer.pair(0, camera, [1])
    changed = np.abs(pixels(ghosted.context) - pixels(without)).max(axis=2)
    assert ghosted.visible > 0.95
    assert (changed > 40).sum() > 50
    assert (changed > 40).mean() < 0.1


def test_coincident_faces_show_the_target_without_speckles():
    scene = Scene.from_meshes(
        [shapes.box((0.2, 0.2, 0.2)), shapes.box((0.3, 0.2, 0.2), (0.05, 0, 0))], colors=[[0.9, 0, 0], [0, 0, 0.9]]
    )
    for target in (0, 1):
        pair = PairRenderer(scene).pair(target, frame(scene.mesh(target)[0], (0.1, -1, 0.2), SIZE, margin=0.2))
        assert pair.visible == 1.0


def test_of_other_coincident_faces_one_mesh_wins():
    scene = Scene.from_meshes(
        [shapes.box((0.1, 0.1, 0.1), (0, 0, -5)), shapes.box((0.2, 0.2, 0.2)), shapes.box((0.2, 0.2, 0.2))],
        colors=[[0.5, 0.5, 0.5], [0.9, 0, 0], [0, 0, 0.9]],
    )
    camera = frame(scene.mesh(1)[0], (0.1, -1, 0.2), SIZE, margin=0.2)
    red, _, blue = pixels(PairRenderer(scene, plain=True).pair(0, camera).context).reshape(-1, 3).T
    assert (red > blue + 60).sum() > 500
    assert (blue > red + 60).sum() == 0


def test_a_cut_shows_the_material_of_a_solid_and_the_bore_of_a_tube():
    plane = np.array([0.0, -1.0, 0.0, 0.001])
    for shape, least, most in ((shapes.cylinder(0.1, 0.3), 0.95, 1.0), (shapes.tube(0.1, 0.08, 0.3), 0.1, 0.4)):
        scene = Scene.from_meshes([shape])
        renderer = PairRenderer(scene)
        camera = frame(scene.mesh(0)[0], (0, -1, 0.001), SIZE, margin=0.1)
        share, closed = renderer.share_of_cut(0, camera, plane)
        assert closed
        assert least <= share <= most
        assert renderer.alone(0, camera, plane).tobytes() != renderer.alone(0, camera).tobytes()


def test_a_cut_through_an_open_sheet_has_no_material():
    vertices, faces = shapes.box((0.2, 0.2, 0.2))
    scene = Scene.from_meshes([(vertices, faces[:-2])])
    camera = frame(scene.mesh(0)[0], (0, -1, 0.001), SIZE)
    assert PairRenderer(scene).share_of_cut(0, camera, np.array([0.0, -1.0, 0.0, 0.001])) == (0.0, False)


def test_a_target_outside_the_picture_is_not_drawn():
    camera = frame(SCENE.mesh(0)[0] + (0, 0, 5), (0, -1, 0), SIZE)
    assert PairRenderer(SCENE).pair(0, camera).pixels == 0


def test_a_camera_within_the_target_is_harmless():
    camera = frame(SCENE.mesh(1)[0], (0.1, -1, 0.2), SIZE)
    assert PairRenderer(SCENE).pair(2, camera).context.size == SIZE


def test_detail_far_from_the_origin_is_kept():
    near = Scene.from_meshes([shapes.cylinder(0.01, 0.02)])
    far = Scene.from_meshes([shapes.moved(shapes.cylinder(0.01, 0.02), translation=(2e5, -3e5, 10))])
    images = [
        pixels(PairRenderer(s, plain=True).pair(0, frame(s.mesh(0)[0], (1, -2, 1), SIZE, margin=0.2)).alone)
        for s in (near, far)
    ]
    assert np.abs(images[0] - images[1]).mean() < 2


@pytest.mark.parametrize(
    ("limit", "length"), [(1.0, 1.0), (0.99, 0.5), (0.3, 0.2), (0.049, 0.02), (7, 5), (1e-4, 1e-4)]
)
def test_scale_bars_have_round_lengths(limit, length):
    assert round_length(limit) == pytest.approx(length)


@pytest.mark.parametrize(("length", "text"), [(2.0, "2 m"), (0.2, "20 cm"), (0.005, "5 mm"), (0.0002, "0.2 mm")])
def test_lengths_as_people_say_them(length, text):
    assert length_text(length) == text


def test_scale_bar_is_as_long_as_it_says():
    image = PairRenderer(SCENE, plain=True).pair(0, camera_of(size=(256, 256))).alone
    before = pixels(image)
    length = draw_scale_bar(image, 0.001)
    dark = (pixels(image).sum(axis=2) < 150) & (before.sum(axis=2) > 300)
    row = dark[256 - 6 - 1]
    assert np.ptp(np.flatnonzero(row)) == pytest.approx(length / 0.001, abs=3)


def test_a_length_that_is_none_is_refused():
    with pytest.raises(ValueError, match="positive"):
        round_length(0)
