"""What the source file says of parts, joined with what a labeler says: each fact a witness that is right so often."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from cadgraph.config import LabelConfig
from cadgraph.facts.rules import Claim
from cadgraph.facts.statements import Statements, statements_of
from cadgraph.facts.words import read_words
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.beliefs import LabelBeliefs, shared_weight
from cadgraph.labelers.likeliest import Likeliest
from cadgraph.model.analysis import Analysis
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import FileEvidence, FileSupport, FormerLabel, GeometryEvidence, Label
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = ["lay_file"]

_SETTLES = 0.75  # a claim that is trusted so much says the name where geometry sees the same group
_WHOLE = 2 / 3  # share of the parts that a file calls a valve or a pump that are one, and no piece of one (ours)
_MOST_TOLD = 30  # labels that one note names
_LONGEST = 400  # characters of what stands in the file that a label keeps

_T = TypeVar("_T")


def lay_file(labeling: Labeling, analysis: Analysis, vocabulary: Vocabulary, config: LabelConfig) -> Labeling:
    """Joins what a labeler says with what the file says, where that is asked for.

    Each kind of fact is a witness that is right as often as it is trusted, and the labeler's probabilities are what is
    known before. Facts that say the same share most of their mistakes, so each counts for less. The group is the more
    probable one. Within it the file names the part where its claim is trusted by three quarters; but a valve, gauge,
    pump or tank may be drawn in pieces that are all filed as that, so which piece a part is, is left to both.

    Args:
        labeling: of the labeler.
        analysis: of the scene, whose facts count.
        vocabulary: the labels in use.
        config: whether facts count, and which words of the user's.

    Returns:
        The labels of both. Their source is ``file`` where the file gives or changes a label; where it agrees with the
        labeler, that stays its source, and its evidence holds what agrees.

    Raises:
        LabelError: the user's words can't be read.
    """
    if not config.use_metadata:
        return labeling
    statements = statements_of(analysis, read_words(config.words), vocabulary)
    parts, answers = analysis.parts, list(labeling.answers)
    beliefs = LabelBeliefs(vocabulary, labeling, parts.n_parts)
    told: dict[int, Claim] = {}
    often = _Often(statements, len(beliefs.classes))
    for part, claims in enumerate(statements.of_parts):
        before = answers[part]
        # A label that is the file's already comes from a finished graph.
        if not claims or parts.ground[part] or (before is not None and before.source == "file"):
            continue
        _weigh(beliefs, part, claims, vocabulary, often if beliefs.known[part] else None)
        found = beliefs.label_of(part, labeling.thresholds[part])
        answers[part] = _joined(before, found, claims)
        told[part] = next((claim for claim in claims if not claim.is_prior), claims[0])
    if not told:
        return replace(labeling, diagnostics=(*labeling.diagnostics, *_unheld(statements)))
    judged = Labeling.judge(answers, labeling.thresholds, sure=labeling.sure)
    found_out = (*_unheld(statements), *_disagreements(labeling, judged, told, analysis))
    return replace(
        labeling,
        labels=_of(told, judged.labels, labeling.labels),
        guesses=_of(told, judged.guesses, labeling.guesses),
        answers=judged.answers,
        probabilities=_probabilities(labeling, beliefs, sorted(told)),
        diagnostics=(*labeling.diagnostics, *found_out),
    )


def _of(told: Collection[int], joined: Sequence[_T], alone: Sequence[_T]) -> tuple[_T, ...]:
    """What follows from both where the file says something, else what the labeler says."""
    return tuple(joined[part] if part in told else one for part, one in enumerate(alone))


class _Often:
    """How often a file says each label: what it says wrongly is mostly what it says often.

    Args:
        statements: of all parts.
        n_labels: of the vocabulary; each is taken to be said once more than it is.
    """

    def __init__(self, statements: Statements, n_labels: int) -> None:
        self._counts = Counter(claim.said for claims in statements.of_parts for claim in claims)
        self._total = self._counts.total() + n_labels

    def share(self, claim: Claim) -> float:
        """Of all that is said, 0..1."""
        return (self._counts[claim.said] + 1) / self._total


def _weigh(
    beliefs: LabelBeliefs, part: int, claims: Sequence[Claim], vocabulary: Vocabulary, often: _Often | None
) -> None:
    """Takes the claims about a part into account; without ``often`` nothing is known of it but them."""
    logs = np.zeros(len(beliefs.classes))
    for claim in claims:
        alike = sum(claim.group == other.group for other in claims)
        # A wrong name is mostly one of the same group.
        grouped = claim.trust if claim.is_prior else (1 + claim.trust) / 2
        astray = None if often is None else often.share(claim)
        named = claim.trust * (_WHOLE if _is_device(claim, vocabulary) else 1)
        logs += shared_weight(alike) * np.log(beliefs.likelihood(*claim.said, named, grouped, astray, claim.also))
    beliefs.weigh(np.array([part], np.int64), logs)
    group = beliefs.group_of(part)
    for claim in claims:
        if claim.name is not None and claim.trust >= _SETTLES and claim.group == group:
            if not _is_device(claim, vocabulary):
                beliefs.name_within(part, group, (claim.name, *claim.also), claim.trust)
            return


def _is_device(claim: Claim, vocabulary: Vocabulary) -> bool:
    """Whether a claim speaks of a whole device, a valve or a pump, of which the part may be a piece."""
    return claim.name is not None and claim.name == vocabulary.groups[claim.group].unit


def _joined(before: Label | None, found: Likeliest, claims: Sequence[Claim]) -> Label:
    """The label that follows from a labeler's answer and the claims."""
    speaking = [claim for claim in claims if claim.group == found.group]
    claim = next((c for c in speaking if c.name == found.name), speaking[0] if speaking else None)
    if before is not None and (claim is None or before.said == found.said):
        return _kept(before, found, claim)
    claim = claim or claims[0]
    why = f"{claim.key} {claim.value[:80]!r} in the file: {claim.rule}, trusted by {claim.trust:.0%}"
    if before is not None:
        why += f"; the labeler alone says {spell_label(*before.said)} ({before.confidence:.0%})"
    evidence = FileEvidence(
        why=why, key=claim.key, text=claim.value[:_LONGEST], rule=claim.rule, before=FormerLabel.of(before)
    )
    return Label(found.group, found.name, found.confidence, "file", evidence, found.guesses)


