import pytest

import graphs
from cadgraph.errors import UnknownNode
from cadgraph.model.records import Junction, Part, Terminal, Unit
from cadgraph.query.isolate import find_isolation
from cadgraph.query.trace import trace
from gallery import gallery
from networks import pumping


@pytest.fixture
def graph():
    return pumping()


@pytest.mark.parametrize("spelt", ["V-004", "unit-V-004", "v4", "V 004", "v_04"])
def test_a_tag_may_be_spelt_loosely(graph, spelt):
    assert graph.unit(spelt).tag == "V-004"
    assert graph.find(spelt).id == "unit-V-004"


@pytest.mark.parametrize("called", ["platform +3.00 m (south east)", "place-002", "platform 3.00 m south-east"])
def test_a_level_is_known_by_its_name(called):
    assert gallery().find(called).id == "place-002"


def test_what_is_not_there_is_a_key_error_and_a_value_error_with_a_plain_text(graph):
    with pytest.raises(UnknownNode) as caught:
        graph.unit("V-0044")
    assert isinstance(caught.value, KeyError)
    assert isinstance(caught.value, ValueError)
    assert str(caught.value).startswith("nothing in the graph is called 'V-0044'; did you mean V-004")


def test_every_query_refuses_in_the_same_words(graph):
    told = set()
    for ask in (
        graph.unit,
        graph.neighbors,
        graph.connections,
        lambda tag: trace(graph, tag),
        lambda tag: find_isolation(graph, tag),
    ):
        with pytest.raises(UnknownNode) as caught:
            ask("P-999")
        told.add(str(caught.value))
    assert len(told) == 1


def test_a_node_of_another_kind_is_named_as_what_it_is(graph):
    with pytest.raises(UnknownNode, match="'V-004' is a unit, not a junction or terminal"):
        graph.find("V-004", Junction, Terminal)
    with pytest.raises(UnknownNode, match="'V-004' is a unit, not a part"):
        graph.part("V-004")


def test_a_part_or_its_mesh_stands_for_its_unit():
    graph = graphs.graph([graphs.part(0), graphs.part(1), graphs.unit("V-001", "part-1")])
    assert graph.unit("/mesh_1") is graph.unit("part-1") is graph.unit("V-001")
    assert isinstance(graph.find("/mesh_1"), Part)
    assert isinstance(graph.find("/mesh_1", Unit), Unit)
    assert graph.part_with("/mesh_1") is graph.part("part-1")
    with pytest.raises(UnknownNode, match="'/mesh_0' is a part, not a unit"):
        graph.unit("/mesh_0")


def test_the_path_of_a_mesh_is_exact_and_near_ones_are_offered():
    graph = graphs.graph([graphs.part(0, "/pump/casing"), graphs.part(1, "/pump/shaft")])
    assert graph.part_with("/pump/Casing") is None
    with pytest.raises(UnknownNode, match="no part is called '/pump/casin'; did you mean /pump/casing"):
        graph.part("/pump/casin")
    with pytest.raises(UnknownNode, match="lists all parts"):
        graph.part("&&&")
