import numpy as np
import pytest

import shapes
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.color import from_hex
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.scene import Scene

SIZE = (96, 64)
PLAIN = Look(samples=2, lines=0, floor=False, top="#ffffff", bottom="#ffffff")


def scene_of(*meshes, **more):
    return Scene.from_meshes(meshes, **more)


def painted(*colors):
    return Paint(np.array([from_hex(color) for color in colors]))


def pixels(image):
    return np.asarray(image).astype(int)


TWO = scene_of(shapes.box(center=(-1, 0, 0)), shapes.sphere(0.6, sides=32, rings=16))


@pytest.fixture(scope="module")
def renderer():
    return Renderer(TWO, threads=2)


def camera_of(renderer, **more):
    return frame(renderer.points(), (0.4, -1, 0.5), SIZE, **more)


def test_picture_has_the_size_of_the_camera_and_shows_both_colours(renderer):
    image = renderer.picture(camera_of(renderer), painted("#ff2020", "#2040ff"), PLAIN)
    assert image.size == SIZE
    assert image.mode == "RGB"
    red, _, blue = pixels(image).reshape(-1, 3).T
    assert (red > blue + 80).sum() > 200
    assert (blue > red + 80).sum() > 200


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_same_bytes_from_run_to_run_whatever_the_threads(samples):
    look = Look(samples=samples)
    images = []
    for threads in (1, 3):
        renderer = Renderer(TWO, threads=threads)
        camera = frame(renderer.points(), (0.4, -1, 0.5), (400, 300))
        images.append(renderer.picture(camera, look=look).tobytes())
    assert images[0] == images[1]


def test_scene_is_not_changed(renderer):
    before = [a.copy() for a in (TWO.vertices, TWO.faces, TWO.colors)]
    renderer.picture(camera_of(renderer))
    for old, new in zip(before, (TWO.vertices, TWO.faces, TWO.colors), strict=True):
        np.testing.assert_array_equal(old, new)


def test_empty_scene_is_an_error():
    with pytest.raises(ValueError, match="empty scene"):
        Renderer(scene_of())


def test_one_triangle_seen_edge_on():
    scene = scene_of(([[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 2]]))
    renderer = Renderer(scene)
    image = renderer.picture(frame(renderer.points(), (1, 0, 0), (32, 32)))
    assert image.size == (32, 32)


def test_wrong_number_of_colours_is_an_error(renderer):
    with pytest.raises(ValueError, match="2 meshes"):
        renderer.picture(camera_of(renderer), painted("#ff2020"))


def test_ghosted_mesh_in_front_lets_the_other_show_through():
    scene = scene_of(shapes.box((1, 0.1, 1)), shapes.box((2, 0.1, 2), center=(0, -1, 0)))
    renderer = Renderer(scene)
    camera = frame(renderer.points(), (0, -1, 0.01), (64, 64))
    paint = Paint(painted("#e01010", "#404040").colors, ghosted=np.array([False, True]))
    middle = pixels(renderer.picture(camera, paint, PLAIN))[32, 32]
    assert middle[0] > middle[2] + 60
    solid = pixels(renderer.picture(camera, painted("#e01010", "#404040"), PLAIN))[32, 32]
    assert abs(solid[0] - solid[2]) < 20


def test_edges_are_anti_aliased(renderer):
    def levels(samples):
        look = Look(samples=samples, sky_rays=0, lines=0, floor=False, top="#ffffff", bottom="#ffffff")
        return len(np.unique(pixels(renderer.picture(camera_of(renderer), painted("#000000", "#000000"), look))))

    assert levels(4) > levels(1)