def _kept(before: Label, found: Likeliest, claim: Claim | None) -> Label:
    """A labeler's answer, as sure as it is with the file's word."""
    evidence = before.evidence
    if isinstance(evidence, GeometryEvidence) and claim is not None:
        support = FileSupport(
            key=claim.key, text=claim.value[:_LONGEST], rule=claim.rule, without=round(before.confidence, 6)
        )
        evidence = evidence.model_copy(update={"file": support})
    now = {"group": found.group, "name": found.name, "confidence": found.confidence}
    return before.model_copy(update={**now, "evidence": evidence, "guesses": found.guesses})


def _probabilities(labeling: Labeling, beliefs: LabelBeliefs, told: Sequence[int]) -> Probabilities | None:
    """The labeler's probabilities, and where the file says something those of both."""
    if labeling.probabilities is None:
        return None
    column = {said: k for k, said in enumerate(beliefs.classes)}
    values = np.zeros_like(beliefs.values)
    for mine, said in enumerate(labeling.probabilities.classes):
        if said in column:
            values[:, column[said]] = labeling.probabilities.values[:, mine]
    values[told] = beliefs.values[told]
    return Probabilities(beliefs.classes, values)


def _disagreements(
    labeling: Labeling, judged: Labeling, told: Mapping[int, Claim], analysis: Analysis
) -> Iterator[Diagnostic]:
    """Where file and labeler say different groups: a note for each pair of labels."""
    found: dict[tuple[str, str], list[int]] = {}
    for part, claim in told.items():
        alone = labeling.labels[part]
        if alone is not None and not claim.is_prior and alone.group != claim.group:
            found.setdefault((spell_label(*claim.said), spell_label(*alone.said)), []).append(part)
    for (file, alone_said), parts in sorted(found.items(), key=lambda one: (-len(one[1]), one[0])):
        won = sum((label := judged.labels[part]) is not None and label.group == told[part].group for part in parts)
        who = "the file counts" if won == len(parts) else "geometry counts" if not won else f"the file counts for {won}"
        message = (
            f"{len(parts)} part{'s' * (len(parts) != 1)} that the file says to be {file} and the labeler {alone_said}; "
            f"{who}, as the more probable"
        )
        paths = tuple(analysis.scene.paths[analysis.parts.meshes[part][0]] for part in parts)
        yield Diagnostic("file-disagrees", message, paths)


def _unheld(statements: Statements) -> Iterator[Diagnostic]:
    """What the file says in terms that the vocabulary lacks."""
    if not statements.unheld:
        return
    labels = [spell_label(*said) for said in statements.unheld]
    more = f" and {len(labels) - _MOST_TOLD} more" if len(labels) > _MOST_TOLD else ""
    message = (
        f"what the file says by these labels is left out, as the vocabulary lacks them: "
        f"{', '.join(labels[:_MOST_TOLD])}{more}; add them to it (--vocabulary), or other words (label.words)"
    )
    meshes = tuple(dict.fromkeys(mesh for paths in statements.unheld.values() for mesh in paths))
    yield Diagnostic("file-unknown-label", message, meshes)
