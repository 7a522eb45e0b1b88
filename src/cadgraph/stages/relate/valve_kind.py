"""Which kind of valve a unit is: what turns it, how long it is, how it lies in the line, weighed together."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from cadgraph.model.derived import store_of
from cadgraph.model.parts import Parts, UnitParts
from cadgraph.model.scene import Floats
from cadgraph.model.standards import lengths_of
from cadgraph.stages.relate.body_shape import Surface, box_around, line_through, surface_about
from cadgraph.stages.relate.operator_shape import standing_on

__all__ = ["SURE_FROM", "valve_kinds"]

SURE_FROM = 0.85
"""A kind is stated from this confidence on."""

# How common kinds are in piping of plants and buildings (ours); "other" stands for all that have no rule here: knife
# gates, solenoid, pressure reducing, three-way and needle valves...
_PRIOR = MappingProxyType(
    {
        "ball": 0.3, "gate": 0.2, "globe": 0.15, "butterfly": 0.1, "check": 0.12, "plug": 0.01, "diaphragm": 0.008,
        "relief": 0.04, "control": 0.05, "other": 0.06,
    }
)  # fmt: skip
# What turns a valve of each kind; a dome is the actuator with a diaphragm, wide and flat.
_TURNED = MappingProxyType(
    {
        "ball": {"lever": 0.75, "actuator": 0.2, "gearbox": 0.03, "wheel": 0.01, "none": 0.003},
        "gate": {"wheel": 0.9, "actuator": 0.06, "gearbox": 0.03, "lever": 0.003, "none": 0.003},
        "globe": {"wheel": 0.95, "actuator": 0.03, "gearbox": 0.005, "lever": 0.001, "none": 0.003},
        "butterfly": {"lever": 0.5, "gearbox": 0.3, "actuator": 0.18, "wheel": 0.02, "none": 0.003},
        "check": {"none": 0.97, "lever": 0.02, "wheel": 0.001, "actuator": 0.001, "gearbox": 0.001},
        "plug": {"lever": 0.6, "gearbox": 0.15, "actuator": 0.15, "wheel": 0.02, "none": 0.05},
        "diaphragm": {"wheel": 0.85, "dome": 0.05, "actuator": 0.05, "lever": 0.01, "none": 0.01, "gearbox": 0.001},
        "relief": {"none": 0.5, "lever": 0.35, "wheel": 0.15, "actuator": 0.001, "gearbox": 0.001},
        "control": {"dome": 0.6, "actuator": 0.35, "wheel": 0.03, "none": 0.01, "lever": 0.001, "gearbox": 0.001},
        "other": {"actuator": 0.3, "dome": 0.1, "wheel": 0.25, "none": 0.2, "lever": 0.15, "gearbox": 0.02},
    }
)
# What is seen of what turns a valve, by its shape alone: measured on valves of the generator in one mesh.
_SEEN = MappingProxyType(
    {
        "wheel": {"wheel": 0.5, "dome": 0.01, "actuator": 0.006, "gearbox": 0.01, "lever": 0.002, "none": 0.003},
        "lever": {"lever": 0.35, "wheel": 0.02, "dome": 0.005, "actuator": 0.02, "gearbox": 0.1, "none": 0.01},
        "lid": {"none": 0.3, "dome": 0.002, "actuator": 0.006, "wheel": 0.002, "lever": 0.003, "gearbox": 0.002},
    }
)
# A name says what it is, but for these shares of names that are wrong: of any, and of those that the shape agrees with.
_MISNAMED, _AGREED = 0.005, 0.001
_NAMED = MappingProxyType({"gearbox": "gearbox", "actuator": "actuator", "handwheel": "wheel", "lever": "lever"})
# Parts without which a cover is that of a check valve.
_TURNING = frozenset({"valve stem", "yoke", "gland", "position indicator"})
# A body without a cover is that of a check valve where it swells to this many nominal sizes, as cones point to point
# don't, rises no more over its ends than this, and no more to one side than this against the other.
_SWELLS, _BARE, _EVEN = 1.35, 1.03, 1.1

# How often a valve of a kind has a length of its tables, is as short as a wafer, or has any other length.
_LENGTH = MappingProxyType(
    {
        "ball": (0.5, 0.01, 0.25), "gate": (0.6, 0.03, 0.02), "globe": (0.6, 0.001, 0.02),
        "butterfly": (0.6, 0.3, 0.02), "check": (0.5, 0.3, 0.15), "plug": (0.3, 0.002, 0.2),
        "diaphragm": (0.5, 0.002, 0.1), "relief": (0.1, 0.001, 0.9), "control": (0.5, 0.02, 0.3),
        "other": (0.15, 0.1, 0.75),
    }
)  # fmt: skip
# Whose lengths a kind has, where not its own.
_TABLES = MappingProxyType(
    {
        "plug": ("gate", "ball"),
        "control": ("globe",),
        "check": ("check", "wafer check"),
        "relief": ("globe",),
        "other": ("gate", "globe", "ball", "check"),
    }
)
# Two lengths are one within this [m], gaskets and the gaps instead of them included; of wafers, whose lengths are less
# far apart, within this. A wafer is shorter than this share of its nominal size, or than this one with a length of the
# tables of wafers.
_FACE, _WAFER_FACE, _WAFER, _WAFER_AT_MOST = 0.010, 0.006, 0.8, 0.95

# How often a valve of a kind lies in a straight line, turns it, or ends it.
_PLACE = MappingProxyType(
    {
        "ball": (0.9, 0.005, 0.1), "gate": (0.97, 0.002, 0.03), "globe": (0.93, 0.05, 0.03),
        "butterfly": (0.98, 0.001, 0.02), "check": (0.97, 0.02, 0.005), "plug": (0.97, 0.01, 0.03),
        "diaphragm": (0.97, 0.01, 0.02), "relief": (0.03, 0.4, 0.57), "control": (0.93, 0.06, 0.005),
        "other": (0.7, 0.2, 0.1),
    }
)  # fmt: skip
# A spring housing over the inlet and a snout aside: of relief valves, of others.
_SPRUNG, _UNSPRUNG = (0.6, 0.01), (0.4, 0.99)
# A relief valve is slender over its snout; the snout is low, reaches over the housing on one side, but not as far as a
# lever does; and it ends otherwise than it begins (radii).
_SLENDER, _REACH, _ALONE, _UNLIKE, _TALL = 0.8, 3.2, 0.75, 0.12, 1.6
# A ball among the parts is that of a ball valve, but for check valves with a ball, and for control valves that turn a
# segment of one, a fifth of them (ours): driven, and as long as no ball valve is, it may be either. A disc is named
# in two of three butterfly valves, in no ball valve (counted on generated ones).
_BALL = "valve ball"
_HOLDS = MappingProxyType(
    {
        _BALL: MappingProxyType({"ball": 1.0, "check": 0.02, "plug": 0.02, "control": 0.2}),
        "valve disc": MappingProxyType(
            {
                "gate": 0.02, "globe": 0.02, "butterfly": 0.7, "check": 0.1, "plug": 0.1,
                "diaphragm": 0.02, "relief": 0.05, "control": 0.1, "other": 0.3,
            }
        ),
    }
)  # fmt: skip
# How often valves of a kind that is turned by hand have a yoke, which carries a stem that rises (ours); a quarter turn
# needs none. Brackets of actuators are called so, too.
_HOLDS_YOKE = MappingProxyType(
    {
        "ball": 0.01, "gate": 0.6, "globe": 0.6, "butterfly": 0.01, "check": 0.005, "plug": 0.01, "diaphragm": 0.2,
        "relief": 0.2, "control": 0.6, "other": 0.3,
    }
)  # fmt: skip
# How often valves of a kind have several levers: an arm with its weight, as on check and float valves. Others have
# one (counted on generated valves: 1 of 25 ball valves has more, all check valves with a lever have).
_SEVERAL_LEVERS = MappingProxyType({"check": 0.5, "relief": 0.15, "other": 0.4})
# How often the stem under a lever passes the line by more than this share of the bore's radius (ours): a ball, a plug
# and a disc turn about the middle of the bore, as good as; a clapper hangs from a shaft above it, whose lever holds a
# weight.
_PASSES = 0.25
_ABOVE = MappingProxyType({"check": 0.5, "relief": 0.05, "butterfly": 0.01, "other": 0.2})
# How often valves of a kind that is turned by a wheel have one that is small for their size, and several bonnets, one
# on the other: a spring is set by a small wheel on its housing, which stands on that of a diaphragm (counted on
# generated valves in pieces; wheels of EN 12570 and of catalogues).
_SMALL_WHEEL = MappingProxyType({"gate": 0.01, "globe": 0.06, "diaphragm": 0.05})
_SEVERAL_BONNETS = MappingProxyType({"gate": 0.02, "globe": 0.06, "diaphragm": 0.03, "other": 0.3})
# A wheel is small below this share of the nominal size; those of large valves are smaller (DN and share).
_LEAST_WHEEL = ((150, 1.6), (300, 1.2), (10_000, 0.9))
# A stem is this much longer than wide, and lies across the line up to this (cosine).
_LONG, _ACROSS = 1.3, 0.3
# A lever over a body as long as check valves are, and as no ball valve is, is this much likelier their arm (ours).
_ARM = 4.0


@dataclass(frozen=True)
class _Look:
    """What there is to see of a valve.

    Args:
        turned: what turns it, by the names of its parts, or None.
        shape: what stands on it, by its shape, or None.
        covered: whether it has a cover, or swells without one, and nothing that could be turned.
        place: 0 in a straight line, 1 in a corner, 2 at an end.
        length: from face to face [m], or None.
        size: nominal (DN), or None.
        sprung: whether it looks like a spring housing with a snout; None where that can't be said.
        closed_by: what closes it, by the names of its parts: a ball, a disc, or None.
        yoke: whether there is a yoke among its parts, and no actuator or gearbox.
        levers: how many levers there are among its parts.
        above: whether a lever turns about a stem that passes the line.
        small_wheel: whether a wheel turns it that is small for its size.
        bonnets: how many bonnets there are among its parts.
    """

    turned: str | None
    shape: str | None
    covered: bool
    place: int
    length: float | None
    size: int | None
    sprung: bool | None
    closed_by: str | None
    yoke: bool = False
    levers: int = 0
    above: bool = False
    small_wheel: bool = False
    bonnets: int = 0

    @property
    def says_something(self) -> bool:
        """Whether there is anything to tell kinds by: a length or a disc alone is that of several, but for wafers."""
        if self.turned or self.shape or self.covered or self.closed_by == _BALL or self.sprung:
            return True
        return self.length is not None and self.size is not None and _is_wafer(self.length, self.size)


def valve_kinds(
    unit: UnitParts, names: Sequence[str | None], sizes: Sequence[int], parts: Parts
) -> tuple[tuple[str, float], ...]:
    """The kinds that a valve may be of, with their confidences, the likeliest first.

    Args:
        unit: a valve, with its openings.
        names: of each part of the scene.
        sizes: nominal sizes (DN) of the lines that join it.
        parts: of the scene.

    Returns:
        ``("gate valve", 0.95)``... of those with rules; nothing where nothing can be seen.
    """
    # All that it follows from, beside geometry: what a correction elsewhere leaves as it was is not looked at again.
    known = store_of(parts, "kinds of valves")
    key = unit.parts, unit.openings, tuple(names[part] for part in unit.parts), min(sizes, default=None)
    if key not in known:
        known[key] = _weigh(_look(unit, names, min(sizes, default=None), parts))
    found: tuple[tuple[str, float], ...] = known[key]
    return found


def _weigh(look: _Look) -> tuple[tuple[str, float], ...]:
    """The kinds that have the look of a valve, the likeliest first."""
    if not look.says_something:
        return ()
    weight = {kind: share * _likelihood(kind, look) for kind, share in _PRIOR.items()}
    total = sum(weight.values())
    found = ((f"{kind} valve", value / total) for kind, value in weight.items() if kind != "other")
    return tuple(sorted(found, key=lambda one: (-one[1], one[0])))


def _likelihood(kind: str, look: _Look) -> float:
    share = _by_operator(kind, look) * _by_length(kind, look.length, look.size) * _PLACE[kind][look.place]
    if look.sprung is not None:
        share *= (_SPRUNG if look.sprung else _UNSPRUNG)[kind != "relief"]
    return share * _by_parts(kind, look)


def _by_parts(kind: str, look: _Look) -> float:
    """How often a valve of a kind has what this one has: a ball or a disc, a yoke, several levers, a weight's arm, a
    stem that passes the line, a small wheel, several bonnets.
    """
    share = _HOLDS[look.closed_by].get(kind, 0.002) if look.closed_by else 1.0
    share *= _HOLDS_YOKE[kind] if look.yoke else 1.0
    share *= _ARM if kind == "check" and _may_be_arm(look) else 1.0
    share *= _ABOVE.get(kind, 0.002) if look.above else 1.0
    if look.turned == "wheel":
        share *= _SMALL_WHEEL.get(kind, 0.4) if look.small_wheel else 1.0
        share *= _SEVERAL_BONNETS.get(kind, 0.2) if look.bonnets > 1 else 1.0
    return share * (_SEVERAL_LEVERS.get(kind, 0.04) if look.levers > 1 else 1.0)


def _may_be_arm(look: _Look) -> bool:
    """Whether a valve with a lever has a length of check valves that ball valves don't have."""
    length, size = look.length, look.size
    if look.turned != "lever" or length is None or size is None:
        return False
    return _is_one_of(length, "check", size, _FACE) and not _is_one_of(length, "ball", size, _FACE)


