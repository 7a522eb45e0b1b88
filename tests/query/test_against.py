"""What stands against a section without being joined to it makes an answer doubtful."""

import pytest

import shapes
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Evidence, FormerLabel, Guess
from cadgraph.model.records import CUT, Joint
from cadgraph.query import find_isolation
from cadgraph.query.trace import trace
from piping import FASTENER, GAUGE, PIPE, STEEL, TANK, VALVE, Plant, R, pipe, turned, valve_mesh

TANK_MESH = turned(shapes.cylinder(0.5, 2.0, 64), (0, 0, 1), (0, 0, 1))


def tank_line():
    """A tank, a pipe to a gate valve, and an open pipe behind it."""
    plant = Plant().add(TANK_MESH, TANK, "tank").pipe((0.5, 0, 1), (1.5, 0, 1))
    return plant.add(valve_mesh((1.589, 0, 1)), VALVE, "valve").pipe((1.678, 0, 1), (2.5, 0, 1))


def doubts(plant, **settings):
    return doubts_of(plant.graph(**settings))


def doubts_of(graph):
    return [doubt.text for doubt in find_isolation(graph, "T-001", assume_shutoff=True).doubts if "stands" in doubt.text
            or "lies at" in doubt.text]  # fmt: skip


def test_a_line_of_its_own_casts_no_doubt():
    assert doubts(tank_line()) == []


def test_a_valve_without_a_line_whose_wheel_touches_a_pipe_of_the_section():
    plant = tank_line().add(turned(shapes.cylinder(0.02, 0.12), (1, 0, 1 + R + 0.06), (0, 0, 1)), VALVE, "handwheel")
    (text,) = doubts(plant.add(shapes.box((0.1, 0.1, 0.1), (1, 0, 1 + R + 0.17)), VALVE, "valve"))
    assert "none of whose two ports has a line, stands against part-" in text


def test_a_valve_that_stands_on_a_pipe_of_the_section_may_let_out_what_is_in_it():
    plant = tank_line().add(turned(shapes.cylinder(0.02, 0.12), (1, 0, 1 + R + 0.06), (0, 0, 1)), VALVE, "valve")
    assert find_isolation(plant.graph(), "T-001", assume_shutoff=True).isolated is None


@pytest.mark.parametrize(
    ("change", "lever", "n"),
    [({}, False, 0), ({"likely": True}, False, 1), ({"source": "network"}, False, 1), ({"source": "network"}, True, 1)],
)
def test_a_valve_of_which_nobody_is_sure_that_it_is_one(change, lever, n):
    plant = tank_line()
    if lever:
        plant.add(shapes.box((0.02, 0.02, 0.3), (1.589, 0, 1.15)), VALVE, "lever")
    graph = plant.graph()
    for part in graph.unit("V-001").parts:
        node = graph.part(part)
        if node.label.name != "lever":
            graph.nodes[part] = node.model_copy(update={"label": node.label.model_copy(update=change)})
    found = find_isolation(graph, "T-001", assume_shutoff=True).doubts
    assert sum("nobody is sure of its body" in doubt.text for doubt in found) == n


def test_a_valve_over_a_piece_that_has_no_label():
    plant = tank_line().add(turned(shapes.box((0.04, 0.04, 0.1)), (0, 0, 2.05), (0, 0, 1)), None)
    plant.add(turned(valve_mesh((0, 0, 0)), (0, 0, 2.189), (1, 0, 0)), VALVE, "valve")
    plant.add(pipe((0, 0, 2.278), (0, 0, 2.6)), PIPE, "pipe")
    (text,) = doubts(plant)
    assert "only one of whose two ports has a line, stands against" in text
    assert " over part-" in text
    found = trace(plant.graph(), "T-001", "downstream")
    assert any("stands against" in doubt.text for doubt in found.doubts)


