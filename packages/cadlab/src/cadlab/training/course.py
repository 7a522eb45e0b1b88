"""The whole course: build the plants, try held-out families, train, calibrate, and write the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from hashlib import sha256
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch

import cadgraph
import cadlab
import cadplants
from cadgraph.labelers.embedded.classifier import Classifier
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.embedded.model import STRANGE, Model
from cadgraph.model.vocabulary import default_vocabulary
from cadlab.training.example import Example, Texts, make_parts_from
from cadlab.training.figure import Answers, Scores, answer, least_confidence, score, temperature
from cadlab.training.fit import Recipe, fit
from cadlab.training.fit import __file__ as fit_file
from cadlab.training.samples import (
    TRIED_FROM,
    Sample,
    bolted_lessons,
    build_samples,
    held_out_lessons,
    training_samples,
)
from cadplants.assortment import FAMILIES
from cadplants.preset import make

__all__ = ["Course", "Trials", "run_course"]

FIXED = (("riser", 3, "vendor"), ("tank", 2, "bim"))
"""Small plants by which the model in the package is known again: preset, seed, style."""

PRECISION = 0.95
"""Of the names above the threshold, on plants of which some families were held out."""
NEW_PRECISION = 0.85
"""Of the names above the threshold, on the parts of held-out families alone."""

_MAKERS = (
    (cadplants, "**/*.py"),
    (cadgraph, "geometry/**/*.py"), (cadgraph, "model/scene.py"), (cadgraph, "model/parts.py"),
    (cadgraph, "model/shapes.py"),
    *((cadgraph, f"stages/{name}.py") for name in ("adjacency", "ground", "group", "parts", "preprocess")),
    *((cadgraph, f"labelers/embedded/{name}.py") for name in (
        "descriptor", "edges", "features", "sample", "surroundings")),
    *((cadlab, f"training/{name}.py") for name in ("distractors", "example", "fastener", "oddities", "samples")),
)  # fmt: skip
"""What makes plants, and what the labeler sees of them."""


@dataclass(frozen=True)
class Course:
    """The settings of a training run; they are written into the model.

    Args:
        plants: how many are learnt from.
        distractors: scenes of shapes that belong to no plant, and as many of loose fasteners and of rare things.
        bolted: plants whose flanges hold their bolts in one mesh: half of the networks that are kept learn from these
            as well, those of the trials do not.
        members: pairs of networks whose answers are averaged.
        folds: parts that the families are dealt into; each is held out once.
        kind_folds: likewise for whole kinds of families.
        seeds: plants of each kind that the networks are tried on.
        recipe: of each network.
    """

    plants: int = 800
    distractors: int = 60
    bolted: int = 80
    members: int = 2
    folds: int = 6
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
        folder: keeps plants and networks: a run that was broken off goes on where it stopped.
        workers: processes that build and train.
        told: how far it is.
    """
    folder = folder / source_digest()
    samples = training_samples(course.plants, course.distractors)
    examples = build_samples(samples, folder, workers, told)
    plants = {
        name: build_samples(some, folder, workers, lambda text, name=name: told(f"{name}: {text}"))  # type: ignore[misc]
        for name, some in held_out_lessons(course.seeds).items()
    }
    classes = known_classes()
    build_folds = deal_families(examples, course.folds)
    kind_folds = deal_families(examples, course.kind_folds, whole=True)
    outs = [*build_folds, *kind_folds]
    bolted = tuple(bolted_lessons(course.bolted))
    examples += build_samples(bolted, folder, workers, told)
    job = _Job(tuple(samples), (), folder, tuple(classes), course.recipe, 0, frozenset())
    jobs = [replace(job, seed=seed, out=out) for seed, out in enumerate(outs)]
    for seed in range(len(outs), len(outs) + course.members):
        jobs += [replace(job, seed=seed), replace(job, seed=seed, more=bolted)]
    networks = _train(jobs, workers, told)
    trials = [
        _Trial(Model((network,), tuple(classes), 1.0, 0.5), plants["new seeds"], out, _left(examples, out))
        for network, out in zip(networks, outs, strict=False)
    ]
    builds, kinds = trials[: course.folds], trials[course.folds : course.folds + course.kind_folds]
    members = networks[len(outs) :]
    # Calibrated on whole plants of which some families are new: known things and unknown ones, as in life.
    best = temperature(lambda value: _asked(builds, value, None))
    mixed, families, unlearnable = (_asked(builds, best, learnable) for learnable in (None, True, False))
    threshold = max(least_confidence(mixed, PRECISION), least_confidence(families, NEW_PRECISION))
    card = {
        "plants": course.plants, "strangers": course.distractors, "bolted": course.bolted,
        "seeds": [0, course.plants - 1],
        "tried from": TRIED_FROM,
        "parts": int(sum(len(e.label) for e in examples)), "recipe": asdict(course.recipe), "folds": course.folds,
        "generator": folder.name,
        "some of the families new": _card(score(mixed, threshold)),
        "held-out families": _card(score(families, threshold)),
        "held-out kinds": _card(score(_asked(kinds, best), threshold)),
        "held-out families, unlearnable": {"parts": len(unlearnable.truth)},
    }  # fmt: skip
    model = Model(tuple(members), tuple(classes), best, threshold, card)
    model = replace(model, card=card | {"fixed trial": [_fixed_trial(model, *trial) for trial in FIXED]})
    return Trials(model, mixed, families, _asked(kinds, best), _both(unlearnable, _asked(kinds, best, False)), plants)


