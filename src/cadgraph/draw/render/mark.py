"""The colour of what marks a mesh: the one of a few with a name that is furthest from all colours of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.color import from_hex, source_colors, to_srgb
from cadgraph.model.scene import Floats, Scene

__all__ = ["MARKS", "Mark", "choose_mark"]


@dataclass(frozen=True)
class Mark:
    """A colour that people, and models, have a word for.

    Args:
        name: the word.
        color: ``"#rrggbb"``.
    """

    name: str
    color: str


MARKS = (
    Mark("magenta", "#ff00aa"),
    Mark("orange", "#ff7a00"),
    Mark("cyan", "#00c4f5"),
    Mark("green", "#1fcf1f"),
    Mark("violet", "#8a2bff"),
    Mark("red", "#f5101c"),
    Mark("blue", "#1040ff"),
)
"""Of equally good ones the first is taken. No yellow: it doesn't show on what is light."""

_LIGHTNESS = 0.35  # how much a difference in lightness counts: shading makes all of them
_LEVELS = ((0.05, 1.0), (0.005, 1.25), (0.0, 1.6))  # colours of a lesser share of the meshes count as further away
_RADIX = 16  # levels of a channel within which colours count as one


def choose_mark(scene: Scene) -> Mark:
    """The mark of a scene. It follows from which colours its meshes have and roughly how often, from nothing else.

    Args:
        scene: any; a mesh without a colour counts as the grey that it is drawn in.
    """
    if not scene.n_meshes:
        return MARKS[0]
    srgb = np.floor(to_srgb(source_colors(scene)) * (256 - 1e-3) / _RADIX).astype(np.int64)
    colors, times = np.unique(srgb, axis=0, return_counts=True)
    share = times / times.sum()
    there = _oklab((colors + 0.5) * _RADIX / 256)
    weight = np.select([share >= least for least, _ in _LEVELS], [factor for _, factor in _LEVELS])
    marks = _oklab(np.array([to_srgb(from_hex(mark.color)) for mark in MARKS], np.float64))
    apart = marks[:, None] - there[None]
    apart[..., 0] *= _LIGHTNESS
    least = (np.sqrt((apart * apart).sum(axis=2)) * weight).min(axis=1)
    return MARKS[int(np.argmax(np.round(least, 3)))]


def _oklab(srgb: npt.ArrayLike) -> Floats:
    """From sRGB in 0..1 to lightness and two axes of colour, apart as people see them (Oklab, B. Ottosson, 2020)."""
    s = np.asarray(srgb, np.float64)
    red, green, blue = np.moveaxis(np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4), -1, 0)
    long = np.cbrt(0.4122214708 * red + 0.5363325363 * green + 0.0514459929 * blue)
    medium = np.cbrt(0.2119034982 * red + 0.6806995451 * green + 0.1073969566 * blue)
    short = np.cbrt(0.0883024619 * red + 0.2817188376 * green + 0.6299787005 * blue)
    return np.stack(
        [
            0.2104542553 * long + 0.7936177850 * medium - 0.0040720468 * short,
            1.9779984951 * long - 2.4285922050 * medium + 0.4505937099 * short,
            0.0259040371 * long + 0.7827717662 * medium - 0.8086757660 * short,
        ],
        axis=-1,
    )
