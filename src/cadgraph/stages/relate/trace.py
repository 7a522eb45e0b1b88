"""Which parts carry lines: the connectors, and what only geometry shows to be one."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline
from cadgraph.geometry.line.part_lines import lines_of_parts
from cadgraph.geometry.shape.analysis import shapes_of
from cadgraph.model.derived import store_of
from cadgraph.model.labels import Label
from cadgraph.model.parts import Bools, Contacts, Parts
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.attach import facings_of
from cadgraph.stages.relate.decide import decide_joints
from cadgraph.stages.relate.enclosed import holds_disc
from cadgraph.stages.relate.joint import Ends, find_tap, gather_ends
from cadgraph.stages.relate.line import is_disc, is_fitting, is_neck, is_plain_tube, is_steady, is_straight
from cadgraph.stages.relate.offer import Surroundings, offer_faces
from cadgraph.stages.relate.piping import Group, Piping, RelateInput
from cadgraph.stages.relate.role import Roles, likely_lines
from cadgraph.stages.relate.stubbed import find_stubbed, likely_stubbed
from cadgraph.stages.relate.unit import connected_groups

__all__ = ["drop_shapeless", "trace_lines"]

_Value = TypeVar("_Value")

# A part that only its shape calls a pipe must face one of about its size: this ratio of radii, that of a reducing
# flange; one that its label calls a device must face one of its own size.
_RATIO, _OWN_RATIO = 0.3, 0.9
# What may be a device and is wider than the pipes at both of its ends is a sleeve on them up to this ratio of radii.
_SLEEVE = 0.7
# A short cylinder of a pipe's own size is a piece of it where the labeler is less sure than this of the device.
_SAME_RATIO, _UNSURE = 0.97, 0.9
# What bends or branches between its mouths, all of its surface along that line, is a fitting where the labeler has no
# name for it and is less sure than this of a device: an angle or three-way valve has a bonnet, a gauge its case.
_UNSURE_OF_FITTING = 0.7
_WITH_PIPES = frozenset({"valve", "pump"})
_IN_LINE = frozenset({"flow meter", "sight glass"})  # devices that stand in a line and may be shaped like a piece of it
_PLATES = frozenset({"flange", "blind flange", "gasket"})
# What the labeler alone takes for steelwork is a pipe only where lines go on at both of its ends: no ratio is enough.
_BOTH_ENDS, _LEAST_LINES, _MOST_LINES = 2.0, 2, 6
_ROUND = 0.12  # sides of a box that differ by less than this share are those of something round
# A device drawn as a mere cylinder is straight and at most so many radii long: a DN 15 gate valve has ten.
_LONGEST_DEVICE = 12.0
# A jacket has thinner lines (share of its radius) in its middle (likewise) at this share of so many places along it.
# It is at least so many radii long, as couplings are not; or one line runs on beyond it by so many radii.
_THINNER, _OFF_MIDDLE, _JACKET, _SAMPLES, _LEAST_JACKET, _BEYOND = 0.97, 0.25, 0.7, 9, 4.0, 0.25
_SAME_PLACE = 1e-4  # copies of a part lie this near to each other [m]


def trace_lines(given: RelateInput, roles: Roles) -> Piping:
    """Finds the lines, and the groups of parts between which they run.

    Args:
        given: what everything is found from.
        roles: what each part does.

    Returns:
        The piping; a connector whose shape is no line's is among its lineless ones.
    """
    connectors = _without_bodies(given, roles, _connectors(given, roles))
    others = likely_lines(roles, given.opinions, given.contacts, given.vocabulary, given.parts.ground.tolist())
    possible = _possible_lines(given, roles, _with_further_pieces(given, roles, others))
    carrying = [*connectors, *possible.candidates()]
    beside = likely_stubbed(given, roles, carrying)
    candidates = [*carrying, *beside, *_tubes_of_units(given, roles)]
    traced, copies = _distinct_lines(given, candidates)
    sure = {part: traced[part] for part in connectors if part in traced}
    jackets = _jackets(given, traced, sure)
    ratios = _without(_least_ratios(given, roles, possible, traced), jackets)
    sure = _without(sure, jackets)
    lines = _continued(sure, ratios, traced, given.contacts, given.config.relate.bridge)
    stubbed = find_stubbed(given, roles, beside, _without(traced, jackets), lines)
    if stubbed.lines:
        lines = _continued({**lines, **stubbed.lines}, ratios, traced, given.contacts, given.config.relate.bridge)
    apart = copies | jackets | lines.keys()
    lineless = [part for part in connectors if part not in apart and given.cluster[part] >= 0]
    groups = connected_groups(given, roles, lines.keys() | jackets)
    return Piping(
        given=given,
        roles=roles,
        lines=dict(sorted(lines.items())),
        lineless=tuple(lineless),
        groups=tuple(groups),
        members=_parts_of(groups),
        feet=_parts_of(group for group in groups if group.unit_type == "gauge"),
        jackets=frozenset(jackets),
        branches=frozenset(stubbed.lines),
        open=stubbed.open,
    )


def _connectors(given: RelateInput, roles: Roles) -> list[int]:
    """The parts whose role is that of a connector."""
    return [part for part, group in enumerate(roles.groups) if group in given.vocabulary.connector_groups]


def _without(values: Mapping[int, _Value], some: Collection[int]) -> dict[int, _Value]:
    """What is known of parts, some of them left out."""
    return {part: value for part, value in values.items() if part not in some}


@dataclass(frozen=True)
class _Possible:
    """Parts that are no connectors by label but may carry a line.

    Args:
        others: parts of unknown function.
        singles: parts that stand alone as a unit.
        between: what the labeler takes for steelwork or the like between two lines.
        unsure: what the labeler takes for a piece of a device without being sure.
    """

    others: Sequence[int]
    singles: Sequence[int]
    between: Sequence[int]
    unsure: Sequence[int]

    def candidates(self) -> list[int]:
        """All of them."""
        return [*self.others, *self.singles, *self.between, *self.unsure]


def _possible_lines(given: RelateInput, roles: Roles, others: Sequence[int]) -> _Possible:
    """The parts that may continue a line, and what speaks for each of them."""
    others = [part for part in others if not holds_disc(given, roles, part)]
    singles = [group.parts[0] for group in connected_groups(given, roles) if len(group.parts) == 1]
    return _Possible(others, singles, _likely_between(given, roles, others), _unsure_pieces(given))


def _tubes_of_units(given: RelateInput, roles: Roles) -> list[int]:
    """Tubes that the labeler alone takes for pieces of devices."""
    unit_of_group, known = given.vocabulary.unit_of_group, shapes_of(given.parts)
    return [
        part
        for part, group in enumerate(roles.groups)
        if group in unit_of_group
        and given.labels[part] is given.opinions[part]
        and known.facts[int(known.shape[part])].tube
    ]


def _unsure_pieces(given: RelateInput) -> list[int]:
    """Parts that the labeler alone takes for pieces of valves or pumps without being sure."""
    unit_of_group = given.vocabulary.unit_of_group
    return [
        part
        for part, label in enumerate(given.labels)
        if label is not None
        and label is given.opinions[part]
        and unit_of_group.get(label.group) in _WITH_PIPES
        and label.confidence < _UNSURE
    ]


def _without_bodies(given: RelateInput, roles: Roles, parts: Iterable[int]) -> list[int]:
    """Those parts that can't be the body of a valve."""
    return [part for part in parts if not _may_be_body(given, roles, part)]


