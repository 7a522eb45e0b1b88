"""Pictures for agents: the target in red, seen though others stand before it."""

import io

import numpy as np
from PIL import Image

import graphs
import shapes
from cadgraph.agents.drawing.drawer import Drawer
from cadgraph.agents.picture import order_of
from cadgraph.agents.plant import Plant
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


def test_a_target_that_stands_behind_others_is_seen_through_them():
    scene = Scene.from_meshes([shapes.box((0.2, 0.2, 0.2)), shapes.box()], ["/inside", "/around"])
    inside, around = graphs.part(1, "/inside", size=0.2), graphs.part(2, "/around")
    drawn = Drawer(scene).draw(order_of(Plant(graphs.graph([inside, around])), "part-1"))
    red = np.asarray(Image.open(io.BytesIO(drawn.png)).convert("RGB")).astype(int)
    assert (red[..., 0] - red[..., 1] > 80).sum() > 3000
    assert "drawn faint" in drawn.text
    assert "part-2" not in drawn.text
