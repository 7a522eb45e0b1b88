"""Devices of few sides, as asset packs have them: their pieces may be melted into one mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cadplants.builder.device import Device
from cadplants.builder.params import among, chance
from cadplants.builder.table import Table
from cadplants.model.plant import Turning
from cadplants.solids.mesh_ops import Solid

__all__ = ["FACETS", "FACETS_TEXT", "Melting", "Piece", "put_pieces", "sides_of"]

FACETS = (0, 0, 0, 0, 6, 8, 10, 12, 16)
"""Sides of what is round in asset packs; 0: as the style has them."""
FACETS_TEXT = "sides of what is round; 0: as the style has them"


def sides_of(t: Table, radius: float, facets: int) -> int:
    """Sides of a circle of a radius [m]: as many as are asked for, as the style has them where that is 0."""
    return facets or t.n(radius, 6)


class Melting(Device):
    """A device of few sides, in one mesh or in pieces."""

    melted: bool = chance(0.5, "all of it is one mesh")
    facets: int = among(FACETS, FACETS_TEXT)

    def n(self, t: Table, radius: float) -> int:
        """Sides of a circle of a radius [m]."""
        return sides_of(t, radius, self.facets)


@dataclass(frozen=True)
class Piece:
    """A piece of a device that may be melted into one mesh with the others.

    Args:
        name: of the vocabulary.
        solids: in the device's frame.
        turns: what of it turns.
    """

    name: str
    solids: Sequence[Solid]
    turns: Turning | None = None


def put_pieces(t: Table, pieces: Sequence[Piece], melted: bool, whole_of: str = "valve", of: str = "valve") -> None:
    """Puts pieces down, melted into one mesh or each by itself; ``of``: material of the one mesh."""
    if melted:
        t.bundled(whole_of).add(whole_of, *(solid for piece in pieces for solid in piece.solids), of=of)
        return
    for piece in pieces:
        t.add(piece.name, *piece.solids, turns=piece.turns)