def _may_be_body(given: RelateInput, roles: Roles, part: int) -> bool:
    """Whether the labeler alone takes a part for piping, without a name for it, and it holds what closes a valve."""
    label = given.labels[part]
    return label is given.opinions[part] and label is not None and label.name is None and holds_disc(given, roles, part)


def _is_flanged(given: RelateInput, part: int) -> bool:
    """Whether flanges or gaskets lie on both sides of a part, which are as wide as a valve between them."""
    middles = given.parts.properties.centroid
    offsets = np.array(
        [
            middles[other] - middles[part]
            for other in given.neighbors.get(part, ())
            if (label := given.labels[other]) is not None and label.name in _PLATES
        ]
    ).reshape(-1, 3)
    return bool((offsets @ offsets.T < 0).any())


def _with_further_pieces(given: RelateInput, roles: Roles, others: Sequence[int]) -> list[int]:
    """Some parts of unknown function, and those that go on from them as wide and as round as they are: a pipe cut into
    pieces.
    """
    widths = _widths(given.parts)
    found, front = set(others), [part for part in others if np.isfinite(widths[part]).any()]
    while front:
        here = front.pop()
        for part in given.neighbors.get(here, ()):
            unknown = roles.groups[part] is None and part not in found and not given.parts.ground[part]
            if unknown and _are_alike(widths[here], widths[part]):
                found.add(part)
                front.append(part)
    return sorted(found)


def _widths(parts: Parts) -> Floats:
    """``(n_parts, 2)`` widths of each part as a round one: two sides of its box that are alike [m]; else NaN."""
    sides = np.sort(parts.properties.obb_extents, axis=1)
    pairs = np.stack([sides[:, :2], sides[:, 1:]], axis=1)
    alike = pairs[:, :, 1] <= (1 + _ROUND) * pairs[:, :, 0]
    return np.where(alike, pairs.mean(axis=2), np.nan)


