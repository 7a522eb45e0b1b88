"""Tables of the standards of piping, as CSV files beside this module: lengths in mm, a column ``source`` in each.

=======================  ===========================================================================================
``pipes``                outer diameters by nominal size (DN), and the wall where the size is built by the generator
``hygienic_tubes``       the same of tubes for food and pharmacy, whose sizes are others
``hygienic_tubes_inch``  the same of such tubes in inches
``flanges``              class 150
``face_to_face``         lengths of valves from flange face to flange face, class 150 (ASME B16.10)
``face_to_face_en558``   the same after EN 558, by basic series
``fittings``             lengths of elbows, tees and reducers
``nuts``                 by the diameter of their bolt
``washers``              by the diameter of their bolt
``gauges``               pressure gauges by the diameter of their case
``sections``             steel sections
=======================  ===========================================================================================
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType

__all__ = ["by_size", "lengths_of", "outer_diameters", "read_table"]


@cache
def read_table(name: str) -> tuple[Mapping[str, str], ...]:
    """The rows of a table by their columns, as they are written.

    Args:
        name: of the table, without ``.csv``.

    Raises:
        FileNotFoundError: there is no such table.
    """
    text = resources.files("cadgraph.model.standards").joinpath(f"{name}.csv").read_text(encoding="utf-8")
    return tuple(MappingProxyType(row) for row in csv.DictReader(text.splitlines()))


@cache
def outer_diameters(table: str = "pipes") -> tuple[tuple[int, float], ...]:
    """Nominal size (DN) and outer diameter of pipes [m], by every standard that is in a table.

    Args:
        table: ``pipes``, ``hygienic_tubes`` or ``hygienic_tubes_inch``.
    """
    return tuple(dict.fromkeys((int(row["dn"]), float(row["outer_mm"]) / 1000) for row in read_table(table)))


@cache
def by_size(table: str, column: str, kind: str) -> Mapping[int, float]:
    """The lengths of one kind of a table by nominal size (DN) [m].

    Args:
        table: ``face_to_face`` or ``fittings``.
        column: says what a row is of: ``valve`` or ``fitting``.
        kind: is in that column: ``gate``, ``elbow``...
    """
    rows = (row for row in read_table(table) if row[column] == kind)
    return MappingProxyType({int(row["dn"]): float(row["length_mm"]) / 1000 for row in rows})


@cache
def lengths_of(valve: str, size: int) -> tuple[float, ...]:
    """Lengths from face to face of a kind of valve at a nominal size, by ASME B16.10 and EN 558, ascending [m].

    Args:
        valve: ``gate``, ``globe``, ``ball``, ``check``, ``wafer check``, ``butterfly`` or ``diaphragm``.
        size: nominal (DN).
    """
    rows = (*read_table("face_to_face"), *read_table("face_to_face_en558"))
    found = {float(row["length_mm"]) / 1000 for row in rows if row["valve"] == valve and int(row["dn"]) == size}
    return tuple(sorted(found))
