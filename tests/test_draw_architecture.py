"""The picture of what imports what: read from the files, laid out in floors, the same every time."""

import importlib.util
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[1] / "tools" / "draw_architecture.py"


@pytest.fixture(scope="module")
def drawing():
    spec = importlib.util.spec_from_file_location("draw_architecture", TOOL)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look for it
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def tree(tmp_path):
    def write(files):
        for name, text in {"__init__.py": "", **files}.items():
            path = tmp_path / "src" / "cadgraph" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return tmp_path

    return write


CHAIN = {
    "cli.py": "from cadgraph.load import read\nfrom cadgraph import model\n",
    "load/__init__.py": "from cadgraph.load.usd import read\n",
    "load/usd.py": "def read():\n    from cadgraph.model import Scene\n    return Scene\n",
    "load/inner/deep.py": "",
    "model.py": "class Scene: ...\n",
}


def test_rooms_are_folders_and_modules_of_a_package(drawing, tree):
    house = drawing.read_house(tree(CHAIN))
    assert set(house.rooms) == {"cadgraph/cli", "cadgraph/load", "cadgraph/model"}
    assert house.rooms["cadgraph/load"].lines == 4
    assert [name for name, _ in house.rooms["cadgraph/load"].inner] == ["inner"]


def test_imports_count_wherever_in_a_file_they_stand(drawing, tree):
    pairs = drawing.read_house(tree(CHAIN)).imports
    assert pairs == {
        ("cadgraph/cli", "cadgraph/load"): 1,
        ("cadgraph/cli", "cadgraph/model"): 1,
        ("cadgraph/load", "cadgraph/model"): 1,
    }


def test_a_room_stands_above_what_it_imports(drawing, tree):
    house = drawing.read_house(tree(CHAIN))
    upward = drawing._upward(house)
    assert upward == set()
    assert drawing._floors(house, upward) == {"cadgraph/model": 0, "cadgraph/load": 1, "cadgraph/cli": 2}
    assert drawing._implied(house, upward) == {("cadgraph/cli", "cadgraph/model")}


def test_a_circle_has_one_arrow_upward(drawing, tree):
    house = drawing.read_house(tree({**CHAIN, "model.py": "from cadgraph.cli import main\n"}))
    assert len(drawing._upward(house)) == 1
    assert drawing._RED in drawing.draw(house, "a circle")


def test_relative_imports_and_versions(drawing, tree):
    files = {**CHAIN, "load/usd.py": "from ..model import Scene\nfrom cadgraph import __version__\nimport cadgraph\n"}
    pairs = drawing.read_house(tree(files)).imports
    assert ("cadgraph/load", "cadgraph/model") in pairs
    assert "cadgraph/__init__" not in {room for pair in pairs for room in pair}


def test_the_picture_is_well_formed_and_the_same_every_time(drawing, tree):
    first, again = (drawing.draw(drawing.read_house(tree(CHAIN)), "a < b") for _ in range(2))
    assert first == again
    words = [node.text for node in ElementTree.fromstring(first).iter("{http://www.w3.org/2000/svg}text")]
    assert {"a < b", "cli", "load", "model"} <= set(words)


def test_check_fails_until_the_picture_is_written(drawing, tree, tmp_path, capsys):
    options = ["--tree", str(tree(CHAIN)), "--output", str(tmp_path / "picture.svg")]
    assert drawing.main([*options, "--check"]) == 1
    assert "out of date" in capsys.readouterr().out
    assert drawing.main(options) == 0
    assert drawing.main([*options, "--check"]) == 0
    assert drawing.main([*options, "--lines"]) == 0
    assert "load" in capsys.readouterr().out
