"""What a line says of the part that carries it."""

from __future__ import annotations

from cadgraph.geometry.line.centreline import Centreline

__all__ = ["is_disc", "is_fitting", "is_neck", "is_plain_tube", "is_steady", "is_straight"]

# The radius of a plain tube is as much at both of its ends within this share, and changes by less than the other one
# between them: bends of few sides are narrower at their mitres.
_STEADY, _UNEVEN = 0.06, 0.12
_NARROW = 0.8  # the narrow end of a welding neck as share of its wide one
_STRAIGHT = -0.996  # cosine between the ends of something straight


def is_disc(line: Centreline) -> bool:
    """Whether a line is that of something short: a flange, a gasket, a coupling, a cap."""
    return len(line.branches) == 1 and line.length < 1.6 * line.branches[0].widest


def is_plain_tube(line: Centreline) -> bool:
    """Whether a line is that of a pipe or bend: one run of steady radius, longer than it is wide, with two ends."""
    return is_steady(line) and line.length >= 3.0 * float(line.branches[0].radius.max())


def is_steady(line: Centreline) -> bool:
    """Whether a line is one run of steady radius with two ends, however short."""
    if len(line.branches) != 1 or line.n_ends != 2:
        return False
    radius = line.branches[0].radius
    first, last = sorted(line.radii)
    even = radius.max() <= (1 + _UNEVEN) * radius.min() and last <= (1 + _STEADY) * first
    return bool(even and line.share > 0.9)


def is_fitting(line: Centreline) -> bool:
    """Whether a line bends or branches between ends that are all open to others, along all of its surface."""
    return line.share > 0.9 and (line.n_ends > 2 or (line.n_ends == 2 and not is_straight(line)))


def is_neck(line: Centreline) -> bool:
    """Whether a line is that of a short straight piece of two widths: a flange with its welding neck."""
    if not (is_disc(line) and is_straight(line)):
        return False
    narrow, wide = sorted(line.radii)
    return narrow <= _NARROW * wide


def is_straight(line: Centreline) -> bool:
    """Whether a line has two ends that look opposite ways."""
    outward = line.table_of_ends[:, 3:6]
    return line.n_ends == 2 and float(outward[0] @ outward[1]) < _STRAIGHT