def _by_operator(kind: str, look: _Look) -> float:
    turned = _TURNED[kind]
    share = 1.0
    if look.turned is not None:
        often = turned[look.turned] + (turned.get("dome", 0.0) if look.turned == "actuator" else 0.0)
        share *= often + (_AGREED if look.shape == look.turned else _MISNAMED)
    elif look.covered:
        share *= turned["none"] + _MISNAMED
    if look.shape is not None and look.shape != look.turned:
        share *= sum(_SEEN[look.shape][real] * often for real, often in turned.items())
    return share


def _by_length(kind: str, length: float | None, size: int | None) -> float:
    if length is None or size is None:
        return 1.0
    alike, wafer, other = _LENGTH[kind]
    short = _is_wafer(length, size)
    near = _WAFER_FACE if short else _FACE
    if any(_is_one_of(length, table, size, near) for table in _TABLES.get(kind, (kind,))):
        return alike
    return wafer if short else other


def _is_wafer(length: float, size: int) -> bool:
    """Whether a valve is so short that it has no flanges of its own."""
    if length <= _WAFER_AT_MOST * size / 1000 and _is_one_of(length, "butterfly", size, _WAFER_FACE):
        return True
    return length <= _WAFER * size / 1000


def _is_one_of(length: float, table: str, size: int, near: float) -> bool:
    return any(abs(length - known) <= near for known in lengths_of(table, size))


