"""A user's corrections laid over the labels, and what they say about other parts.

A correction spreads in three steps: to the exact repeats of the part, to parts of its shape with other triangles, other
size or mirrored, and to its kin: parts that lie close to it in the space in which the network sees shapes, even if the
network has no name for them. The farther a part is, and the surer somebody was about it, the less a correction reaches.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.labelers.catalog import find_matches
from cadgraph.model.anchors import anchored_parts
from cadgraph.model.catalog import Catalog, Entry
from cadgraph.model.derived import store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.edits import LOST, Correction, tell_lost
from cadgraph.model.labels import CorrectedEvidence, FormerLabel, Label
from cadgraph.model.parts import Bools, Contacts, Parts
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["apply_corrections"]

# How far a correction reaches among kin, as distance of unit vectors (0 the same, 1.41 nothing in common), and how many
# times as far that may be as the nearest part with another label: for a part that nobody was sure about; one with the
# label that the corrected parts had, too; any other. Ours, measured on kinds of parts that a network had not learnt, in
# generated plants; see docs/catalog.md.
CONFUSED, SURE = (0.5, 0.9), (0.3, 0.7)
_OPEN_SHARE = 1.2
# Parts that nobody was sure about are reached as far as corrected parts of one label lie apart, times this, within
# these bounds; a single correction reaches as far as the last number says.
_SPREAD, _LEAST_OPEN, _MOST_OPEN, _ALONE = 1.5, 0.5, 0.85, 0.6
_SETTLED = frozenset({"author", "human", "catalog"})
_KIN_CONFIDENCE = 0.9  # of the closest kin


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
        entries = [Entry("", s.group, s.name) for s in self._sources]
        catalog = Catalog.of(self._parts.scene.select([s.part for s in self._sources]), entries)
        shape = self._parts.shape
        heads: dict[int, int] = {}
        for part in open_parts:
            heads.setdefault(int(shape[part]), part)
        matches, _ = find_matches(catalog, self._parts.scene.select(list(heads.values())))
        of_shape = dict(zip(heads, matches, strict=True))
        for part in open_parts:
            match = of_shape[int(shape[part])]
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
        confused = {
            (s.group, s.name): {
                (old.group, old.name)
                for other in self._sources
                if (other.group, other.name) == (s.group, s.name) and (old := self.before[other.part]) is not None
            }
            for s in self._sources
        }
        reaches = {label: self._reach(space, label) for label in confused}
        rivals = self._rivals()
        chosen = []
        for part in open_parts:
            far = np.linalg.norm(space[[s.part for s in self._sources]] - space[part], axis=1)
            source, near = self._sources[int(far.argmin())], float(far.min())
            wrong = confused[source.group, source.name]
            old = self.before[part]
            # What is only likely is as open to a correction as what has no label.
            label = (old.group, old.name) if old is not None and not old.likely else None
            if label == (source.group, source.name):
                continue
            widest = reaches[source.group, source.name]
            reach, share = (widest, _OPEN_SHARE) if label is None else CONFUSED if label in wrong else SURE
            if near <= min(reach, widest) and near <= share * self._nearest_other(space, part, source, wrong, rivals):
                chosen.append((part, source, near))
        for part, source, near in chosen:
            alike = 1.0 - near**2 / 2  # the cosine
            confidence = _KIN_CONFIDENCE * alike
            self._take(part, source, confidence, f"much like it ({alike:.0%})", "kin", {"similarity": round(alike, 4)})

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

    def _nearest_other(
        self, space: Floats, part: int, source: _Source, wrong: Collection[tuple[str, str | None]], rivals: _Rivals
    ) -> float:
        """How far the nearest part is whose label, another one, nothing speaks against."""
        mine = rivals.number.get((source.group, source.name), -1)
        doubted = [rivals.number[label] for label in wrong if label in rivals.number]
        others = rivals.labelled & (rivals.label != mine) & (self._parts.shape != self._parts.shape[part])
        others &= rivals.settled | ~np.isin(rivals.label, doubted)
        others[part] = False
        return float(np.linalg.norm(space[others] - space[part], axis=1).min()) if others.any() else np.inf

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
        kept = store_of(contacts, "kinship")
        if self._parts not in kept:
            from cadgraph.labelers.embedded.features import observe
            from cadgraph.labelers.embedded.model import default_model

            kept[self._parts] = default_model().kinship(observe(self._parts, contacts))
        space: Floats = kept[self._parts]
        return space
