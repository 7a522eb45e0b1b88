"""The whole course: build the plants, try held-out families, train, calibrate, and write the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.environment.assortment import FAMILIES
from cadgraph.environment.preset import make
from cadgraph.stages.label.embedded import EmbeddedLabeler
from cadgraph.stages.label.model import STRANGE, Model
from cadgraph.training.example import Example, Texts, make_parts_from
from cadgraph.training.figure import Answers, Scores, answer, least_confidence, score, temperature
from cadgraph.training.fit import Recipe, fit
from cadgraph.training.lesson import TRIED_FROM, build_lessons, held_out_lessons, training_lessons
from cadgraph.vocabulary import default_vocabulary

__all__ = ["Course", "Trials", "run_course"]

FIXED = (("riser", 3, "vendor"), ("tank", 2, "bim"))
"""Small plants by which the model in the package is known again: preset, seed, hand."""

PRECISION = 0.95
"""Of the names above a threshold, on plants of which some families were held out, and on these families alone."""


@dataclass(frozen=True)
class Course:
    """The settings of a training run; they are written into the model.

    Args:
        plants: how many are learnt from.
        strangers: scenes of shapes that belong to no plant, and as many of loose fasteners and of rare things.
        members: networks whose answers are averaged.
        folds: parts that the families are dealt into; each is held out once.
        kind_folds: likewise for whole kinds of families.
        seeds: plants of each kind that the network is tried on.
        recipe: of each network.
    """

    plants: int = 320
    strangers: int = 50
    members: int = 2
    folds: int = 3
    kind_folds: int = 2
    seeds: int = 1
    recipe: Recipe = field(default_factory=Recipe)


@dataclass(frozen=True)
class Trials:
    """What a run leaves.

    Args:
        model: that was trained.
        mixed: answers about all parts of plants, by networks that never saw some of the families in them.
        families: those about parts of families that were held out.
        kinds: likewise where all families of a kind were held out.
        unlearnable: likewise about those whose name nothing else has: no answer can be right.
        plants: what the model is tried on, by the name of the trial.
    """

    model: Model
    mixed: Answers
    families: Answers
    kinds: Answers
    unlearnable: Answers
    plants: dict[str, list[Example]]


def run_course(course: Course, folder: Path, workers: int = 2, told: Callable[[str], None] = lambda _: None) -> Trials:
    """Trains the model.

    Args:
        course: the settings.
        folder: keeps the plants.
        workers: processes that build plants.
        told: how far it is.
    """
    lessons = training_lessons(course.plants, course.strangers)
    examples = build_lessons(lessons, folder, workers, told)
    plants = {
        name: build_lessons(some, folder, workers, lambda text, name=name: told(f"{name}: {text}"))  # type: ignore[misc]
        for name, some in held_out_lessons(course.seeds).items()
    }
    classes = known_classes()
    builds = _try_families(course, examples, plants["new seeds"], classes, deal_families(examples, course.folds), told)
    kinds = _try_families(
        course, examples, plants["new seeds"], classes, deal_families(examples, course.kind_folds, whole=True), told
    )
    # Calibrated on whole plants of which a third of the families is new: known things and unknown ones, as in life.
    best = temperature(lambda value: _asked(builds, value, None))
    mixed, families, unlearnable = (_asked(builds, best, learnable) for learnable in (None, True, False))
    # Midway: on such plants as a whole hardly anything need be left open, of the new families alone nearly everything.
    threshold = (least_confidence(mixed, PRECISION) + least_confidence(families, PRECISION)) / 2
    members = []
    for k in range(course.members):
        members.append(fit(examples, classes, course.recipe, k, lambda text, k=k: told(f"network {k}: {text}")))  # type: ignore[misc]
    card = {
        "plants": course.plants, "strangers": course.strangers, "seeds": [0, course.plants - 1],
        "tried from": TRIED_FROM,
        "parts": int(sum(len(e.label) for e in examples)), "recipe": asdict(course.recipe), "folds": course.folds,
        "a third of the families new": _card(score(mixed, threshold)),
        "held-out families": _card(score(families, threshold)),
        "held-out kinds": _card(score(_asked(kinds, best), threshold)),
        "held-out families, unlearnable": {
            "parts": len(unlearnable.truth), "left open": float((unlearnable.confidence < threshold).mean()),
        },
    }  # fmt: skip
    model = Model(tuple(members), tuple(classes), best, threshold, card)
    model = replace(model, card=card | {"fixed trial": [_fixed_trial(model, *trial) for trial in FIXED]})
    return Trials(model, mixed, families, _asked(kinds, best), _both(unlearnable, _asked(kinds, best, False)), plants)


def _fixed_trial(model: Model, preset: str, seed: int, hand: str) -> dict[str, Any]:
    """What the labeler gets right of one small plant; a test repeats it with the model in the package."""
    plant = make(preset, seed, hand)
    parts, contacts = make_parts_from(plant.scene())
    rank = {path: i for i, path in enumerate(plant.paths())}
    heads = [plant.components[rank[path]] for path in parts.scene.paths]
    said = EmbeddedLabeler(model).label(parts, contacts, default_vocabulary())
    pairs = [(label, head) for label, head in zip(said, heads, strict=True) if label is not None]
    return {
        "preset": preset, "seed": seed, "hand": hand,
        "name": round(float(np.mean([(a.group, a.name) == (b.group, b.name) for a, b in pairs])), 4),
        "group": round(float(np.mean([a.group == b.group for a, b in pairs])), 4),
    }  # fmt: skip


def known_classes() -> list[str]:
    """All names of the built-in vocabulary, and what is strange."""
    tree = default_vocabulary().to_json()
    return [f"{group}/{name}" for group, content in tree.items() for name in content["names"]] + [STRANGE]


def deal_families(examples: Sequence[Example], folds: int, whole: bool = False) -> list[frozenset[str]]:
    """Families of devices dealt into folds of about as many each.

    Args:
        examples: that hold them.
        folds: how many.
        whole: whether all families of a kind (``ball valve/...``) go together.
    """
    # Pipe, elbows and plain flanges are in every plant and of no family of devices.
    names = {str(name) for e in examples for name in np.unique(e.family)} & set(FAMILIES)
    kinds = sorted({name.split("/")[0] for name in names} if whole else names)
    order = np.random.default_rng(43).permutation(len(kinds))
    dealt = [{kinds[i] for i in order[k::folds]} for k in range(folds)]
    return [frozenset(name for name in names if name in out or name.split("/")[0] in out) for out in dealt]


_Raw = list[tuple[Model, list[Example], frozenset[str], frozenset[str]]]


def _try_families(
    course: Course,
    examples: Sequence[Example],
    tried: Sequence[Example],
    classes: Sequence[str],
    folds: Sequence[frozenset[str]],
    told: Callable[[str], None],
) -> _Raw:
    """A network for each fold of families, which learns from the others only."""
    raw: _Raw = []
    for k, out in enumerate(folds):
        rest = [replace(e, label=np.where(_within(e.family, out), "", e.label)) for e in examples]
        network = fit(rest, classes, course.recipe, 100 + k, lambda text, k=k: told(f"fold {k}: {text}"))  # type: ignore[misc]
        left = frozenset(str(name) for e in rest for name in np.unique(e.label))
        raw.append((Model((network,), tuple(classes), 1.0, 0.5), list(tried), out, left))
    return raw


def _within(family: Texts, out: frozenset[str]) -> npt.NDArray[np.bool_]:
    """Whether each family is one of those."""
    return np.array([str(name) in out for name in family], np.bool_)


def _asked(raw: _Raw, value: float, learnable: bool | None = True) -> Answers:
    """What the networks of all folds say of the families that each never saw; of all parts if ``learnable`` is None."""
    found = []
    for model, tried, out, left in raw:
        told = answer(replace(model, temperature=value), tried)
        mine = _within(told.family, out)
        can = np.array([str(name) in left for name in told.truth], np.bool_)
        found.append(told if learnable is None else told.where(mine & (can == learnable)))
    return _both(*found)


def _both(*answers: Answers) -> Answers:
    return Answers(**{key: np.concatenate([getattr(a, key) for a in answers]) for key in Answers.__annotations__})


def _card(scores: Scores) -> dict[str, float]:
    return {key: round(value, 4) for key, value in asdict(scores).items()}
