"""Why a part has its label, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from cadgraph.labelers.embedded.shape_facts import Facts

__all__ = ["describe_company", "describe_form"]

_FEW = 3  # kinds of neighbours that are named


def describe_form(f: Facts) -> str:
    """The shape of a part: ``torus with 5 spokes, 310 mm``."""
    long, middle, short = (float(x) for x in f.section)
    across = 2 * f.radius
    bored = [p for p in f.ports if 0 < p.inner < p.outer]
    if f.turned > 0.7 and f.sides == 6 and (not f.tube or f.length < 2 * across):
        return f"six-sided {'ring' if bored else 'prism'}, {_mm(across)} across, {_mm(f.length)} long"
    if f.tube:
        width = 2 * f.ports[0].outer
        hollow = "hollow" if bored else "solid"
        return f"{hollow} {'bent ' if f.bent else ''}tube, {_mm(width)} across, {_mm(f.tube)} long"
    if f.sides >= 8 and 3 <= f.spokes <= 8 and f.rim > 0.4:
        return f"ring with {f.spokes} spokes, {_mm(across)} across"
    if f.round:
        kind = "ring" if bored else "round body"
        flat = "flat " if f.length < 0.25 * across else "long " if f.length > 3 * across else ""
        return f"{flat}{kind}, {_mm(across)} across, {_mm(f.length)} long"
    ways = len([p for p in f.ports if p.outer > 0.2 * f.radius])
    size = f"{_mm(long)} x {_mm(middle)} x {_mm(short)}"
    if ways >= 2:
        return f"body with {ways} round ends, {size}"
    if short < 0.1 * middle:
        return f"{'strip' if long > 4 * middle else 'plate'}, {size}"
    if long > 4 * middle:
        return f"bar, {size}"
    if f.fill > 0.95:
        return f"block, {size}"
    return f"body, {size}"


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
