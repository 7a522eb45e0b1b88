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
from cadplants.assortment import FAMILIES, make_assortment
from cadplants.authoring_systems import make_in_system
from cadplants.defects import Defects, degrade
from cadplants.drawn_styles import draw_modeling_style
from cadplants.modeling_style import STYLES, ModelingStyle
from cadplants.plant import Plant
from cadplants.preset import PRESETS

__all__ = ["SINS", "Sample", "bolted_lessons", "build_samples", "held_out_lessons", "training_samples"]

SINS: dict[str, Defects] = {
    "duplicates": Defects(duplicates=0.3),
    "hidden": Defects(hidden=0.3),
    "flipped": Defects(flipped=1.0),
    "soup": Defects(soup=1.0),
    "degenerate": Defects(degenerate=1.0),
}
_PLANTS = ("skid", "riser", "tank", "pumps", "rack")
_SPOILT_EVERY, _VISITED_EVERY = 3, 6
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
        system: of an assortment, the system that draws it (a key of ``SYSTEMS``), with a style of its own; or empty.
    """

    kind: str
    seed: int
    style: str = ""
    sin: str = ""
    sides: float = 1.0
    guests: bool = False
    system: str = ""

    def plant(self) -> Plant:
        """Builds the plant."""
        plant = self._plant()
        return visited(plant, self.seed) if self.guests else plant

    def _plant(self) -> Plant:
        if self.kind == "rare":
            return _make_rare(self.seed)
        if self.kind == "bolted":
            drawn = draw_modeling_style(np.random.default_rng([self.seed, 84]))
            return make_assortment(2_000_000 + self.seed, replace(drawn, fasteners="flange"))
        if self.kind in _LOOSE:
            return _LOOSE[self.kind](self.seed)
        style = _retold(STYLES[self.style], self.sides) if self.style else None
        if self.kind == "assortment" and self.system:
            plant = make_in_system(self.seed, self.system)
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


def training_samples(count: int, distractors: int) -> list[Sample]:
    """Assortments in drawn styles, a third of them with defects, a sixth among distractors; rare things; loose
    fasteners; what belongs to no plant.
    """
    plants = [
        Sample("assortment", seed, sin="some" if seed % _SPOILT_EVERY == 0 else "", guests=seed % _VISITED_EVERY == 1)
        for seed in range(count)
    ]
    return plants + [Sample(kind, seed) for kind in ("rare", *_LOOSE) for seed in range(distractors)]


def bolted_lessons(count: int) -> list[Sample]:
    """Assortments whose flanges are of one mesh with the bolts of their joint."""
    return [Sample("bolted", seed) for seed in range(count)]


def held_out_lessons(seeds: int = 2) -> dict[str, list[Sample]]:
    """What the network is tried on, by the name of the trial.

    ``new seeds``: assortments in drawn styles. ``new styles``: the presets, whose layouts were never learnt from, and
    assortments, both in the six published styles, which were never learnt from either; then each of these again for
    each sin, with half and double the sides, and distractors.
    """
    tried = range(TRIED_FROM, TRIED_FROM + seeds)
    styles = [Sample(kind, seed, style) for style in STYLES for kind in (*_PLANTS, "assortment") for seed in tried]
    few = [Sample(kind, TRIED_FROM, style) for style in STYLES for kind in ("riser", "tank")]
    return {
        "new seeds": [Sample("assortment", seed) for seed in range(TRIED_FROM, TRIED_FROM + 48 * seeds)],
        "new styles": styles,
        **{f"sin: {sin}": [replace(sample, sin=sin) for sample in few] for sin in SINS},
        "half the sides": [replace(sample, sides=0.5) for sample in few],
        "twice the sides": [replace(sample, sides=2.0) for sample in few],
        "strangers": [Sample("strangers", seed) for seed in range(TRIED_FROM, TRIED_FROM + 5 * seeds)],
        "unseen strangers": [Sample("strangers", seed) for seed in range(UNSEEN_FROM, UNSEEN_FROM + 5 * seeds)],
    }


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
        write_examples([make_example(sample.plant(), sample.style or "drawn") for sample in batch], beside)
        beside.replace(path)
    return path


def _hash_of(text: str) -> int:
    """A number that depends on a text alone, the same on every machine."""
    return int.from_bytes(sha256(text.encode()).digest()[:4], "big")
