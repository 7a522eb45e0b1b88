import networkx as nx
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.stages.relate import find_units, pipe_systems, relate_units

VOCABULARY = default_vocabulary()
GROUPS = {"p": "Pipe assembly", "v": "Valve assembly", "g": "Gauge assembly", "s": "Structural element", "-": None}


def contacts(*pairs):
    rows = np.array(sorted(tuple(sorted(p)) for p in pairs), np.int64).reshape(-1, 2)
    return Contacts(rows, np.zeros(len(rows)), np.zeros((len(rows), 2, 3)))


def labels(letters):
    return [Label(GROUPS[c], None, 1.0, "author") if GROUPS[c] else None for c in letters]


def one_cluster(letters):
    return np.zeros(len(letters), np.int64)


def relations(letters, *pairs, cluster=None):
    named, touching = labels(letters), contacts(*pairs)
    cluster = one_cluster(letters) if cluster is None else np.array(cluster)
    units = find_units(named, touching, cluster, VOCABULARY)
    return [tuple(units[i].tag for i in pair) for pair in relate_units(units, named, touching, cluster, VOCABULARY)]


def test_connected_parts_of_one_functional_group_form_a_unit():
    units = find_units(labels("vvpv"), contacts((0, 1), (1, 2), (2, 3)), one_cluster("vvpv"), VOCABULARY)
    assert [(u.tag, u.unit_type, u.parts) for u in units] == [("V-001", "valve", (0, 1)), ("V-002", "valve", (3,))]


def test_parts_of_different_functional_groups_stay_apart():
    units = find_units(labels("vg"), contacts((0, 1)), one_cluster("vg"), VOCABULARY)
    assert [u.tag for u in units] == ["G-001", "V-001"]


def test_units_along_a_pipe_are_related_in_their_order():
    assert relations("vpgpv", (0, 1), (1, 2), (2, 3), (3, 4)) == [("G-001", "V-001"), ("G-001", "V-002")]


def test_growth_stops_at_parts_that_are_no_connectors():
    assert relations("vpspv", (0, 1), (1, 2), (2, 3), (3, 4)) == []


def test_two_gauges_on_one_pipe_both_relate_to_it_through_the_first():
    # The paper's case in S1: the pipe belongs to the unit that comes first, so the order stays open.
    assert relations("gpgv", (0, 1), (1, 2), (1, 3)) == [("G-001", "G-002"), ("G-001", "V-001")]


def test_relations_are_only_looked_for_in_pipe_systems():
    assert relations("vg", (0, 1)) == []
    assert relations("vgp", (0, 1), (1, 2)) == [("G-001", "V-001")]


def test_clusters_do_not_relate_to_each_other():
    assert relations("vpv", (0, 1), (1, 2), cluster=[0, 0, 1]) == []


def test_a_unit_that_touches_nothing_is_a_unit_without_relations():
    assert relations("vpg", (0, 1)) == []


def test_nothing_gives_nothing():
    assert relations("") == []
    assert pipe_systems([], np.zeros(0, np.int64), VOCABULARY) == frozenset()


def paper_algorithm_1(units, connector, graph):
    """Algorithm 1 as it stands in the paper, line by line."""
    territories = [set(u.parts) for u in units]
    marked = set().union(*territories) if territories else set()
    while True:
        size = len(marked)
        for territory in territories:
            new = set()
            for v in territory:
                for u in graph[v]:
                    if u not in marked and connector[u]:
                        new.add(u)
                        marked.add(u)
            territory |= new
        if len(marked) == size:
            break
    owner = {v: i for i, t in enumerate(territories) for v in t}
    return sorted(
        {
            tuple(sorted((owner[v], owner[u])))
            for v, u in graph.edges
            if v in owner and u in owner and owner[v] != owner[u]
        }
    )


@settings(max_examples=150, deadline=None)
@given(st.text("pppvgs-", min_size=1, max_size=30), st.data())
def test_growing_by_fronts_gives_what_the_papers_full_scan_gives(letters, data):
    n = len(letters)
    index = st.integers(0, n - 1)
    pairs = {tuple(sorted(p)) for p in data.draw(st.lists(st.tuples(index, index), max_size=60)) if p[0] != p[1]}
    graph = nx.Graph(sorted(pairs))
    graph.add_nodes_from(range(n))
    cluster = np.zeros(n, np.int64)
    for c, members in enumerate(nx.connected_components(graph)):
        cluster[list(members)] = c
    named, touching = labels(letters), contacts(*pairs)
    units = find_units(named, touching, cluster, VOCABULARY)
    systems = pipe_systems(named, cluster, VOCABULARY)
    inside = graph.edge_subgraph([e for e in graph.edges if int(cluster[e[0]]) in systems]).copy()
    inside.add_nodes_from(graph)
    connector = [c == "p" for c in letters]
    assert relate_units(units, named, touching, cluster, VOCABULARY) == tuple(
        paper_algorithm_1(units, connector, inside)
    )