def _look(unit: UnitParts, names: Sequence[str | None], size: int | None, parts: Parts) -> _Look:
    named = [names[part] for part in unit.parts]
    own = set(named)
    by = _first_of(_NAMED, own)
    turned = None if by is None else _NAMED[by]
    still = turned is None and not own & _TURNING
    look = _Look(
        turned=turned,
        shape=None,
        covered=still and "valve bonnet" in own,
        place=1 if len(unit.openings) > 1 else 2,
        length=None,
        size=size,
        sprung=_is_sprung(unit, names, parts),
        closed_by=_first_of(_HOLDS, own),
        yoke="yoke" in own and turned not in ("actuator", "gearbox"),
        levers=named.count("lever"),
        small_wheel=_has_small_wheel(unit, names, parts, size),
        bonnets=named.count("valve bonnet"),
    )
    line = line_through(unit.openings)
    if line is None:
        return look
    look = replace(look, above=turned == "lever" and _stem_passes(unit, names, parts, line, size))
    return _in_line(look, surface_about(parts, unit.parts, *line), still and "valve body" in own)


def _has_small_wheel(unit: UnitParts, names: Sequence[str | None], parts: Parts, size: int | None) -> bool:
    """Whether the wheels of a valve are all smaller than those that turn valves of its size, if that is known."""
    wheels = [part for part in unit.parts if names[part] == "handwheel"]
    if size is None or not wheels:
        return False
    least = next(share for most, share in _LEAST_WHEEL if size <= most) * size / 1000
    return float(parts.properties.obb_extents[wheels].max()) < least


