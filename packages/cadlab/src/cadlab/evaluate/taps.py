"""The order of units that tap into one mesh: what the paper's Algorithm 1 can't know (its section V-D)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from cadgraph._io.text import natural_key
from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.relations import UnitGraph, predicted_graph, true_graph
from cadlab.evaluate.scores import share
from cadlab.evaluate.units import UnitMatch

__all__ = ["TapScores", "TapVerdict", "compare_taps", "score_taps"]

_FOOT = "branch outlet"
"""Name of what an instrument stands on: it taps into what its outlet is welded to."""


@dataclass(frozen=True)
class TapVerdict:
    """Two units that follow each other and tap into one mesh.

    Args:
        units: their tags, in natural order.
        mesh: that both tap into.
        outcome: ``"right"``, ``"wrong"`` or ``"undecided"``.
        structures: the true clusters that they are in.
    """

    units: tuple[str, str]
    mesh: str
    outcome: str
    structures: tuple[str, ...]


@dataclass(frozen=True)
class TapScores:
    """The order of neighbours on one mesh.

    Args:
        n_pairs: pairs of true neighbours that tap into one mesh and have something else beyond.
        n_right: of these, what the graph puts in the same order.
        n_wrong: what it puts the other way round.
        reversed_pairs: the pairs of these.
    """

    n_pairs: int
    n_right: int
    n_wrong: int
    reversed_pairs: tuple[TapVerdict, ...]

    @property
    def accuracy(self) -> float | None:
        """The right share of all pairs; undecided ones are not right."""
        return share(self.n_right, self.n_pairs)


def compare_taps(pairing: Pairing, match: UnitMatch, kind: str) -> tuple[TapVerdict, ...]:
    """Asks for each two true neighbours on one mesh whether the graph has them in the same order.

    The order of a and b shows in what lies beyond: it is right where a and b are neighbours in the graph, too, and
    what lies beyond a in the truth is next to a, not to b; wrong where it is next to b.

    Args:
        pairing: graph and truth; the truth has contacts.
        match: which predicted unit stands for which true one.
        kind: ``"connected"`` or ``"related"``.
    """
    true = true_graph(pairing)
    found = _translated(predicted_graph(pairing, kind), match)
    tapped = _tapped(pairing)
    tags = {unit.id: unit.tag for unit in match.true}
    place = {unit.id: unit.structure for unit in match.true}
    near_true, near_found = _near(true.directions), _near(found.directions)
    verdicts = []
    for a, b in true.directions:
        common = tapped.get(a, set()) & tapped.get(b, set())
        if not common:
            continue
        beyond_a = (near_true[a] - near_true[b]) - {b}
        beyond_b = (near_true[b] - near_true[a]) - {a}
        # Algorithm 1 knows no open ends: what only these tell apart it is not asked for.
        ends_a, ends_b = (true.open_ends.get(end, 0) if kind == "connected" else 0 for end in (a, b))
        if not beyond_a and not beyond_b and (ends_a > 0) == (ends_b > 0):
            continue
        of_a, of_b = near_found.get(a, set()), near_found.get(b, set())
        right = len(beyond_a & of_a) + len(beyond_b & of_b)
        wrong = len(beyond_a & of_b) + len(beyond_b & of_a)
        if (ends_a > 0) != (ends_b > 0):
            keeps, other = (a, b) if ends_a else (b, a)
            right += found.open_ends.get(keeps, 0) > 0
            wrong += found.open_ends.get(other, 0) > 0
        outcome = "wrong" if wrong else "right" if right and b in of_a else "undecided"
        first, second = sorted((tags[a], tags[b]), key=natural_key)
        here = tuple(sorted({one for unit in (a, b) if (one := place[unit]) is not None}))
        verdicts.append(TapVerdict((first, second), min(common, key=natural_key), outcome, here))
    return tuple(sorted(verdicts, key=lambda verdict: tuple(map(natural_key, verdict.units))))


def score_taps(verdicts: Sequence[TapVerdict]) -> TapScores:
    """Counts pairs on one mesh."""
    wrong = tuple(verdict for verdict in verdicts if verdict.outcome == "wrong")
    return TapScores(len(verdicts), sum(verdict.outcome == "right" for verdict in verdicts), len(wrong), wrong)


def _tapped(pairing: Pairing) -> dict[str, set[str]]:
    """For each true unit the connector meshes that it touches, directly or by its branch outlet."""
    truth, rows = pairing.truth, pairing.rows
    connectors = {row.mesh for row in truth.meshes if row.group is not None and _connects(pairing, row.group)}
    beside: dict[str, set[str]] = {}
    for a, b in truth.contacts or ():
        beside.setdefault(a, set()).add(b)
        beside.setdefault(b, set()).add(a)
    found: dict[str, set[str]] = {}
    for unit in truth.units or ():
        touched = {mesh for own in unit.meshes for mesh in beside.get(own, ())} & connectors
        feet = {mesh for mesh in touched if rows[mesh].name == _FOOT}
        found[unit.id] = (touched - feet) | ({mesh for foot in feet for mesh in beside[foot]} & connectors)
    return found


def _connects(pairing: Pairing, group: str) -> bool:
    entry = pairing.vocabulary.groups.get(group)
    return entry is not None and entry.connector


def _near(pairs: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    near: dict[str, set[str]] = {}
    for a, b in pairs:
        near.setdefault(a, set()).add(b)
        near.setdefault(b, set()).add(a)
    return near


def _translated(found: UnitGraph, match: UnitMatch) -> UnitGraph:
    """The graph's neighbours by the true units that they stand for; those that stand for none are left out."""
    known: Mapping[str, str] = match.true_of
    pairs = {(known[a], known[b]): way for (a, b), way in found.directions.items() if a in known and b in known}
    return UnitGraph(pairs, {known[unit]: n for unit, n in found.open_ends.items() if unit in known})
