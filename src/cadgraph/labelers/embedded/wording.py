"""Why a part has its label, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from cadgraph.model.shapes import Facts

__all__ = ["describe_company", "describe_form"]

_FEW = 3  # kinds of neighbours that are named


def describe_form(f: Facts) -> str:
    """The shape of a part: ``torus with 5 spokes, 310 mm``."""
    return _turned_form(f) or _angular_form(f)


def _turned_form(f: Facts) -> str | None:
    """What looks alike all around an axis, or follows one: prisms, tubes, wheels, rings."""
    across = 2 * f.radius
    bored = any(0 < port.inner < port.outer for port in f.ports)
    if f.turned > 0.7 and f.sides == 6 and (not f.tube or f.length < 2 * across):
        return f"six-sided {'ring' if bored else 'prism'}, {_mm(across)} across, {_mm(f.length)} long"
    if f.tube:
        hollow, bent = "hollow" if bored else "solid", "bent " if f.bent else ""
        return f"{hollow} {bent}tube, {_mm(2 * f.ports[0].outer)} across, {_mm(f.tube)} long"
    if f.sides >= 8 and 3 <= f.spokes <= 8 and f.rim > 0.4:
        return f"ring with {f.spokes} spokes, {_mm(across)} across"
    if f.round:
        kind = "ring" if bored else "round body"
        return f"{_proportion(f.length, across)}{kind}, {_mm(across)} across, {_mm(f.length)} long"
    return None


def _proportion(length: float, across: float) -> str:
    if length < 0.25 * across:
        return "flat "
    return "long " if length > 3 * across else ""


def _angular_form(f: Facts) -> str:
    """Everything else, by the proportions of its box."""
    long, middle, short = (float(x) for x in f.section)
    ways = sum(port.outer > 0.2 * f.radius for port in f.ports)
    rules = (
        (ways >= 2, f"body with {ways} round ends"),
        (short < 0.1 * middle, "strip" if long > 4 * middle else "plate"),
        (long > 4 * middle, "bar"),
        (f.fill > 0.95, "block"),
        (True, "body"),
    )
    kind = next(kind for holds, kind in rules if holds)
    return f"{kind}, {_mm(long)} x {_mm(middle)} x {_mm(short)}"


def describe_company(names: Sequence[str | None], alike: int) -> str:
    """What a part touches: ``touches 2 flanges, 8 bolts``.

    Args:
        names: of its neighbours, None where not known.
        alike: how many of its shape, itself included, touch the same neighbour.
    """
    counts = Counter(name for name in names if name is not None)
    named = sorted(counts.items(), key=lambda item: (-item[1], item[0]))[:_FEW]
    words = ", ".join(f"{n} {_plural(name) if n > 1 else name}" for name, n in named)
    told = [f"touches {words}" if words else "touches nothing known" if names else "stands alone"]
    if alike >= 3:
        told.append(f"one of {alike} alike on one part")
    return "; ".join(told)


def _plural(name: str) -> str:
    if name.endswith("s"):
        return name
    return name[:-1] + "ies" if name.endswith("y") and name[-2:-1] not in "aeiou" else name + "s"


def _mm(length: float) -> str:
    return f"{length:.2f} m" if length >= 2 else f"{1000 * length:.0f} mm"
