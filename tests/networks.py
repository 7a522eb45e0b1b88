"""Functional graphs worked out by hand, with places, for tests of what reads them."""

from __future__ import annotations

import math
from itertools import pairwise

import graphs
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import (
    Adjacent,
    Connected,
    Contains,
    GraphDocument,
    Joint,
    Junction,
    Port,
    Site,
    SourceRecord,
    System,
    Terminal,
    Unit,
)

TYPES = {"V": "valve", "G": "gauge", "P": "pump", "T": "tank", "E": "equipment"}


def unit(tag, kind=None, at=(0.0, 0.0, 0.0), ports=(), unit_type=None):
    low, high = tuple(c - 0.1 for c in at), tuple(c + 0.1 for c in at)
    return Unit(
        id=f"unit-{tag}",
        unit_type=unit_type or TYPES[tag[0]],
        tag=tag,
        kind=kind,
        parts=(),
        ports=tuple(Port(name=name, point=at) for name in ports),
        centroid=at,
        aabb=(low, high),
    )


def junction(number, at=(0.0, 0.0, 0.0)):
    return Junction(id=f"junction-{number:03d}", point=at, parts=())


def terminal(number, kind="open", at=(0.0, 0.0, 0.0)):
    return Terminal(id=f"terminal-{number:03d}", kind=kind, point=at, parts=())


def id_of(name):
    """``V-001`` for a unit, ``J1`` for a junction, ``X1`` for a terminal; ``P-001.N2`` names the port too."""
    name = name.split(".")[0]
    if name[0] == "J":
        return f"junction-{int(name[1:]):03d}"
    return f"terminal-{int(name[1:]):03d}" if name[0] == "X" else f"unit-{name}"


def chain(text, size=80, length=1.0, direction="forward", **more):
    """``"T-001.N1 V-001 J1"`` as edges: one from each name to the next."""
    names = text.split()
    edges = []
    for a, b in pairwise(names):
        ports = [name.partition(".")[2] or None for name in (a, b)]
        edges.append(
            Connected(
                source=id_of(a),
                target=id_of(b),
                size=size,
                diameter=size / 1000 if size else None,
                length=length,
                direction=direction,
                source_port=ports[0],
                target_port=ports[1],
                **more,
            )
        )
    return edges


def mounted(count=1, size=0.1):
    """A level gauge ``G-001`` without a line, pieces of a size in a row beside it, and the tank that they reach."""
    gauge = unit("G-001", "level gauge").model_copy(update={"parts": ("part-0",)})
    tank = unit("T-001", at=(0, 0, 2.0), ports=("N1",)).model_copy(update={"parts": (f"part-{count + 1}",)})
    parts = [
        graphs.part(0),
        *(graphs.part(k, size=size) for k in range(1, count + 1)),
        graphs.part(count + 1, size=9.0),
    ]
    touch = [Adjacent(source=a.id, target=b.id, distance=0.0, point=(0.0, 0.0, 0.0)) for a, b in pairwise(parts)]
    return [gauge, tank, *parts], touch


def joint(first, second, gap=0.0, score=0.9, made=True, kind="face", reasons=("axes aligned",), at=(0.0, 0.0, 0.0)):
    return Joint(first=first, second=second, kind=kind, point=at, gap=gap, score=score, made=made, reasons=reasons)


def network(nodes, edges, path="plant.usd", systems=True, joints=()):
    """A graph of nodes and edges; one system of all that has an edge."""
    pipes = [edge for edge in edges if isinstance(edge, Connected)]
    used = {end for edge in pipes for end in (edge.source, edge.target)}
    if systems and used:
        kinds = (Unit, Junction, Terminal)
        members = [tuple(n.id for n in nodes if isinstance(n, kind) and n.id in used) for kind in kinds]
        length = sum(edge.length or 0 for edge in pipes)
        sizes = tuple(sorted({edge.size for edge in pipes if edge.size}))
        system = System(
            id="system-001", units=members[0], junctions=members[1], terminals=members[2], length=length, sizes=sizes
        )
        nodes = [*nodes, system]
        edges = [*edges, *(Contains(source=system.id, target=member) for member in members[0])]
    return SceneGraph(
        GraphDocument(
            nodes=(Site(id="site"), *nodes), edges=tuple(edges), source=SourceRecord(path=path), joints=tuple(joints)
        )
    )


def along(*names, **places):
    """Edges between consecutive names with straight paths between their places and lengths to match."""
    size, direction = places.pop("size", 80), places.pop("direction", "forward")
    return [
        edge.model_copy(
            update={
                "path": (places["at"][a.split(".")[0]], places["at"][b.split(".")[0]]),
                "length": math.dist(places["at"][a.split(".")[0]], places["at"][b.split(".")[0]]),
            }
        )
        for a, b in pairwise(names)
        for edge in chain(
            f"{a} {b}", size, direction=direction, reason=None if direction == "unknown" else "pump P-001"
        )
    ]


