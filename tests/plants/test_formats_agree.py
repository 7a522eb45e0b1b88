"""One plant in several formats: the same graph, whoever reads it."""

import pytest

from cadgraph.config import Config
from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import evaluate
from cadplants import make
from cadplants.writers import write_plant
from cadplants.writers.matching import truth_for

NONE: dict[str, object] = {}
OPEN = {"load.unit": "mm", "load.up": "Y"}


@pytest.fixture(scope="module")
def scores(tmp_path_factory):
    """What the graph of a plant gets right, by the file's name and settings; of each, built once."""
    plant, folder, found = make("riser", 5), tmp_path_factory.mktemp("formats"), {}

    def of(name, settings=NONE):
        key = name, tuple(settings.items())
        if key not in found:
            found[key] = scores_of(plant, folder / name, settings)
        return found[key]

    return of


def scores_of(plant, file, settings):
    truth = Truth.load(write_plant(plant, file))
    config = Config().replace({"load.isolate": False, **settings})
    scene = load(file, config.load)
    fitting = truth if file.suffix == ".usdc" else truth_for(scene, truth)
    score = evaluate(build(scene, config), fitting).total
    correct = score.meshes.group.n_correct, score.meshes.name.n_correct
    return plant.n_meshes, scene.n_meshes, *correct, score.connected.edges.f1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "settings"), [("plant.rvm", NONE), ("plant.ifc", NONE), ("plant.glb", NONE), ("plant.obj", OPEN)]
)
def test_a_plant_has_the_same_graph_in_every_format(scores, name, settings):
    if name.endswith(".ifc"):
        pytest.importorskip("ifcopenshell")
    expected, found = scores("plant.usdc"), scores(name, settings)
    meshes = found[0]
    assert found[1] == expected[1] == meshes
    assert found[4] == expected[4] == 1.0
    # Rounded to what a format stores, a part at the limit may be named otherwise.
    assert found[2:4] == pytest.approx(expected[2:4], abs=0.02 * meshes)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["plant.rvm", "plant.ifc"])
def test_what_a_file_says_rightly_makes_labels_better(scores, name):
    if name.endswith(".ifc"):
        pytest.importorskip("ifcopenshell")
    plain, told = scores(name), scores(name, {"label.use_metadata": True, "relate.use_metadata": True})
    assert told[2] >= plain[2]
    assert told[3] >= plain[3]
    assert told[4] == 1.0