def _stem_passes(
    unit: UnitParts, names: Sequence[str | None], parts: Parts, line: tuple[Floats, Floats], size: int | None
) -> bool:
    """Whether a stem of a valve passes the line through it, by more than balls and discs are off the middle."""
    if size is None:
        return False
    stems = [part for part in unit.parts if names[part] == "valve stem"]
    return any(_passes(parts, stem, *line, _PASSES * size / 2000) for stem in stems)


def _passes(parts: Parts, stem: int, start: Floats, end: Floats, least: float) -> bool:
    """Whether a stem lies across a line and passes it by more than some metres."""
    properties = parts.properties
    long, wide, _ = properties.obb_extents[stem]
    if long < _LONG * wide:
        return False
    way, axis = (end - start) / np.linalg.norm(end - start), properties.obb_axes[stem, 0]
    square = np.cross(way, axis)
    if abs(float(way @ axis)) > _ACROSS:
        return False
    return abs(float((properties.obb_center[stem] - start) @ square)) / float(np.linalg.norm(square)) > least


def _first_of(wanted: Iterable[str], names: Collection[str | None]) -> str | None:
    return next((name for name in wanted if name in names), None)


def _in_line(look: _Look, surface: Surface, closed: bool) -> _Look:
    """What the surface of a valve in a straight line adds; ``closed`` where no part of it could be turned."""
    shape = standing_on(surface)
    bare = closed and shape is None and look.size is not None and _is_bare(surface, look.size)
    return replace(look, shape=shape, covered=look.covered or bare, place=0, length=surface.length)


