"""A user's corrections laid over the labels, and what they say about other parts.

A correction spreads in three steps: to the exact repeats of the part, to parts of its shape with other triangles, other
size or mirrored, and to its kin: parts that lie close to it in the space in which the network sees shapes, even if the
network has no name for them. The farther a part is, and the surer somebody was about it, the less a correction reaches.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.distance import cdist

from cadgraph.labelers.catalog import Match, decide_matches, matches_of_shape
from cadgraph.model.anchors import anchored_parts
from cadgraph.model.derived import kept_with, store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.edits import LOST, Correction, tell_lost
from cadgraph.model.labels import CorrectedEvidence, FormerLabel, Label
from cadgraph.model.parts import Bools, Contacts, Parts
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["apply_corrections", "prepare_corrections"]

# How far a correction reaches among kin, as distance of unit vectors (0 the same, 1.41 nothing in common), and how many
# times as far that may be as the nearest part with another label: for a part whose label is only likely; one with the
# label that the corrected parts had, too; any other. Ours, measured by correcting what the network has wrong in plants
# of all kinds of devices and in real ones: beyond this more is spoilt than mended; see docs/catalog.md.
LIKELY, CONFUSED, SURE = (0.2, 1.2), (0.3, 0.9), (0.2, 0.7)
_KNOWN = 0.95  # confidence from which on a part with the label that the corrected parts had counts as any other
# Parts without a label are reached as far as corrected parts of one label lie apart, times this, within these bounds; a
# single correction reaches as far as the last number says.
_OPEN_SHARE = 1.2
_SPREAD, _LEAST_OPEN, _MOST_OPEN, _ALONE = 1.5, 0.5, 0.85, 0.6
_SETTLED = frozenset({"author", "human", "catalog"})
_KIN_CONFIDENCE = 0.9  # of the closest kin
_MOST_NEAR = 64  # nearest parts of other shapes that are kept of a part


def apply_corrections(
    labels: Sequence[Label | None],
    corrections: Sequence[Correction],
    scene: Scene,
    parts: Parts,
    contacts: Contacts,
) -> tuple[tuple[Label | None, ...], tuple[Diagnostic, ...]]:
    """Lays corrections over the labels so far.

    Args:
        labels: of each part.
        corrections: the latest last.
        scene: the source meshes.
        parts: made from them.
        contacts: pairs of parts that are adjacent.

    Returns:
        The labels of each part, and what is to be reported.
    """
    if not corrections:
        return tuple(labels), ()
    anchored = anchored_parts(scene, parts)
    found = [anchored.find(correction.anchor) for correction in corrections]
    corrected = {part: c for part, c in zip(found, corrections, strict=True) if part is not None}
    work = _Spread(labels, corrected, parts)
    work.correct()
    work.to_repeats(contacts)
    work.to_near_shapes()
    work.to_kin(contacts)
    lost = [c for part, c in zip(found, corrections, strict=True) if part is None]
    return tuple(work.labels), tuple(
        Diagnostic(LOST, tell_lost(c, "no part of that path and shape, and none of that shape in its place"), (c.mesh,))
        for c in lost
    )


@dataclass(frozen=True)
class _Source:
    """A corrected part that speaks for others."""

    part: int
    group: str
    name: str | None


@dataclass(frozen=True, eq=False)
class _Rivals:
    """The labels of all parts as numbers.

    Args:
        number: of each label.
        label: ``(n_parts,)`` its number, -1 where there is none.
        labelled: ``(n_parts,)`` whether there is one.
        settled: ``(n_parts,)`` whether somebody has settled it.
    """

    number: Mapping[tuple[str, str | None], int]
    label: Ints
    labelled: Bools
    settled: Bools


class _Spread:
    """Labels while corrections spread; ``labels`` is what comes out."""

    def __init__(self, labels: Sequence[Label | None], corrected: Mapping[int, Correction], parts: Parts) -> None:
        self.before = tuple(labels)
        self.labels = list(labels)
        self._corrected = corrected
        self._parts = parts
        self._sources = [_Source(p, c.group, c.name) for p, c in corrected.items() if not c.this_only]

    def correct(self) -> None:
        """The corrected parts themselves."""
        for part, correction in self._corrected.items():
            evidence = CorrectedEvidence(
                why="corrected by a user", mesh=correction.mesh, before=FormerLabel.of(self.before[part])
            )
            self.labels[part] = Label(correction.group, correction.name, 1.0, "human", evidence)

    def to_repeats(self, contacts: Contacts) -> None:
        """Parts of exactly the same shape; of several corrections of it the part most alike in its place counts."""
        shape = self._parts.shape
        by_shape: dict[int, list[_Source]] = {}
        for source in self._sources:
            by_shape.setdefault(int(shape[source.part]), []).append(source)
        for part in range(self._parts.n_parts):
            sources = by_shape.get(int(shape[part]), [])
            if not sources or not self._may_change(part, {"author", "human"}):
                continue
            source = sources[-1]
            if len({(s.group, s.name) for s in sources}) > 1:
                space = self._kinship(contacts)
                source = min(reversed(sources), key=lambda s: float(np.linalg.norm(space[s.part] - space[part])))
            self._take(part, source, 1.0, "same shape", "exact", {})

    def to_near_shapes(self) -> None:
        """Parts of the same shape with other triangles, of other size, or mirrored."""
        open_parts = [part for part in range(self._parts.n_parts) if self._is_open(part)]
        if not self._sources or not open_parts:
            return
        shape = self._parts.shape
        first: dict[int, int] = {}
        for number, source in enumerate(self._sources):
            first.setdefault(int(shape[source.part]), number)
        found: dict[int, list[Match]] = {}
        for own, number in first.items():
            for other, alike in matches_of_shape(self._parts, own).items():
                found.setdefault(other, []).append(replace(alike, entry=number))
        matches, _ = decide_matches([(s.group, s.name) for s in self._sources], list(found.values()))
        of_shape = dict(zip(found, matches, strict=True))
        for part in open_parts:
            match = of_shape.get(int(shape[part]))
            if match is not None:
                words = f"{match.kind} shape" if match.kind == "mirrored" else f"{match.similarity:.0%} the same shape"
                words += f" at {match.scale:.3g} times the size" if match.kind == "scaled" else ""
                more = {"similarity": round(match.similarity, 4), "scale": round(match.scale, 4)}
                self._take(part, self._sources[match.entry], match.confidence, words, match.kind, more)

    def to_kin(self, contacts: Contacts) -> None:
        """Parts that the network sees much like corrected ones."""
        open_parts = [part for part in range(self._parts.n_parts) if self._is_open(part)]
        if not self._sources or not open_parts:
            return
        space = self._kinship(contacts)
        confused = self._confused()
        reaches = {label: self._reach(space, label) for label in confused}
        rivals = self._rivals()
        against = {label: self._against(label, wrong, rivals) for label, wrong in confused.items()}
        against_known = {label: self._against(label, (), rivals) for label in confused}
        chosen = []
        far = cdist(space[open_parts], space[[s.part for s in self._sources]])
        for part, number, near in zip(open_parts, far.argmin(axis=1).tolist(), far.min(axis=1).tolist(), strict=True):
            source = self._sources[number]
            wrong = confused[source.group, source.name]
            old = self.before[part]
            if old is not None and not old.likely and old.said == (source.group, source.name):
                continue
            known = old is not None and old.said in wrong and old.confidence >= _KNOWN
            reach, share = self._openness(old, wrong, known, reaches[source.group, source.name])
            rival = (against_known if known else against)[source.group, source.name]
            if near <= reach and not self._is_contested(contacts, part, rival, near / share):
                chosen.append((part, source, near))
        for part, source, near in chosen:
            alike = 1.0 - near**2 / 2  # the cosine
            confidence = _KIN_CONFIDENCE * alike
            self._take(part, source, confidence, f"much like it ({alike:.0%})", "kin", {"similarity": round(alike, 4)})

    def _openness(
        self, old: Label | None, wrong: Collection[tuple[str, str | None]], known: bool, widest: float
    ) -> tuple[float, float]:
        """How far a correction may be from a part to reach it, and how many times as far as another label."""
        if old is None:
            return widest, _OPEN_SHARE
        reach, share = LIKELY if old.likely else CONFUSED if old.said in wrong and not known else SURE
        return min(reach, widest), share

    def _confused(self) -> dict[tuple[str, str | None], set[tuple[str, str | None]]]:
        """By what a user said: what those parts were called before."""
        found: dict[tuple[str, str | None], set[tuple[str, str | None]]] = {}
        for source in self._sources:
            old, wrong = self.before[source.part], found.setdefault((source.group, source.name), set())
            if old is not None:
                wrong.add((old.group, old.name))
        return found

    def _reach(self, space: Floats, label: tuple[str, str | None]) -> float:
        """How far corrections to a label reach among parts that nobody was sure about."""
        shape = self._parts.shape
        members = {int(shape[s.part]): s.part for s in self._sources if (s.group, s.name) == label}
        rows = space[list(members.values())]
        if len(rows) < 2:
            return _ALONE
        apart = np.linalg.norm(rows[:, None] - rows[None], axis=2)
        np.fill_diagonal(apart, np.inf)
        return float(np.clip(_SPREAD * np.median(apart.min(axis=1)), _LEAST_OPEN, _MOST_OPEN))

    def _against(
        self, label: tuple[str, str | None], wrong: Collection[tuple[str, str | None]], rivals: _Rivals
    ) -> Bools:
        """``(n_parts,)`` whether a part has another label, which nothing speaks against."""
        doubted = [rivals.number[one] for one in wrong if one in rivals.number]
        found: Bools = rivals.labelled & (rivals.label != rivals.number.get(label, -1))
        return found & (rivals.settled | ~np.isin(rivals.label, doubted))

    def _is_contested(self, contacts: Contacts, part: int, against: Bools, within: float) -> bool:
        """Whether a part of another shape that speaks against a correction is nearer than it."""
        near, apart = self._nearest(contacts, part)
        if len(near) == _MOST_NEAR and apart[-1] < within:
            near, apart = self._others(contacts, part)
        return bool((apart[against[near]] < within).any())

    def _nearest(self, contacts: Contacts, part: int) -> tuple[Ints, Floats]:
        """The nearest parts of other shapes, the nearest first, and how far they are; kept for the same parts."""
        kept = store_of(contacts, "nearest kin", self._parts)
        if part not in kept:
            others, apart = self._others(contacts, part)
            order = np.argsort(apart, kind="stable")[:_MOST_NEAR]
            kept[part] = others[order], apart[order]
        found: tuple[Ints, Floats] = kept[part]
        return found

    def _others(self, contacts: Contacts, part: int) -> tuple[Ints, Floats]:
        """All parts of other shapes, and how far they are."""
        space, others = self._kinship(contacts), np.flatnonzero(self._parts.shape != self._parts.shape[part])
        return others, cdist(space[[part]], space)[0, others]

    def _rivals(self) -> _Rivals:
        said = [None if label is None or label.likely else label.said for label in self.labels]
        number = {label: k for k, label in enumerate(dict.fromkeys(label for label in said if label is not None))}
        return _Rivals(
            number,
            np.array([-1 if label is None else number[label] for label in said], np.int64),
            np.array([label is not None for label in said], np.bool_),
            np.array([label is not None and label.source in _SETTLED for label in self.labels], np.bool_),
        )

    def _take(
        self, part: int, source: _Source, confidence: float, how: str, match: str, more: Mapping[str, float]
    ) -> None:
        mesh = self._corrected[source.part].mesh
        evidence = CorrectedEvidence(
            why=f"{how} as {mesh}, which a user corrected" if match == "exact" else f"{how}: {mesh} was corrected",
            corrected=mesh,
            match=match,
            similarity=more.get("similarity"),
            scale=more.get("scale"),
            before=FormerLabel.of(self.before[part]),
        )
        self.labels[part] = Label(source.group, source.name, confidence, "repeat", evidence)

    def _may_change(self, part: int, kept: Collection[str]) -> bool:
        label = self.labels[part]
        return (
            part not in self._corrected
            and not self._parts.ground[part]
            and not (label is not None and label.source in kept)
        )

    def _is_open(self, part: int) -> bool:
        """Whether nobody has settled a part, nor a correction reached it."""
        label = self.labels[part]
        reached = label is not None and isinstance(label.evidence, CorrectedEvidence)
        return self._may_change(part, _SETTLED) and not reached

    def _kinship(self, contacts: Contacts) -> Floats:
        return _kinship(contacts, self._parts)


def prepare_corrections(parts: Parts, contacts: Contacts) -> None:
    """Works out how the shapes and the parts of a scene are alike, which else the first correction does.

    Args:
        parts: of the scene.
        contacts: pairs of parts that are adjacent.
    """
    if parts.n_parts:
        _kinship(contacts, parts)
        matches_of_shape(parts, int(parts.shape[0]))


@kept_with
def _kinship(contacts: Contacts, parts: Parts) -> Floats:
    from cadgraph.labelers.embedded.features import observe
    from cadgraph.labelers.embedded.model import default_model

    return default_model().kinship(observe(parts, contacts))
