"""Which plants the network learns from, and which it is tried on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

import numpy as np

from cadlab.training.distractors import UNSEEN_FROM, make_distractors, visited
from cadlab.training.example import Example, make_example, read_examples, write_examples
from cadlab.training.fastener import make_fasteners
from cadplants.faults.defects import DEFECTS, Defects, degrade
from cadplants.faults.omissions import omitted
from cadplants.model.plant import Plant
from cadplants.presets.assortment import FAMILIES, make_assortment
from cadplants.presets.authoring_systems import SYSTEMS, draw_system, make_in_system
from cadplants.presets.preset import PRESETS, make
from cadplants.solids.transforms import spun
from cadplants.styles.drawn_styles import draw_modeling_style
from cadplants.styles.modeling_style import STYLES, ModelingStyle

__all__ = ["LEFT_OUT", "SINS", "Sample", "build_samples", "held_out_lessons", "training_samples"]

SINS: dict[str, Defects] = {
    "duplicates": Defects(duplicates=0.3),
    "hidden": Defects(hidden=0.3),
    "flipped": Defects(flipped=1.0),
    "soup": Defects(soup=1.0),
    "degenerate": Defects(degenerate=1.0),
}
_PLANTS = ("skid", "riser", "tank", "pumps", "rack")
_SPOILT_EVERY, _VISITED_EVERY, _BOLTED_EVERY, _FALLEN_EVERY, _LAID_OUT_EVERY = 3, 6, 5, 11, 5
_LAYOUTS, _TRIED_LAYOUTS = ("loop", "manifold"), ("skid", "tank")
_WITHOUT = ("fasteners", "gaskets", "structure", "gauge glasses")
_SPOILT = ("one", "primitives", "gaps", "setback", "long", "split", "shuffled", "mirrored", "all")
_SHARE = 0.15
# Kinds of families with names that other plants hold too few of to learn from.
_RARE = frozenset({
    "blower", "boiler", "burner", "cable tray", "camera", "compressor", "conduit", "control panel", "cross",
    "fire extinguisher", "grating", "hydrant", "impeller", "junction box", "lamp", "level gauge", "manway", "platform",
    "pump", "radiator", "sign", "siphon", "skid frame", "skirt", "tank",
})  # fmt: skip
_COMMON = 0.04
_LOOSE: dict[str, Callable[[int], Plant]] = {
    "strangers": make_distractors,
    "fasteners": make_fasteners,
}
_BATCH = 12
_PER_DRAW = 10_000  # seeds
LEFT_OUT = frozenset({"asset-pack"})
"""Systems that only the first draw learns from."""
TRIED_FROM = 100_000
"""Seeds from here on are never learnt from."""


@dataclass(frozen=True)
class Sample:
    """One plant, by name.

    Args:
        kind: ``assortment``, ``rare``, ``bolted``, ``distractors``, ``fasteners`` or a preset.
        seed: of the plant.
        style: a published style by name; empty for drawn ones, or the preset's own.
        sin: a key of ``SINS``, ``some`` for a few of each, or empty.
        sides: factor of the number of sides of everything round.
        guests: whether distractors lean on its parts.
        system: the system that draws it (a key of ``SYSTEMS``), with a style of its own; or empty.
        fallen: whether it lies on its side, as where the axis that is up was declared wrongly.
        without: a key of ``OMISSIONS``: what it lacks; or empty.
        spoilt: a key of ``DEFECTS``, as others draw; or empty.
    """

    kind: str
    seed: int
    style: str = ""
    sin: str = ""
    sides: float = 1.0
    guests: bool = False
    system: str = ""
    fallen: bool = False
    without: str = ""
    spoilt: str = ""

    def plant(self) -> Plant:
        """Builds the plant."""
        plant = self._plant()
        if self.without:
            plant = omitted(plant, frozenset({self.without}))
        if self.guests:
            plant = visited(plant, self.seed)
        if self.fallen:
            plant = replace(plant, components=plant.placed(spun("x", np.pi / 2)).components)
        return plant

    def _plant(self) -> Plant:
        if self.kind == "rare":
            return _make_rare(self.seed)
        if self.kind == "bolted":
            drawn = draw_modeling_style(np.random.default_rng([self.seed, 84]))
            return make_assortment(2_000_000 + self.seed, replace(drawn, fasteners="flange"))
        if self.kind in _LOOSE:
            return _LOOSE[self.kind](self.seed)
        style = _retold(STYLES[self.style], self.sides) if self.style else None
        if self.spoilt:
            return make(self.kind, self.seed, self.style, DEFECTS[self.spoilt])
        if self.kind == "assortment" and self.system:
            plant = make_in_system(self.seed, self.system)
        elif self.system:
            manner = draw_system(np.random.default_rng([self.seed, 27]), self.system)
            plant = PRESETS[self.kind](self.seed, manner.defects.of_style(manner.style))
            plant = degrade(omitted(plant, manner.omissions), manner.defects, self.seed)
        elif self.kind == "assortment":
            plant = make_assortment(self.seed, style)
        else:
            plant = PRESETS[self.kind](self.seed, style)
        if self.sin == "some":
            share = _SHARE
            defects = Defects(duplicates=share / 3, flipped=share, soup=share, degenerate=share)
            return degrade(plant, defects, self.seed)
        return degrade(plant, SINS[self.sin], self.seed) if self.sin else plant


def _make_rare(seed: int) -> Plant:
    """A plant of what is seldom drawn otherwise, and a few other things."""
    rng = np.random.default_rng([seed, 83])
    out = [name for name in FAMILIES if name.split("/")[0] not in _RARE and rng.random() > _COMMON]
    return make_assortment(1_000_000 + seed, without=frozenset(out))


def _retold(style: ModelingStyle, factor: float) -> ModelingStyle:
    """The same style with more or fewer sides."""
    if factor == 1.0:
        return style
    least, most = (max(6, round(n * factor)) for n in style.sides)
    return replace(style, sides=(least, most), sag=style.sag / factor**2)


def training_samples(systems: int, drawn: int, others: int, draw: int = 0) -> list[Sample]:
    """Plants as the authoring systems draw them (assortments and two layouts, some of them on their side); assortments
    in drawn styles, a third with defects, some with their bolts melted into flanges; a sixth of all among distractors;
    rare things; loose fasteners; what belongs to no plant.

    Args:
        systems: plants of all systems together.
        drawn: assortments in drawn styles.
        others: scenes of rare things, and as many of what belongs to no plant; two thirds as many of fasteners.
        draw: other plants for each. All but the first leave out the systems ``LEFT_OUT``: what only these draw is
            learnt by some of the networks, and what they cost the plants of engineers is not paid by all.
    """
    names = [name for name in SYSTEMS if draw == 0 or name not in LEFT_OUT]
    first, plants = draw * _PER_DRAW, []
    for k in range(systems * len(names) // len(SYSTEMS)):
        turn = k // len(names)
        kind = _LAYOUTS[turn % len(_LAYOUTS)] if turn % _LAID_OUT_EVERY == 0 else "assortment"
        plants.append(Sample(
            kind, first + k, guests=k % _VISITED_EVERY == 1, system=names[k % len(names)],
            fallen=k % _FALLEN_EVERY == 2,
        ))  # fmt: skip
    for k in range(drawn):
        sin = "some" if k % _SPOILT_EVERY == 0 else ""
        kind = "bolted" if k % _BOLTED_EVERY == 2 else "assortment"
        plants.append(Sample(kind, first + k, sin="" if kind == "bolted" else sin, guests=k % _VISITED_EVERY == 1))
    loose = [Sample(kind, first + k)
             for kind, n in (("rare", others), ("strangers", others), ("fasteners", 2 * others // 3))
             for k in range(n)]  # fmt: skip
    return plants + loose


def held_out_lessons(seeds: int = 1) -> dict[str, list[Sample]]:
    """What the networks are tried on, by the name of the trial.

    ``system: NAME``: assortments and a layout as this system draws them. ``published styles``: layouts that are not
    learnt from, in the six published styles, which are not either; then some of these again for each sin, with half and
    double the sides, without some class of parts, with the defects of plants that others drew; and strangers.
    """
    tried = range(TRIED_FROM, TRIED_FROM + seeds)
    styles = [Sample(kind, seed, style) for style in STYLES for kind in _PLANTS for seed in tried]
    few = [Sample(kind, TRIED_FROM, style) for style in ("mechanical", "vendor") for kind in ("riser", "pumps")]
    return {
        **{
            f"system: {name}": [
                Sample("assortment", seed, system=name) for seed in range(TRIED_FROM, TRIED_FROM + 6 * seeds)
            ] + [Sample(kind, seed, system=name) for kind in _TRIED_LAYOUTS for seed in tried]
            for name in SYSTEMS
        },
        "published styles": styles,
        "the next four as they are": few,
        **{f"no {name}": [replace(sample, without=name) for sample in few] for name in _WITHOUT},
        **{f"defect: {name}": [replace(sample, spoilt=name) for sample in few] for name in _SPOILT},
        **{f"mesh fault: {name}": [replace(sample, sin=name) for sample in few] for name in SINS},
        "half the sides": [replace(sample, sides=0.5) for sample in few],
        "on its side": [replace(sample, fallen=True) for sample in few],
        "strangers": [Sample("strangers", seed) for seed in range(TRIED_FROM, TRIED_FROM + 5 * seeds)],
        "unseen strangers": [Sample("strangers", seed) for seed in range(UNSEEN_FROM, UNSEEN_FROM + 5 * seeds)],
    }  # fmt: skip


def build_samples(
    samples: Sequence[Sample], folder: Path, workers: int = 1, told: Callable[[str], None] = lambda _: None
) -> list[Example]:
    """Builds plants, or reads them where they were built before.

    Args:
        samples: in order.
        folder: keeps what was built, a file for each few plants; delete it after the generator or the descriptors
            change.
        workers: processes.
        told: how far it is.
    """
    folder.mkdir(parents=True, exist_ok=True)
    batches = [tuple(samples[k : k + _BATCH]) for k in range(0, len(samples), _BATCH)]
    examples: list[Example] = []
    with nullcontext() if workers == 1 else ProcessPoolExecutor(max_workers=workers) as pool:
        run = map if pool is None else pool.map
        for k, path in enumerate(run(_built, batches, [folder] * len(batches))):
            examples += read_examples(path)
            told(f"plants: {min(_BATCH * (k + 1), len(samples))} of {len(samples)}")
    return examples


def _built(samples: Iterable[Sample], folder: Path) -> Path:
    batch = list(samples)
    name = f"{_hash_of(repr(batch)):08x}-{len(batch)}"
    path = folder / f"{name}.npz"
    if not path.is_file():
        beside = path.with_suffix(".part")
        write_examples([_example(sample) for sample in batch], beside)
        beside.replace(path)
    return path


def _example(sample: Sample) -> Example:
    """What is seen of a plant; each part is of the plant's system, where it has one."""
    made = make_example(sample.plant(), sample.style or "drawn")
    return replace(made, style=np.full(len(made.label), sample.system)) if sample.system else made


def _hash_of(text: str) -> int:
    """A number that depends on a text alone, the same on every machine."""
    return int.from_bytes(sha256(text.encode()).digest()[:4], "big")
