"""Whatever the network, however odd: every answer ends, nothing is lost, the drawing is sound, DEXPI comes back."""

import xml.etree.ElementTree as ET

import networkx as nx
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.draw.schematic import draw_diagram
from cadgraph.draw.schematic.layout import lay_out
from cadgraph.draw.schematic.plan import plan_systems
from cadgraph.export.dexpi import read_dexpi, write_dexpi
from cadgraph.query import (
    Arc,
    Network,
    explain_connection,
    explain_unit,
    find_isolation,
    find_lines,
    find_way,
    trace,
    what_if,
)
from cadgraph.query.text import isolation_lines, trace_lines
from networks import chain, id_of, junction, network, terminal, unit

NAMES = ["T-001", "P-001", "E-001", "J1", "J2", "X1", "X2", "V-001", "V-002", "V-003", "V-004", "G-001", "G-002"]
KINDS = {"X2": "blind", "V-001": "check valve", "V-002": "relief valve", "V-003": "control valve"}
EDGE = st.tuples(
    st.sampled_from(NAMES),
    st.sampled_from(NAMES),
    st.sampled_from(["forward", "backward", "unknown"]),
    st.sampled_from([50, 80, None]),
    st.sampled_from([1.0, 0.25, None]),
)


def node(name):
    at = (float(NAMES.index(name)), 1.0, 2.0)
    if name[0] == "J":
        return junction(int(name[1:]), at)
    return terminal(int(name[1:]), KINDS.get(name, "open"), at) if name[0] == "X" else unit(name, KINDS.get(name), at)


def made(rows):
    used = dict.fromkeys(name for row in rows for name in row[:2])
    return network(
        [node(name) for name in used],
        [e for a, b, flow, size, long in rows for e in chain(f"{a} {b}", size, long, flow)],
    )


networks = st.lists(EDGE, min_size=1, max_size=12).map(made)


@settings(max_examples=25, deadline=None)
@given(networks)
def test_every_connection_is_in_one_line_or_on_one_tap(graph):
    view = Network(graph)
    inside = [arc.index for line in find_lines(view) for arc in line.arcs]
    taps = [i for i, edge in enumerate(view.edges) if view.is_tap(Arc(i, edge, True))]
    assert sorted(inside + taps) == list(range(len(view.edges)))


@settings(max_examples=15, deadline=None)
@given(networks, st.booleans())
def test_every_question_has_an_answer(graph, check_valves):
    view = Network(graph)
    for place in view.places:
        for direction in ("downstream", "upstream"):
            assert trace_lines(trace(view, place, direction, through_unknown=check_valves))
        for fewest in (False, True):
            found = find_isolation(view, place, check_valves=check_valves, fewest=fewest)
            assert isolation_lines(found)
            assert not {valve.place for valve in found.valves} & set(found.shut_off)


@settings(max_examples=15, deadline=None)
@given(networks)
def test_neighbours_paths_and_explanations_agree(graph):
    view = Network(graph)
    for a in view.places:
        for b in graph.neighbors(a):
            assert a in {other.id for other in graph.neighbors(b)} or not a.startswith("unit")
        for b in view.places:
            way = [node.id for node in graph.path(a, b)]
            assert way == [step.place for step in find_way(view, a, b).steps]
            if a != b:
                found = explain_connection(view, a, b)
                assert found.connected == bool(way)
                assert found.lines()
    for place in view.places:
        assert explain_unit(view, place).lines()


@settings(max_examples=15, deadline=None)
@given(networks)
def test_every_drawing_is_orthogonal_and_well_formed(graph):
    ET.fromstring(draw_diagram(graph))
    for sketch in plan_systems(Network(graph)):
        for way in lay_out(sketch).ways:
            for (ax, ay), (bx, by) in zip(way, way[1:], strict=False):
                assert abs(ax - bx) < 0.01 or abs(ay - by) < 0.01


@settings(max_examples=25, deadline=None)
@given(networks)
def test_lines_come_back_from_dexpi(tmp_path_factory, graph):
    def told(lines):
        rows = []
        for line in lines:
            ends = sorted([(line.start, line.start_port or ""), (line.end, line.end_port or "")])
            length = None if line.length is None else round(line.length, 6)
            rows.append((ends, sorted(line.through), length, sorted(line.sizes), line.flow))
        return sorted(map(str, rows))

    path = write_dexpi(graph, tmp_path_factory.mktemp("dexpi") / "plant.xml")
    assert told(find_lines(read_dexpi(path))) == told(find_lines(graph))


def test_ids_of_names_are_those_of_the_nodes():
    assert [node(name).id for name in NAMES] == [id_of(name) for name in NAMES]


@settings(max_examples=40, deadline=None)
@given(networks, st.sets(st.sampled_from(["V-001", "V-002", "V-003", "V-004"]), min_size=1, max_size=3))
def test_closing_valves_leaves_nothing_out_and_closing_more_cuts_off_no_less(graph, tags):
    view = Network(graph)
    valves = sorted(tag for tag in tags if f"unit-{tag}" in view.places)
    if not valves:
        return
    found = what_if(view, valves)
    lists = [{one.place for one in those} for those in (found.cut_off, found.unknown, found.still_fed)]
    assert sum(map(len, lists)) == len(set().union(*lists))
    assert not set().union(*lists) & {f"unit-{tag}" for tag in valves}
    for tag in valves:
        fewer = {one.place for one in what_if(view, tag, found.sources or None).cut_off} if found.sources else set()
        given = {one.place for one in what_if(view, valves, found.sources).cut_off} if found.sources else set()
        assert fewer - {f"unit-{tag}" for tag in valves} <= given
    sources = {view.find(name) for name in found.sources}
    walked = nx.MultiDiGraph(
        (arc.start, arc.end) for p in view.places for arc in view.arcs(p) if view.is_tap(arc) or arc.flow != "against"
    )
    walked.add_nodes_from(view.places)
    before = sources.union(*(nx.descendants(walked, source) for source in sources))
    walked.remove_nodes_from(view.find(tag) for tag in valves)
    after = sources.union(*(nx.descendants(walked, source) for source in sources))
    told = {p for p in before - after if view.what(p) not in ("junction", "blind end") and view.name(p) not in valves}
    assert {one.place for one in found.cut_off} == told
