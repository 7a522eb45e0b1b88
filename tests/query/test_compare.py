import json

import pytest

from cadgraph.cli import main
from cadgraph.errors import FormatError
from cadgraph.export.dexpi import read_dexpi, write_dexpi
from cadgraph.model.graph import SceneGraph
from cadgraph.query import Network, compare
from cadgraph.query.compare import Difference, Missing, OtherDirection, OtherOrder, read_mapping
from cadgraph.query.regions import find_regions
from cadgraph.query.text import comparison_lines
from networks import PLACES, along, chain, junction, network, pumping, terminal, unit


def changed(graph, nodes=None, edges=None, without=()):
    """A graph with other nodes by id, other edges, and nodes taken out together with their edges."""
    document = graph.document
    kept = [(nodes or {}).get(node.id, node) for node in document.nodes if node.id not in without]
    edges = document.edges if edges is None else edges
    return SceneGraph(document.model_copy(update={"nodes": tuple(kept), "edges": tuple(edges)}))


def renamed(graph, tags):
    """The same graph with other tags and ids, as another tool gives them."""
    text = json.dumps(graph.to_json())
    for k, old in enumerate(tags):
        text = text.replace(f'"unit-{old}"', f'"unit-#{k}#"').replace(f'"{old}"', f'"#{k}#"')
    for k, new in enumerate(tags.values()):
        text = text.replace(f"#{k}#", new)
    return SceneGraph.from_json(json.loads(text))


def without_valve(graph, tag):
    """A graph in which a pipe runs through where a valve was."""
    name = f"unit-{tag}"
    into, out = graph.connections(tag)
    through = into.model_copy(update={"target": out.target, "target_port": out.target_port})
    edges = [edge for edge in graph.document.edges if name not in (edge.source, edge.target)]
    nodes = {
        node.id: node.model_copy(update={"units": tuple(u for u in node.units if u != name)})
        for node in graph.systems()
    }
    return changed(graph, nodes, [*edges, through], without={name})


def exchanged(graph, a, b):
    """A graph in which two units have each other's tag."""
    return renamed(graph, {a: b, b: a})


def ending(kind, edges="T-001.N1 V-001 X1"):
    nodes = [unit("T-001", ports=("N1", "N2")), unit("V-001", "gate valve"), *([terminal(1, kind)] if kind else [])]
    return network(nodes, [edge for text in edges.split("; ") for edge in chain(text)])


@pytest.mark.parametrize(
    ("built", "drawn", "said"),
    [
        ("open", "open", None),
        ("open", "unknown", None),
        ("unknown", "blind", None),
        ("open", "blind", ("1 open end", "1 blind end")),
        ("blind", "open", ("1 blind end", "1 open end")),
        ("open", "", ("1 open end", "no end")),
    ],
)
def test_what_pipes_end_in_is_compared(built, drawn, said):
    found = compare(ending(built), ending(drawn, "T-001.N1 V-001 X1" if drawn else "T-001.N1 V-001"))
    assert [(one.where, one.plant, one.plan) for one in found.ends] == ([] if said is None else [(("V-001",), *said)])
    assert found.agrees is (said is None)
    lines = comparison_lines(found)
    assert f"ends of pipes  {len(found.ends)} differ" in lines
    if said is not None:
        assert f"  V-001  {said[0]} in the plant,  {said[1]} in the plan" in lines


def test_plant_and_its_own_plan_agree(tmp_path):
    plan = read_dexpi(write_dexpi(pumping(), tmp_path / "plan.xml"))
    found = compare(pumping(), plan)
    assert found.agrees
    assert len(found.found) == len(pumping().units())
    assert {(unit.by, unit.sure) for unit in found.found} == {("tag", 1.0)}
    assert len(found.agreeing) > 20
    assert len(found.lines) > 5


