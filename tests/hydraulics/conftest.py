import pytest

from cadgraph.hydraulics.process import Process
from cadgraph.model.given_labels import GivenLabel
from cadgraph.pipeline import build
from cadplants import make


@pytest.fixture(scope="session")
def plants():
    """Plants as processes, by preset, each built when it is first asked for."""
    found = {}

    def built(preset):
        if preset not in found:
            plant = make(preset, 7)
            parts = zip(plant.paths(), plant.components, strict=True)
            given = [GivenLabel(path, part.group, part.name) for path, part in parts if part.group]
            found[preset] = build(plant.scene(), labels=given)
        return Process(found[preset])

    return built
