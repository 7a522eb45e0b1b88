"""The rows of the tables that SQL can ask, from a finished graph."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cadgraph._io.text import tag_key
from cadgraph.agents.answer import cell
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Box, Cluster, Part, Place, System, Unit
from cadgraph.model.regions import region_of
from cadgraph.query.lines import Line
from cadgraph.query.network import Arc, Network

__all__ = ["Row", "Rows", "make_tables"]

Row = tuple[str | float | int | None, ...]
Rows = Mapping[str, Sequence[Row]]

_LONGEST = 200  # characters of a text in a table: paths of meshes come from anybody


def make_tables(network: Network, lines: Sequence[Line], extent: Box) -> Rows:
    """The rows of all tables of :data:`~cadgraph.agents.sql.schema.TABLES`, by table, in the order of its columns.

    Texts are on one line, without control characters, and cut to 200 characters.

    Args:
        network: of the finished graph, with names as answers show them: on one line, no two alike.
        lines: all of it.
        extent: box that the regions are ninths of, in plan [m].
    """
    graph = network.graph
    names = {place: network.name(place) for place in network.places}
    places = [node.model_dump() for node in graph.of_layer(Place)]
    levels = _level_names(places)
    return {
        "unit": list(_units(network, names, levels, extent)),
        "point": list(_points(network, names)),
        "part": list(_parts(graph, names)),
        "pipe": list(_pipes(network, lines, names)),
        "contact": list(_contacts(graph)),
        "line": list(_lines(lines, names)),
        "cluster": [
            (_text(node.id), _text(node.kind), node.n_parts, *node.centroid) for node in graph.of_layer(Cluster)
        ],
        "system": [
            (_text(node.id), len(node.units), len(node.terminals), node.length, _joined(node.sizes))
            for node in graph.of_layer(System)
        ],
        "level": [
            (levels[p["id"]], _text(p["kind"]), p["height"], p["low"], p["area"], _text(p["id"])) for p in places
        ],
    }


def _text(value: str | None) -> str | None:
    return None if value is None else cell(value, _LONGEST)


def _joined(sizes: Sequence[int]) -> str:
    return "/".join(str(size) for size in sizes)


def _level_names(places: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """What levels are called in the tables, by id: no two alike."""
    often = Counter(cell(place["name"]) for place in places)
    return {
        place["id"]: cell(place["name"]) if often[cell(place["name"])] == 1 else f"{cell(place['name'])} {place['id']}"
        for place in places
    }


def _units(network: Network, names: Mapping[str, str], levels: Mapping[str, str], extent: Box) -> Iterator[Row]:
    for unit in sorted(network.graph.of_layer(Unit), key=lambda unit: tag_key(unit.tag)):
        access = unit.model_dump().get("access") or {}
        guess = unit.kind_guesses[0][0] if unit.kind is None and unit.kind_guesses else None
        yield (
            names[unit.id], _text(unit.unit_type), _text(unit.kind), _text(guess), _text(network.system(unit.id)),
            region_of(*extent, unit.centroid), levels.get(access.get("place") or ""), *unit.centroid,
            unit.aabb[0][2], unit.aabb[1][2], access.get("height"), access.get("reach"),
            len({arc.index for arc in network.arcs(unit.id)}), _text(unit.id),
        )  # fmt: skip


def _points(network: Network, names: Mapping[str, str]) -> Iterator[Row]:
    for place, node in network.places.items():
        what = "unit" if isinstance(node, Unit) else network.what(place)
        at = node.centroid if isinstance(node, Unit) else node.point
        yield names[place], what, _text(network.system(place)), *at


def _parts(graph: SceneGraph, names: Mapping[str, str]) -> Iterator[Row]:
    for part in graph.of_layer(Part):
        label, unit, cluster = part.label, graph.unit_of(part), graph.cluster_of(part)
        yield (
            _text(part.id), *((_text(label.group), _text(label.name), label.confidence) if label else (None,) * 3),
            int(label.likely) if label else None, names[unit.id] if unit else None,
            _text(cluster.id) if cluster else None, _text(part.meshes[0]), *part.centroid, *_extents(part.aabb),
        )  # fmt: skip


def _extents(box: Box) -> tuple[float, float, float]:
    x, y, z = (high - low for low, high in zip(*box, strict=True))
    return x, y, z


def _pipes(network: Network, lines: Sequence[Line], names: Mapping[str, str]) -> Iterator[Row]:
    line_of = {arc.index: line.tag for line in lines for arc in line.arcs}
    for number, edge in enumerate(network.edges):
        for arc in (Arc(number, edge, True), Arc(number, edge, False)):
            yield (
                names[arc.start], names[arc.end], arc.flow, arc.length, edge.size, line_of.get(number),
                edge.confidence, number,
            )  # fmt: skip


def _contacts(graph: SceneGraph) -> Iterator[Row]:
    for edge in graph.of_kind(Adjacent):
        a, b = _text(edge.source), _text(edge.target)
        yield a, b, edge.distance
        yield b, a, edge.distance


def _lines(lines: Sequence[Line], names: Mapping[str, str]) -> Iterator[Row]:
    for line in lines:
        through = ", ".join(names[place] for place in line.through)
        yield (
            line.tag, names[line.start], names[line.end], through, line.length, int(line.whole), line.size, line.flow,
            _text(line.system),
        )  # fmt: skip
