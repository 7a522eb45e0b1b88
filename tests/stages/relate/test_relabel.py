"""What the network learns flows back into labels, and never over what a user said."""

from functools import cache

import numpy as np
import pytest

from cadgraph.config import Config
from cadgraph.labelers.base import label_parts
from cadgraph.labelers.precedence import settle_labels
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.labels import FormerLabel, Label, NetworkEvidence
from cadgraph.pipeline import analyse
from cadgraph.stages.relate import RelateInput, connect_units
from cadgraph.stages.relate.role import USERS
from cadplants import make
from cadplants.faults.defects import DEFECTS
from piping import PIPE, PUMP, STEEL, TANK, VALVE, bend, pipe
from sketch import VOCABULARY, Sketch, around, block


def continued(mesh, group=STEEL, name="beam", source="geometry", after=((1, 0, 0), (2, 0, 0)), **said):
    """The label of a mesh between two pipes."""
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    number = sketch.add(mesh, group, name, source=source, **said)
    sketch.pipe(*after)
    return sketch.connected().labels[number]


STRAIGHT = {"mesh": pipe((1, 0, 0), (1.5, 0, 0)), "after": ((1.5, 0, 0), (2, 0, 0))}
BENT = {"mesh": bend((0.9, 0, 0), (1.076, 0, 0), (1.076, 0.2, 0)), "after": ((1.076, 0.076, 0), (1.076, 1, 0))}


@pytest.mark.parametrize(("shape", "name"), [(STRAIGHT, "pipe"), (BENT, "elbow")])
def test_what_a_line_runs_through_is_called_by_its_shape(shape, name):
    label = continued(**shape)
    assert (label.group, label.name, label.source, label.confidence) == (PIPE, name, "network", 0.8)


def test_what_was_said_before_is_kept_as_evidence():
    before = FormerLabel(group=STEEL, name="beam", confidence=0.6, source="geometry")
    assert continued(**STRAIGHT, sure=0.6).evidence == NetworkEvidence(why="a line runs through it", before=before)


def test_what_had_no_label_has_none_before():
    label = continued(**STRAIGHT, group=None, name=None)
    assert (label.group, label.name, label.evidence.before) == (PIPE, "pipe", None)


@pytest.mark.parametrize("source", [*sorted(USERS), "author", "file"])
def test_what_anybody_named_stays_so_even_in_a_line(source):
    label = continued(**STRAIGHT, source=source)
    assert (label.group, label.name, label.source) == (STEEL, "beam", source)


def test_what_is_called_a_connector_already_keeps_its_label():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(pipe((1, 0, 0), (1.3, 0, 0)), PIPE, "nipple")
    assert sketch.connected().labels[1] is sketch.labels[1]


@pytest.mark.parametrize(
    ("likely", "name"),
    [
        ({(VALVE, "valve body"): 0.3, (VALVE, "valve"): 0.1}, "valve"),
        ({(VALVE, "valve body"): 0.3}, "valve"),
    ],
)
def test_a_device_that_was_found_in_one_piece_has_the_name_of_the_whole(likely, name):
    connected = around(0.24, "aligned", likely=likely).connected()
    label = connected.labels[0]
    assert (label.group, label.name, label.source) == (VALVE, name, "network")
    assert label.evidence.why.startswith("it is part of a valve in the network: two lines end at it on one axis (+2.0)")


def test_a_piece_that_was_found_beside_others_is_called_by_what_is_likeliest():
    def name(likely):
        sketch = around(0.24, "aligned", likely=likely)
        sketch.add(block((0, 0.14, 0), (0.2, 0.04, 0.2)), VALVE, "handwheel")
        return sketch.connected().labels[0].name

    assert name({(VALVE, "valve body"): 0.2, (VALVE, "valve"): 0.1}) == "valve body"
    assert name({(VALVE, "valve body"): 0.1, (VALVE, "valve"): 0.09, (VALVE, "lever"): 0.08}) is None


