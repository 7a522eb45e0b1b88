"""Random modelling styles: how a style is drawn that nobody has published."""

from __future__ import annotations

from typing import Literal

import numpy as np

from cadplants.styles.modeling_style import RGB, STYLES, Grain, ModelingStyle

__all__ = ["draw_modeling_style"]

_SIDES = (6, 8, 8, 10, 12, 14, 16, 16, 18, 20, 24, 24, 28, 30, 32, 36, 40, 48, 64)
_LEAST_DRILLED = 12  # sides; the holes of a coarser flange (DN250 of B16.5) would cut its rim


def draw_modeling_style(rng: np.random.Generator, name: str = "drawn") -> ModelingStyle:
    """A modelling style at random, from coarse and merged to fine and in pieces, clean or broken.

    Args:
        rng: of everything.
        name: of the style, for the truth; never that of a published one.

    Returns:
        The style. The published ones (``STYLES``) stay apart as test styles: a drawn one equals none of them.
    """
    sag, sides = _roundness(rng)
    hollow = bool(rng.random() < 0.5)
    drilled = bool(sides[0] >= _LEAST_DRILLED and rng.random() < 0.55)
    bent: Literal["segments", "bent"] = "bent" if rng.random() < 0.35 else "segments"
    loose = _gap(rng)
    return ModelingStyle(
        name,
        sag=sag,
        sides=sides,
        hollow=hollow,
        flange=("neck", "slip", "ring")[int(rng.integers(3))],
        holes=drilled,
        fasteners=("none", "none", "set", "bolt", "pieces")[int(rng.integers(5))],
        gaskets=bool(rng.random() < 0.55),
        valve=_grain(rng),
        gauge=_grain(rng),
        pump=_grain(rng),
        tank=_grain(rng),
        equipment=_grain(rng),
        structure=_grain(rng),
        spool=bent,
        merged=bool(rng.random() < 0.2),
        capped=bool(hollow or rng.random() < 0.7),
        rows=float(np.exp(rng.uniform(np.log(0.02), np.log(0.3)))) if rng.random() < 0.2 else 0.0,
        fans=bool(rng.random() < 0.5),
        soup=float(rng.choice([0.0, 0.0, 0.0, 0.1, 0.4, 1.0])),
        cracks=float(rng.choice([0.0, 0.0, 0.0, 0.0, 0.1, 0.3])),
        gap=loose,
        wobble=float(rng.uniform(0.0002, 0.0015)) if rng.random() < 0.15 else 0.0,
        palette=_palette(rng),
    )


def _roundness(rng: np.random.Generator) -> tuple[float, tuple[int, int]]:
    """Sag [m] and least and most sides: one number for all circles, or by size."""
    if rng.random() < 0.5:
        count = int(rng.choice(_SIDES))
        return 0.001, (count, count)
    least = int(rng.choice([6, 8, 10, 12, 16, 20]))
    return float(10 ** rng.uniform(-4.2, -2.5)), (least, min(64, least + 4 * int(rng.integers(1, 13))))


def _grain(rng: np.random.Generator) -> Grain:
    grains: tuple[Grain, ...] = ("one", "few", "pieces")
    return grains[int(rng.integers(3))]


def _gap(rng: np.random.Generator) -> tuple[float, float]:
    """Exact in half of the styles; else gaps up to 5 mm, with or without overlaps of 2 mm."""
    kind = rng.random()
    if kind < 0.5:
        return 0.0, 0.0
    most = float(rng.uniform(0.0005, 0.005))
    return (0.0, most) if kind < 0.75 else (-0.002, most)


def _palette(rng: np.random.Generator) -> dict[str, RGB]:
    """Painted as it is, all alike, by a few systems, or at random."""
    kinds = STYLES["plant-design"].palette
    kind = rng.random()
    if kind < 0.4:
        return {key: _jitter(rng, color) for key, color in kinds.items()}
    if kind < 0.6:
        one = _any(rng)
        return dict.fromkeys(kinds, one)
    if kind < 0.8:
        few = [_any(rng) for _ in range(int(rng.integers(2, 5)))]
        return {key: few[int(rng.integers(len(few)))] for key in kinds}
    return {key: _any(rng) for key in kinds}


def _any(rng: np.random.Generator) -> RGB:
    r, g, b = (round(float(x), 3) for x in rng.uniform(0.02, 0.9, 3))
    return r, g, b


def _jitter(rng: np.random.Generator, color: RGB) -> RGB:
    r, g, b = (round(float(np.clip(c + d, 0, 1)), 3) for c, d in zip(color, rng.normal(0, 0.05, 3), strict=True))
    return r, g, b
