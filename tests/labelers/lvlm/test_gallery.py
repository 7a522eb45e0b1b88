import random
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import shapes
from cadgraph.labelers.lvlm.gallery import Gallery
from cadgraph.labelers.lvlm.prompt import Wording, label_text
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary

SIZE = 96


def flanged(x=0.0, bolts=((0.07, 0.0), (-0.07, 0.0), (0.0, 0.07)), color=(0.1, 0.2, 0.6)):
    """A pipe with a pair of flanges, a gasket and bolts; flanges and pipe share faces."""
    meshes = [
        shapes.moved(shapes.tube(0.05, 0.045, 0.6), translation=(x, 0, -0.32)),
        shapes.moved(shapes.tube(0.1, 0.045, 0.02), translation=(x, 0, -0.011)),
        shapes.moved(shapes.tube(0.1, 0.045, 0.02), translation=(x, 0, 0.011)),
        shapes.moved(shapes.tube(0.06, 0.05, 0.002), translation=(x, 0, 0)),
        *(shapes.moved(shapes.cylinder(0.008, 0.06), translation=(x + a, b, 0)) for a, b in bolts),
    ]
    return meshes, [color] * len(meshes)


def plant(*groups):
    meshes = [mesh for each, _ in groups for mesh in each]
    return Scene.from_meshes(meshes, colors=[color for _, colors in groups for color in colors])


NEAR, FAR = flanged(), flanged(30.0)
FAR_MOVED = flanged(30.0, bolts=((0.07, 0.0), (-0.07, 0.0), (0.0, -0.07)))
PLANT = plant(NEAR, FAR)


def drawn(gallery, parts, threads):
    with ThreadPoolExecutor(threads) as pool:
        found = pool.map(lambda part: (part, [(p.caption, p.draw()) for p in gallery.pictures(part)]), parts)
        return dict(found)


def test_the_same_bytes_whatever_the_threads_and_the_order_of_asking():
    parts = list(range(PLANT.n_meshes))
    one = drawn(Gallery(PLANT, size=SIZE), parts, 1)
    shuffled = random.Random(3).sample(parts * 2, 2 * len(parts))
    assert drawn(Gallery(PLANT, size=SIZE), shuffled, 4) == one


def test_pictures_may_be_drawn_in_any_order():
    first = [picture.draw() for picture in Gallery(PLANT, size=SIZE).pictures(3)]
    last = [picture.draw() for picture in reversed(Gallery(PLANT, size=SIZE).pictures(3))]
    assert first == last[::-1]


def test_a_bolt_moved_far_away_leaves_recipe_and_pictures():
    one, two = Gallery(PLANT, size=SIZE), Gallery(plant(NEAR, FAR_MOVED), size=SIZE)
    near, far = range(len(NEAR[0])), range(len(NEAR[0]), PLANT.n_meshes)
    assert [one.recipe(i) for i in near] == [two.recipe(i) for i in near]
    assert drawn(one, [0, 3, 4], 1) == drawn(two, [0, 3, 4], 1)
    assert all(one.recipe(i) != two.recipe(i) for i in far)


def test_copies_in_the_same_surroundings_share_recipe_and_pictures():
    gallery = Gallery(PLANT, size=SIZE)
    n = len(NEAR[0])
    assert gallery.recipe(4) == gallery.recipe(4 + n)
    assert gallery.recipe(4) != gallery.recipe(5)
    assert list(drawn(gallery, [3], 1).values()) == list(drawn(gallery, [3 + n], 1).values())


def test_a_plant_ten_metres_further_has_the_same_recipes_and_pictures():
    moved = Scene.from_meshes(
        [(v + np.array([10.0, -10.0, 0]), f) for v, f in map(PLANT.mesh, range(7))], colors=NEAR[1]
    )
    still = plant(NEAR)
    one, two = Gallery(still, size=SIZE), Gallery(moved, size=SIZE)
    assert [one.recipe(i) for i in range(7)] == [two.recipe(i) for i in range(7)]
    assert drawn(one, [2, 5], 1) == drawn(two, [2, 5], 1)


@pytest.mark.parametrize("paper", [False, True])
def test_no_picture_is_empty(paper):
    import io

    from PIL import Image

    for part in (0, 3, 4):
        for picture in Gallery(PLANT, size=SIZE, paper=paper).pictures(part):
            with Image.open(io.BytesIO(picture.draw())) as image:
                pixels = np.asarray(image.convert("L")).astype(int)
            assert (np.abs(pixels - np.median(pixels, axis=1, keepdims=True)).max(axis=1) > 15).mean() > 0.05


def test_the_mark_is_named_in_the_question_and_part_of_the_recipe():
    blue, green = Gallery(PLANT, size=SIZE), Gallery(plant(flanged(color=(0.02, 0.6, 0.02))), size=SIZE)
    assert green.mark.name not in {"green", blue.mark.name}
    assert blue.mark.name in blue.recipe(0)
    text = label_text(Wording((1, 1, 1), 1, default_vocabulary(), mark=green.mark.name))
    assert f"the part is {green.mark.name}" in text


def test_recipes_tell_sizes_and_ways_apart():
    recipes = {
        Gallery(PLANT, size=SIZE).recipe(0),
        Gallery(PLANT, size=128).recipe(0),
        Gallery(PLANT, size=SIZE, paper=True).recipe(0),
    }
    assert len(recipes) == 3


def test_the_last_picture_says_what_it_is():
    gallery = Gallery(PLANT, size=SIZE)
    assert "cut open" in gallery.pictures(0)[5].caption or "end" in gallery.pictures(0)[5].caption
    assert "end" in gallery.pictures(4)[5].caption
    assert "broad side" in gallery.pictures(3)[5].caption


def test_a_part_that_cannot_be_drawn_has_a_recipe_all_the_same():
    broken = Scene.from_meshes([shapes.box(), (np.full((3, 3), np.nan), [[0, 1, 2]])])
    gallery = Gallery(broken, size=SIZE)
    assert gallery.recipe(1) != gallery.recipe(0)
    with pytest.raises(ValueError, match="/mesh_1"):
        gallery.pictures(1)
