"""Writes a finished graph in the formats of other tools; :mod:`cadgraph.export.usd` lays it over the source as USD."""

from __future__ import annotations

from cadgraph.export.registry import Written, export_graph, formats, write_export

__all__ = ["Written", "export_graph", "formats", "write_export"]
