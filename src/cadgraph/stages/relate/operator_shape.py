"""What stands on the body of a valve by its shape alone: a wheel, a lever, a lid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.stages.relate.body_shape import Surface

__all__ = ["Operator", "standing_on"]

Operator = Literal["wheel", "lever", "lid"]

# Slices between the ends' rim and the top of what stands on a body.
_SLICES = 16
# A wheel is as wide as long within this share, wider than what carries it by this factor, and than the body's ends are
# high by this one; it is flat, unlike an actuator with a diaphragm: no higher than this share of its width; and most of
# it is far from its middle.
_ROUND, _OVERHANGS, _WIDE, _FLAT, _RIM = 0.8, 1.7, 1.8, 0.105, 0.5
# It is in the upper part of what stands there, and what is above it is narrower than this against it.
_UPPER, _ABOVE = 0.5, 0.6
# A lever is long against the ends' radius, and against its own width; most of it is on one side of its stem.
_LONG, _SLENDER, _ONE_SIDED, _THIN = 1.3, 0.4, 0.2, 0.35
# It is above this share of what stands there: the lever of a small cock on the leg of a strainer is amid it.
_HIGH = 0.6
# A lid is low, broad, round, and carries nothing that is narrower than this against it.
_LOW, _BROAD, _CROWN = 1.6, 0.9, 0.28
# Which way something stands is where most of the surface reaches: all of it, else what is no farther from the line than
# this share, as a lever that is turned across the line draws it aside.
_SHARES = (1.0, 0.7)
# What stands there rises over the ends at least by this factor.
_STANDS = 1.1


@dataclass(frozen=True)
class _Slice:
    """A slice across the way that something stands: its height, and its extents along and across the body, in rims."""

    high: float
    long: float
    wide: float
    middle: tuple[float, float]
    far: float

    @property
    def most(self) -> float:
        """The greater extent."""
        return max(self.long, self.wide)

    @property
    def least(self) -> float:
        """The lesser extent."""
        return min(self.long, self.wide)

    @property
    def is_wheel(self) -> bool:
        """Whether it is as wide as long, and wide."""
        return self.most >= _WIDE and self.least >= _ROUND * self.most


def standing_on(surface: Surface) -> Operator | None:
    """What stands on a body.

    Args:
        surface: of the whole valve about the line through it.

    Returns:
        ``wheel``, ``lever``, ``lid`` (a cover, and nothing that could be turned), or None where it is none of these.
    """
    height = surface.height
    for share in _SHARES:
        near = height <= share * height.max(initial=0.0)
        pull = (surface.area[near] * height[near]) @ surface.out[near]
        norm = float(np.linalg.norm(pull))
        found = _standing(surface, pull / norm) if norm > 0.0 else None
        if found is not None:
            return found
    return None


def _standing(surface: Surface, up: Floats) -> Operator | None:
    """What stands on a body in one direction."""
    rise, aside = surface.out @ up, surface.out @ np.array([-up[1], up[0]])
    rim = float(surface.height[rise < 0].max(initial=0.0))
    top = float(rise.max(initial=0.0))
    if rim <= 0.0 or top < _STANDS * rim:
        return None
    places = np.column_stack([surface.along * surface.length, aside]) / rim
    slices = _sliced(places, rise, surface.area, np.linspace(rim, top, _SLICES + 1), rim)
    if _has_lever(slices):
        return "lever"
    if _has_wheel(slices):
        return "wheel"
    return "lid" if top <= _LOW * rim and _is_lid(slices) else None


def _sliced(places: Floats, rise: Floats, area: Floats, borders: Floats, rim: float) -> list[_Slice]:
    """The slices that hold anything, from below."""
    found = []
    for low, high in zip(borders[:-1], borders[1:], strict=True):
        row = (rise >= low) & (rise <= high)
        if not row.any():
            continue
        some, weight = places[row], area[row]
        least, most = some.min(axis=0), some.max(axis=0)
        middle = (least + most) / 2
        out = np.linalg.norm(some - middle, axis=1)
        far = float(weight @ out) / max(float(weight.sum()) * float(out.max(initial=0.0)), 1e-12)
        long, wide = (float(x) for x in most - least)
        found.append(_Slice(float(high - low) / rim, long, wide, (float(middle[0]), float(middle[1])), far))
    return found


def _has_wheel(slices: list[_Slice]) -> bool:
    wheels = [k for k in _overhanging(slices) if slices[k].is_wheel]
    if not wheels or wheels[0] < _UPPER * len(slices):
        return False
    return _is_flat_ring(slices[wheels[0] : wheels[-1] + 1], slices[wheels[-1] + 1 :])


def _is_flat_ring(wheel: list[_Slice], above: list[_Slice]) -> bool:
    """Whether some slices are flat, and most of them far from their middle, with nothing wide above them."""
    widest = max(one.most for one in wheel)
    flat = sum(one.high for one in wheel[1:]) <= _FLAT * widest
    alone = max((one.most for one in above), default=0.0) <= _ABOVE * widest
    return flat and alone and max(one.far for one in wheel) >= _RIM


def _overhanging(slices: list[_Slice]) -> list[int]:
    """The slices that are wider than what carries them."""
    least = [min((below.most for below in slices[:k]), default=np.inf) for k in range(len(slices))]
    return [k for k, one in enumerate(slices) if one.most >= _OVERHANGS * least[k]]


def _has_lever(slices: list[_Slice]) -> bool:
    levers = [
        k for k in _overhanging(slices) if slices[k].most >= _LONG and slices[k].least <= _SLENDER * slices[k].most
    ]
    if not levers or len(levers) > _THIN * len(slices) or levers[0] < _HIGH * len(slices):
        return False
    carrier = min(slices[: levers[0]], key=lambda one: one.most)
    longest = max((slices[k] for k in levers), key=lambda one: one.most)
    if max(one.least for one in slices[levers[0] :]) > _SLENDER * longest.most:
        return False
    return float(np.linalg.norm(np.subtract(longest.middle, carrier.middle))) >= _ONE_SIDED * longest.most


def _is_lid(slices: list[_Slice]) -> bool:
    widest = max(slices, key=lambda one: one.most)
    return widest.least >= _BROAD and widest.least >= _ROUND * widest.most and slices[-1].least >= _CROWN * widest.most
