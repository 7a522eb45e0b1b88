"""One plant in several formats: the same graph, whoever reads it."""

from pathlib import Path

import pytest

from cadgraph.config import Config
from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import evaluate
from cadplants import make
from cadplants.matching import truth_for
from cadplants.writers import write_plant

OPEN = {"load.unit": "mm", "load.up": "Y"}


@pytest.fixture(scope="module")
def plant():
    return make("riser", 5)


def scores(plant, file: Path, settings=None):
    truth = Truth.load(write_plant(plant, file))
    config = Config().replace({"load.isolate": False, **(settings or {})})
    scene = load(file, config.load)
    fitting = truth if file.suffix == ".usdc" else truth_for(scene, truth)
    found = evaluate(build(scene, config), fitting).total
    return scene.n_meshes, found.meshes.group.n_correct, found.meshes.name.n_correct, found.connected.edges.f1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "settings"), [("plant.rvm", None), ("plant.ifc", None), ("plant.glb", None), ("plant.obj", OPEN)]
)
def test_a_plant_has_the_same_graph_in_every_format(plant, tmp_path, name, settings):
    if name.endswith(".ifc"):
        pytest.importorskip("ifcopenshell")
    expected = scores(plant, tmp_path / "plant.usdc")
    found = scores(plant, tmp_path / name, settings)
    assert found[0] == expected[0] == plant.n_meshes
    assert found[3] == expected[3] == 1.0
    # Rounded to what a format stores, a part at the limit may be named otherwise.
    assert found[1:3] == pytest.approx(expected[1:3], abs=0.02 * plant.n_meshes)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["plant.rvm", "plant.ifc"])
def test_what_a_file_says_rightly_makes_labels_better(plant, tmp_path, name):
    if name.endswith(".ifc"):
        pytest.importorskip("ifcopenshell")
    plain = scores(plant, tmp_path / name)
    told = scores(plant, tmp_path / name, {"label.use_metadata": True, "relate.use_metadata": True})
    assert told[1] >= plain[1]
    assert told[2] >= plain[2]
    assert told[3] == 1.0
