"""From spans to runs: what is there twice goes, gauges take their taps' places, and what merely passes is joined."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.stages.relate.network import Drawing
from cadgraph.stages.relate.span import Net, Span

__all__ = ["Closed", "simplify"]

# Two spans between the same nodes are one thing there twice (a pipe within its flange or coupling) where both are
# shorter than this many of their diameters, or this much [m], and nowhere farther apart than half a diameter.
_TWICE, _LEAST_TWICE = 3.0, 0.05
# A stub of a flange or gasket that hangs beside a joint of two others says nothing.
_STUB = 0.15
# A lid of a fitting is at most this many diameters from its axis.
_POCKET = 3.0
# Without a fitting of its own, a leg stands in the run where it is at most this wide against it.
_NARROW = 0.7
# Junctions nearer to each other than this share of the diameter are one.
_WITHIN = 0.3


@dataclass(frozen=True)
class Closed:
    """Where no run ends, although a line does.

    Args:
        covers: lids that close a fitting of their own, as a strainer's lid does.
        pockets: nodes at which a fitting is closed in itself, as in a strainer's pot.
    """

    covers: frozenset[int]
    pockets: frozenset[int]


def simplify(drawing: Drawing, gauges: Collection[int], closed: Closed, n_units: int, leg: float) -> Net:
    """Joins spans to runs between units, junctions and terminals.

    Args:
        drawing: the network as drawn; it stays as it is.
        gauges: numbers of the units that may stand in a run although they only sit on a tap of it.
        closed: where no run ends.
        n_units: number of units, which are the first nodes.
        leg: greatest length between a tap and its gauge [m].

    Returns:
        The net, in which each node is a unit, or has one or at least three spans.
    """
    net = drawing.net.copy()
    units = range(n_units)
    changed = True
    while changed:
        changed = _merge_parallel(net) | _drop_stubs(net, n_units, drawing, closed)
        net.dissolve(units)
        changed |= _merge_parallel(net) | _drop_stubs(net, n_units, drawing, closed)
    net.dissolve(units)
    for gauge in sorted(gauges):
        _fold(net, gauge, drawing.taps, gauges, n_units, leg)
    net.dissolve(units)
    _collapse(net, n_units)
    return net


def _collapse(net: Net, n_units: int) -> None:
    """Makes one junction of two that lie within each other: a cross traced as two tees."""
    for number, span in sorted(net.spans.items()):
        span = net.spans[number]
        if min(span.a, span.b) < n_units or span.a == span.b or min(net.degree(span.a), net.degree(span.b)) < 3:
            continue
        width = max(_width(net.spans[other]) for node in (span.a, span.b) for other in net.at[node])
        if span.length <= _WITHIN * width:
            net.remove(number)
            for other in list(net.at[span.b]):
                net.move(other, span.b, span.a)


def _width(span: Span) -> float:
    """The diameter of most of a span [m]; 0 where it has no pipe."""
    return max(span.pieces, key=lambda piece: piece[0])[1] if span.pieces else 0.0


def _merge_parallel(net: Net) -> bool:
    """Drops spans that lie in another one."""
    between: dict[tuple[int, int], list[int]] = {}
    for number, span in sorted(net.spans.items()):
        between.setdefault((min(span.a, span.b), max(span.a, span.b)), []).append(number)
    merged = False
    for (a, b), numbers in sorted(between.items()):
        if a == b:
            for number in numbers:
                if net.spans[number].length < max(_LEAST_TWICE, _TWICE * _width(net.spans[number])):
                    net.remove(number)
                    merged = True
            continue
        kept: list[int] = []
        for number in sorted(numbers, key=lambda n: (not net.spans[n].pieces, -len(net.spans[n].via), n)):
            span = net.spans[number]
            if any(_twice(net.spans[other], span) for other in kept):
                net.remove(number)
                merged = True
            else:
                kept.append(number)
    return merged


def _twice(one: Span, other: Span) -> bool:
    wide = max(_width(one), _width(other))
    if max(one.length, other.length) > max(_LEAST_TWICE, _TWICE * wide):
        return False
    # Both begin and end at the same nodes, so that middles near each other say that they lie in each other.
    apart = float(np.linalg.norm(_middle(one.points) - _middle(other.points)))
    return apart <= max(0.5 * wide, 0.5 * _LEAST_TWICE)


def _middle(points: Floats) -> Floats:
    if len(points) == 1:
        return np.asarray(points[0])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    return np.array([np.interp(walked[-1] / 2, walked, points[:, c]) for c in range(3)])


def _drop_stubs(net: Net, n_units: int, drawing: Drawing, closed: Closed) -> bool:
    """Drops what ends freely beside a joint of two others without being pipe."""
    dropped = False
    for number, span in sorted(net.spans.items()):
        for tip, foot in ((span.a, span.b), (span.b, span.a)):
            free = number in net.spans and tip >= n_units and net.degree(tip) == 1 and tip not in drawing.solids
            if free and net.degree(foot) >= 3 and _is_stub(net, span, tip, foot, closed):
                net.remove(number)
                dropped = True
    return dropped


def _is_stub(net: Net, span: Span, tip: int, foot: int, closed: Closed) -> bool:
    """Whether a span from a joint, its foot, to a free tip is no pipe: a flange or gasket, a fitting's lid or pot."""
    wide = max(_width(net.spans[other]) for other in net.at[foot])
    # Only what lies at the tip closes it: a line that goes on through a conical socket is none of a fitting's.
    last = span.via[-1 if tip == span.b else 0] if span.via else None
    pocket = tip in closed.pockets or last in closed.covers
    return (pocket and span.length <= max(_STUB, _POCKET * wide)) or (not span.pieces and span.length <= _STUB)


