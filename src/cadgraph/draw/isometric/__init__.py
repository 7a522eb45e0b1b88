"""Isometric drawings of lines: 30 degree axes, lengths not to scale, dimensions in millimetres, bill of components.

Directions are those of the plant: north (+y) to the upper right, east (+x) to the lower right, up upwards; or north to
the upper left and east to the upper right, where that shows more. What runs along none of the three gets the edges of a
box beside it, dashed. Every text has a place of its own: one that finds none beside what it belongs to moves out, with
a line that leads back.
"""

from __future__ import annotations

from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.draw.isometric.dimensions import draw_dimensions, draw_skews
from cadgraph.draw.isometric.legs import legs_of, untangled
from cadgraph.draw.isometric.page import document_of
from cadgraph.draw.isometric.sheet import Box, Isometric, back
from cadgraph.draw.isometric.symbols import draw_instruments, draw_pipes, write_end, write_tags
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.query.components import find_components
from cadgraph.query.piped_line import PipedLine

__all__ = ["Box", "Isometric", "draw_isometric", "write_isometrics"]


def write_isometrics(graph: SceneGraph, folder: str | Path) -> tuple[tuple[Path, ...], tuple[Diagnostic, ...]]:
    """Writes a drawing of each line, ``L-0123.svg``.

    Args:
        graph: the finished graph.
        folder: where to; made if missing.

    Returns:
        The files in the order of the line list, and notes on lines that could not be drawn (``no-centreline``,
        ``no-component``) or lack joints (``missing-joint``).

    Raises:
        OutputError: a file can't be written.
    """
    files: list[Path] = []
    notes: list[Diagnostic] = []
    for line in find_components(graph):
        notes.extend(line.notes)
        if not line.components:
            if not line.notes:
                notes.append(Diagnostic("no-component", f"{line.line.tag}: nothing of it stands between what it joins"))
            continue
        path = Path(folder) / f"{line.line.tag}.svg"
        write_atomically(path, draw_isometric(line)[0])
        files.append(path)
    return tuple(files), tuple(notes)


def draw_isometric(line: PipedLine) -> tuple[str, Isometric]:
    """The drawing of one line.

    Args:
        line: with at least one component.

    Returns:
        The SVG document, and where on the sheet what stands.
    """
    legs = legs_of(line.components)
    spots, turned = untangled(legs)
    sheet = Isometric(turned=turned)
    draw_pipes(sheet, line, legs, spots)
    write_end(sheet, line.start, spots[0], back(spots[0], spots[1]))
    write_end(sheet, line.end, spots[-1], back(spots[-1], spots[-2]))
    draw_instruments(sheet, line, legs, spots)
    write_tags(sheet, legs, spots)
    draw_dimensions(sheet, legs, spots)
    draw_skews(sheet, legs, spots)
    sheet.settle()
    return document_of(sheet, line), sheet
