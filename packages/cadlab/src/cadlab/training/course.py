"""The whole course: build the plants, try held-out systems, train, calibrate, and write the model."""

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
from cadlab.training.figure import Answers, Scores, answer, joined, least_confidence, score, temperature
from cadlab.training.fit import Recipe, fit
from cadlab.training.fit import __file__ as fit_file
from cadlab.training.real import ModelledPlant, RealPart, RealPlant, side_by_side
from cadlab.training.samples import TRIED_FROM, Sample, build_samples, held_out_lessons, training_samples
from cadplants.presets.authoring_systems import SYSTEMS
from cadplants.presets.preset import make
from cadplants.presets.taste import ALL_FAMILIES

__all__ = ["ALONE", "PRECISION", "SURE", "Course", "Trials", "run_course"]

FIXED = (("riser", 3, "vendor"), ("tank", 2, "bim"))
"""Small plants by which the model in the package is known again: preset, seed, style."""

PRECISION = 0.87
"""Of the groups of parts that get a label at all, in plants of held-out systems, on parts of held-out families."""
ALONE = 0.95
"""Of the groups of single parts that get a label, of held-out makers; and of the strangers among them nine of ten stay
open."""
SURE = 0.95
"""Of the groups of parts that are called sure, of held-out families and makers together."""

_MAKERS = (
    (cadplants, "**/*.py"),
    (cadgraph, "geometry/**/*.py"), (cadgraph, "model/scene.py"), (cadgraph, "model/parts.py"),
    (cadgraph, "model/shapes.py"),
    *((cadgraph, f"stages/{name}.py") for name in ("adjacency", "ground", "group", "parts", "preprocess")),
    *((cadgraph, f"labelers/embedded/{name}.py") for name in (
        "descriptor", "edges", "features", "integrals", "surroundings")),
    *((cadlab, f"training/{name}.py") for name in ("distractors", "example", "fastener", "oddities", "samples")),
)  # fmt: skip
"""What makes plants, and what the labeler sees of them."""

_OPEN = 0.9  # share of the strangers that stay open
_TOGETHER = 24  # single real parts that are shown as one scene
_COPIES = 2  # times that each of these, and each modelled plant, is shown while a plant is shown once


@dataclass(frozen=True)
class Course:
    """The settings of a training run; they are written into the model.

    Args:
        plants: how many are learnt from that are drawn as the authoring systems draw, as many of each.
        drawn: in styles drawn at random.
        others: scenes of shapes that belong to no plant, and as many of rare things; two thirds as many of loose
            fasteners.
        members: networks whose scores are averaged.
        draws: of plants among which the members take turns; the folds learn from the first.
        folds: each holds out some of the authoring systems, of the families of devices, of the makers of real parts and
            of the modellers of plants.
        seeds: plants of each kind that the networks are tried on.
        ablations: whether networks that lack something are trained for comparison.
        recipe: of each network.
    """

    plants: int = 720
    drawn: int = 80
    others: int = 48
    members: int = 8
    draws: int = 2
    folds: int = 4
    seeds: int = 3
    ablations: bool = True
    recipe: Recipe = field(default_factory=Recipe)


@dataclass(frozen=True)
class Trials:
    """What a run leaves.

    Args:
        model: that was trained.
        systems: answers about all parts of plants of systems that were held out.
        families: of these, about parts of families that were held out as well.
        makers: about single real parts whose makers were held out.
        modellers: about modelled plants whose modellers were held out.
        ablations: answers about what the first fold held out (systems, makers, modellers), as it is and without
            something.
        real: of the model in the end about real plants, by their names.
        plants: what the model is tried on, by the name of the trial.
    """

    model: Model
    systems: Answers
    families: Answers
    makers: Answers
    modellers: Answers
    ablations: dict[str, tuple[Answers, Answers, Answers]]
    real: dict[str, Answers]
    plants: dict[str, list[Example]]


@dataclass(frozen=True)
class Fold:
    """What one network never saw.

    Args:
        systems: of authoring.
        families: of devices.
        makers: of single real parts.
        modellers: of plants.
    """

    systems: frozenset[str] = frozenset()
    families: frozenset[str] = frozenset()
    makers: frozenset[str] = frozenset()
    modellers: frozenset[str] = frozenset()


