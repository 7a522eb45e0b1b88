"""Which part or unit a fact belongs to."""

from cadgraph.facts.places import Places
from cadgraph.model.facts import Fact

PATHS = ("/z/P/a", "/z/P/b", "/z/P/c/d", "/z/Q", "/z/R")


def places(*paths, parts=(0, 0, 1, 2, 3), heads=(0, 2, 3, 4)):
    facts = [Fact(path, "description", path, "x") for path in paths]
    return Places(PATHS, parts, heads, facts)


def values(facts):
    return [fact.value for fact in facts]


def test_facts_of_meshes_and_of_nodes_that_hold_one_part():
    found = places("/z/P/b", "/z/P/c", "/z/P/c/d", "/z/Q", "/z")
    assert values(found.of_part(0)) == ["/z/P/b"]
    assert values(found.of_part(1)) == ["/z/P/c", "/z/P/c/d"]
    assert values(found.of_part(2)) == ["/z/Q"]
    assert found.of_part(3) == []


def test_a_part_is_named_by_its_largest_mesh_and_the_nodes_that_hold_nothing_else():
    found = places("/z/P/b", "/z/P/c")
    assert [(path, name) for path, _, name in found.nodes_of_part(1)] == [("/z/P/c/d", "d"), ("/z/P/c", "c")]
    # What a small mesh that joined a larger one is called says nothing of that one.
    assert [(path, values(facts)) for path, facts, _ in found.nodes_of_part(0)] == [("/z/P/a", [])]


def test_a_node_stands_for_a_unit_that_nearly_all_its_meshes_belong_to():
    found = places("/z/P", "/z")
    (unit,) = found.of_units([(0, 1)])
    assert [(node.path, node.covers, node.n_meshes) for node in unit] == [("/z/P", 1.0, 3)]
    assert values(found.left_over([unit])) == ["/z"]


def test_a_mixed_node_stands_for_a_unit_only_where_no_purer_one_does():
    # Three of the five meshes below /z are of the unit.
    assert [[node.path for node in unit] for unit in places("/z").of_units([(0, 1)])] == [["/z"]]
    assert [[node.path for node in unit] for unit in places("/z", "/z/P").of_units([(0, 1)])] == [["/z/P"]]
    assert places("/z").of_units([(1, 2)]) == ((),)


def test_every_fact_stands_somewhere():
    paths = ["/z", "/z/P", "/z/P/c", "/z/Q", "/nowhere", "/z/P/a"]
    found = places(*paths)
    units = found.of_units([(0, 1), (2,)])
    told = [fact for part in range(4) for fact in found.of_part(part)]
    told += [fact for nodes in units for node in nodes for fact in node.facts] + found.left_over(units)
    assert sorted(values(told)) == sorted(paths)


def test_a_path_of_very_many_steps_is_no_burden():
    deep = "/a" * 100_000
    found = Places((deep,), (0,), (0,), [])
    assert len(list(found.nodes_of_part(0))) == 64
