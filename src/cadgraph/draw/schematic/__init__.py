"""The functional graph as a schematic in the manner of a piping and instrumentation diagram."""

from __future__ import annotations

from cadgraph.model.graph import SceneGraph
from cadgraph.query import Network

__all__ = ["diagram_style", "draw_diagram"]


def draw_diagram(graph: SceneGraph | Network, system: str | None = None, *, for_page: bool = False) -> str:
    """The functional graph as a schematic, one or all systems on a sheet.

    Valves after ISO 10628-2, instruments after ISA 5.1. Arrows stand where the direction of flow is known. Every name
    from the source is text, never markup; the same graph gives the same bytes. What stands for a unit, junction or end
    carries its id as ``data-id``, what stands for a line the line's tag as ``data-line``.

    Args:
        graph: the finished graph, or its network.
        system: id of the system to draw; all where None.
        for_page: whether the page that it is put into has the rules of :func:`diagram_style`, as one must that lets in
            no styles within; else they are in the document. The pieces of lines carry the rows of their connections as
            ``data-connection`` then, so that the page can mark some of a line alone.

    Returns:
        An SVG document.

    Raises:
        ValueError: no system has that id.
    """
    # The layout library is needed only by those who draw.
    from cadgraph.draw.schematic.drawing import draw_sheet

    return draw_sheet(graph if isinstance(graph, Network) else Network(graph), system, styled=not for_page)


def diagram_style() -> str:
    """The CSS rules of schematics, all of them within ``.schematic``."""
    from cadgraph.draw.schematic.drawing import STYLE

    return STYLE
