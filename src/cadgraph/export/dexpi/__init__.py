"""DEXPI 1.3 as Proteus XML: the functional graph for P&ID tools, and back. ``docs/dexpi.md`` says what is covered."""

from __future__ import annotations

from cadgraph.export.dexpi.reader import read_dexpi
from cadgraph.export.dexpi.writer import write_dexpi

__all__ = ["read_dexpi", "write_dexpi"]