def _is_bare(surface: Surface, size: int) -> bool:
    """Whether a body swells between its ends, and nothing stands out of it that could be turned."""
    height = surface.height
    middle = np.abs(surface.along) < 0.35
    ends = float(height[(np.abs(surface.along) > 0.4) & (np.abs(surface.along) <= 0.55)].max(initial=0.0))
    pull = (surface.area * height) @ surface.out
    rise = surface.out[middle] @ pull / max(float(np.linalg.norm(pull)), 1e-12)
    girth = float(-rise.min(initial=0.0))
    if float(height.max(initial=0.0)) > _BARE * ends or float(rise.max(initial=0.0)) > _EVEN * girth:
        return False
    return girth >= _SWELLS * size / 2000


def _is_sprung(unit: UnitParts, names: Sequence[str | None], parts: Parts) -> bool | None:
    """Whether a valve at the end of a line is slender above a snout on one side; None where it ends no line."""
    if len(unit.openings) != 1:
        return None
    opening = unit.openings[0]
    body = [part for part in unit.parts if names[part] not in ("lever", "handwheel")]
    if opening.direction is None or not body:
        return None
    start, way = np.asarray(opening.point), -np.asarray(opening.direction)
    low, high = box_around(parts, body)
    reach = float(np.where(way > 0, high, low) @ way - start @ way)
    return _spring_housing(surface_about(parts, body, start, start + reach * way)) if reach > 1e-3 else None


def _spring_housing(surface: Surface) -> bool | None:
    """Whether a valve is a spring housing over a snout; None where it is, but might end in two flanges as well."""
    height = surface.height
    low, high = surface.along < 0.0, surface.along > 0.1
    snout, housing = (float(height[row].max(initial=0.0)) for row in (low, high))
    if not 0.0 < housing <= _SLENDER * snout or snout > _REACH * housing or surface.length < _TALL * snout:
        return False
    far = low & (height > 0.8 * snout)
    out = surface.out[far] / height[far, None]
    alone = float(np.linalg.norm(surface.area[far] @ out)) / float(surface.area[far].sum())
    if alone < _ALONE:
        return False
    return True if _unlike(surface.along, height) else None


def _unlike(along: Floats, height: Floats) -> bool:
    """Whether a body ends otherwise than it begins, unlike one with two flanges."""
    first = float(height[along < -0.42].max(initial=0.0))
    last = float(height[along > 0.42].max(initial=0.0))
    return abs(last - first) > _UNLIKE * max(first, last)
