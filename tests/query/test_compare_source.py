"""A graph beside what its source says is joined: what agrees, what only one side has, what can't be compared."""

import json

import pytest

from cadgraph.errors import FormatError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Joint, OrientedBox, Part, Stated
from cadgraph.query.compare_source import Uncompared, compare_source
from cadgraph.query.source_text import source_lines, source_values
from command_line import refused, run
from networks import chain, junction, network, unit

O = (0.0, 0.0, 0.0)  # noqa: E741


def part(name):
    """A part of one mesh: ``part-a`` of ``/p/a``."""
    box = OrientedBox(center=O, axes=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), extents=(1.0, 1.0, 1.0))
    return Part(
        id=f"part-{name}", meshes=(f"/p/{name}",), centroid=O, aabb=(O, O), obb=box, area=1.0, volume=None,
        n_triangles=1, shape="s",
    )  # fmt: skip


def device(tag):
    """A unit of one part of the same name."""
    return unit(tag).model_copy(update={"parts": (f"part-{tag}",)})


def said(first, second, flow="unknown", lost=()):
    """A link between meshes; those in ``lost`` are not in the graph."""
    ends = [() if name in lost else (f"part-{name}",) for name in (first, second)]
    return Stated(
        first=ends[0], second=ends[1], first_path=f"/p/{first}", second_path=f"/p/{second}", flow=flow, where="order"
    )


def ways(text, flow="unknown"):
    """``"a b c"`` as links from each to the next."""
    names = text.split()
    return [said(a, b, flow) for a, b in zip(names, names[1:], strict=False)]


def plant(edges, links, tags="V-001 V-002", pipes="a b", joints=(), places=()):
    units = [device(tag) for tag in tags.split()]
    parts = [part(name) for name in (*tags.split(), *pipes.split())]
    graph = network([*units, *places, *parts], edges, joints=joints)
    return SceneGraph(graph.document.model_copy(update={"stated": tuple(links)}))


def via(text, *names, direction="unknown"):
    return [
        edge.model_copy(update={"via": tuple(f"part-{n}" for n in names)}) for edge in chain(text, direction=direction)
    ]


def pairs(claims):
    return [(claim.first, claim.second) for claim in claims]


STRAIGHT = via("V-001 V-002", "a", "b")


def test_what_both_join_agrees_with_the_way_of_each():
    found = compare_source(plant(STRAIGHT, ways("V-001 a b V-002")))
    (claim,) = found.agreeing
    assert (claim.first, claim.second, claim.ids) == ("V-001", "V-002", ("unit-V-001", "unit-V-002"))
    assert claim.via == ("part-a", "part-b")
    assert claim.paths == ("/p/V-001", "/p/a", "/p/b", "/p/V-002")
    assert found.agrees
    assert (found.only_ours, found.only_theirs, found.uncompared, found.silent) == ((), (), (), ())


def test_what_only_the_source_joins_names_where_our_joints_end():
    made = [Joint(first="part-V-001", second="part-a", kind="mount", point=O, gap=0.0, score=0.9, made=True)]
    free = [Joint(first="part-a", second="part-b", kind="face", point=O, gap=0.1, score=0.1, made=False)]
    held = [Joint(first="part-b", second="part-V-002", kind="mount", point=O, gap=0.0, score=0.9, made=True)]
    found = compare_source(plant([], ways("V-001 a b V-002"), joints=[*made, *free, *held]))
    (claim,) = found.only_theirs
    assert claim.gaps == (("/p/a", "/p/b"),)
    assert claim.via == ()
    assert not found.agrees


def test_a_gasket_that_the_source_leaves_out_is_no_gap():
    joints = [
        Joint(first=f"part-{a}", second=f"part-{b}", kind="face", point=O, gap=0.0, score=0.9, made=True)
        for a, b in ("Va", "ag", "gb")
        for a, b in [({"V": "V-001"}.get(a, a), b)]
    ]
    found = compare_source(plant([], ways("V-001 a b V-002"), pipes="a b g", joints=joints))
    assert found.only_theirs[0].gaps == (("/p/b", "/p/V-002"),)


def test_what_only_we_join_says_whether_the_source_is_silent():
    found = compare_source(plant(STRAIGHT, ways("V-001 a")))
    assert pairs(found.only_ours) == [("V-001", "V-002")]
    assert found.silent == ("V-002",)
    assert "the source states nothing of V-002" in "\n".join(source_lines(found))


def test_branches_are_contracted_alike_on_both_sides():
    edges = [*via("V-001 J1", "a"), *via("J1 V-002", "b"), *via("J1 V-003", "c")]
    links = [*ways("V-001 a t b V-002"), *ways("V-003 c t")]
    found = compare_source(plant(edges, links, "V-001 V-002 V-003", "a b c t", places=[junction(1)]))
    assert pairs(found.agreeing) == [("V-001", "V-002"), ("V-001", "V-003"), ("V-002", "V-003")]
    assert found.agrees