def run_course(
    course: Course,
    folder: Path,
    plants: Sequence[RealPlant] = (),
    parts: Sequence[RealPart] = (),
    modelled: Sequence[ModelledPlant] = (),
    workers: int = 2,
    told: Callable[[str], None] = lambda _: None,
) -> Trials:
    """Trains the model.

    Args:
        course: the settings.
        folder: keeps plants and networks: a run that was broken off goes on where it stopped.
        plants: real ones to report on; nothing is learnt from them.
        parts: single real ones, learnt from where their licences permit.
        modelled: plants of others to learn from.
        workers: processes that build and train.
        told: how far it is.
    """
    folder = folder / source_digest()
    draws = [tuple(training_samples(course.plants, course.drawn, course.others, k)) for k in range(course.draws)]
    examples, *more = (build_samples(samples, folder, workers, told) for samples in draws)
    tried = {
        name: build_samples(some, folder, workers, lambda text, name=name: told(f"{name}: {text}"))  # type: ignore[misc]
        for name, some in held_out_lessons(course.seeds).items()
    }
    classes = known_classes()
    folds = deal_folds(examples, parts, modelled, course.folds)
    job = _Job(draws[0], folder, tuple(classes), course.recipe, 0, Fold(), tuple(parts), tuple(modelled))
    jobs = [replace(job, seed=seed, out=out) for seed, out in enumerate(folds)]
    jobs += [replace(job, seed=len(folds) + k, samples=draws[k % len(draws)]) for k in range(course.members)]
    lacking = {
        "without plants by other modellers": replace(jobs[0], modelled=()),
        "without single real parts": replace(jobs[0], parts=()),
    } if course.ablations else {}  # fmt: skip
    networks = _train([*jobs, *lacking.values()], workers, told)
    members, others = networks[len(folds) : len(jobs)], networks[len(jobs) :]
    trials = [_Trial(network, fold, tried, parts, modelled) for network, fold in zip(networks, folds, strict=False)]

    def asked(value: float, which: str) -> Answers:
        return joined(*(getattr(trial, which)(classes, value) for trial in trials))

    best = temperature(lambda value: asked(value, "systems"))
    systems, families = asked(best, "systems"), asked(best, "families")
    makers, modellers = asked(best, "makers"), asked(best, "modellers")
    least, alone, sure = _thresholds(families, makers)
    without = [(name, replace(trials[0], network=network)) for name, network in zip(lacking, others, strict=True)]
    compared = [("as it is", trials[0]), *without] if lacking else []
    ablations = {
        name: (trial.systems(classes, best), trial.makers(classes, best), trial.modellers(classes, best))
        for name, trial in compared
    }
    card = {
        "draws": course.draws, "plants": course.plants, "plants in drawn styles": course.drawn,
        "scenes of others": course.others,
        "systems": list(SYSTEMS), "tried from": TRIED_FROM,
        "parts": int(sum(len(e.label) for some in (examples, *more) for e in some)),
        "recipe": asdict(course.recipe), "folds": course.folds,
        "generator": folder.name,
        "held-out systems": _card(score(systems, least)),
        "held-out systems and families": _card(score(families, least)),
        "held-out makers": _card(score(makers, alone)),
        "learnt real parts": sum(part.open for part in parts),
        "their makers": sorted({part.maker for part in parts if part.open}),
        "plants of held-out modellers": _card(score(modellers, least)),
        "learnt plants of others": len(modelled),
        "their modellers": len({plant.modeller for plant in modelled}),
    }  # fmt: skip
    model = Model(tuple(members), tuple(classes), best, least, alone, sure, card)
    model = replace(model, card=card | {"fixed trial": [_fixed_trial(model, *trial) for trial in FIXED]})
    real = {plant.name: answer(model, [plant.example]) for plant in plants}
    return Trials(model, systems, families, makers, modellers, ablations, real, tried)


def _thresholds(families: Answers, makers: Answers) -> tuple[float, float, float]:
    """From where on a label is given, also to a part that touches nothing, and from where on it is sure.

    Args:
        families: answers about held-out families in held-out systems.
        makers: about single real parts of held-out makers.
    """
    least = least_confidence(families, PRECISION, by_group=True)
    alone = max(
        least,
        least_confidence(makers.where(~makers.strange), ALONE, by_group=True),
        float(np.quantile(makers.sureness[makers.strange], _OPEN)) if makers.strange.any() else 0.0,
    )
    return least, alone, max(least, least_confidence(joined(families, makers), SURE, by_group=True))


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


