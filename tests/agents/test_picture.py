"""Pictures for agents: the target in red, seen though others stand before it."""

import io

import numpy as np
from PIL import Image

import graphs
import shapes
from cadgraph.agents.drawing.drawer import Drawer
from cadgraph.agents.picture import order_of
from cadgraph.agents.plant import Plant
from cadgraph.model.records import FreeFloor, Place
from cadgraph.model.scene import Scene
from command_line import refused, run
from serving import make_folder


def test_a_picture_is_drawn_from_the_command_line(capsys, tmp_path):
    blocks = make_folder(tmp_path)
    code, told, _ = run(capsys, "picture", blocks, "part-00001", "-o", tmp_path / "a.png")
    assert code == 0
    assert "part-00001 in red" in told
    with Image.open(tmp_path / "a.png") as image:
        assert image.size == (768, 576)
    assert "part-99999" in refused(capsys, "picture", blocks, "part-99999")
    assert "give a file that ends in .png" in refused(capsys, "picture", blocks, "part-00001", "-o", tmp_path / "a.jpg")


def test_a_target_that_stands_behind_others_is_seen_through_them():
    scene = Scene.from_meshes([shapes.box((0.2, 0.2, 0.2)), shapes.box()], ["/inside", "/around"])
    inside, around = graphs.part(1, "/inside", size=0.2), graphs.part(2, "/around")
    drawn = Drawer(scene).draw(order_of(Plant(graphs.graph([inside, around])), "part-1"))
    red = np.asarray(Image.open(io.BytesIO(drawn.png)).convert("RGB")).astype(int)
    assert (red[..., 0] - red[..., 1] > 80).sum() > 3000
    assert "drawn faint" in drawn.text
    assert "part-2" not in drawn.text


def test_a_level_without_a_mesh_is_shown_by_where_one_can_stand():
    floor = FreeFloor(origin=(0.0, 0.0), step=0.1, size=(100, 60), runs=(0, 3000, 3000))
    box = ((0.0, 0.0, 0.0), (10.0, 6.0, 0.0))
    level = Place(id="place-001", kind="ground", name="ground", height=0.0, area=30.0, aabb=box, parts=(), floor=floor)
    order = order_of(Plant(graphs.graph([graphs.part(1, "/block"), level])), "place-001")
    assert 100 < len(order.spots) <= 400
    assert all(0 < x < 10 and 0 < y < 3 and z == 0 for x, y, z in order.spots)
    drawn = Drawer(Scene.from_meshes([shapes.box()], ["/block"])).draw(order)
    assert "where one can stand" in drawn.text
    red = np.asarray(Image.open(io.BytesIO(drawn.png)).convert("RGB")).astype(int)
    assert (red[..., 0] - red[..., 1] > 80).sum() > 10 * len(order.spots)
