"""Colours: between sRGB and linear light, colours of a source, and sets of colours that are easy to tell apart."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Scene

__all__ = ["NEUTRAL", "Colors", "distinct_colors", "from_hex", "source_colors", "to_hex", "to_linear", "to_srgb"]

Colors = npt.NDArray[np.float32]

NEUTRAL = "#aeb7c2"
"""Surfaces whose source gives no colour: a cool light grey, on which shading and tinted marks both show."""

_GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))
_LEAST_ALBEDO, _GREATEST_ALBEDO = 0.025, 0.86


def to_linear(srgb: npt.ArrayLike) -> Colors:
    """Turns sRGB values in 0..1 into linear light (IEC 61966-2-1)."""
    s = np.asarray(srgb, np.float32)
    return np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4).astype(np.float32)


def to_srgb(linear: npt.ArrayLike) -> Colors:
    """Turns linear light into sRGB values, both in 0..1; what lies outside is clipped (IEC 61966-2-1)."""
    c = np.clip(np.asarray(linear, np.float32), 0, 1)
    return np.where(c <= 0.0031308, c * 12.92, 1.055 * c ** np.float32(1 / 2.4) - 0.055).astype(np.float32)


def from_hex(text: str) -> Colors:
    """``"#rrggbb"`` as ``(3,)`` linear light.

    Raises:
        ValueError: the text is no such colour.
    """
    digits = text.removeprefix("#")
    if len(digits) != 6:
        raise ValueError(f"{text!r} is not a colour; give six hexadecimal digits like '#8a8f98'")
    return to_linear(np.array([int(digits[i : i + 2], 16) for i in (0, 2, 4)], np.float32) / 255)


def to_hex(linear: npt.ArrayLike) -> str:
    """``(3,)`` linear light as ``"#rrggbb"``."""
    red, green, blue = (round(float(c) * 255) for c in to_srgb(linear))
    return f"#{red:02x}{green:02x}{blue:02x}"


def source_colors(scene: Scene) -> Colors:
    """``(n_meshes, 3)`` linear light: the colour that the source gives, :data:`NEUTRAL` where it gives none.

    Pure black and pure white are pulled in a little, because neither would show any shading.
    """
    colors = np.clip(scene.colors.astype(np.float32), _LEAST_ALBEDO, _GREATEST_ALBEDO)
    without = ~np.isfinite(scene.colors).all(axis=1)
    colors[without] = from_hex(NEUTRAL)
    return colors


def distinct_colors(count: int) -> Colors:
    """``(count, 3)`` linear light: hues a golden angle apart, so that any first few differ well, at two lightnesses."""
    steps = np.arange(count)
    hue = 4.55 + steps * _GOLDEN_ANGLE
    lightness = np.array([0.64, 0.74, 0.56])[steps % 3]
    chroma = np.array([0.155, 0.13, 0.14])[steps % 3]
    return _from_oklch(lightness, chroma, hue.astype(np.float64))


def _from_oklch(
    lightness: npt.NDArray[np.float64], chroma: npt.NDArray[np.float64], hue: npt.NDArray[np.float64]
) -> Colors:
    """Oklch (B. Ottosson, 2020) to linear sRGB, clipped to what a screen can show."""
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    red = 4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short
    green = -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short
    blue = -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short
    return np.clip(np.stack([red, green, blue], axis=-1), 0, 1).astype(np.float32)