@pytest.mark.parametrize(("before", "n"), [(None, 1), (VALVE, 1), (GAUGE, 0)])
def test_a_gauge_on_the_tank_that_is_one_only_because_of_where_it_stands(before, n):
    mesh = turned(shapes.cylinder(0.04, 0.12), (-0.54, 0, 1), (0, 0, 1))
    # It touches a beam, too, so that it may but lean on the tank.
    graph = (
        tank_line().add(mesh, GAUGE, "gauge").add(shapes.box((0.1, 0.1, 0.1), (-0.54, 0, 0.89)), STEEL, "beam").graph()
    )
    node = graph.part(graph.unit("G-001").parts[0])
    former = None if before is None else FormerLabel(group=before, name=None, confidence=0.6, source="geometry")
    change = {"source": "network", "evidence": Evidence(why="it stands alone on a vessel", before=former)}
    graph.nodes[node.id] = node.model_copy(update={"label": node.label.model_copy(update=change)})
    assert len(doubts_of(graph)) == n


def test_the_end_of_another_line_inside_the_tank():
    plant = tank_line().pipe((0, 0, 1.5), (0, 0, 2.6))
    (text,) = doubts(plant)
    assert text.startswith("open end terminal-")
    assert "of another line lies at part-" in text


def test_what_a_user_says_does_not_join_casts_no_doubt():
    graph = tank_line().pipe((0, 0, 1.5), (0, 0, 2.6)).graph()
    (other,) = (part for part in graph.parts() if part.centroid[2] > 2)
    tank = graph.unit("T-001").parts[0]
    cut = Joint(
        first=other.id, second=tank, kind="mount", point=(0, 0, 2), gap=0.0, score=0.0, made=False, reasons=(CUT,)
    )
    document = graph.document
    told = SceneGraph(document.model_copy(update={"joints": (*document.joints, cut)}))
    assert (len(doubts_of(graph)), len(doubts_of(told))) == (1, 0)


def test_a_bolt_leads_nowhere():
    plant = tank_line().add(shapes.box((0.02, 0.02, 0.06), (1, 0, 1 + R + 0.03)), FASTENER, "bolt")
    plant.add(turned(shapes.cylinder(0.02, 0.12), (1, 0, 1 + R + 0.12), (0, 0, 1)), VALVE, "valve")
    assert doubts(plant) == []


def test_a_pipe_in_no_line_over_a_piece_that_has_no_label():
    plant = tank_line().add(shapes.box((0.06, 0.06, 0.04), (1, 0, 1 + R + 0.02)), None)
    plant.add(shapes.box((0.03, 0.03, 0.2), (1, 0, 1 + R + 0.14)), PIPE, "pipe")
    (text,) = doubts(plant)
    assert "(likely pipe), in no network, stands against part-" in text


def perhaps(graph, *guesses):
    """The doubts about a plant whose last part has no label and may be something."""
    last = graph.parts()[-1]
    guessed = tuple(Guess(group, name, sure) for group, name, sure in guesses)
    graph.nodes[last.id] = last.model_copy(update={"guesses": guessed})
    return doubts_of(graph)


@pytest.mark.parametrize(("sure", "n"), [(0.4, 1), (0.2, 0)])
def test_a_piece_without_a_label_that_may_be_a_valve(sure, n):
    plant = tank_line().add(turned(shapes.cylinder(0.02, 0.12), (1, 0, 1 + R + 0.06), (0, 0, 1)), None)
    found = perhaps(plant.graph(), (VALVE, "valve", sure / 2), (VALVE, "valve body", sure / 2), (STEEL, "post", 0.1))
    assert len(found) == n
    assert all("(without a label, perhaps valve), in no network, stands against part-" in text for text in found)


@pytest.mark.parametrize(("over", "n"), [(True, 1), (False, 0)])
def test_a_piece_without_a_label_that_may_be_a_pipe_over_another_one(over, n):
    plant = tank_line()
    if over:
        plant.add(shapes.box((0.06, 0.06, 0.04), (1, 0, 1 + R + 0.02)), None)
    plant.add(shapes.box((0.03, 0.03, 0.2), (1, 0, 1 + R + 0.1 + 0.04 * over)), None)
    assert len(perhaps(plant.graph(), (PIPE, "pipe", 0.25), (TANK, "nozzle", 0.25))) == n