def test_valve_that_is_missing_is_told_and_its_connections_are_not():
    found = compare(without_valve(pumping(), "V-005"), pumping())
    assert found.only_plan == (Missing("V-005", "gate valve", ("V-004", "V-007", "V-008", "V-009")),)
    assert (found.only_plant, found.missing, found.extra, found.orders) == ((), (), (), ())
    assert not found.agrees
    assert compare(pumping(), without_valve(pumping(), "V-005")).only_plant == found.only_plan


def test_pipe_that_leads_elsewhere_is_a_connection_less_and_one_more():
    plant, plan = (
        network([unit(t) for t in ("T-001", "P-001", "P-002", "V-001")], chain(f"T-001 V-001 {pump}"))
        for pump in ("P-001", "P-002")
    )
    found = compare(plant, plan)
    assert found.agreeing == (("T-001", "V-001"),)
    assert found.extra == (("P-001", "V-001"),)
    assert found.missing == (("P-002", "V-001"),)


def test_second_pipe_between_the_same_two_is_a_connection_of_its_own():
    nodes = [unit("T-001"), unit("T-002")]
    found = compare(network(nodes, chain("T-001 T-002") * 2), network(nodes, chain("T-001 T-002")))
    assert found.agreeing == found.extra == (("T-001", "T-002"),)


def test_gauges_that_changed_places_are_told_as_another_order():
    nodes = [unit(t) for t in ("T-001", "G-001", "V-001", "G-002", "T-002")]
    plant = network(nodes, chain("T-001 G-001 V-001 G-002 T-002"))
    found = compare(plant, network(nodes, chain("T-001 G-002 V-001 G-001 T-002")))
    (order,) = found.orders
    assert order.plant == ("T-001", "G-001", "V-001", "G-002", "T-002")
    assert order.plan == ("T-001", "G-002", "V-001", "G-001", "T-002")
    assert not found.lines


def test_line_drawn_from_its_other_end_has_the_same_order():
    nodes = [unit(t) for t in ("T-001", "G-001", "V-001", "T-002")]
    plant = network(nodes, chain("T-001 G-001 V-001 T-002", direction="unknown"))
    found = compare(plant, network(nodes, chain("T-002 V-001 G-001 T-001", direction="unknown")))
    assert found.agrees
    assert len(found.lines) == 1


def test_two_gauges_between_junctions_have_an_order_where_the_flow_is_known():
    nodes = [unit("G-001"), unit("G-002"), *(terminal(i) for i in range(2))]
    for direction, orders in (("forward", 1), ("unknown", 0)):
        plant = network(nodes, chain("X0 G-001 G-002 X1", direction=direction))
        plan = network(nodes, chain("X0 G-002 G-001 X1", direction=direction))
        assert len(compare(plant, plan).orders) == orders


def test_flow_against_the_plan_is_told():
    nodes = [unit(t) for t in ("T-001", "P-001", "V-001")]
    plant = network(nodes, chain("T-001 P-001 V-001"))
    plan = network(nodes, [*chain("T-001 P-001"), *chain("P-001 V-001", direction="backward")])
    assert compare(plant, plan).directions == (OtherDirection("P-001", ("V-001",), "out", "in"),)
    unknown = network(nodes, [*chain("T-001 P-001"), *chain("P-001 V-001", direction="unknown")])
    assert compare(plant, unknown).agrees


def test_flow_at_a_branch_is_told_for_each_unit():
    nodes = [unit("P-001"), unit("P-002"), unit("T-001"), junction(1)]
    edges = [*chain("P-001 J1"), *chain("P-002 J1"), *chain("J1 T-001")]
    plan = network(nodes, [*chain("P-001 J1"), *chain("J1 P-002"), *chain("J1 T-001")])
    assert compare(network(nodes, edges), plan).directions == (
        OtherDirection("P-002", ("P-001", "T-001"), "out", "in"),
    )