def test_gauges_stand_aside_wherever_a_side_has_them():
    edges = [*via("V-001 G-001", "a"), *via("G-001 V-002", "a")]
    links = [*ways("V-001 a V-002"), *ways("G-001 a")]
    found = compare_source(plant(edges, links, "V-001 V-002 G-001", "a"))
    assert found.agrees
    assert len(found.agreeing) == 3
    assert [(way.first, way.second) for way in found.flows] == [("V-001", "V-002")]


def test_a_valve_tapped_into_a_run_stands_aside():
    edges = [*via("V-001 V-003.N1", "a"), *via("V-003.N1 V-002", "a")]
    found = compare_source(plant(edges, [*ways("V-001 a V-002"), *ways("V-003 a")], "V-001 V-002 V-003", "a"))
    assert pairs(found.agreeing) == [("V-001", "V-002"), ("V-001", "V-003"), ("V-002", "V-003")]
    assert found.agrees
    passed = [*via("V-001 V-003.N1", "a"), *via("V-003.N2 V-002", "a")]
    other = compare_source(plant(passed, [*ways("V-001 a V-002"), *ways("V-003 a")], "V-001 V-002 V-003", "a"))
    assert pairs(other.only_theirs) == [("V-001", "V-002")]


def test_two_pipes_between_the_same_two_are_counted_and_their_flow_is_not_compared():
    edges = [*via("V-001 V-002", "a"), *via("V-001 V-002", "b")]
    found = compare_source(plant(edges, [*ways("V-001 a V-002"), *ways("V-001 b V-002")]))
    assert len(found.agreeing) == 2
    assert found.unclear == (("V-001", "V-002"),)
    assert compare_source(plant(edges, ways("V-001 a V-002"))).only_ours[0].via == ("part-b",)


def test_devices_flange_to_flange():
    found = compare_source(plant(via("V-001 V-002"), [said("V-002", "V-001", "forward")], pipes=""))
    assert found.agrees
    assert found.flows[0].theirs == "backward"


@pytest.mark.parametrize(
    ("ours", "links", "verdict"),
    [
        ("forward", ways("V-001 a b V-002", "forward"), "agree"),
        ("forward", ways("V-001 a b V-002", "backward"), "differ"),
        ("forward", ways("V-001 a b V-002"), "ours"),
        ("unknown", ways("V-001 a b V-002", "forward"), "theirs"),
        ("unknown", ways("V-001 a b V-002"), "open"),
        ("backward", [said("V-001", "a"), said("b", "a", "forward"), said("b", "V-002")], "agree"),
        ("forward", [said("V-001", "a"), said("a", "b"), said("V-002", "b", "forward")], "differ"),
    ],
)
def test_directions(ours, links, verdict):
    found = compare_source(plant(via("V-001 V-002", "a", "b", direction=ours), links))
    assert [(way.first, way.second) for way in found.directions(verdict)] == [("V-001", "V-002")]
    assert len(found.flows) == 1
    assert found.agrees == (verdict != "differ")


def test_what_cannot_be_compared_is_listed_and_never_dropped():
    several = Stated(
        first=("part-V-001", "part-V-002"), second=("part-a",), first_path="/p", second_path="/p/a", where="order"
    )
    above = Stated(first=("part-a", "part-z"), second=("part-V-001",), first_path="/q", second_path="/p/V-001")
    wide = Stated(first=(), second=("part-a",), first_path="/p/V-001/", second_path="/p/a")
    lost = [said("V-001", "x", lost="x"), said("x", "V-002", lost="x")]
    graph = plant(via("V-001 V-002", "a"), [*lost, several, above, *ways("a b"), *ways("V-001 z")], pipes="a b z")
    found = compare_source(graph)
    assert (found.agrees, found.complete) == (True, False)
    assert "what could be compared agrees" in found.verdict
    assert found.uncompared == (
        Uncompared("/p", "it is several units: V-001, V-002"),
        Uncompared("/p/b", "no line of the graph leads through it"),
        Uncompared("/p/x", "it is not in the graph"),
        Uncompared("/p/z", "no line of the graph leads through it"),
        Uncompared("/q", "it is a node above several elements that the source joins"),
    )
    # What is not in the graph is a place that pipes lead through.
    (claim,) = found.agreeing
    assert claim.lost == ("/p/x",)
    assert compare_source(plant(STRAIGHT, [wide])).uncompared[0].why == "it is not in the graph"


def test_a_node_above_too_many_meshes_is_told_as_such():
    wide = Stated(first=(), second=("part-a",), first_path="/p", second_path="/p/a")
    assert compare_source(plant(STRAIGHT, [wide])).uncompared == (
        Uncompared("/p", "it is a node above too many meshes"),
    )


