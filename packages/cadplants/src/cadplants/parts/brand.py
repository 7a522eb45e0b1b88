"""Makes: what one manufacturer's valves look like, and what a plant is painted in; drawn once for a plant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from cadplants.styles.modeling_style import RGB, STYLES, ModelingStyle

__all__ = ["Brand", "draw_brand", "dressed", "painted"]

_PIPE_PAINTS: tuple[RGB, ...] = (
    (0.36, 0.40, 0.44),
    (0.04, 0.30, 0.30),
    (0.55, 0.57, 0.58),
    (0.06, 0.26, 0.09),
    (0.62, 0.42, 0.04),
    (0.20, 0.24, 0.34),
)
_VALVE_PAINTS: tuple[RGB, ...] = (
    (0.03, 0.14, 0.42),
    (0.40, 0.05, 0.03),
    (0.30, 0.31, 0.33),
    (0.05, 0.05, 0.06),
    (0.03, 0.24, 0.16),
)
_HANDLE_PAINTS: tuple[RGB, ...] = ((0.50, 0.02, 0.02), (0.04, 0.04, 0.05), (0.62, 0.45, 0.02), (0.03, 0.12, 0.45))
_STEEL_PAINTS: tuple[RGB, ...] = ((0.24, 0.26, 0.28), (0.45, 0.46, 0.47), (0.10, 0.16, 0.26), (0.30, 0.12, 0.08))


@dataclass(frozen=True)
class Brand:
    """How the valves of one manufacturer are built.

    Args:
        wheel: handwheel with a ``round`` rim on spokes, a pressed ``plate`` with windows, or a ``solid`` dished disc.
        spokes: of the handwheel, 3 to 6.
        lever: ``cranked`` or ``straight``.
        ball: body of ball valves: ``two-piece`` (bolted end piece) or ``barrel``.
        globe: body of globe valves: ``sphere`` or ``barrel``.
        gearbox: whether butterfly valves have a gearbox; None leaves it to their size.
    """

    wheel: Literal["round", "plate", "solid"] = "round"
    spokes: int = 5
    lever: Literal["cranked", "straight"] = "cranked"
    ball: Literal["two-piece", "barrel"] = "two-piece"
    globe: Literal["sphere", "barrel"] = "sphere"
    gearbox: bool | None = None


def draw_brand(rng: np.random.Generator) -> Brand:
    """One manufacturer at random."""
    return Brand(
        wheel=("round", "round", "plate", "solid")[int(rng.integers(4))],
        spokes=int(rng.integers(3, 7)),
        lever=("cranked", "cranked", "straight")[int(rng.integers(3))],
        ball=("two-piece", "barrel")[int(rng.integers(2))],
        globe=("sphere", "barrel")[int(rng.integers(2))],
        gearbox=(None, None, True)[int(rng.integers(3))],
    )


def painted(style: ModelingStyle, rng: np.random.Generator, seed: int) -> ModelingStyle:
    """The style with a plant's own paint; those that colour by system or not at all keep their colours.

    Args:
        style: that models the plant.
        rng: of the paint.
        seed: 0 keeps the hand's own colours.
    """
    picks = [int(rng.integers(len(paints))) for paints in (_PIPE_PAINTS, _VALVE_PAINTS, _HANDLE_PAINTS, _STEEL_PAINTS)]
    if seed == 0 or style.palette is not STYLES["plant-design"].palette:
        return style
    pipe, valve = _PIPE_PAINTS[picks[0]], _VALVE_PAINTS[picks[1]]
    handle, steel = _HANDLE_PAINTS[picks[2]], _STEEL_PAINTS[picks[3]]
    bright = tuple(min(1.0, 1.12 * x + 0.01) for x in pipe)
    flange = (bright[0], bright[1], bright[2])
    return replace(
        style,
        palette={**style.palette, "pipe": pipe, "flange": flange, "valve": valve, "handle": handle, "steel": steel},
    )


def dressed(
    style: ModelingStyle | None, rng: np.random.Generator, seed: int, usual: Mapping[str, Any]
) -> ModelingStyle:
    """The style that models a plant: the one asked for, or plant-design CAD as fine as somebody happened to model.

    Args:
        style: asked for, or None.
        rng: of paint and grain.
        seed: 0 takes the preset's usual grain and the hand's own colours.
        usual: settings of ``Style`` that give the preset as many parts as the paper's structure has.
    """
    grains = {
        "fasteners": ("none", "flange", "set", "set", "bolt")[int(rng.integers(5))],
        "valve": ("few", "few", "pieces")[int(rng.integers(3))],
        "gauge": ("few", "pieces")[int(rng.integers(2))],
        "spool": ("segments", "segments", "bent")[int(rng.integers(3))],
        "gaskets": bool(rng.random() < 0.7),
    }
    chosen: dict[str, Any] = {**usual, **(grains if seed else {})}
    return painted(style if style is not None else replace(STYLES["plant-design"], **chosen), rng, seed)