@pytest.mark.parametrize(
    ("built", "drawn", "differs"),
    [
        ("ball valve", "gate valve", True),
        ("swing check valve", "check valve", False),
        ("valve", "gate valve", False),
        (None, "gate valve", False),
    ],
)
def test_kinds_that_contradict_each_other_are_told(built, drawn, differs):
    plant, plan = (network([unit("V-001", kind), unit("T-001")], chain("T-001 V-001")) for kind in (built, drawn))
    expected = (Difference(("V-001",), built, drawn),) if differs else ()
    assert compare(plant, plan).kinds == expected


def test_gauge_on_a_branch_is_where_one_in_the_line_is():
    nodes = [unit("T-001"), unit("T-002"), unit("G-001"), junction(1)]
    plant = network(nodes, [*chain("T-001 J1 T-002"), *chain("J1 G-001", direction="unknown")])
    found = compare(plant, network(nodes[:3], chain("T-001 G-001 T-002")))
    assert found.agrees
    assert found.agreeing == (("G-001", "T-001"), ("G-001", "T-002"), ("T-001", "T-002"))


OWN = {unit.tag: f"{unit.tag[0]}X{990 - 7 * i}" for i, unit in enumerate(pumping().units())}


def test_plan_with_other_tags_is_matched_by_the_network():
    found = compare(pumping(), renamed(pumping(), OWN))
    assert found.agrees
    assert all(OWN[unit.plant] == unit.plan and unit.by == "network" and unit.sure == 1 for unit in found.found)
    matched = {unit.plant for unit in found.found}
    alike = {tag for tags, _ in found.alike for tag in tags}
    assert matched | alike == set(OWN)
    assert {"T-001", "V-008", "G-006", "V-009"} <= matched
    # The duty pump and the standby pump are the same in every respect.
    assert any(set(tags) == {"P-001", "P-002"} for tags, _ in found.alike)


def test_given_pairs_tell_apart_what_is_alike():
    found = compare(pumping(), renamed(pumping(), OWN), {OWN["P-001"]: "P-001"})
    how = {unit.plant: unit.by for unit in found.found}
    assert (how["P-001"], how["P-002"], how["V-005"]) == ("given", "network", "network")
    assert all(OWN[unit.plant] == unit.plan for unit in found.found)
    assert found.agrees


def test_what_the_network_does_not_tell_stays_unmatched():
    plan = renamed(without_valve(pumping(), "V-009"), {old: new for old, new in OWN.items() if old != "V-009"})
    found = compare(pumping(), plan)
    assert all(OWN[unit.plant] == unit.plan for unit in found.found)
    assert "V-009" in [unit.tag for unit in found.only_plant]
    assert len(found.found) > 10


def test_networks_that_have_nothing_in_common_are_not_matched():
    plan = network([unit("E-001"), unit("E-002")], chain("E-001 E-002"))
    found = compare(pumping(), plan)
    assert found.found == ()
    assert len(found.only_plan) == 2


def test_equal_tags_of_other_types_are_not_the_same():
    plant = network([unit("V-001"), unit("T-001")], chain("T-001 V-001"))
    plan = network([unit("V-001", unit_type="tank"), unit("P-001")], chain("P-001 V-001"))
    assert "V-001" not in [unit.plant for unit in compare(plant, plan).found if unit.by == "tag"]


def test_tags_spelt_in_another_way_are_the_same():
    plant = network([unit("V-001"), unit("T-001")], chain("T-001 V-001"))
    plan = network([unit("V1", unit_type="valve"), unit("T 01", unit_type="tank")], [])
    assert [(u.plant, u.plan, u.by) for u in compare(plant, plan).found] == [
        ("V-001", "V1", "tag"),
        ("T-001", "T 01", "tag"),
    ]


def test_tags_count_for_nothing_where_the_plan_counts_in_its_own_way():
    nodes = [unit("V-001", "ball valve"), unit("V-002", "gate valve"), unit("T-001"), unit("P-001")]
    plant = network(nodes, chain("T-001 V-001 V-002 P-001"))
    found = compare(plant, exchanged(plant, "V-001", "V-002"), by_tag=False)
    assert {unit.plant: unit.plan for unit in found.found} == {
        "V-001": "V-002", "V-002": "V-001", "T-001": "T-001", "P-001": "P-001",
    }  # fmt: skip
    assert found.agrees