def test_a_node_and_a_mesh_below_it_are_one_place():
    node = Stated(first=("part-a", "part-b"), second=("part-V-002",), first_path="/node", second_path="/p/V-002")
    found = compare_source(plant(STRAIGHT, [said("V-001", "a"), node]))
    assert pairs(found.agreeing) == [("V-001", "V-002")]


@pytest.mark.parametrize("joined", [True, False])
def test_a_branch_is_a_place_where_its_elements_hang_together(joined):
    ends = ("part-a", "part-b"), ("part-V-001",)
    branch = Stated(first=ends[0], second=ends[1], first_path="/branch", second_path="/p/V-001", where="att HREF")
    rest = ways("a b V-002") if joined else [*ways("b V-002"), *ways("a c")]
    found = compare_source(plant(via("V-001 V-002", "a", "b", "c"), [branch, *rest], pipes="a b c"))
    assert pairs(found.agreeing) == ([("V-001", "V-002")] if joined else [])
    assert [one.path for one in found.uncompared] == ([] if joined else ["/branch"])


def test_links_within_one_device_are_counted():
    link = Stated(first=("part-V-001",), second=("part-V-001",), first_path="/p/V-001", second_path="/p/V-001/stem")
    found = compare_source(plant(STRAIGHT, [link]))
    assert (found.links, found.within) == (1, 1)
    assert "1 of them within one device" in source_lines(found)[0]


def test_agreement_with_what_was_used_as_evidence_is_marked():
    graph = plant(STRAIGHT, ways("V-001 a b V-002"))
    used = SceneGraph(graph.document.model_copy(update={"config": {"relate": {"use_metadata": True}}}))
    assert compare_source(used).used
    assert not compare_source(graph).used
    assert any("as evidence" in line for line in source_lines(compare_source(used)))


def test_a_source_that_states_nothing_is_told_in_one_line():
    found = compare_source(plant(STRAIGHT, []))
    assert len(source_lines(found)) == 1
    assert source_values(found)["agrees"] is None


def test_long_lists_end_with_how_many_more():
    tags = " ".join(f"V-{k:03d}" for k in range(1, 31))
    found = compare_source(plant([], ways(tags), tags))
    assert "  and 9 more; --json has them all" not in source_lines(found, most=29)
    assert sum(line.startswith("  only in the source") for line in source_lines(found, most=10)) <= 10
    assert any("more; --json has them all" in line for line in source_lines(found, most=10))


# --- the command and the file ---


def test_command(tmp_path, capsys):
    graph = plant(STRAIGHT, ways("V-001 a b V-002", "forward"))
    graph.save(tmp_path / "graph.json")
    code, text, _ = run(capsys, "compare", tmp_path, "--source")
    assert code == 0
    assert "connections    1 agree, 0 only in the graph, 0 only in the source" in text
    assert "directions     0 agree, 0 differ, 0 only in the graph, 1 only in the source, 0 in neither" in text
    values = json.loads(run(capsys, "compare", tmp_path, "--source", "--json")[1])
    assert values["connections"]["agree"][0]["paths"] == ["/p/V-001", "/p/a", "/p/b", "/p/V-002"]
    assert values["directions"]["only_in_source"] == [
        {"first": "V-001", "second": "V-002", "ours": "unknown", "theirs": "forward"}
    ]
    assert run(capsys, "compare", tmp_path, "--source", "-o", tmp_path / "found.json", "--json")[0] == 0
    assert json.loads((tmp_path / "found.json").read_text()) == values


@pytest.mark.parametrize(("strict", "code"), [([], 0), (["--strict"], 1)])
def test_only_strict_ends_with_1_where_they_differ(strict, code, tmp_path, capsys):
    plant([], ways("V-001 a b V-002")).save(tmp_path / "graph.json")
    found, text, _ = run(capsys, "compare", tmp_path, "--source", *strict)
    assert found == code
    assert "the graph and its source differ" in text


@pytest.mark.parametrize("more", [[], ["plan.xml", "--source"], ["--source", "--by-network"]])
def test_neither_or_both_is_one_clear_line(more, tmp_path, capsys):
    plant(STRAIGHT, []).save(tmp_path / "graph.json")
    assert "--source" in refused(capsys, "compare", tmp_path, *more)


def test_a_link_to_a_part_that_is_not_there_is_no_graph():
    document = plant(STRAIGHT, ways("V-001 a")).to_json()
    document["stated"][0]["second"] = ["part-nowhere"]
    with pytest.raises(FormatError, match=r"the stated link from '/p/V-001' to '/p/a' names 'part-nowhere'"):
        SceneGraph.from_json(document)
    document["stated"][0]["flow"] = "sideways"
    with pytest.raises(FormatError, match=r"link '/p/V-001' - '/p/a' \(stated.0.flow\)"):
        SceneGraph.from_json(document)