def _fixed_trial(model: Model, preset: str, seed: int, style: str) -> dict[str, Any]:
    """What the labeler gets right of one small plant; a test repeats it with the model in the package."""
    plant = make(preset, seed, style)
    parts, contacts = make_parts_from(plant.scene())
    rank = {path: i for i, path in enumerate(plant.paths())}
    heads = [plant.components[rank[path]] for path in parts.scene.paths]
    said = EmbeddedLabeler(model).label(parts, contacts, default_vocabulary())
    pairs = [(label, head) for label, head in zip(said.answers, heads, strict=True) if label is not None]
    return {
        "preset": preset, "seed": seed, "hand": style,
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


def source_digest() -> str:
    """Eight digits that change with the code that makes plants or looks at them: plants kept under others are stale."""
    digest = sha256()
    for package, pattern in _MAKERS:
        for path in sorted(Path(package.__file__ or "").parent.glob(pattern)):
            digest.update(path.read_text(encoding="utf-8").encode())
    return digest.hexdigest()[:8]


@dataclass(frozen=True)
class _Job:
    """One network to train, in a process of its own: it reads the plants itself."""

    samples: tuple[Sample, ...]
    more: tuple[Sample, ...]
    folder: Path
    classes: tuple[str, ...]
    recipe: Recipe
    seed: int
    out: frozenset[str]


@dataclass(frozen=True)
class _Trial:
    """A network that never saw some families, what it is tried on, and the names that it could learn."""

    model: Model
    tried: Sequence[Example]
    out: frozenset[str]
    left: frozenset[str]


def _train(jobs: Sequence[_Job], workers: int, told: Callable[[str], None]) -> list[Classifier]:
    networks = []
    # Spawned, not forked: torch's threads don't survive a fork.
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        for k, network in enumerate(pool.map(_trained, jobs)):
            networks.append(network)
            told(f"networks: {k + 1} of {len(jobs)}")
    return networks


def _trained(job: _Job) -> Classifier:
    """Trains one network, or reads it where it was trained before."""
    text = repr((job.samples, job.classes, job.recipe, job.seed, sorted(job.out))) + Path(fit_file).read_text("utf-8")
    text += repr(job.more) if job.more else ""
    path = job.folder / f"network-{sha256(text.encode()).hexdigest()[:12]}.npz"
    if not path.is_file():
        # One thread each: the same sums in the same order on every machine, and no waiting for each other.
        torch.set_num_threads(1)
        examples = [*build_samples(job.samples, job.folder), *build_samples(job.more, job.folder)]
        rest = [replace(e, label=np.where(_within(e.family, job.out), "", e.label)) for e in examples]
        network = fit(rest, job.classes, job.recipe, job.seed)
        beside = path.with_suffix(".part")
        with beside.open("wb") as file:
            np.savez(file, allow_pickle=False, **network.weights)
        beside.replace(path)
    with np.load(path, allow_pickle=False) as file:
        return Classifier({name: file[name] for name in file.files}, job.recipe.rounds)


def _left(examples: Sequence[Example], out: frozenset[str]) -> frozenset[str]:
    """The labels that something outside of some families has."""
    return frozenset(str(name) for e in examples for name in np.unique(e.label[~_within(e.family, out)]))


def _within(family: Texts, out: frozenset[str]) -> npt.NDArray[np.bool_]:
    """Whether each family is one of those."""
    return np.array([str(name) in out for name in family], np.bool_)


def _asked(trials: Sequence[_Trial], value: float, learnable: bool | None = True) -> Answers:
    """What the networks of all folds say of the families that each never saw; of all parts if ``learnable`` is None."""
    found = []
    for trial in trials:
        told = answer(replace(trial.model, temperature=value), trial.tried)
        mine = _within(told.family, trial.out)
        can = np.array([str(name) in trial.left for name in told.truth], np.bool_)
        found.append(told if learnable is None else told.where(mine & (can == learnable)))
    return _both(*found)


def _both(*answers: Answers) -> Answers:
    return Answers(**{key: np.concatenate([getattr(a, key) for a in answers]) for key in Answers.__annotations__})


def _card(scores: Scores) -> dict[str, float]:
    return {key: round(value, 4) for key, value in asdict(scores).items()}
