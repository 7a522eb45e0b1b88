"""What the file says of joints and flow: kept without influence, and as a witness where that is asked for."""

from dataclasses import replace

import numpy as np
import pytest

import shapes
from cadgraph.config import Config
from cadgraph.model.facts import StatedLink
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.parts import Link, Network, Place, UnitParts
from cadgraph.model.scene import Scene
from cadgraph.model.stated import MOST_MESHES, StatedJoin, resolve_links
from cadgraph.pipeline import build
from cadgraph.stages.relate.flow_file import file_flow, weigh_flow
from cadgraph.stages.relate.flow_spread import Evidence
from cadgraph.stages.relate.stated import REACH, Stated, mouth_gap
from piping import PIPE, VALVE, Plant, R, connections, links, pipe, valve_mesh

PORTS, ORDER = "IfcRelConnectsPorts", "order in branch"


def link(first, second, flow="unknown", where=PORTS):
    return StatedLink(*(f"/m{each}" if isinstance(each, int) else each for each in (first, second)), flow, where)


def graph(plant, stated=(), use=True, **settings):
    """The graph of a plant whose file says some links."""
    paths = [f"/m{i}" for i in range(len(plant.meshes))]
    scene = replace(Scene.from_meshes(plant.meshes, paths), links=tuple(stated))
    given = [GivenLabel(path, *label) for path, label in zip(paths, plant.labels, strict=True) if label[0]]
    changes = {"label.labeler": "none", "ground.find": "none", "relate.use_metadata": use, **settings}
    return build(scene, Config().replace(changes), labels=given)


def two_valves(gap, aside=0.0):
    """Valve, pipe, a gap, pipe, valve: meshes 0 to 3."""
    plant = Plant()
    plant.add(valve_mesh((0, 0, 0)), VALVE, "valve")
    plant.pipe((0.089, 0, 0), (1, 0, 0))
    plant.pipe((1 + gap, aside, 0), (2 + gap, aside, 0))
    return plant.add(valve_mesh((2.089 + gap, aside, 0)), VALVE, "valve")


def codes(found):
    return {one.code for one in found.document.diagnostics}


# --- kept ---


def test_links_are_kept_without_influence():
    plant, said = two_valves(0.05), [link(0, 1), link(1, 2, "forward"), link(3, 2, "backward", ORDER)]
    bare, kept = graph(plant, use=False).to_json(), graph(plant, said, use=False).to_json()
    first = kept.pop("stated")
    assert "stated" not in bare
    assert kept == bare
    assert [(one["first"], one["second"], one["flow"], one["where"]) for one in first] == [
        (["part-00000"], ["part-00001"], "unknown", PORTS),
        (["part-00001"], ["part-00002"], "forward", PORTS),
        (["part-00003"], ["part-00002"], "backward", ORDER),
    ]


def test_a_file_without_links_gives_the_same_graph_whether_they_would_count_or_not():
    plant = two_valves(0.0)
    used, bare = graph(plant, use=True).to_json(), graph(plant, use=False).to_json()
    assert used.pop("config") != bare.pop("config")
    assert used == bare


def test_a_node_above_meshes_is_all_of_them_and_keeps_its_path():
    paths = ("/a/pump", "/a/pump/casing", "/a/pump/motor", "/a/pump2/casing", "/b", "/c/x", "/c/y")
    said = [link("/a/pump", "/b"), link("/c/", "/nowhere"), link("/a/pump", "/b")]
    first, second = resolve_links(said, paths, np.array([0, 1, 1, 2, 3, 4, 5]))
    assert (first.first, first.second) == ((0, 1), (3,))
    assert (second.first, second.second) == ((4, 5), ())
    assert first.link is said[0]


@pytest.mark.parametrize("more", [0, 1])
def test_a_node_above_a_whole_plant_says_nothing(more):
    paths = ["/b", *(f"/plant/m{k}" for k in range(MOST_MESHES + more))]
    (join,) = resolve_links([link("/plant", "/b")], paths, np.arange(len(paths)))
    assert len(join.first) == (0 if more else MOST_MESHES)


# --- joints ---


@pytest.mark.parametrize("gap", [0.03, 0.08])
def test_a_gap_is_bridged_where_the_file_joins_its_ends_and_that_counts(gap):
    plant, said = two_valves(gap), [link(1, 2)]
    assert ("V-001", "V-002") not in links(graph(plant, said, use=False))
    assert ("V-001", "V-002") not in links(graph(plant, use=True))
    found = graph(plant, said)
    assert links(found) == [("V-001", "V-002")]
    (joint,) = [one for one in found.joints(made=True) if (one.first, one.second) == ("part-00001", "part-00002")]
    assert any(reason.startswith(f"the file joins them ({PORTS})") for reason in joint.reasons)
    assert connections(found)[0].length == pytest.approx(1.911 + gap, abs=0.001)
    assert "stated-gap" in codes(found)


