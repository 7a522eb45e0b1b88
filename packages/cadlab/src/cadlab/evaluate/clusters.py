"""Connected structures, and what touches what."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from cadgraph.model.records import Adjacent
from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.scores import Score

__all__ = [
    "ClusterScores",
    "ClusterVerdict",
    "ContactScores",
    "ContactVerdict",
    "adjusted_rand_index",
    "compare_clusters",
    "compare_contacts",
    "score_clusters",
    "score_contacts",
]


@dataclass(frozen=True)
class ClusterVerdict:
    """What became of one true cluster.

    Args:
        id: as the truth calls it.
        n_parts: parts whose largest mesh is in it.
        pieces: ids of the predicted clusters that these are in; a part in none is a piece of its own, under its id.
        joined_with: ids of the true clusters that share a predicted cluster with it.
    """

    id: str
    n_parts: int
    pieces: tuple[str, ...]
    joined_with: tuple[str, ...]

    @property
    def split(self) -> bool:
        """It lies in several predicted clusters."""
        return len(self.pieces) > 1

    @property
    def exact(self) -> bool:
        """One predicted cluster holds exactly its parts, as far as the truth knows."""
        return len(self.pieces) == 1 and not self.joined_with


@dataclass(frozen=True)
class ClusterScores:
    """All clusters.

    Args:
        n_true: true clusters that hold a part.
        n_predicted: predicted clusters that hold a part of a true one.
        n_exact: true clusters of which one predicted cluster holds exactly the parts.
        n_split: true clusters that lie in several predicted ones.
        n_merged: predicted clusters that hold parts of several true ones.
        adjusted_rand: agreement of both divisions of the parts, 1 for the same, about 0 by chance; None below two
            parts.
        clusters: what became of each.
    """

    n_true: int
    n_predicted: int
    n_exact: int
    n_split: int
    n_merged: int
    adjusted_rand: float | None
    clusters: tuple[ClusterVerdict, ...]


@dataclass(frozen=True)
class ContactVerdict:
    """One pair of parts, of the truth, of the graph or of both.

    Args:
        meshes: the largest listed mesh of each part, ascending.
        in_truth: meshes of theirs touch.
        in_graph: they are adjacent.
        distance: predicted [m], or None.
        structures: the true clusters that they are in.
    """

    meshes: tuple[str, str]
    in_truth: bool
    in_graph: bool
    distance: float | None
    structures: tuple[str, ...]


@dataclass(frozen=True)
class ContactScores:
    """All contacts.

    Args:
        pairs: pairs of parts of which meshes touch against pairs that are adjacent. The graph also calls parts
            adjacent that are near without touching (``cluster.eps``), so precision below 1 need not be an error.
        n_extra_apart: extra pairs with a distance above 0.
        missing: pairs that only the truth has.
    """

    pairs: Score
    n_extra_apart: int
    missing: tuple[tuple[str, str], ...]


def adjusted_rand_index(true: Sequence[str], predicted: Sequence[str]) -> float | None:
    """How well two divisions of the same things agree (Hubert and Arabie, Comparing partitions, 1985).

    Args:
        true: ``(n,)`` the class of each in one division.
        predicted: ``(n,)`` likewise in the other.

    Returns:
        1 for equal divisions, 0 on average for random ones, at least -0.5; None below two things.
    """
    n = len(true)
    if n < 2:
        return None
    together = _pairs(Counter(zip(true, predicted, strict=True)).values())
    rows, columns = _pairs(Counter(true).values()), _pairs(Counter(predicted).values())
    expected = rows * columns / _pairs([n])
    greatest = (rows + columns) / 2
    # Both divisions are one whole, or both are all single: they are equal, and chance could do no other.
    return 1.0 if greatest == expected else (together - expected) / (greatest - expected)


def compare_clusters(pairing: Pairing) -> tuple[tuple[str, str], ...]:
    """The true and the predicted cluster of each part that is in a true one."""
    pairs = []
    for part in pairing.parts:
        true = pairing.structure_of_part(part.id)
        if true is not None:
            found = pairing.graph.cluster_of(part)
            pairs.append((true, found.id if found is not None else part.id))
    return tuple(pairs)


def score_clusters(pairs: Sequence[tuple[str, str]], only: str | None = None) -> ClusterScores:
    """Scores the division into clusters.

    Args:
        pairs: the true and the predicted cluster of each part.
        only: count just this true cluster, and the predicted ones that it lies in.
    """
    true_in: dict[str, dict[str, None]] = {}
    pieces_of: dict[str, dict[str, None]] = {}
    for true, predicted in pairs:
        true_in.setdefault(predicted, {})[true] = None
        pieces_of.setdefault(true, {})[predicted] = None
    sizes = Counter(true for true, _ in pairs)
    verdicts = tuple(
        ClusterVerdict(
            id=true,
            n_parts=sizes[true],
            pieces=tuple(sorted(pieces)),
            joined_with=tuple(sorted({other for piece in pieces for other in true_in[piece]} - {true})),
        )
        for true, pieces in sorted(pieces_of.items())
        if only in (None, true)
    )
    here = [pair for pair in pairs if only in (None, pair[0])]
    touched = {predicted for _, predicted in here}
    return ClusterScores(
        n_true=len(verdicts),
        n_predicted=len(touched),
        n_exact=sum(verdict.exact for verdict in verdicts),
        n_split=sum(verdict.split for verdict in verdicts),
        n_merged=sum(len(true_in[predicted]) > 1 for predicted in touched),
        # Within one true cluster the index would say 0 for any split: it needs all clusters to mean something.
        adjusted_rand=adjusted_rand_index([a for a, _ in pairs], [b for _, b in pairs]) if only is None else None,
        clusters=verdicts,
    )


def compare_contacts(pairing: Pairing) -> tuple[ContactVerdict, ...]:
    """True contacts of meshes lifted to their parts, laid over the adjacency of the graph."""
    true: set[tuple[str, str]] = set()
    for a, b in pairing.truth.contacts or ():
        one, other = pairing.part_of_mesh.get(a), pairing.part_of_mesh.get(b)
        if one is not None and other is not None and one != other:
            true.add((min(one, other), max(one, other)))
    found = {
        (min(edge.source, edge.target), max(edge.source, edge.target)): edge.distance
        for edge in pairing.graph.of_kind(Adjacent)
        if edge.source in pairing.head and edge.target in pairing.head
    }
    verdicts = []
    for pair in true | set(found):
        first, last = sorted(pairing.head[part] for part in pair)
        structures = {here for part in pair if (here := pairing.structure_of_part(part)) is not None}
        verdicts.append(
            ContactVerdict((first, last), pair in true, pair in found, found.get(pair), tuple(sorted(structures)))
        )
    return tuple(sorted(verdicts, key=lambda verdict: verdict.meshes))


def score_contacts(verdicts: Sequence[ContactVerdict]) -> ContactScores:
    """Counts contacts."""
    return ContactScores(
        Score(
            sum(v.in_truth for v in verdicts),
            sum(v.in_graph for v in verdicts),
            sum(v.in_truth and v.in_graph for v in verdicts),
        ),
        sum(not v.in_truth and v.distance is not None and v.distance > 0 for v in verdicts),
        tuple(v.meshes for v in verdicts if not v.in_graph),
    )


def _pairs(counts: Iterable[int]) -> int:
    return sum(n * (n - 1) // 2 for n in counts)
