"""Lines that only look like some: rings that lead nowhere, and stubs of what the labeler takes for something else."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import replace

from cadgraph.geometry.components import connected_sets
from cadgraph.model.parts import Bools
from cadgraph.stages.relate.attach import Attachments
from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.piping import Piping

__all__ = ["likely_devices", "prune_lines"]

_LEAST_PIPE = 0.3  # a line that the labeler finds less likely than this leads to two things at least, a disc sooner
_LEAST_END = 0.5  # likewise a disc that touches one thing only: the flange at the end of a run
_LEADS = 2
_HARDLY, _DEVICE = 0.25, 0.5  # a likely device is one by the second at least, and piping by this share of it
_MOST_ENDS = 4  # that a fitting has: a cross
# Names of connectors that have no more ends than that.
_FEW_ENDS = frozenset({
    "elbow", "tee", "cross", "reducer", "flange", "blind flange", "gasket", "coupling", "union", "nipple", "pipe cap",
    "expansion joint", "hose", "strainer",
})  # fmt: skip
_OPPOSITE = -0.95  # cosine between two ends on one axis
_LIKELY = 0.7  # from this probability on something is taken for a line, or a piece of a unit, without more


def prune_lines(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that are none, where nobody but the labeler says what their parts are.

    Args:
        piping: with all lines.
        beliefs: what each part may be.
    """
    return _without_stubs(_without_bodies(_without_rings(piping, beliefs), beliefs), beliefs)


def _without_rings(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that only lead into each other: pieces of a volute, a coil, a handle."""
    possible = {part for part in _closed_lines(piping.joints) if beliefs.open[part]}
    connected = connected_sets(sorted(piping.lines), _facing_parts(piping.joints))
    rings = [ring for ring in connected if possible.issuperset(ring)]
    return _dropped(piping, {part for ring in rings for part in ring})


def _facing_parts(found: Attachments) -> list[tuple[int, int]]:
    """The pairs of parts whose ends face each other."""
    part = found.ends.part
    return [(int(part[facing.first]), int(part[facing.second])) for facing in found.facings]


def _closed_lines(found: Attachments) -> set[int]:
    """The parts with ends, all of which face another one, that nothing is tapped into."""
    joined = {row for facing in found.facings for row in (facing.first, facing.second)}
    tapped = {tapped.part for tapped in found.taps if not tapped.tap.sleeve}
    return {part for part, rows in found.ends.of_part.items() if joined.issuperset(rows)} - tapped


def likely_devices(piping: Piping, beliefs: Beliefs) -> Bools:
    """``(n_parts,)`` what nobody but the labeler names, and it holds for a device and hardly for piping."""
    connectors = beliefs.of_groups(piping.given.vocabulary.connector_groups)
    units = beliefs.of_groups(piping.given.vocabulary.unit_of_group.keys())
    found: Bools = beliefs.open & (units >= _DEVICE) & (connectors <= _HARDLY * units)
    return found


def _without_bodies(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines of likely devices that lead round a corner or to more than two ends: a hydrocyclone, a sump.

    What has two ends on one axis is looked at as a piece of a line.
    """
    devices = likely_devices(piping, beliefs)
    bodies = {part for part in piping.lines if devices[part] and not _passes_straight(piping.joints, part)}
    return _dropped(piping, bodies | _vessels(piping, beliefs))


def _vessels(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Lines with more ends than any fitting has, of what is likelier a device than a pipe with branches."""
    vocabulary = piping.given.vocabulary
    units = beliefs.of_groups(vocabulary.unit_of_group.keys())
    headers = beliefs.of_groups(vocabulary.connector_groups, _FEW_ENDS)
    made, of_part = piping.joints.made, piping.joints.ends.of_part
    many = [part for part in piping.lines if sum(row in made for row in of_part.get(part, ())) > _MOST_ENDS]
    return {part for part in many if beliefs.open[part] and units[part] > headers[part]}


def _passes_straight(found: Attachments, part: int) -> bool:
    """Whether just two ends of a part join others, and look opposite ways."""
    rows = [row for row in found.ends.of_part.get(part, ()) if row in found.made]
    directions = found.ends.direction
    return len(rows) == 2 and float(directions[rows[0]] @ directions[rows[1]]) <= _OPPOSITE


def _dropped(piping: Piping, parts: Collection[int]) -> Piping:
    """Without the lines of some parts."""
    if not parts:
        return piping
    return replace(piping, lines={part: line for part, line in piping.lines.items() if part not in parts})


def _without_stubs(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that the labeler holds for something else and that don't run between two likely things."""
    likely, doubtful = _likely_solids(piping, beliefs), _doubtful_lines(piping, beliefs)
    while doubtful:
        joined = _joined_parts(piping.joints)
        leads = Counter(part for part, other in joined if other in likely or other in piping.lines)
        stubs = {part for part in doubtful if leads[part] < _LEADS}
        if not stubs:
            break
        piping = _dropped(piping, stubs)
        doubtful -= stubs
    return piping


def _doubtful_lines(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Lines that the labeler finds unlikely; discs sooner, for the line of one is soon found, but not those at the end
    of a run, which touch nothing but what they close.
    """
    connectors = beliefs.of_groups(piping.given.vocabulary.connector_groups)

    def least(part: int) -> float:
        if not is_disc(piping.lines[part]):
            return _LEAST_PIPE
        return _LIKELY if len(piping.given.neighbors.get(part, ())) > 1 else _LEAST_END

    return {
        part
        for part in piping.lines
        if beliefs.open[part] and part not in piping.branches and connectors[part] < least(part)
    }


def _likely_solids(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Connectors without a line, and parts of units one of whose parts others call so or the labeler finds likely."""
    units = beliefs.of_groups(piping.given.vocabulary.unit_of_group.keys())
    likely = set(piping.lineless)
    for group in piping.groups:
        if any(not beliefs.open[part] or units[part] >= _LIKELY for part in group.parts):
            likely.update(group.parts)
    return likely


def _joined_parts(found: Attachments) -> Iterator[tuple[int, int]]:
    """For each joint of a line the part that carries it and the other one; a part in a sleeve leads nowhere."""
    for row, offer in found.made.items():
        part = int(found.ends.part[row])
        if offer.of_two_ends:
            yield part, int(found.ends.part[offer.other if offer.row == row else offer.row])
        elif offer.kind != "sleeve":
            yield part, offer.other
            if offer.kind == "tap":
                yield offer.other, part