@pytest.mark.parametrize(
    ("plant", "said"),
    [
        (two_valves(REACH + 0.01), [link(1, 2)]),
        (two_valves(0.145), [link(1, 2)]),
        (two_valves(0.05, aside=0.05), [link(1, 2)]),
        (two_valves(0.05), [link(0, 3)]),
        (two_valves(0.05), [link(1, 1)]),
    ],
    ids=["far", "at its limit", "beside", "other parts", "itself"],
)
def test_a_wrong_link_joins_nothing(plant, said):
    found = graph(plant, said)
    assert ("V-001", "V-002") not in links(found)
    assert "stated-gap" not in codes(found)


def test_a_link_past_another_part_changes_nothing():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    plant.pipe((1.001, 0, 0), (1.08, 0, 0)).pipe((1.081, 0, 0), (2, 0, 0))
    found = graph(plant, [link(0, 2)])
    joined = {(one.first, one.second) for one in found.joints(made=True)}
    assert joined == {("part-00000", "part-00001"), ("part-00001", "part-00002")}


@pytest.mark.parametrize("use", [False, True])
def test_an_end_before_a_valve_joins_it_where_the_file_says_so(use):
    plant = Plant().add(valve_mesh((0, 0, 0)), VALVE, "valve").pipe((0.089 + 0.04, 0, 0), (1, 0, 0))
    plant.add(valve_mesh((1.089, 0, 0)), VALVE, "valve")
    found = graph(plant, [link(0, 1), link(1, 2)], use)
    assert (("V-001", "V-002") in links(found)) == use


@pytest.mark.parametrize("use", [False, True])
def test_a_branch_that_stops_before_its_header_joins_it_where_the_file_says_so(use):
    plant = Plant().pipe((0, 0, 0), (2, 0, 0))
    plant.add(pipe((1, 0, R + 0.03), (1, 0, 0.5), 0.02, 0.017), PIPE, "pipe")
    found = graph(plant, [link(1, 0)], use)
    assert links(found).count(("J", "open")) == (3 if use else 0)


def test_a_tap_between_elements_that_the_file_joins_elsewhere_is_less_sure():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0)).pipe((1, 0, 0), (2, 0, 0)).pipe((-1, 0, 0), (0, 0, 0))
    plant.add(pipe((0.5, 0, R), (0.5, 0, 0.5), 0.02, 0.017), PIPE, "pipe")
    plant.add(pipe((0.5, 0, 0.5), (0.5, 0, 1), 0.02, 0.017), PIPE, "pipe")
    plant.add(pipe((0.5, 0, 1), (0.5, 0, 1.5), 0.02, 0.017), PIPE, "pipe")
    whole = [link(0, 1), link(0, 2), link(3, 4), link(3, 5)]

    def tap(said):
        (found,) = (one for one in graph(plant, said).joints() if one.kind == "tap")
        return found

    assert tap(whole).score < tap(whole[:3]).score
    assert "the file joins both to others only (-1.0)" in tap(whole).reasons
    assert tap(whole).made


def test_links_that_say_nothing_are_told():
    found = graph(two_valves(0.0), [link(0, "/elsewhere"), link(0, 1)])
    (told,) = [one for one in found.document.diagnostics if one.code == "stated-unplaced"]
    assert "1 of 2 links" in told.message
    assert "/elsewhere" in told.message


@pytest.mark.parametrize(("distance", "met"), [(0.1, True), (REACH + 0.01, False), (-0.01, False)])
def test_a_wall_is_met_within_reach_before_a_mouth(distance, met):
    vertices, faces = shapes.moved(shapes.box((0.4, 0.4, 0.02)), np.eye(3), (0, 0, distance + 0.01))
    if distance < 0:
        vertices = vertices - [0, 0, 0.5]
    found = mouth_gap(vertices[faces], np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.05)
    assert (found is not None) == met
    if found is not None:
        assert found == pytest.approx((distance, 0.0), abs=1e-9)


def test_a_wall_that_covers_a_third_of_a_mouth_is_not_before_it():
    vertices, faces = shapes.moved(shapes.box((0.1, 0.4, 0.02)), np.eye(3), (0.07, 0, 0.05))
    assert mouth_gap(vertices[faces], np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.05) is None


# --- flow ---


def direction(found):
    """Of the only connection: whether it flows from V-001 to V-002, its reason, and how sure that is."""
    (edge,) = (one for one in connections(found))
    tags = {unit.id: unit.tag for unit in found.units()}
    onward = (tags[edge.source] == "V-001") == (edge.direction == "forward")
    return (onward if edge.direction != "unknown" else None), edge.reason or "", edge.direction_confidence