def test_comparison_does_not_depend_on_the_order_of_nodes():
    graph = renamed(pumping(), OWN)
    turned = changed(graph, edges=graph.document.edges[::-1])
    turned = SceneGraph(turned.document.model_copy(update={"nodes": turned.document.nodes[::-1]}))
    assert {u.plant: u.plan for u in compare(pumping(), turned).found} == {
        u.plant: u.plan for u in compare(pumping(), graph).found
    }


def test_empty_graphs_agree():
    assert compare(network([], []), network([], [])).agrees


def test_region_holds_what_lies_between_units_and_the_flow_at_them():
    (region,) = find_regions(
        Network(network([unit("P-001"), unit("T-001"), junction(1), unit("G-001")], [
            *chain("P-001 J1 T-001"), *chain("J1 G-001", direction="unknown"),
        ])),
        {"unit-P-001", "unit-T-001"},
    )  # fmt: skip
    assert region.ends == {"unit-P-001", "unit-T-001"}
    assert region.inside == {"junction-001", "unit-G-001"}
    assert region.flows == {"unit-P-001": "out", "unit-T-001": "in"}


# The file of pairs


def test_pairs_are_read_with_or_without_a_header():
    assert read_mapping("plan,plant\nHV-1, V-001\n\n# all\nHV-2,V-002 # here\n", "a") == {
        "HV-1": "V-001",
        "HV-2": "V-002",
    }


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a\n", "line 1"),
        ("a,b,c\n", "line 1"),
        ("a,b\na,c\n", "line 2: 'a' is there twice"),
        ("a,b\n" + 200_000 * "c" + ",d\n", "tags.csv: line 2: not CSV"),
    ],
)
def test_pairs_that_are_none_are_refused(text, says):
    with pytest.raises(ValueError, match=says):
        read_mapping(text, "tags.csv")


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"V-099": "V-001"}, "'V-099'"),
        ({"V-001": "V-099"}, "'V-099'"),
        ({"V-001": "V-002", "V-003": "V-002"}, "already"),
        ({"junction-001": "V-001"}, "no unit"),
    ],
)
def test_pairs_of_unknown_tags_are_refused(given, says):
    with pytest.raises(ValueError, match=says):
        compare(pumping(), pumping(), given)


# The command


def run(capsys, *arguments):
    code = 0
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        code = end.code or 0
    out, err = capsys.readouterr()
    return code, out, err


@pytest.fixture
def plant(tmp_path):
    pumping().save(tmp_path)
    write_dexpi(pumping(), tmp_path / "plan.xml")
    text = (tmp_path / "plan.xml").read_text(encoding="utf-8")
    (tmp_path / "other.xml").write_text(text.replace('"V-008"', '"HV-8"').replace("GlobeValve", "GateValve"), "utf-8")
    return tmp_path


def test_command_says_that_both_agree(plant, capsys):
    code, out, _ = run(capsys, "compare", plant, plant / "plan.xml", "--strict")
    assert code == 0
    assert out.splitlines()[-1] == "the plant and the plan agree (nominal sizes and nozzles are not compared)"


def test_command_tells_each_difference_and_ends_with_one_only_when_strict(plant, capsys):
    code, out, _ = run(capsys, "compare", plant, plant / "other.xml")
    assert code == 0
    assert "V-008  globe valve in the plant,  gate valve in the plan" in out
    assert "V-008  =  HV-8" in out
    assert run(capsys, "compare", plant, plant / "other.xml", "--strict")[0] == 1