def test_thin_wire_does_not_break_up():
    scene = scene_of(
        shapes.moved(shapes.cylinder(0.003, 2.0), [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
        shapes.box((2, 0.1, 1), (0, 0, 1)),
    )
    renderer = Renderer(scene)
    camera = frame(renderer.points(), (0.0, -1, 0.001), (160, 120))
    image = pixels(
        renderer.picture(
            camera,
            painted("#000000", "#ffffff"),
            Look(samples=4, sky_rays=0, lines=0, floor=False, top="#ffffff", bottom="#ffffff"),
        )
    )
    row = round(float(camera.project([[0, 0, 0]])[0][0, 1]))
    band = image[row - 2 : row + 3, 20:140].min(axis=(0, 2))
    assert (band < 250).all()


def test_hatched_mesh_is_striped(renderer):
    def spread(hatched):
        paint = Paint(painted("#d0d0d0", "#d0d0d0").colors, hatched=np.array([hatched, False]))
        look = Look(samples=1, sky_rays=0, lines=0, floor=False)
        return pixels(renderer.picture(frame(renderer.points([0]), (0, -1, 0.01), (64, 64)), paint, look))[
            20:44, 20:44
        ].std()

    assert spread(True) > spread(False) + 5


def test_floor_takes_a_shadow(renderer):
    camera = camera_of(renderer)
    with_floor = pixels(renderer.picture(camera, look=Look(lines=0)))
    without = pixels(renderer.picture(camera, look=Look(lines=0, floor=False)))
    assert (with_floor <= without + 1).all()
    assert (with_floor < without - 15).any()


def test_contact_with_another_surface_darkens():
    wall = scene_of(shapes.box((4, 4, 0.1)), shapes.box((1, 1, 1), (0, 0, 0.55)))
    renderer = Renderer(wall)
    camera = frame(renderer.points(), (0, -1, 1), (120, 120))
    near, far = (
        tuple(int(c) for c in camera.project([p])[0][0].round()) for p in ((0.6, -0.4, 0.05), (1.6, -1.6, 0.05))
    )
    lit = pixels(renderer.picture(camera, look=Look(lines=0)))
    assert lit[near[1], near[0]].sum() < lit[far[1], far[0]].sum() - 20


def test_pictures_drawn_together_equal_those_drawn_alone(renderer):
    camera = camera_of(renderer)
    paints = [
        painted("#ff2020", "#2040ff"),
        Paint(painted("#10a010", "#c0c0c0").colors, hatched=np.array([True, False])),
    ]
    together = renderer.pictures(camera, paints)
    assert [image.tobytes() for image in together] == [renderer.picture(camera, paint).tobytes() for paint in paints]


def test_pictures_drawn_together_must_ghost_the_same(renderer):
    colors = painted("#ff2020", "#2040ff").colors
    with pytest.raises(ValueError, match="the same meshes"):
        renderer.pictures(camera_of(renderer), [Paint(colors), Paint(colors, ghosted=np.array([True, False]))])
    with pytest.raises(ValueError, match="at least one"):
        renderer.pictures(camera_of(renderer), [])


def test_chunks_leave_no_seam():
    scene = scene_of(shapes.sphere(sides=64, rings=32))
    renderer = Renderer(scene)
    camera = frame(renderer.points(), (0.3, -1, 0.4), (200, 400), margin=0.02)
    image = pixels(renderer.picture(camera, look=Look(lines=0, floor=False)))
    column = image[120:280, 100].sum(axis=1)
    assert np.abs(np.diff(column, 2)).max() < 30


def test_drawing_meshes_without_faces_is_harmless():
    scene = scene_of(shapes.box(), ([[5, 5, 5]], np.zeros((0, 3), int)))
    renderer = Renderer(scene)
    paint = Paint(painted("#808080", "#808080").colors, ghosted=np.array([False, True]))
    assert renderer.picture(frame(renderer.points([0]), (1, -1, 1), (32, 32)), paint).size == (32, 32)


def test_facets_of_a_coarse_cylinder_do_not_show_where_it_turns_from_the_lamp():
    scene = scene_of(shapes.cylinder(sides=16))
    renderer = Renderer(scene)
    camera = frame(renderer.points(), (0, -1, 0.001), (200, 200))
    paint = painted("#909090")
    image = pixels(renderer.picture(camera, paint, Look(lines=0, floor=False)))[100, 30:170].sum(axis=1)
    assert np.abs(np.diff(image)).max() < 25
