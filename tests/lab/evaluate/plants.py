"""Small truths for tests, and the graphs that agree with them."""

from __future__ import annotations

import random

import graphs
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import (
    Adjacent,
    Cluster,
    Connected,
    Contains,
    GraphDocument,
    Junction,
    Related,
    Site,
    Terminal,
)
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary

PIPE, VALVE, GAUGE, STEEL = "Pipe assembly", "Valve assembly", "Gauge assembly", "Structural element"


def line():
    """end - V1 - junction (branch to G1) - V2 with a flow, in cluster A; V3 and a beam in cluster B; a ground."""
    rows = [
        ("/p0", PIPE, "pipe"), ("/v1", VALVE, "valve body"), ("/v1w", VALVE, "handwheel"), ("/p1", PIPE, "tee"),
        ("/g1", GAUGE, "gauge"), ("/p2", PIPE, "pipe"), ("/v2", VALVE, "valve body"), ("/v2w", VALVE, "handwheel"),
        ("/b", STEEL, "beam"), ("/v3", VALVE, "valve"), ("/floor", STEEL, "ground"),
    ]  # fmt: skip
    return Truth.from_json(
        {
            "format": "cadgraph-truth",
            "version": 1,
            "meshes": [{"mesh": m, "group": g, "name": n} for m, g, n in rows],
            "units": [
                {"id": "V1", "type": "valve", "kind": "gate valve", "tag": "V-1", "meshes": ["/v1", "/v1w"]},
                {"id": "V2", "type": "valve", "kind": "ball valve", "tag": "V-2", "meshes": ["/v2", "/v2w"]},
                {"id": "V3", "type": "valve", "kind": None, "tag": None, "meshes": ["/v3"]},
                {"id": "G1", "type": "gauge", "kind": "pressure gauge", "tag": "G-1", "meshes": ["/g1"]},
            ],
            "points": [
                {"id": "end", "kind": "terminal", "point": [0, 0, 0]},
                {"id": "branch", "kind": "junction", "point": [1, 0, 0]},
            ],
            "connections": [
                {"from": "end", "to": "V1"},
                {"from": "V1", "to": "branch", "direction": "forward", "reason": "check valve"},
                {"from": "V2", "to": "branch", "direction": "backward"},
                {"from": "branch", "to": "G1"},
            ],
            "clusters": [
                {"id": "A", "meshes": ["/p0", "/v1", "/v1w", "/p1", "/g1", "/p2", "/v2", "/v2w"]},
                ["/b", "/v3"],
            ],
            "contacts": [
                ["/p0", "/v1"], ["/v1", "/v1w"], ["/v1", "/p1"], ["/p1", "/g1"], ["/p1", "/p2"], ["/p2", "/v2"],
                ["/v2", "/v2w"], ["/b", "/v3"],
            ],
        }
    )  # fmt: skip


def related_pairs(truth):
    """Adjacent units of a truth, found another way than the code under test: by removing one junction after another."""
    links = {frozenset((c.source, c.target)) for c in truth.connections or ()}
    for point in truth.points:
        if point.kind == "junction":
            near = sorted(set().union(*(pair for pair in links if point.id in pair)) - {point.id})
            links = {pair for pair in links if point.id not in pair}
            links |= {frozenset((a, b)) for a in near for b in near if a < b}
    units = {unit.id for unit in truth.units or ()}
    return sorted(tuple(sorted(pair)) for pair in links if len(pair) == 2 and pair <= units)


def agreeing(truth, confidence=1.0, rename=lambda kind, name: f"{kind}-{name}", shuffle=None):
    """A graph that says exactly what the truth says, one part for each mesh.

    Args:
        truth: of which the graph is made.
        confidence: of all labels.
        rename: makes ids of a kind of thing and its name in the truth.
        shuffle: seed for the order of nodes and edges.
    """
    ids = {row.mesh: rename("part", row.mesh.strip("/")) for row in truth.meshes}
    nodes = [
        graphs.part(
            i,
            row.mesh,
            id=ids[row.mesh],
            ground=row.name == "ground",
            label=None
            if row.group is None or row.name == "ground"
            else Label(group=row.group, name=row.name, confidence=confidence, source="human"),
        )
        for i, row in enumerate(truth.meshes)
    ]
    edges = []
    for number, cluster in enumerate(truth.clusters or ()):
        here = rename("cluster", number)
        nodes.append(Cluster(id=here, n_parts=len(cluster.meshes), centroid=graphs.ORIGIN, aabb=graphs.box()))
        edges += [Contains(source=here, target=ids[mesh]) for mesh in cluster.meshes]
    for unit in truth.units or ():
        made = graphs.unit(f"X-{unit.id}", *(ids[m] for m in unit.meshes), unit_type=unit.type, kind=unit.kind)
        nodes.append(made.model_copy(update={"id": rename("node", unit.id)}))
    for point in truth.points:
        here = rename("node", point.id)
        if point.kind == "junction":
            nodes.append(Junction(id=here, point=graphs.ORIGIN, parts=()))
        else:
            nodes.append(Terminal(id=here, kind=point.end or "unknown", point=graphs.ORIGIN, parts=()))
    edges += [
        Connected(source=rename("node", c.source), target=rename("node", c.target), direction=c.direction)
        for c in truth.connections or ()
    ]
    edges += [Related(source=rename("node", a), target=rename("node", b)) for a, b in related_pairs(truth)]
    edges += [
        Adjacent(source=min(ids[a], ids[b]), target=max(ids[a], ids[b]), distance=0.0, point=graphs.ORIGIN)
        for a, b in truth.contacts or ()
    ]
    if shuffle is not None:
        random.Random(shuffle).shuffle(nodes)
        random.Random(shuffle).shuffle(edges)
    return made_of([Site(id="site"), *nodes], edges)


def made_of(nodes, edges, vocabulary=True):
    tree = default_vocabulary().to_json() if vocabulary else {}
    return SceneGraph(GraphDocument(nodes=tuple(nodes), edges=tuple(edges), vocabulary=tree))


def changed(graph, nodes=lambda node: node, edges=lambda edge: edge):
    """A copy with nodes and edges changed one by one; None leaves one out."""
    document = graph.document
    return SceneGraph(
        document.model_copy(
            update={
                "nodes": tuple(new for node in document.nodes if (new := nodes(node)) is not None),
                "edges": tuple(new for edge in document.edges if (new := edges(edge)) is not None),
            }
        )
    )


def relabelled(graph, labels):
    """Parts by mesh with another label: ``(group, name, confidence)`` or None."""

    def change(node):
        mesh = getattr(node, "meshes", ("",))[0]
        if mesh not in labels:
            return node
        given = labels[mesh]
        label = Label(group=given[0], name=given[1], confidence=given[2], source="human") if given else None
        return node.model_copy(update={"label": label})

    return changed(graph, change)
