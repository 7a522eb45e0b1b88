"""Where things stand on the sheet, for those who draw it themselves."""

from __future__ import annotations

from dataclasses import dataclass

from cadgraph.draw.schematic.layout import lay_out, pack
from cadgraph.draw.schematic.plan import Row, plan_systems
from cadgraph.query.network import Network

__all__ = ["Places", "find_places"]

Spot = tuple[float, float]


@dataclass(frozen=True)
class Places:
    """Places of a schematic, x to the right and y up [mm].

    Args:
        width: of the sheet.
        height: of the sheet.
        spots: of units, junctions and terminals by id.
        routes: of lines by tag: corners from the start of the line to its first symbol, and from its last to its end.
    """

    width: float
    height: float
    spots: dict[str, Spot]
    routes: dict[str, tuple[tuple[Spot, ...], tuple[Spot, ...]]]


_MM = 0.25  # mm to a px: a valve is then 6.5 mm long, as on sheets for print
_MARGIN = 40.0  # px


def find_places(network: Network) -> Places:
    """The places of everything in the schematic of all systems."""
    placed = [lay_out(sketch) for sketch in plan_systems(network)]
    corners, wide, high = pack([(p.box[2] - p.box[0], p.box[3] - p.box[1]) for p in placed], _MARGIN)
    width, height = wide + 2 * _MARGIN, high + 2 * _MARGIN
    spots: dict[str, Spot] = {}
    routes: dict[str, tuple[tuple[Spot, ...], tuple[Spot, ...]]] = {}
    for one, (left, top) in zip(placed, corners, strict=True):
        move = _Move(left - one.box[0] + _MARGIN, top - one.box[1] + _MARGIN, height)
        for anchor, (x, y) in zip(one.sketch.anchors, one.anchors, strict=True):
            spots[anchor.place] = move.spot(x, y)
        for row, (x, y) in zip(one.sketch.rows, one.rows, strict=True):
            spots.update(_row_spots(row, x, y, move))
        ways = [tuple(move.spot(x, y) for x, y in way) for way in one.ways]
        for i, edge in enumerate(one.sketch.edges):
            line = one.sketch.rows[edge.row].line
            # The edge at a line's start stands right before the one at its end.
            if line is not None and line.tag not in routes:
                routes[line.tag] = ways[i], ways[i + 1][::-1]
    return Places(round(width * _MM, 4), round(height * _MM, 4), spots, routes)


@dataclass(frozen=True)
class _Move:
    """From the drawing's own places [px] to those on the sheet [mm]."""

    dx: float
    dy: float
    height: float

    def spot(self, x: float, y: float) -> Spot:
        return round((x + self.dx) * _MM, 4), round((self.height - y - self.dy) * _MM, 4)


def _row_spots(row: Row, x: float, y: float, move: _Move) -> dict[str, Spot]:
    """Where what stands in a row is, and what hangs at it."""
    spots: dict[str, Spot] = {}
    used = sum(cell.width for cell in row.cells)
    at = x - row.width / 2 + ((row.width - used) / 2 if row.line else 0.0)
    for cell in row.cells:
        middle = at + cell.width / 2
        if cell.place:
            spots[cell.place] = move.spot(middle, y)
        at += cell.width
    return spots