@dataclass(frozen=True)
class _Tap:
    """What meets at a joint at which gauges hang.

    Args:
        legs: number of each gauge, and of its span with that span as it leaves the joint, in order.
        others: numbers of the other spans.
    """

    legs: Sequence[tuple[int, int, Span]]
    others: Sequence[int]


def _fold(net: Net, gauge: int, taps: Collection[int], gauges: Collection[int], n_units: int, leg: float) -> None:
    """Puts a gauge that hangs on a run into the run; several on one tap follow each other."""
    if net.degree(gauge) != 1:
        return
    ((_, own),) = net.leaving(gauge)
    joint = own.b
    if joint < n_units or own.length > leg:
        return
    there = _at_joint(net, joint, gauges, leg)
    if len(there.others) != 2 or there.others[0] == there.others[1]:
        return
    if joint in taps or _is_narrow(net, there):
        _put_in_run(net, joint, there, own)


def _is_narrow(net: Net, there: _Tap) -> bool:
    """Whether the legs of a joint are so narrow against the run that they stand in it."""
    narrow = min(_width(net.spans[number]) for number in there.others)
    return all(_width(span) <= _NARROW * narrow for _, _, span in there.legs)


def _at_joint(net: Net, joint: int, gauges: Collection[int], leg: float) -> _Tap:
    """The legs to gauges, and the other spans, of a joint."""
    legs: list[tuple[int, int, Span]] = []
    others: list[int] = []
    for number, span in net.leaving(joint):
        if span.b in gauges and net.degree(span.b) == 1 and span.length <= leg:
            legs.append((span.b, number, span))
        else:
            others.append(number)
    return _Tap(sorted(legs, key=lambda row: row[:2]), others)


def _put_in_run(net: Net, joint: int, there: _Tap, own: Span) -> None:
    """Lets the two other spans of a joint end at its gauges, which follow each other there."""
    ports = []
    for _, number, span in there.legs:
        net.remove(number)
        ports.append(span.port_b)
    chain = [unit for unit, _, _ in there.legs]
    point = own.points[-1][None]
    for number, unit, port in ((there.others[0], chain[0], ports[0]), (there.others[1], chain[-1], ports[-1])):
        span = net.remove(number)
        net.add(span._replace(a=unit, port_a=port) if span.a == joint else span._replace(b=unit, port_b=port))
    for k in range(len(chain) - 1):
        net.add(Span(chain[k], chain[k + 1], (), point, 0.0, (), own.confidence, ports[k], ports[k + 1]))
