"""What utilities are fixed to: walls, columns, struts, posts, beams overhead."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import Device
from cadplants.builder.draws import of_form
from cadplants.builder.params import Params, among, between
from cadplants.builder.table import Table
from cadplants.model.family import Part
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import section_channel, section_i
from cadplants.solids.primitives import box, cylinder, hexagon, rod
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "FRAME",
    "GROUP",
    "JOINT",
    "Back",
    "Utility",
    "beam_over",
    "gland",
    "h_column",
    "hanger",
    "pole",
    "strut",
    "wall",
]

GROUP = "Electrical and safety"
FRAME, JOINT = "Structural element", "Connection assembly"


class Utility(Device, place="floor", group=GROUP, sizes=(15,), grain="fitting"):
    """Electrical or safety equipment that stands by itself; its label is the first word of its name."""

    def __init_subclass__(cls, **said: Any) -> None:
        super().__init_subclass__(**{"label": said.get("name", "").split("/")[0], **said})


def wall(x0: float, x1: float, height: float, thick: float = 0.12) -> Part:
    """A wall along x whose face looks to -y at y = 0."""
    return Part(box((x1 - x0, thick, height), ((x0 + x1) / 2, thick / 2, height / 2)), "wall", "concrete", "", FRAME)


def h_column(height: float, size: float = 0.16) -> Part:
    """An H column with the face of its flange at y = 0, standing behind it."""
    section = extrude(section_i(size, size, 0.006, 0.009), 0.0, height)
    return Part(moved(section, at(0, size / 2)), "column", "steel", "", FRAME)


def pole(height: float, radius: float, style: ModelingStyle, square: bool = False) -> list[Part]:
    """A post on a base plate with anchors."""
    shaft = (
        box((2 * radius, 2 * radius, height - 0.012), (0, 0, (height + 0.012) / 2))
        if square
        else cylinder(radius, 0.012, height, style.round(radius))
    )
    foot = 2 * radius + 0.12
    bolts = [
        moved(hexagon(0.02, 0.012, 0.025), at(sx * 0.38 * foot, sy * 0.38 * foot)) for sx in (-1, 1) for sy in (-1, 1)
    ]
    return [
        Part(shaft, "post", "clamp", "", FRAME),
        Part(box((foot, foot, 0.012), (0, 0, 0.006)), "base plate", "clamp", "", FRAME),
        Part(merge(bolts), "bolt", "fastener", "", JOINT, True),
    ]


def strut(x0: float, x1: float, size: float = 0.041) -> Solid:
    """A strut channel (41 mm) along x, its open side looking to -y, its back at y = 0."""
    section = section_channel(size, size, 0.0025, 0.0025)
    return moved(about_x(extrude(section, x0, x1)), spun("x", np.pi))


def beam_over(x0: float, x1: float, height: float, y: float = 0.0, size: float = 0.14) -> list[Part]:
    """A beam along x with its underside at a height, on a column at each end."""
    beam = moved(about_x(extrude(section_i(size, 0.6 * size, 0.006, 0.008), x0, x1)), at(0, y, height + size / 2))
    posts = [box((0.1, 0.1, height), (x, y, height / 2)) for x in (x0 + 0.05, x1 - 0.05)]
    return [Part(beam, "beam", "steel", "", FRAME), *(Part(p, "column", "steel", "", FRAME) for p in posts)]


def gland(radius: float) -> Solid:
    """A cable gland about z, from its box at 0 downwards: two hexagons and a dome nut."""
    return merge(
        [
            hexagon(3.0 * radius, -0.8 * radius, 0.0),
            cylinder(1.2 * radius, -1.4 * radius, -0.7 * radius, 10),
            hexagon(2.7 * radius, -2.6 * radius, -1.3 * radius),
        ]
    )


def hanger(x: float, y: float, low: float, high: float) -> Solid:
    """A threaded rod from a height up to another."""
    return rod((x, y, low), (x, y, high), 0.005, 6)


class Back(Params):
    """What a thing whose back is at y = 0 is fixed to: a wall, a column or a post."""

    form: str = among(("wall", "wall", "column", "post"), "what it is")
    radius: float = between(0.03, 0.05, "half the width of a post", "m", when=of_form("post"))

    def build(self, t: Table, height: float, wide: float = 0.5) -> None:
        """Puts it down, a wall of twice this width [m]."""
        if self.form == "wall":
            t.extend([wall(-wide, wide, height)])
        elif self.form == "column":
            t.extend([h_column(height, 0.2)])
        else:
            t.at(0, self.radius).extend(pole(height, self.radius, t.style, True))