@pytest.mark.parametrize(
    ("said", "onward", "sure"),
    [
        ([link(0, 1, "forward")], True, 0.9),
        ([link(1, 0, "forward")], False, 0.9),
        ([link(1, 0, "backward")], True, 0.9),
        ([link(0, 1, "forward", ORDER)], True, 0.8),
        ([link(0, 1, "forward", ORDER), link(1, 2, "forward"), link(2, 3, "forward")], True, 0.9),
        ([link(0, 1, "forward"), link(1, 2, "forward"), link(3, 2, "forward")], True, 0.6),
        ([link(0, 1, "forward"), link(2, 1, "forward")], None, None),
        ([link(0, 1), link(1, 2)], None, None),
    ],
)
def test_flow_that_the_file_states_becomes_a_direction(said, onward, sure):
    found = graph(two_valves(0.0), said)
    assert direction(found)[0] is onward
    assert direction(found)[2] == sure
    assert (onward is None) or direction(found)[1].startswith("stated in the file: /m")
    contradicts = len({one.first < one.second if one.flow == "forward" else one.second < one.first for one in said}) > 1
    assert ("flow-disagrees" in codes(found)) == (contradicts and any(one.flow != "unknown" for one in said))


def test_what_the_user_says_goes_before_the_file():
    found = graph(two_valves(0.0), [link(0, 1, "forward")], **{"relate.flow": ("V-002 -> V-001",)})
    assert direction(found)[:2] == (False, "stated: V-002 -> V-001")
    assert "flow-disagrees" in codes(found)


def row(*types):
    """Units in a row, each joined to the next by one part: part 10 between the first two, 11, 12..."""
    units = tuple(UnitParts(kind, f"U-{k}", (k,)) for k, kind in enumerate(types))
    pipes = tuple(Link(k, k + 1, (10 + k,), ((k, 0.0, 0.0), (k + 1, 0.0, 0.0)), 1.0) for k in range(len(types) - 1))
    return Network(units, (), pipes)


def filed(network, *said):
    """Evidence of links between parts: (first, second, where)."""
    joins = (StatedJoin((a,), (b,), StatedLink(f"/{a}", f"/{b}", "forward", where)) for a, b, where in said)
    return file_flow(network, Stated(tuple(joins)))[0]


@pytest.mark.parametrize(
    ("sure", "file_wins"), [(0.7, True), (0.85, False), (0.95, False)], ids=["a guess", "construction", "shaft"]
)
def test_the_file_goes_before_guesses_but_not_before_construction(sure, file_wins):
    network = row("tank", "pump", "tank")
    weighed = weigh_flow(network, [], [Evidence(1, False, sure, "shown")], filed(network, (1, 11, PORTS)))
    assert weighed.flows.chosen[1].forward == file_wins
    assert len(weighed.disagreeing) == 1


def test_statements_that_contradict_each_other_fall_and_the_others_hold():
    network = row("tank", "valve", "valve", "valve", "tank")
    said = filed(network, (0, 10, ORDER), (10, 1, ORDER), (11, 1, ORDER), (2, 12, ORDER), (3, 13, ORDER))
    weighed = weigh_flow(network, [], [], said)
    assert {number: one.forward for number, one in weighed.flows.chosen.items()} == dict.fromkeys(range(4), True)
    assert weighed.disagreeing


@pytest.mark.parametrize(("kind", "flows"), [("open", True), ("blind", False)])
def test_where_a_branch_of_a_file_ends_at_a_lid_nothing_flows(kind, flows):
    units = (UnitParts("tank", "T-0", (0,)), UnitParts("tank", "T-1", (1,)))
    places = (Place("junction", (1.0, 0.0, 0.0), (20,)), Place(kind, (1.0, 1.0, 0.0), (21,)))
    ends = (0, 2), (2, 1), (2, 3)
    pipes = tuple(Link(a, b, (10 + k,), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), 1.0) for k, (a, b) in enumerate(ends))
    said = filed(Network(units, places, pipes), (20, 12, ORDER), (12, 21, ORDER), (10, 20, ORDER))
    assert [one.link for one in said] == ([0, 2] if flows else [0])


def test_one_statement_speaks_for_the_link_that_both_its_ends_are_on():
    tee = Place("junction", (1.0, 0.0, 0.0), (20,))
    units = tuple(UnitParts("tank", f"T-{k}", (k,)) for k in range(3))
    pipes = tuple(Link(k, 3, (10 + k,), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), 1.0) for k in range(3))
    network = Network(units, (tee,), pipes)
    assert [(one.link, one.forward) for one in filed(network, (11, 20, ORDER), (20, 12, ORDER))] == [
        (1, True),
        (2, False),
    ]
    assert filed(network, (10, 11, ORDER)) == []


def test_of_two_pipes_between_the_same_two_nobody_can_say_which_is_meant():
    units = tuple(UnitParts("tank", f"T-{k}", (k,)) for k in range(2))
    pipes = tuple(Link(0, 1, (10 + k,), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), 1.0) for k in range(2))
    network = Network(units, (), pipes)
    assert filed(network, (0, 1, PORTS)) == []
    assert [one.link for one in filed(network, (0, 11, PORTS))] == [1]


def test_a_statement_that_passes_too_many_parts_says_nothing():
    units = tuple(UnitParts("tank", f"T-{k}", (k,)) for k in range(2))
    way = Link(0, 1, tuple(range(10, 20)), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), 1.0)
    network = Network(units, (), (way,))
    assert len(filed(network, (10, 14, PORTS))) == 1
    assert filed(network, (10, 15, PORTS)) == []
