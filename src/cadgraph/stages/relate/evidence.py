"""What speaks for and against a joint, added up: one table of terms, each in log-odds.

Every curve gives the contribution at some values of its quantity, straight between them. What is measured of a joint is
looked up in each curve that fits its kind and added to the kind's base; the logistic function of the sum is how sure
the joint is. ``tests/stages/relate/test_evidence.py`` holds both sides of each.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from sys import intern
from typing import TypeAlias

import numpy as np

from cadgraph.model.scene import Floats

__all__ = [
    "BASE",
    "CURVES",
    "FLAGS",
    "OPEN_END",
    "Curve",
    "Term",
    "add_up",
    "add_up_one",
    "score_of",
    "scores_of",
    "tell",
    "tell_terms",
]


Term: TypeAlias = tuple[str, float]
"""What speaks for or against something, in words, and its log-odds."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A contribution to the log-odds.

    Args:
        at: values of the quantity, ascending.
        gives: the contribution at each.
        says: the quantity in words, with one place for its value.
        scale: what the value is multiplied by where it is said.
    """

    at: tuple[float, ...]
    gives: tuple[float, ...]
    says: str
    scale: float = 1.0

    def __call__(self, value: Floats | float) -> Floats:
        """The contribution at a value, or at each of several; 0 where it is not known (NaN)."""
        given = np.interp(value, self.at, self.gives)
        return np.where(np.isnan(given), 0.0, given)

    def at_one(self, value: float) -> float:
        """The same at one value, without an array; what was asked before is remembered."""
        return _given(self, value)


# Gaps of real plants: 1.5-4.5 mm between flanges without gasket, 3-8 mm behind the face of a slip-on flange, 0.1-0.6 mm
# at screwed joints; 12 mm and more are the places of wafer valves and missing pieces.
CURVES: Mapping[str, Curve] = {
    "gap": Curve((0.0, 0.001, 0.005, 0.010, 0.012, 0.024), (2.5, 2.2, 1.2, 0.2, -0.5, -4.0), "a gap of {:.1f} mm", 1e3),
    "wide": Curve((0.0, 0.5, 1.0, 2.0), (0.0, 0.0, -1.5, -6.0), "a gap of {:.1f} radii"),
    "depth": Curve((0.0, 1.0, 1.03, 1.2), (2.2, 1.2, 0.0, -5.0), "in each other by {:.0%} of the shorter one"),
    "angle": Curve((0.0, 10.0, 20.0, 32.0), (1.0, 0.5, -0.5, -2.5), "axes {:.0f} degrees apart"),
    "offset": Curve((0.0, 0.1, 0.35, 0.5), (1.0, 0.8, -0.5, -5.0), "axes {:.2f} radii off each other"),
    "size": Curve((0.1, 0.3, 0.6, 0.9, 1.0), (-3.0, -0.5, 0.2, 0.8, 1.0), "widths as 1 to {:.2f}"),
    "off": Curve((0.0, 0.5, 1.3, 2.0), (1.0, 0.5, -1.0, -4.0), "middle of the contact {:.2f} radii off the axis"),
    "behind": Curve((0.0, 1.0, 3.0, 4.0), (0.5, 0.0, -1.0, -4.0), "contact {:.1f} radii from the end"),
    "facing": Curve((0.2, 0.7, 1.0), (-1.0, 0.5, 1.0), "faces parallel by {:.2f}"),
    "miss": Curve((0.0, 0.5, 0.85, 1.2), (1.0, 0.5, -0.5, -4.0), "axis {:.2f} radii off the other one"),
    # Where the file itself joins the two, a gap is a piece that was not drawn: the longer, the less likely.
    "far": Curve(
        (0.0, 0.012, 0.05, 0.1, 0.15), (2.5, 1.5, 0.5, -2.0, -6.0), "a gap of {:.1f} mm in a stated joint", 1e3
    ),
    "near end": Curve((0.0, 0.9, 1.1, 2.0), (-2.5, -2.5, 0.0, 0.0), "{:.1f} radii from an end of the other one"),
}
"""The contributions of what is measured."""

BASE: Mapping[str, float] = {"face": -0.5, "corner": -1.0, "mount": 0.5, "tap": 0.0, "sleeve": -2.5}
"""The log-odds that each kind of joint starts from."""

FLAGS: Mapping[str, tuple[float, str]] = {
    "habit": (2.0, "a gap that this plant's other joints have, too"),
    "bolted": (2.5, "fasteners hold both"),
    "hidden": (-3.0, "another part's end lies between"),
    "over": (-4.0, "a gap wider than relate.bridge"),
    "blocked": (-3.0, "something else lies near both, so that the gap may be its place"),
    "disc": (0.5, "one of them is a flange, gasket or the like"),
    # Where a tenth of a file's links is wrong, most often by one place, a link between neighbours is twenty times as
    # likely if they join; where a tenth is missing, complete ends without one speak against it no more than this.
    "stated": (3.0, "the file joins them"),
    "unstated": (-1.0, "the file joins both to others only"),
}
"""The contributions of what is there or not, in words."""

_MOST_KEPT = 1 << 16  # values whose contributions are kept
_NOTHING = 0.05  # log-odds that are 0.0 in words

OPEN_END = 1.5
"""What an end that joins nothing costs, in log-odds: pipes end at something."""


def add_up(kind: str, measured: Mapping[str, Floats], flags: Mapping[str, Floats] | None = None) -> Floats:
    """The log-odds of joints of one kind.

    Args:
        kind: one of ``BASE``.
        measured: quantities of ``CURVES``, ``(n,)`` each; NaN where one does not apply.
        flags: of ``FLAGS``, ``(n,)`` each, 1 where it holds.
    """
    first, *others = (CURVES[name](value) for name, value in measured.items())
    total = sum(others, first) + BASE[kind]
    for name, holds in (flags or {}).items():
        total = total + FLAGS[name][0] * holds
    return np.asarray(total, np.float64)


def add_up_one(kind: str, measured: Mapping[str, float]) -> float:
    """The log-odds of one joint; see ``add_up``."""
    return sum(CURVES[name].at_one(value) for name, value in measured.items() if not math.isnan(value)) + BASE[kind]


@lru_cache(maxsize=_MOST_KEPT)
def _given(curve: Curve, value: float) -> float:
    """What a curve gives at one value; a change of labels leaves most joints as they were."""
    given = float(np.interp(value, curve.at, curve.gives))
    return 0.0 if math.isnan(given) else given


@lru_cache(maxsize=_MOST_KEPT)
def score_of(odds: float) -> float:
    """How sure a joint of these log-odds is, 0..1."""
    return float(scores_of(odds))


def scores_of(odds: Floats | float) -> Floats:
    """How sure joints of these log-odds are, 0..1."""
    return np.asarray(1 / (1 + np.exp(-np.clip(odds, -30, 30))))


def tell(measured: Mapping[str, float], flags: Sequence[str] = (), said: str = "") -> tuple[str, ...]:
    """What speaks for and against a joint, in words, the weightiest first; each with its log-odds.

    Args:
        measured: quantities of ``CURVES``.
        flags: of ``FLAGS``.
        said: by what the file joins the two, where ``stated`` is one of the flags.
    """
    terms = [
        (CURVES[name].says.format(CURVES[name].scale * value), odds)
        for name, value in measured.items()
        if math.isfinite(value) and abs(odds := CURVES[name].at_one(value)) >= _NOTHING
    ]
    terms += [(f"{FLAGS[name][1]} ({said})" if name == "stated" else FLAGS[name][1], FLAGS[name][0]) for name in flags]
    return tell_terms(terms)


def tell_terms(terms: Sequence[Term]) -> tuple[str, ...]:
    """Terms in words, the weightiest first; each with its log-odds, without those that weigh nothing."""
    ordered = sorted((term for term in terms if abs(term[1]) >= _NOTHING), key=lambda term: (-abs(term[1]), term[0]))
    # A plant's joints are alike: the same words stand at many thousands.
    return tuple(intern(f"{words} ({odds:+.1f})") for words, odds in ordered)
