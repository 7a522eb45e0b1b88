"""Modelling styles: consistent styles in which somebody models a plant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Literal

import numpy as np

__all__ = ["RGB", "STYLES", "Grain", "ModelingStyle"]

RGB = tuple[float, float, float]
Grain = Literal["one", "few", "pieces"]

_LONG_BEND = 4  # pieces of a bend of long triangles

_REALISTIC: dict[str, RGB] = {
    "pipe": (0.36, 0.40, 0.44),
    "flange": (0.42, 0.45, 0.48),
    "gasket": (0.05, 0.05, 0.06),
    "fastener": (0.50, 0.47, 0.36),
    "valve": (0.03, 0.14, 0.42),
    "trim": (0.45, 0.46, 0.48),
    "handle": (0.50, 0.02, 0.02),
    "gauge": (0.55, 0.56, 0.58),
    "dial": (0.88, 0.88, 0.86),
    "needle": (0.02, 0.02, 0.02),
    "steel": (0.24, 0.26, 0.28),
    "clamp": (0.60, 0.61, 0.62),
    "rubber": (0.03, 0.03, 0.03),
    "tank": (0.62, 0.64, 0.66),
    "motor": (0.05, 0.22, 0.36),
    "pump": (0.03, 0.18, 0.38),
    "safety": (0.65, 0.45, 0.02),
    "fence": (0.75, 0.76, 0.77),
    "gate": (0.03, 0.32, 0.08),
    "concrete": (0.55, 0.54, 0.51),
    "electrical": (0.50, 0.51, 0.47),
    "ground": (0.68, 0.68, 0.67),
}


@dataclass(frozen=True)
class ModelingStyle:
    """How somebody models: what is left out, what is one mesh, how round things are.

    Args:
        name: short, for the truth.
        sag: greatest deviation of a polygon from its circle [m].
        sides: least and greatest number of sides of a round section.
        hollow: whether pipes have inner walls.
        flange: ``neck`` (hub, raised face), ``slip`` (short hub) or ``ring`` (a plain disc).
        holes: whether flanges are drilled.
        fasteners: ``none``, ``flange`` (the bolts of a joint are of one mesh with a flange), ``set`` (they are one
            mesh), ``bolt`` (a bolt with its nuts is one mesh) or ``pieces`` (stud, nuts, washers).
        gaskets: whether there are any.
        valve: pieces of a valve: ``one``, ``few`` (body, handle) or ``pieces``.
        gauge: likewise.
        spool: ``segments`` (pipes and elbows) or ``bent`` (one mesh from flange to flange).
        pump: likewise pieces of a pump; None as of a valve.
        tank: of a tank; None all pieces.
        equipment: of a heat exchanger, boiler, filter...; None one.
        structure: of ladders, gratings, railings, clamps...; None all pieces.
        merged: whether pipes, elbows and flanges of a spool are one mesh (what ``assortment`` does).
        capped: whether solid pipes have end faces (likewise).
        rows: longest piece of a long face [m]: regular rows rather than slivers; 0 leaves slivers (likewise).
        fans: whether round caps are fanned from a corner rather than from their middle (likewise).
        soup: share of meshes whose triangles share no corners (likewise).
        cracks: share of meshes that lack some triangles or have some twice (likewise).
        gap: least and greatest gap left between what should touch, negative for overlaps [m].
        wobble: greatest unevenness of surfaces [m].
        fittings: ``smooth``, or ``long``: elbows, tees and reducers of few long triangles, as boundary representations
            are meshed; a reducer is a cone between two short spigots, its ends of different numbers of sides.
        devices: ``built`` (valves and pumps with the shapes of their pieces) or ``primitives`` (of cones, cylinders and
            boxes, as plant-design systems draw them).
        palette: colour by kind of material.
    """

    name: str
    sag: float = 0.00025
    sides: tuple[int, int] = (16, 48)
    hollow: bool = True
    flange: Literal["neck", "slip", "ring"] = "neck"
    holes: bool = True
    fasteners: Literal["none", "flange", "set", "bolt", "pieces"] = "bolt"
    gaskets: bool = True
    valve: Literal["one", "few", "pieces"] = "pieces"
    gauge: Literal["one", "few", "pieces"] = "pieces"
    spool: Literal["segments", "bent"] = "segments"
    pump: Grain | None = None
    tank: Grain | None = None
    equipment: Grain | None = None
    structure: Grain | None = None
    merged: bool = False
    capped: bool = True
    rows: float = 0.0
    fans: bool = False
    soup: float = 0.0
    cracks: float = 0.0
    gap: tuple[float, float] = (0.0, 0.0)
    wobble: float = 0.0
    fittings: Literal["smooth", "long"] = "smooth"
    devices: Literal["built", "primitives"] = "built"
    palette: Mapping[str, RGB] = field(default_factory=lambda: _REALISTIC, compare=False)

    @property
    def published(self) -> bool:
        """Whether its name is enough to know it."""
        return STYLES.get(self.name) == self

    def to_json(self) -> dict[str, Any]:
        """All of it but the colours, as plain JSON values."""
        said = ((one.name, getattr(self, one.name)) for one in fields(self) if one.name != "palette")
        return {name: list(value) if isinstance(value, tuple) else value for name, value in said}

    @classmethod
    def from_json(cls, said: Mapping[str, Any]) -> ModelingStyle:
        """What ``to_json`` has written down, in the usual colours.

        Raises:
            ValueError: it says something that no style has.
        """
        other = sorted(set(said) - {one.name for one in fields(cls)})
        if other:
            raise ValueError(f"a style has no {other[0]!r}")
        values: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value for name, value in said.items()
        }
        return cls(**values)

    @property
    def looseness(self) -> float:
        """The greatest gap between two parts that should touch [m]."""
        return max(0.0, self.gap[1]) + 2 * self.wobble

    def round(self, radius: float) -> int:
        """Sides of a circle of this radius [m]: a multiple of 4."""
        angle = 2 * np.arccos(max(-0.5, 1 - self.sag / max(radius, self.sag)))
        least, most = self.sides
        return int(np.clip(np.ceil(2 * np.pi / angle / 4) * 4, least, most))

    def grain(self, kind: str) -> Grain:
        """How fine a ``valve``, ``gauge``, ``pump``, ``tank``, ``equipment``, ``structure`` or ``fitting`` is."""
        grains: dict[str, Grain] = {
            "valve": self.valve,
            "gauge": self.gauge,
            "pump": self.pump or self.valve,
            "tank": self.tank or "pieces",
            "equipment": self.equipment or "one",
            "structure": self.structure or "pieces",
        }
        return grains.get(kind, "pieces")

    def bend(self, radius: float, turn: float = np.pi / 2) -> int:
        """Pieces of a bend of this radius [m] and turn [rad]."""
        pieces = round(self.round(radius) * turn / (2 * np.pi))
        return max(2, min(pieces, _LONG_BEND) if self.fittings == "long" else pieces)

    def round_fitting(self, radius: float) -> int:
        """Sides of a fitting of this radius [m]: as of any circle, or 8 to 16 where fittings are of long triangles."""
        return int(np.clip(self.round(radius), 8, 16)) if self.fittings == "long" else self.round(radius)

    def color(self, kind: str) -> RGB:
        """The colour of a kind of material."""
        return self.palette[kind]


# What other hands colour by: everything alike, or by system.
_GRAY: dict[str, RGB] = dict.fromkeys(_REALISTIC, (0.5, 0.5, 0.5))
_SYSTEMS: dict[str, RGB] = {
    **dict.fromkeys(("pipe", "flange", "gasket", "fastener"), (0.1, 0.42, 0.2)),
    **dict.fromkeys(("valve", "trim", "handle"), (0.62, 0.2, 0.05)),
    **dict.fromkeys(("gauge", "dial", "needle"), (0.7, 0.62, 0.1)),
    **dict.fromkeys(("steel", "clamp", "rubber", "safety", "fence", "gate"), (0.35, 0.37, 0.42)),
    **dict.fromkeys(("tank", "motor", "pump"), (0.3, 0.42, 0.55)),
    **dict.fromkeys(("concrete", "electrical", "ground"), (0.6, 0.58, 0.54)),
}

# The published styles; a plant names the styles it was made by, and a benchmark can hold any of them out.
STYLES: dict[str, ModelingStyle] = {
    style.name: style
    for style in (
        ModelingStyle("plant-design"),
        ModelingStyle(
            "bim",
            sides=(12, 12),
            hollow=False,
            flange="ring",
            holes=False,
            fasteners="none",
            gaskets=False,
            valve="one",
            gauge="one",
            gap=(0.0, 0.003),
            palette=_SYSTEMS,
        ),
        ModelingStyle("mechanical", sag=0.00008, sides=(24, 72), fasteners="pieces"),
        ModelingStyle(
            "game",
            sag=0.002,
            sides=(8, 16),
            hollow=False,
            flange="slip",
            holes=False,
            fasteners="set",
            valve="few",
            gauge="few",
            spool="bent",
        ),
        ModelingStyle(
            "scan",
            sag=0.001,
            sides=(12, 20),
            hollow=False,
            flange="slip",
            holes=False,
            fasteners="none",
            gaskets=False,
            valve="few",
            gauge="few",
            gap=(-0.002, 0.002),
            wobble=0.001,
            palette=_GRAY,
        ),
        ModelingStyle(
            "vendor",
            sag=0.0001,
            sides=(20, 64),
            flange="slip",
            fasteners="set",
            valve="few",
            spool="bent",
            palette=_GRAY,
        ),
    )
}
