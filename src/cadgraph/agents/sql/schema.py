"""The tables that SQL can ask: their columns and what these mean. Lengths are metres, coordinates world, Z up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["PLACED", "TABLES", "Table", "definitions", "schema_line"]


@dataclass(frozen=True)
class Table:
    """A table.

    Args:
        holds: what a row is, in words.
        columns: the type of each column (``TEXT``, ``REAL`` or ``INTEGER``) and what it means, by name.
        looked_up: columns that have an index.
    """

    holds: str
    columns: Mapping[str, tuple[str, str]]
    looked_up: tuple[str, ...] = ()


_X = ("REAL", "centre, towards the east [m]")
_Y = ("REAL", "centre, towards the north [m]")
_Z = ("REAL", "centre, height [m]")
_PLACE = {"x": _X, "y": _Y, "z": _Z}
_SYSTEM = ("TEXT", "id of the system; null where no pipe was found at it")
_NUMBER = ("INTEGER", "number of the connection; the same both ways")

TABLES: Mapping[str, Table] = {
    "unit": Table(
        "a valve, gauge, pump, tank or other equipment",
        {
            "tag": ("TEXT", "what it is called"),
            "type": ("TEXT", "valve, gauge, pump, tank or equipment"),
            "kind": ("TEXT", "ball valve, pressure gauge...; null where it is not known"),
            "likely_kind": ("TEXT", "where kind is null: the likeliest one, a guess"),
            "system": _SYSTEM,
            "region": ("TEXT", "north, north east, middle...: ninths of the plan"),
            "level": ("TEXT", "name of the level that it is worked from"),
            **_PLACE,
            "low": ("REAL", "height of its lowest point [m]"),
            "high": ("REAL", "height of its highest point [m]"),
            "reach_height": ("REAL", "height of its operator or face above the level [m]"),
            "reach": ("TEXT", "floor, platform or out of reach"),
            "pipes": ("INTEGER", "connections found at it; 0 may be a gap of the graph"),
            "id": ("TEXT", "of the node in graph.json"),
        },
        ("tag",),
    ),
    "point": Table(
        "a node of the network of pipes: a unit, a junction or an end",
        {
            "name": ("TEXT", "tag of a unit, id of another"),
            "what": ("TEXT", "unit, junction, open end, blind end or end of pipe (open or blind is not known)"),
            "system": _SYSTEM,
            **_PLACE,
        },
        ("name",),
    ),
    "part": Table(
        "one or more meshes that act as one item",
        {
            "id": ("TEXT", "of the node in graph.json"),
            "label_group": ("TEXT", "group of its label; null where it has none"),
            "label_name": ("TEXT", "name in that group"),
            "confidence": ("REAL", "of the label, 0 to 1"),
            "likely": ("INTEGER", "1 where the label is only the likeliest one"),
            "unit": ("TEXT", "tag of the unit that it belongs to"),
            "cluster": ("TEXT", "id of the structure; null for the ground and for noise"),
            "mesh": ("TEXT", "path of its largest mesh in the source"),
            **_PLACE,
            "dx": ("REAL", "size along x [m]"),
            "dy": ("REAL", "size along y [m]"),
            "dz": ("REAL", "size along z [m]"),
        },
        ("id", "unit"),
    ),
    "pipe": Table(
        "a connection between two points with no other between, once each way: two rows",
        {
            "a": ("TEXT", "name of the point that it leaves"),
            "b": ("TEXT", "name of the point that it leads to"),
            "flow": ("TEXT", "along (from a to b), against or unknown"),
            "length": ("REAL", "along the centreline [m]; null where not known"),
            "size": ("INTEGER", "nominal size, DN"),
            "line": ("TEXT", "tag of the line; null on the way to an instrument"),
            "confidence": ("REAL", "of the connection, 0 to 1"),
            "number": _NUMBER,
        },
        ("a", "b"),
    ),
    "contact": Table(
        "two parts that touch or nearly do, once each way: two rows",
        {
            "a": ("TEXT", "id of a part"),
            "b": ("TEXT", "id of the other part"),
            "gap": ("REAL", "between the surfaces [m]; 0 where they touch"),
        },
        ("a",),
    ),
    "line": Table(
        "a run of pipe without a branch",
        {
            "tag": ("TEXT", "stable name"),
            "first": ("TEXT", "name of the point that it starts at, upstream where that is known"),
            "last": ("TEXT", "name of the point that it ends at"),
            "through": ("TEXT", "tags of what stands in it, in order, taps at their place"),
            "length": ("REAL", "along the centreline [m]; null where not known"),
            "whole": ("INTEGER", "0 where a part of the length is unknown, so that it is a lower bound"),
            "sizes": ("TEXT", "nominal sizes (DN) in order: 80 or 80/50"),
            "flow": ("TEXT", "forward (first to last), backward, none, unknown or contradictory"),
            "system": _SYSTEM,
        },
    ),
    "cluster": Table(
        "a connected structure",
        {"id": ("TEXT", "of the node in graph.json"), "kind": ("TEXT", "pipe system, else its commonest group")}
        | {"parts": ("INTEGER", "how many it has")}
        | _PLACE,
    ),
    "system": Table(
        "a connected network of pipes",
        {
            "id": ("TEXT", "of the node in graph.json"),
            "units": ("INTEGER", "how many it has"),
            "ends": ("INTEGER", "how many open, blind or unknown ends it has"),
            "length": ("REAL", "of all its connections [m]"),
            "sizes": ("TEXT", "nominal sizes (DN), ascending: 15/50/80"),
        },
    ),
    "level": Table(
        "a place where one stands, or a way up; there is none in a graph that was built without places",
        {
            "name": ("TEXT", "ground, platform +2.10 m (north east)..."),
            "kind": ("TEXT", "ground, platform, stairs or ladder"),
            "height": ("REAL", "of the walking surface, or of the top of a way up [m]"),
            "low": ("REAL", "height that a way up starts from [m]"),
            "area": ("REAL", "to stand on, of what nothing else stands on [m2]; 0 for ways up"),
            "id": ("TEXT", "of the node in graph.json"),
        },
    ),
}
"""All tables by name, in the order in which they are documented."""

PLACED = frozenset(
    {"unit.level", "unit.reach", "unit.reach_height"} | {f"level.{name}" for name in TABLES["level"].columns}
)
"""Columns that nothing is known of where a graph was built without places, as ``table.column``."""


def definitions() -> list[str]:
    """The statements that make the tables and, after their rows are in, the indexes."""
    made = [
        f"CREATE TABLE {name} ({', '.join(f'{column} {kind}' for column, (kind, _) in table.columns.items())})"
        for name, table in TABLES.items()
    ]
    return made + [
        f"CREATE INDEX {name}_{column} ON {name} ({column})"
        for name, table in TABLES.items()
        for column in table.looked_up
    ]


def schema_line() -> str:
    """All tables with their columns on one line."""
    return " ".join(f"{name}({','.join(table.columns)})" for name, table in TABLES.items())
