"""What is no fitting argument is told in one line, and nothing is taken for something else."""

import pytest

import graphs
from cadgraph.config import Config
from cadgraph.hydraulics.process import Process
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Unit
from cadgraph.pipeline import build
from cadgraph.query import Network, find_isolation
from cadgraph.session.session import Session
from networks import pumping

SCENE = graphs.boxes(["/a", "/b"])
CORRECTION = {"kind": "tag", "unit": "V-001", "tag": "V-4711"}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"labeler": "embedded"}, "labeler: give an object"),
        ({"vocabulary": "x"}, "vocabulary: give"),
        ({"labels": 5}, "labels: give a list"),
        ({"labels": ["/a"]}, "labels: give a list"),
        ({"corrections": [CORRECTION]}, "corrections: give a list of those of a Session"),
    ],
)
def test_building_takes_what_it_says(arguments, words):
    for start in (build, Session.start):
        with pytest.raises(TypeError, match=words) as told:
            start(SCENE, **arguments)
        assert "\n" not in str(told.value)


def test_a_session_takes_a_list_of_corrections():
    session = Session.start(SCENE, Config().replace({"label.labeler": "none"}))
    for wrong in (CORRECTION, 5, [5], "tag"):
        with pytest.raises(ValueError, match="give a list of corrections"):
            session.apply(wrong)
    with pytest.raises(TypeError, match="takes a Config"):
        Session.start(SCENE, 5)


@pytest.mark.parametrize("wrong", [5, None, [], "plant"])
def test_a_network_is_made_of_a_graph(wrong):
    with pytest.raises(TypeError, match="give a SceneGraph"):
        Network(wrong)
    with pytest.raises(TypeError, match="give a SceneGraph"):
        find_isolation(wrong, "V-001")


def test_a_graph_is_asked_with_names_nodes_and_classes():
    graph = pumping()
    unit = graph.unit("V-001")
    assert graph.unit(unit) == unit
    assert graph.unit_of(unit) == graph.unit_of("V-001") == unit
    assert len(set(graph.units())) == len(graph.units())
    for ask in (graph.unit, graph.find, graph.part):
        with pytest.raises(TypeError, match="give a part, a unit, or the id of one, not 5"):
            ask(5)
    assert graph.count("unit") == len(graph.of_layer(Unit))
    assert graph.count("connected") == len(graph.of_kind(Connected))
    for wrong in ("units", "valve", Unit):
        with pytest.raises(ValueError, match=r"nothing is counted as .*; there are adjacent, cluster, connected"):
            graph.count(wrong)
    for ask in (graph.of_layer, graph.of_kind):
        with pytest.raises(TypeError, match=r"give a class, as cadgraph\."):
            ask("unit")


def test_what_a_graph_hands_out_is_its_own():
    graph = SceneGraph(pumping().document.model_copy(update={"config": {"method": "ours"}}))
    graph.config["method"] = "another"
    graph.label_counts["x", None] = 5
    assert graph.config == {"method": "ours"}
    assert graph.label_counts == {}


def test_a_plant_takes_commands_by_tag_and_a_time():
    plant = Process(pumping())
    for wrong in (5, ["V-001"], "V-001"):
        with pytest.raises(ValueError, match="commands: give values by tag"):
            plant.steady(wrong)
    with pytest.raises(ValueError, match="dt x"):
        plant.step(dt="x")
    for wrong in (5, {5: 1}):
        with pytest.raises(ValueError, match="give values by dotted name"):
            Config().replace(wrong)