@pytest.mark.parametrize(("likely", "name"), [(False, "gasket"), (True, None)])
def test_what_surely_is_a_gasket_stays_one_within_a_unit(likely, name):
    given = around(0.24, "aligned", group=VALVE, name="valve body")
    number = given.add(block((0, 0.13, 0), (0.2, 0.02, 0.2)), PIPE, "gasket")
    given.add(block((0, 0.2, 0), (0.2, 0.12, 0.2)), VALVE, "valve bonnet")
    given.labels[number] = given.labels[number].model_copy(update={"likely": likely})
    connected = given.connected()
    assert any(number in unit.parts for unit in connected.network.units)
    assert connected.labels[number].name == name


def test_the_confidence_of_what_was_found_is_that_of_finding_it():
    likely, sure = {(VALVE, "valve"): 0.1}, 0.906991
    assert around(0.24, "aligned", likely=likely).connected().labels[0].confidence == pytest.approx(sure, abs=1e-6)


MODES = ("labeler", "labeler and users", "a fifth wrong")


@cache
def plant(mode):
    """What relations of a generated plant are found from, some of its labels changed at random."""
    plant = make("riser", 7, "plant-design", DEFECTS["all"])
    analysis = analyse(plant.scene())
    config = Config()
    labeling = label_parts(labeler_of(config.label), analysis.parts, analysis.contacts, VOCABULARY, config.label)
    settled = settle_labels(labeling, analysis, VOCABULARY, config.label)
    labels = list(settled.labels)
    random = np.random.default_rng(0)
    names = [(group, name) for group, held in VOCABULARY.groups.items() for name in held.names]
    sources = {"labeler": (), "labeler and users": sorted(USERS), "a fifth wrong": (*sorted(USERS), "author")}[mode]
    for part in np.flatnonzero(random.random(len(labels)) < 0.2).tolist():
        if sources:
            labels[part] = Label(*names[random.integers(len(names))], 1.0, sources[random.integers(len(sources))])
    return RelateInput(analysis, labels, settled.opinions, VOCABULARY, config, settled.probabilities)


@cache
def outcome(mode):
    return connect_units(plant(mode))


@pytest.mark.parametrize("mode", MODES)
def test_in_a_whole_plant_what_changed_says_so_and_users_are_never_overruled(mode):
    changed = 0
    for before, after in zip(plant(mode).labels, outcome(mode).labels, strict=True):
        if before is not None and before.source in USERS:
            assert after is before
        if after is not before:
            changed += 1
            assert after.source == "network"
            assert after.evidence.why
            assert after.evidence.before == FormerLabel.of(before)
            assert VOCABULARY.holds(after.group, after.name)
            assert 0 < after.confidence <= 1
    # The labeler alone may be right about everything here.
    assert changed > 0 or mode == "labeler"


@pytest.mark.parametrize("mode", MODES)
def test_in_a_whole_plant_no_label_disagrees_with_its_unit(mode):
    functional = VOCABULARY.connector_groups | VOCABULARY.unit_of_group.keys()
    labels, units = outcome(mode).labels, outcome(mode).network.units
    assert units
    wrong = [
        (unit.tag, part, labels[part])
        for unit in units
        for part in unit.parts
        if labels[part] is not None
        and labels[part].source not in (*USERS, "author")
        and labels[part].group in functional
        and VOCABULARY.unit_of_group.get(labels[part].group) != unit.unit_type
    ]
    assert wrong == []


@pytest.mark.parametrize("mode", MODES)
def test_in_a_whole_plant_what_connections_run_through_is_called_a_connector(mode):
    labels, network = outcome(mode).labels, outcome(mode).network
    wrong = [
        part
        for link in network.links
        for part in link.via
        if labels[part] is None
        or (labels[part].group not in VOCABULARY.connector_groups and labels[part].source not in (*USERS, "author"))
    ]
    assert wrong == []


@pytest.mark.parametrize(("group", "name", "stays"), [("Equipment", "heat exchanger", True), (PUMP, "pump", False)])
def test_a_nozzle_of_a_machine_stays_a_nozzle(group, name, stays):
    sketch = Sketch()
    sketch.add(block((0, 0, 0), (1, 0.6, 0.6)), group, name)
    nozzle = sketch.add(block((0.55, 0, 0), (0.1, 0.2, 0.2)), TANK, "nozzle", sure=0.7)
    sketch.pipe((0.6, 0, 0), (2, 0, 0))
    found = sketch.connected()
    assert [label.name for label in found.labels][nozzle] == ("nozzle" if stays else None)