def _are_alike(first: Floats, second: Floats) -> bool:
    """Whether two parts have a width in common."""
    lesser, greater = np.minimum(first[:, None], second), np.maximum(first[:, None], second)
    return bool((greater <= (1 + _ROUND) * lesser).any())


def _likely_between(given: RelateInput, roles: Roles, others: Collection[int]) -> list[int]:
    """Parts that the labeler alone takes for steelwork or the like, and that touch two lines at least."""
    vocabulary = given.vocabulary
    functional = vocabulary.connector_groups | vocabulary.unit_of_group.keys()
    lines = {*_connectors(given, roles), *others}
    return [
        part
        for part, group in enumerate(roles.groups)
        if group is not None
        and group not in functional
        and given.labels[part] is given.opinions[part]
        and _LEAST_LINES <= len(lines.intersection(given.neighbors.get(part, ()))) <= _MOST_LINES
    ]


def _parts_of(groups: Iterable[Group]) -> frozenset[int]:
    return frozenset(part for group in groups for part in group.parts)


def _distinct_lines(given: RelateInput, candidates: Sequence[int]) -> tuple[dict[int, Centreline], set[int]]:
    """The line of each part that has one, and the parts that are mere copies of another one, without theirs."""
    traced = lines_of_parts(given.analysis.scene, given.analysis.properties, given.parts, candidates)
    copies = _repeated(given.parts, given.contacts, traced)
    return {part: line for part, line in traced.items() if part not in copies}, copies


def _repeated(parts: Parts, contacts: Contacts, lines: Mapping[int, Centreline]) -> set[int]:
    """Parts that lie where another one of their shape lies: of copies the first carries the line."""
    middles = parts.properties.centroid
    return {
        b
        for a, b in contacts.plain_pairs
        if a in lines
        and b in lines
        and parts.shape[a] == parts.shape[b]
        and float(np.abs(middles[a] - middles[b]).max()) < _SAME_PLACE
    }


def _least_ratios(
    given: RelateInput, roles: Roles, possible: _Possible, traced: Mapping[int, Centreline]
) -> dict[int, float]:
    """Parts that are no connectors by label but may continue a line, and the least ratio of radii for each.

    Args:
        given: what everything is found from.
        roles: what each part does.
        possible: parts that may carry a line.
        traced: line of each part.
    """
    ratios = {part: _RATIO for part in possible.others if part in traced}
    for part in possible.singles:
        ratio = _single_ratio(given, roles, part, traced[part]) if part in traced else None
        if ratio is not None:
            ratios[part] = ratio
    ratios |= dict.fromkeys(_steady_pieces(given, possible.unsure, traced) - ratios.keys(), _SAME_RATIO)
    # A gasket before it, or its pipe behind it, is far narrower.
    ratios |= dict.fromkeys(_lone_necks(given, possible, traced), _RATIO)
    return ratios | dict.fromkeys(_plain_tubes(possible.between, traced), _BOTH_ENDS)


def _steady_pieces(given: RelateInput, parts: Sequence[int], traced: Mapping[int, Centreline]) -> set[int]:
    """Those parts that run on as wide as they begin and don't lie between flanges."""
    steady = [part for part in parts if part in traced and is_steady(traced[part])]
    return {part for part in steady if not _is_flanged(given, part)}


def _lone_necks(given: RelateInput, possible: _Possible, traced: Mapping[int, Centreline]) -> set[int]:
    """What is taken, by itself and without being sure, for a device, and is a flange with its neck; half a valve's body
    looks like one, too, but has the rest of the valve beside it.
    """
    alone = set(possible.singles).intersection(possible.unsure)
    return {part for part in alone if part in traced and is_neck(traced[part]) and not _is_flanged(given, part)}


def _plain_tubes(parts: Sequence[int], traced: Mapping[int, Centreline]) -> list[int]:
    return [part for part in parts if part in traced and is_plain_tube(traced[part])]


def _single_ratio(given: RelateInput, roles: Roles, part: int, line: Centreline) -> float | None:
    """The least ratio of radii for a part that stands alone as a unit; None where it is no line."""
    label = given.labels[part]
    # The labeler is no second opinion on what it said itself; and whoever else says that a mere cylinder is a
    # valve may mean it, unless labels are doubtful.
    said = label is not None and label is not given.opinions[part]
    if (said and (part in roles.backed or _may_be_device(line, roles.doubtful))) or _is_sure_in_line(label):
        return None
    if _is_pipe(label, line):
        return _RATIO if roles.doubtful else _OWN_RATIO
    return _RATIO if roles.doubtful and is_disc(line) else None


