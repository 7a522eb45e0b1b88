"""The embedded labeler: a trained network over shapes and contacts, offline and without a GPU."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph._io.garbage import collector_paused
from cadgraph.labelers.base import Labeling, Probabilities
from cadgraph.labelers.coverage import find_unlearnt
from cadgraph.labelers.embedded.features import Observation, observe
from cadgraph.labelers.embedded.model import STRANGE, Model, default_model
from cadgraph.labelers.embedded.wording import describe_company, describe_form
from cadgraph.labelers.likeliest import likeliest_of_all
from cadgraph.model.derived import forget
from cadgraph.model.labels import GeometryEvidence, Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Floats, Ints, blocks
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["EmbeddedLabeler", "Verdicts", "judge", "spread"]

_SHARED = 0.5  # greatest weight of what all repeats of a shape say together
_ROWS = 4_096  # parts at once: arrays of all would take memory by their number
_MANY = 10_000  # parts from which on what was seen of them is not kept


@dataclass(frozen=True)
class Verdicts:
    """The probabilities of all parts, and what they come to.

    Args:
        classes: ``(group, name)`` of each column.
        names: ``(n_parts, n_classes)`` probabilities of the classes; what is missing to 1 is strange to the model, or
            unknown to the vocabulary.
        groups: ``(n_parts, n_groups)``.
        group_names: of the columns of ``groups``.
    """

    classes: tuple[tuple[str, str], ...]
    names: Floats
    groups: Floats
    group_names: tuple[str, ...]


class EmbeddedLabeler:
    """Names parts by the trained network in the package.

    Args:
        model: another one than that in the package.
    """

    def __init__(self, model: Model | None = None) -> None:
        self._model = model or default_model()

    @property
    def threshold(self) -> float:
        """Least confidence of the label of a part that touches others: set on what was held out of training."""
        return self._model.threshold

    @property
    def sure(self) -> float:
        """Least confidence of a label that is sure: likewise."""
        return self._model.sure

    @property
    def learnt(self) -> frozenset[tuple[str, str]]:
        """Group and name of each label that it knows."""
        pairs = (label.partition("/") for label in self._model.classes if label != STRANGE)
        return frozenset((group, name) for group, _, name in pairs)

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts; see ``Labeler``. Names that the vocabulary lacks are never given."""
        seen = observe(parts, contacts)
        verdicts = judge(self._model, seen, vocabulary)
        probabilities = Probabilities(verdicts.classes, verdicts.names)
        unlearnt = find_unlearnt(self.learnt, vocabulary)
        least = self._least(parts.n_parts, seen)
        with collector_paused():
            answers = self._answers(parts, seen, verdicts, least)
            if parts.n_parts > _MANY:
                # Only who corrects labels by hand looks at them again.
                forget(parts, observe)
            return Labeling.judge(answers, least.tolist(), probabilities, unlearnt, self.sure)

    def _least(self, n_parts: int, seen: Observation) -> Floats:
        """The least confidence of each part's label: a higher one where it touches nothing."""
        touches = np.bincount(seen.surroundings.here, minlength=n_parts) > 0
        return np.where(touches, self._model.threshold, self._model.alone)

    def _answers(self, parts: Parts, seen: Observation, verdicts: Verdicts, least: Floats) -> list[Label | None]:
        """The likeliest label of each part, and why."""
        if not len(verdicts.classes):
            return [None] * parts.n_parts
        around = seen.surroundings
        starts = np.searchsorted(around.here, np.arange(parts.n_parts + 1))
        best = verdicts.names.argmax(axis=1)
        said: list[str | None] = [None] * parts.n_parts
        for part in np.flatnonzero(verdicts.names[np.arange(parts.n_parts), best] >= least).tolist():
            said[part] = verdicts.classes[best[part]][1]
        alike = np.expm1(around.places[:, 1]).round().astype(np.int64).tolist()
        forms = [describe_form(facts) for facts in seen.facts]
        # Many parts are alike: one object stands for all that are equal.
        known: dict[str, GeometryEvidence] = {}
        given: dict[tuple[object, ...], Label] = {}
        answers: list[Label | None] = []
        all_found = likeliest_of_all(
            verdicts.classes, verdicts.names, verdicts.group_names, verdicts.groups, least.tolist()
        )
        for part, (found, shape) in enumerate(zip(all_found, seen.shape_of_part.tolist(), strict=True)):
            if parts.ground[part]:
                answers.append(None)
                continue
            near = [said[j] for j in around.there[starts[part] : starts[part + 1]].tolist()]
            why = f"{forms[shape]}; {describe_company(near, alike[part])}"
            # Equal guesses are one object, which is sooner told than that their values are equal.
            key = *found[:-1], why, *map(id, found.guesses)
            if key not in given:
                evidence = known.get(why) or known.setdefault(why, GeometryEvidence(why=why))
                given[key] = Label(found.group, found.name, found.confidence, "geometry", evidence, found.guesses)
            answers.append(given[key])
        return answers


def judge(model: Model, seen: Observation, vocabulary: Vocabulary) -> Verdicts:
    """The probabilities of all names and groups that model and vocabulary share."""
    raw = spread(model.probabilities(seen), seen.shape_of_part)
    known = [
        (k, (group, name))
        for k, label in enumerate(model.classes)
        if label != STRANGE
        for group, _, name in [label.partition("/")]
        if vocabulary.holds(group, name)
    ]
    names = raw[:, [k for k, _ in known]]
    classes = tuple(pair for _, pair in known)
    group_names = tuple(dict.fromkeys(group for group, _ in classes))
    groups = np.stack(
        [names[:, [k for k, (g, _) in enumerate(classes) if g == group]].sum(axis=1) for group in group_names], axis=1
    ) if group_names else np.zeros((len(names), 0))  # fmt: skip
    return Verdicts(classes, names, groups, group_names)


def spread(probabilities: Floats, shape: Ints) -> Floats:
    """Lets the repeats of each shape agree, as far as they look alike to begin with.

    A bolt that the network is unsure about follows the other bolts; a plain disc that is a blind flange here keeps its
    name although it is a base plate there.

    Args:
        probabilities: ``(n_parts, n_classes)``.
        shape: ``(n_parts,)`` the same for repeats.

    Returns:
        Of the same shape as ``probabilities``.
    """
    n_shapes = int(shape.max(initial=-1)) + 1
    count = np.maximum(np.bincount(shape, minlength=n_shapes), 1)
    mean = np.zeros((n_shapes, probabilities.shape[1]))
    np.add.at(mean, shape, probabilities)
    mean /= count[:, None]
    mixed = np.empty_like(probabilities)
    for some in blocks(len(shape), _ROWS):
        own, of_shape = probabilities[some], shape[some]
        common = mean[of_shape]
        agreement = np.sqrt(own * common).sum(axis=1) ** 2
        weight = (_SHARED * agreement * (count[of_shape] > 1))[:, None]
        mixed[some] = (1 - weight) * own + weight * common
    return mixed