PLACES = {
    "T-001": (0.0, 0.0, 2.0), "V-001": (1.5, 0.0, 0.8), "J1": (2.0, 0.0, 0.8),
    "V-002": (2.5, 0.0, 0.8), "G-001": (2.9, 0.0, 0.8), "P-001": (3.5, 0.0, 0.8),
    "V-003": (2.5, 2.0, 0.8), "G-002": (2.9, 2.0, 0.8), "P-002": (3.5, 2.0, 0.8),
    "G-003": (3.5, 0.0, 1.2), "V-004": (3.5, 0.0, 1.6), "V-005": (3.5, 0.0, 2.0), "J2": (3.5, 0.0, 2.5),
    "G-004": (3.5, 2.0, 1.2), "V-006": (3.5, 2.0, 1.6), "V-007": (3.5, 2.0, 2.0), "J3": (3.5, 1.0, 2.5),
    "J4": (5.0, 1.0, 2.5), "V-008": (4.0, 1.0, 3.5), "V-009": (6.0, 1.0, 2.5), "G-005": (6.5, 1.0, 2.5),
    "J5": (7.0, 1.0, 2.5), "J6": (8.0, 1.0, 2.5), "J7": (9.0, 1.0, 2.5),
    "V-010": (7.0, 2.0, 2.5), "X1": (7.0, 4.0, 2.5), "V-011": (8.0, 2.0, 2.5), "X2": (8.0, 4.0, 2.5),
    "V-012": (9.0, 2.0, 2.5), "X3": (9.0, 4.0, 2.5), "X4": (10.0, 1.0, 2.5),
    "V-013": (0.0, -1.0, 1.0), "G-006": (0.0, -1.0, 1.5),
    "J8": (6.8, 1.0, 2.5), "V-014": (6.8, 1.0, 2.8), "G-007": (6.8, 1.0, 3.0),
    "V-015": (0.5, 0.0, 3.5), "X5": (0.5, 0.0, 4.5), "V-016": (0.5, 0.0, 0.3), "X6": (0.5, 0.0, 0.1),
}  # fmt: skip


def pumping(path="pumping.usd"):
    """A tank, a duty and a standby pump, a recirculation line, and a header with three branches.

    ::

        T-001 - V-001 - J1 - V-002 - G-001 - P-001 - G-003 - V-004 check - V-005 - J3
                        J1 - V-003 - G-002 - P-002 - G-004 - V-006 check - V-007 - J3
        J3 - J4 - V-008 globe - T-001, the recirculation
             J4 - V-009 control - G-005 - J8 (V-014 - G-007) - J5 - J6 - J7, each with a branch
    """
    at = PLACES
    kinds = {
        "V-001": "gate valve", "V-002": "gate valve", "V-003": "gate valve", "V-004": "check valve",
        "V-005": "gate valve", "V-006": "check valve", "V-007": "gate valve", "V-008": "globe valve",
        "V-009": "control valve", "V-010": "ball valve", "V-011": "butterfly valve", "V-012": None,
        "V-013": "ball valve", "V-014": "ball valve", "V-015": "relief valve", "V-016": "ball valve",
        "G-005": "flow meter", "G-006": "level gauge",
    }  # fmt: skip
    nodes = []
    for name, place in at.items():
        if name[0] == "J":
            nodes.append(junction(int(name[1:]), place))
        elif name[0] == "X":
            nodes.append(terminal(int(name[1:]), "blind" if name == "X4" else "open", place))
        else:
            kind = kinds.get(name, "pressure gauge" if name[0] == "G" else None)
            ports = {"P": ("N1", "N2"), "T": ("N1", "N2", "N3", "N4", "N5")}.get(name[0], ())
            nodes.append(unit(name, kind, place, ports))
    nodes = [node for node in nodes if node.id != id_of("J2")]
    edges = [
        *along("T-001.N1", "V-001", "J1", size=100, at=at),
        *along("J1", "V-002", "G-001", "P-001.N1", at=at),
        *along("J1", "V-003", "G-002", "P-002.N1", at=at),
        *along("P-001.N2", "G-003", "V-004", "V-005", "J3", size=65, at=at),
        *along("P-002.N2", "G-004", "V-006", "V-007", "J3", size=65, at=at),
        *along("J3", "J4", size=80, at=at),
        *along("J4", "V-008", "T-001.N2", size=50, at=at),
        *along("J4", "V-009", size=80, at=at),
        *along("V-009", "G-005", "J8", "J5", "J6", size=80, at=at),
        *along("J6", "J7", "X4", size=80, at=at, direction="unknown"),
        *along("J8", "V-014", "G-007", size=15, at=at, direction="unknown"),
        *along("J5", "V-010", "X1", size=50, at=at),
        *along("J6", "V-011", "X2", size=50, at=at),
        *along("J7", "V-012", "X3", size=50, at=at, direction="unknown"),
        *along("T-001.N3", "V-013", "G-006", size=25, at=at, direction="unknown"),
        *along("T-001.N4", "V-015", "X5", size=50, at=at, direction="unknown"),
        *along("T-001.N5", "V-016", "X6", size=25, at=at, direction="unknown"),
    ]
    return network(nodes, edges, path)
