"""Which colour stands for what."""

from __future__ import annotations

from cadgraph.draw.render.color import distinct_colors, to_hex
from cadgraph.model.graph import SceneGraph

__all__ = ["BACKDROP", "RELATION", "UNLABELLED", "color_of_unit_type", "group_colors"]

UNLABELLED = "#d3d8de"
"""Parts without a label; in pictures they are striped as well."""

BACKDROP = "#dde1e6"
"""What a picture is not about: the ground, and parts outside all clusters."""

RELATION = "#e2211c"
"""Functional relations (paper, figures 4 to 6: red)."""

_GROUPS = {
    # The paper's figures: purple pipe, blue valve, green gauge, magenta tank, grey structure, teal connection. Slightly
    # less saturated than there, so that shading still shows.
    "Pipe assembly": "#8a45e6",
    "Valve assembly": "#1f86f0",
    "Gauge assembly": "#20b03e",
    "Tank": "#e24ad0",
    "Structural element": "#8e949c",
    "Connection assembly": "#0f7f7c",
    # Ours, as far from those and from the red of the relations as there is room.
    "Pump unit": "#f08c1e",
    "Equipment": "#c9a227",
    "Electrical and safety": "#8a5a33",
}


def group_colors(graph: SceneGraph) -> dict[str, str]:
    """A colour for each group of the vocabulary, and for every other group that a part is labelled with.

    Args:
        graph: the finished graph.

    Returns:
        ``"#rrggbb"`` by group, in the order of the vocabulary.
    """
    used = {part.label.group for part in graph.parts() if part.label is not None}
    names = list(graph.vocabulary)
    names += sorted(used - set(names))
    others = [name for name in names if name not in _GROUPS]
    # The first few of the distinct colours come close to the fixed ones: purple, green, red.
    spare = [to_hex(color) for color in distinct_colors(len(others) + 3)[3:]]
    return {name: _GROUPS.get(name) or spare[others.index(name)] for name in names}


def color_of_unit_type(graph: SceneGraph, colors: dict[str, str]) -> dict[str, str]:
    """The colour of each unit type: that of the group whose parts form it."""
    found = {}
    for group, content in graph.vocabulary.items():
        unit_type = content.get("unit") if isinstance(content, dict) else None
        if isinstance(unit_type, str):
            found[unit_type] = colors[group]
    return found
