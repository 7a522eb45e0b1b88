"""Isolation on a generated plant: what is closed shuts off by the truth, whatever labels it was built from."""

from itertools import product

import pytest

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.records import Terminal
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadgraph.query import Network, find_isolation
from cadlab.evaluate.pairing import pair
from cadlab.evaluate.units import match_units
from cadplants import make
from cadplants.truth.truth_writer import truth_of

NEVER = {"check valve", "control valve", "relief valve"}


def built(preset, labels, style="plant-design"):
    """A plant's truth and its graph, from true labels or from those of the embedded labeler."""
    plant = make(preset, 7, style)
    parts = zip(plant.paths(), plant.components, strict=True)
    given = [GivenLabel(path, part.group, part.name) for path, part in parts if part.group]
    return Truth.from_json(truth_of(plant)), build(plant.scene(), labels=given if labels == "true" else [])


@pytest.mark.slow
@pytest.mark.parametrize("labels", ["true", "embedded"])
def test_nothing_is_isolated_by_a_check_control_or_relief_valve(labels):
    truth, graph = built("pumps", labels)
    kind_of_true = {unit.id: unit.kind for unit in truth.units}
    kinds = {place: kind_of_true[unit] for place, unit in match_units(pair(graph, truth)).true_of.items()}
    assert set(kinds.values()) >= {"check valve", "relief valve"}
    network, closed = Network(graph), set()
    for place, fewest in product(network.places, (False, True)):
        if network.unit_type(place) is not None and network.arcs(place):
            closed.update(valve.place for valve in find_isolation(network, place, fewest=fewest).valves)
    assert len(closed) > 5
    assert not NEVER & {kinds.get(place) for place in closed}


@pytest.mark.slow
def test_pumps_are_isolated_by_the_valve_behind_their_check_valve_whose_kind_is_unknown():
    _, graph = built("pumps", "true", "bim")  # valves in one mesh: check valves have no kind
    network = Network(graph)
    for pump in (place for place in network.places if network.unit_type(place) == "pump"):
        found = find_isolation(network, pump)
        suspects = [valve.name for valve in found.passed if "likely a check valve" in valve.why]
        assert len(suspects) == 1
        assert not set(suspects) & {valve.name for valve in found.valves}


@pytest.mark.slow
@pytest.mark.parametrize("preset", ["riser", "tank"])
def test_ends_are_as_open_as_the_truth_says(preset):
    truth, graph = built(preset, "true")
    true = sorted(point.end for point in truth.points if point.kind == "terminal")
    assert sorted(node.kind for node in graph.of_layer(Terminal)) == true