def _is_pipe(label: Label | None, line: Centreline) -> bool:
    """Whether a part has the line of a plain tube, or that of a fitting where its label is not sure of a device."""
    unsure = label is not None and label.name is None and label.confidence < _UNSURE_OF_FITTING
    return is_plain_tube(line) or (unsure and is_fitting(line))


def _is_sure_in_line(label: Label | None) -> bool:
    """Whether a part is surely a device that stands in a line and may be shaped like a piece of it."""
    return label is not None and label.name in _IN_LINE and label.confidence >= _UNSURE


def _jackets(given: RelateInput, traced: Mapping[int, Centreline], sure: Mapping[int, Centreline]) -> set[int]:
    """Parts that nobody but the labeler has named and that run around lines that are sure: insulation."""
    known = store_of(given.parts, "jackets")
    found = set()
    for part, line in traced.items():
        if given.labels[part] is not given.opinions[part]:
            continue
        around = tuple(sure[other] for other in given.neighbors.get(part, ()) if other in sure)
        if (line, around) not in known:
            known[line, around] = _is_jacket(line, around)
        if known[line, around]:
            found.add(part)
    return found


def _is_jacket(line: Centreline, around: Sequence[Centreline]) -> bool:
    """Whether thinner lines run in the middle of a long one, or a single one right through a short one."""
    radius = line.branches[0].widest
    thinner = [one for one in around if one.narrowest <= _THINNER * radius]
    if line.length < min(1.0, _LEAST_JACKET) * radius or not thinner:
        return False
    points, beyond = np.concatenate([_along(branch) for branch in line.branches]), _beyond(line, _BEYOND * radius)
    inner = [_runs_within(np.concatenate([points, beyond]), radius, one) for one in thinner]
    through = bool(np.all(inner, axis=1).any())
    share = float(np.any(inner, axis=0)[: len(points)].mean())
    return (line.length >= radius and through) or (line.length >= _LEAST_JACKET * radius and share >= _JACKET)


def _beyond(line: Centreline, far: float) -> Floats:
    """``(n_ends, 3)`` places beyond the ends of a line [m]."""
    ends = line.table_of_ends
    return ends[:, :3] + far * ends[:, 3:6]


def _along(branch: Branch) -> Floats:
    """``(n, 3)`` places along a branch at equal steps [m]."""
    walked = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(branch.points, axis=0), axis=1))])
    steps = np.linspace(0.0, walked[-1], _SAMPLES)
    return np.stack([np.interp(steps, walked, branch.points[:, c]) for c in range(3)], axis=1)


def _runs_within(points: Floats, radius: float, line: Centreline) -> Bools:
    """``(n,)`` whether a line passes the middle of a wider section at each of some places."""
    found = np.zeros(len(points), np.bool_)
    for branch in line.branches:
        steps = np.diff(branch.points, axis=0)
        offset = points[:, None] - branch.points[None, :-1]
        share = np.clip((offset * steps).sum(axis=2) / np.maximum((steps**2).sum(axis=1), 1e-300), 0.0, 1.0)
        apart = np.linalg.norm(offset - share[:, :, None] * steps, axis=2)
        wall = branch.radius[:-1] + share * np.diff(branch.radius)
        nearest = np.argmin(apart, axis=1)
        row = np.arange(len(points))
        found |= (apart[row, nearest] <= _OFF_MIDDLE * radius) & (wall[row, nearest] <= _THINNER * radius)
    return found


def _may_be_device(line: Centreline, doubtful: bool) -> bool:
    """Whether a tube may be all that is drawn of a valve: a straight, short one."""
    return not doubtful and is_straight(line) and line.length <= _LONGEST_DEVICE * float(line.branches[0].radius.max())


def _continued(
    sure: Mapping[int, Centreline],
    ratios: Mapping[int, float],
    traced: Mapping[int, Centreline],
    contacts: Contacts,
    bridge: float,
) -> dict[int, Centreline]:
    """The sure lines with those that continue one of them.

    Args:
        sure: lines that are kept.
        ratios: parts whose line may continue one, and the least ratio of radii for each.
        traced: line of each part.
        contacts: pairs of parts that are near.
        bridge: greatest gap between ends that face each other [m].
    """
    if not ratios:
        return dict(sure)
    possible = {part: line for part, line in traced.items() if part in sure or part in ratios}
    steps, weak = _facing_parts(possible, ratios, contacts, bridge)
    lines = dict(sure)
    front = list(lines)
    while front:
        lines |= {part: traced[part] for part in _reached(steps, front, lines)}
        # What has a flange at either end is no less a pipe.
        front = [part for part, others in sorted(_without(weak, lines).items()) if _lie_on(others, lines)]
        lines |= {part: traced[part] for part in front}
    return lines