def deal_folds(
    examples: Sequence[Example], parts: Sequence[RealPart], modelled: Sequence[ModelledPlant], folds: int
) -> list[Fold]:
    """Deals systems, families, makers and modellers into folds of about as many each.

    Args:
        examples: plants that hold the families.
        parts: of the makers.
        modelled: by the modellers.
        folds: how many.
    """
    # Pipe, elbows and plain flanges are in every plant and of no family of devices.
    families = {str(name) for e in examples for name in np.unique(e.family)} & set(ALL_FAMILIES)
    return [
        Fold(*sets)
        for sets in zip(
            _dealt(set(SYSTEMS), folds),
            _dealt(families, folds),
            _dealt({part.maker for part in parts}, folds),
            _dealt({plant.modeller for plant in modelled}, folds),
            strict=True,
        )
    ]


def _dealt(names: set[str], folds: int) -> list[frozenset[str]]:
    ordered = sorted(names)
    order = np.random.default_rng(43).permutation(len(ordered))
    return [frozenset(ordered[i] for i in order[k::folds]) for k in range(folds)]


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
    folder: Path
    classes: tuple[str, ...]
    recipe: Recipe
    seed: int
    out: Fold
    parts: tuple[RealPart, ...]
    modelled: tuple[ModelledPlant, ...]


@dataclass(frozen=True)
class _Trial:
    """A network that never saw some things, and what it is tried on."""

    network: Classifier
    out: Fold
    tried: dict[str, list[Example]]
    parts: Sequence[RealPart]
    modelled: Sequence[ModelledPlant]

    def systems(self, classes: Sequence[str], value: float) -> Answers:
        """About all parts of plants of the systems that were held out."""
        return self._answer(
            classes, value, [e for system in sorted(self.out.systems) for e in self.tried[f"system: {system}"]]
        )

    def families(self, classes: Sequence[str], value: float) -> Answers:
        """Of these, about parts of held-out families."""
        told = self.systems(classes, value)
        return told.where(_within(told.family, self.out.families))

    def makers(self, classes: Sequence[str], value: float) -> Answers:
        """About single real parts of held-out makers."""
        return self._answer(classes, value, [p.examples[0] for p in self.parts if p.maker in self.out.makers])

    def modellers(self, classes: Sequence[str], value: float) -> Answers:
        """About plants of held-out modellers."""
        return self._answer(classes, value, [p.examples[0] for p in self.modelled if p.modeller in self.out.modellers])

    def _answer(self, classes: Sequence[str], value: float, examples: Sequence[Example]) -> Answers:
        return answer(Model((self.network,), tuple(classes), value, 0.5, 0.5, 0.5), examples)


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
    text = repr((job.samples, job.classes, job.recipe, job.seed, _listed(job.out)))
    text += repr([part.maker for part in job.parts]) + repr([plant.digest for plant in job.modelled])
    text += Path(fit_file).read_text("utf-8")
    path = job.folder / f"network-{sha256(text.encode()).hexdigest()[:12]}.npz"
    if not path.is_file():
        # One thread each: the same sums in the same order on every machine, and no waiting for each other.
        torch.set_num_threads(1)
        network = fit(_lessons(job), job.classes, job.recipe, job.seed)
        beside = path.with_suffix(".part")
        with beside.open("wb") as file:
            np.savez(file, allow_pickle=False, **network.weights)
        beside.replace(path)
    with np.load(path, allow_pickle=False) as file:
        return Classifier({name: file[name] for name in file.files}, job.recipe.rounds)


def _listed(out: Fold) -> tuple[list[str], ...]:
    return tuple(sorted(names) for names in (out.systems, out.families, out.makers, out.modellers))


def _lessons(job: _Job) -> list[Example]:
    """What a network learns from: nothing of what it must not see."""
    built = build_samples(job.samples, job.folder)
    seen = [e for e, sample in zip(built, job.samples, strict=True) if sample.system not in job.out.systems]
    lessons = [replace(e, label=np.where(_within(e.family, job.out.families), "", e.label)) for e in seen]
    versions = [e for part in job.parts if part.open and part.maker not in job.out.makers for e in part.examples]
    order = np.random.default_rng(47).permutation(len(versions))
    shuffled = [versions[i] for i in order]
    scenes = [side_by_side(shuffled[k : k + _TOGETHER]) for k in range(0, len(shuffled), _TOGETHER)]
    plants = [e for plant in job.modelled if plant.modeller not in job.out.modellers for e in plant.examples]
    return lessons + (scenes + plants) * _COPIES


def _within(family: Texts, out: frozenset[str]) -> npt.NDArray[np.bool_]:
    """Whether each family is one of those."""
    return np.array([str(name) in out for name in family], np.bool_)


def _card(scores: Scores) -> dict[str, float]:
    if not scores.parts:
        return {"parts": 0}  # the others are no numbers
    return {name: round(value, 4) for name, value in asdict(scores).items()}
