"""Lines that only look like some: rings that lead nowhere, and stubs of what the labeler takes for something else."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from cadgraph.geometry.components import connected_sets
from cadgraph.stages.relate.attach import Attachments
from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.piping import Piping

__all__ = ["prune_lines"]

_LEAST_PIPE = 0.3  # a line that the labeler finds less likely than this leads to two things at least, a disc sooner
_LEAST_END = 0.5  # likewise a disc that touches one thing only: the flange at the end of a run
_LEADS = 2
_LIKELY = 0.7  # from this probability on something is taken for a line, or a piece of a unit, without more


def prune_lines(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that are none, where nobody but the labeler says what their parts are.

    Args:
        piping: with all lines.
        beliefs: what each part may be.
    """
    return _without_stubs(_without_rings(piping, beliefs), beliefs)


def _without_rings(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that only lead into each other: pieces of a volute, a coil, a handle."""
    possible = {part for part in _closed_lines(piping.joints) if beliefs.open[part]}
    connected = connected_sets(sorted(piping.lines), _facing_parts(piping.joints))
    rings = [ring for ring in connected if possible.issuperset(ring)]
    if not rings:
        return piping
    gone = {part for ring in rings for part in ring}
    return replace(piping, lines={part: line for part, line in piping.lines.items() if part not in gone})


def _facing_parts(found: Attachments) -> list[tuple[int, int]]:
    """The pairs of parts whose ends face each other."""
    part = found.ends.part
    return [(int(part[facing.first]), int(part[facing.second])) for facing in found.facings]


def _closed_lines(found: Attachments) -> set[int]:
    """The parts with ends, all of which face another one, that nothing is tapped into."""
    joined = {row for facing in found.facings for row in (facing.first, facing.second)}
    tapped = {tapped.part for tapped in found.taps if not tapped.tap.sleeve}
    return {part for part, rows in found.ends.of_part.items() if joined.issuperset(rows)} - tapped


def _without_stubs(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that the labeler holds for something else and that don't run between two likely things."""
    likely, doubtful = _likely_solids(piping, beliefs), _doubtful_lines(piping, beliefs)
    while doubtful:
        joined = _joined_parts(piping.joints)
        leads = Counter(part for part, other in joined if other in likely or other in piping.lines)
        stubs = {part for part in doubtful if leads[part] < _LEADS}
        if not stubs:
            break
        piping = replace(piping, lines={part: line for part, line in piping.lines.items() if part not in stubs})
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
        if offer.kind in ("face", "corner"):
            yield part, int(found.ends.part[offer.other if offer.row == row else offer.row])
        elif offer.kind != "sleeve":
            yield part, offer.other
            if offer.kind == "tap":
                yield offer.other, part