def _reached(steps: Mapping[int, Sequence[int]], start: Sequence[int], known: Collection[int]) -> list[int]:
    """The parts that some others lead to step by step and that are not known yet, in the order in which they are
    found.
    """
    found: dict[int, None] = {}
    front = list(start)
    while front:
        for part in steps.get(front.pop(), ()):
            if part not in known and part not in found:
                found[part] = None
                front.append(part)
    return list(found)


def _lie_on(others: Sequence[int], lines: Collection[int]) -> bool:
    return len(others) >= 2 and all(other in lines for other in others)


def _facing_parts(
    lines: Mapping[int, Centreline], ratios: Mapping[int, float], contacts: Contacts, bridge: float
) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """Whose ends face each other: the parts that may continue each, and for each the others of a lesser ratio."""
    ends = gather_ends(lines)
    steps: dict[int, list[int]] = {}
    weak: dict[int, list[int]] = {}
    for facing in facings_of(decide_joints(offer_faces(ends, Surroundings(contacts, bridge)), {}, {}).joined):
        if facing.corner:
            continue
        a, b = int(ends.part[facing.first]), int(ends.part[facing.second])
        width = {a: float(ends.radius[facing.first]), b: float(ends.radius[facing.second])}
        ratio = min(width.values()) / max(width.values())
        for part, other in ((a, b), (b, a)):
            if ratio >= ratios.get(part, 0.0):
                steps.setdefault(other, []).append(part)
            elif ratio >= _least_between(ratios[part], width[part] > width[other]):
                weak.setdefault(part, []).append(other)
    for part, other in _branches(ends, lines, ratios, contacts, bridge):
        weak.setdefault(part, []).append(other)
    return steps, weak


def _least_between(ratio: float, wider: bool) -> float:
    """The least ratio of radii at which a part is a line for lying between two, by the one at which it continues one.

    What may be a device is one where it is wider than a sleeve on both would be.
    """
    return _SLEEVE if wider and ratio != _BOTH_ENDS else _RATIO


def _branches(
    ends: Ends,
    lines: Mapping[int, Centreline],
    ratios: Mapping[int, float],
    contacts: Contacts,
    bridge: float,
) -> Iterator[tuple[int, int]]:
    """The parts that nothing but their joints can make pipes, each with a line that branches off its side."""
    for a, b in contacts.plain_pairs:
        for part, other in ((a, b), (b, a)):
            if part not in lines or ratios.get(part) != _BOTH_ENDS or other in ratios:
                continue
            taps = [find_tap(ends, row, lines[part], bridge) for row in ends.of_part.get(other, ())]
            if any(tap is not None and not tap.sleeve for tap in taps):
                yield part, other


def drop_shapeless(piping: Piping) -> Piping:
    """Takes away lines that join nothing although ends of others are at them: these were traced wrongly."""
    shapeless = _shapeless(piping)
    if not shapeless:
        return piping
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in shapeless},
        lineless=tuple(sorted((*piping.lineless, *shapeless))),
    )


def _shapeless(piping: Piping) -> set[int]:
    """Parts with a line of their own that joins nothing, at which two or more loose ends of other lines lie."""
    joined, of_part = {row for row, _ in piping.joints.joined()}, piping.joints.ends.of_part
    loose = {part: [row for row in rows if row not in joined] for part, rows in of_part.items()}
    idle = {part for part, rows in loose.items() if len(rows) == len(of_part[part])}
    busy = _without(loose, idle)
    return {part for part in idle if _count_at(piping, part, busy) >= 2}


def _count_at(piping: Piping, part: int, loose: Mapping[int, Sequence[int]]) -> int:
    """How many loose ends of the lines near a part lie at it."""
    rows = [row for other in piping.given.neighbors.get(part, ()) for row in loose.get(other, ())]
    return sum(_lies_at(piping, row, part) for row in rows)


def _lies_at(piping: Piping, row: int, part: int) -> bool:
    """Whether an end lies in a part's box, or its own radius from it."""
    radius, point = float(piping.joints.ends.radius[row]), piping.joints.ends.point[row]
    low, high = piping.given.parts.properties.aabb[part]
    return bool(np.all(point >= low - radius) and np.all(point <= high + radius))