def test_command_answers_as_json_and_into_a_file(plant, capsys):
    values = json.loads(run(capsys, "compare", plant, plant / "other.xml", "--json")[1])
    assert values["agrees"] is False
    assert values["kinds"] == [{"where": ["V-008"], "plant": "globe valve", "plan": "gate valve"}]
    code, out, _ = run(capsys, "compare", plant, plant / "plan.xml", "--json", "-o", plant / "a.json")
    assert (code, "agree" in out) == (0, True)
    assert json.loads((plant / "a.json").read_text(encoding="utf-8"))["agrees"] is True
    run(capsys, "compare", plant, plant / "plan.xml", "-o", plant / "a.txt")
    assert (
        (plant / "a.txt")
        .read_text(encoding="utf-8")
        .endswith("the plant and the plan agree (nominal sizes and nozzles are not compared)\n")
    )


def branches(*kinds):
    """Two equal branches with a valve each, tags as another tool counts."""
    nodes = [unit("P-001"), junction(1), terminal(1), terminal(2)]
    nodes += [unit(f"V-00{k}", kind) for k, kind in enumerate(kinds, 1)]
    return network(nodes, chain("P-001 J1 V-001 X1") + chain("J1 V-002 X2"))


@pytest.mark.parametrize(
    ("drawn", "differs"),
    [
        (("ball valve", "gate valve"), ()),
        ((None, "ball valve"), ()),
        (("ball valve", "check valve"), ("V-001, V-002",)),
    ],
)
def test_units_that_nobody_can_tell_apart_are_not_said_to_agree(tmp_path, capsys, drawn, differs):
    plan = renamed(branches(*drawn), {"P-001": "P-7", "V-001": "HV-3", "V-002": "HV-9"})
    found = compare(branches("gate valve", "ball valve"), plan)
    if found.alike:
        assert [", ".join(kind.where) for kind in found.kinds] == list(differs)
        assert not found.complete
        assert "2 of 3 units can't be told apart" in found.verdict or differs
    branches("gate valve", "ball valve").save(tmp_path)
    write_dexpi(plan, tmp_path / "plan.xml")
    assert run(capsys, "compare", tmp_path, tmp_path / "plan.xml", "--strict")[0] == int(bool(differs or found.alike))


def test_a_plan_with_a_namespace_is_read_too(plant, capsys):
    text = (plant / "plan.xml").read_text(encoding="utf-8").replace("<PlantModel", '<PlantModel xmlns="urn:proteus"', 1)
    (plant / "named.xml").write_text(text, encoding="utf-8")
    assert run(capsys, "compare", plant, plant / "named.xml", "--strict")[0] == 0


def test_command_takes_pairs_of_tags(plant, capsys):
    (plant / "tags.csv").write_text("plan,plant\nHV-8,V-008\n", encoding="utf-8")
    out = run(capsys, "compare", plant, plant / "other.xml", "--map", plant / "tags.csv")[1]
    assert "1 as given" in out
    (plant / "tags.csv").write_text("HV-8\n", encoding="utf-8")
    code, _, err = run(capsys, "compare", plant, plant / "other.xml", "--map", plant / "tags.csv")
    assert (code, "line 1" in err) == (2, True)


def test_command_refuses_what_is_no_plan(plant, capsys):
    code, _, err = run(capsys, "compare", plant, plant / "graph.json")
    assert (code, "not XML" in err) == (2, True)
    with pytest.raises(FormatError):
        read_dexpi(plant / "graph.json")


def test_long_answers_say_how_much_more_there_is():
    plan = network([unit(f"V-{i:03d}") for i in range(30)], [])
    told = comparison_lines(compare(network([], []), plan), most=20)
    assert "  and 10 more; --json has them all" in told


def test_orders_are_told_by_line(tmp_path):
    at = {**PLACES, "G-003": PLACES["V-004"], "V-004": PLACES["G-003"]}
    document = pumping().document
    edges = [e for e in document.edges if not {"unit-G-003", "unit-V-004"} & {e.source, e.target}]
    edges += along("P-001.N2", "V-004", "G-003", "V-005", size=65, at=at)
    found = compare(pumping(), changed(pumping(), edges=edges))
    (order,) = found.orders
    assert order == OtherOrder(order.line, ("P-001", "G-003", "V-004", "V-005"), ("P-001", "V-004", "G-003", "V-005"))
