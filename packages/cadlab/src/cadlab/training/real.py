"""What others drew: real plants to try the network on, and single real parts and modelled plants to learn from."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

import numpy as np

from cadgraph.labelers.embedded.features import observe
from cadgraph.labelers.embedded.model import STRANGE
from cadgraph.load import load
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats, Scene
from cadlab.training.example import Example, Texts, make_parts_from, read_examples, write_examples

__all__ = [
    "OPEN_LICENCES",
    "ModelledPlant",
    "RealPart",
    "RealPlant",
    "read_modelled_plants",
    "read_real_parts",
    "read_real_plants",
    "side_by_side",
]

OPEN_LICENCES = ("Apache-2.0", "BSD", "CC-BY-3.0", "CC-BY-4.0", "CC0", "MIT")
"""How the licences start of what may be learnt from; copyleft and share-alike ones are only tried."""

_STRETCHED = 3  # versions of a part to learn from: as it is, and stretched
_PLANT_STRETCHED = 4  # of a plant
_STRETCH = 0.12  # spread of the logarithm of the factors along the three sides of its box


@dataclass(frozen=True)
class RealPlant:
    """A plant that somebody else drew; never learnt from.

    Args:
        name: of its folder.
        example: what the network sees; parts that the truth doesn't name have no label.
        scene: the geometry of its parts.
    """

    name: str
    example: Example
    scene: Scene


@dataclass(frozen=True)
class RealPart:
    """A file of a part or a few, by one maker.

    Args:
        maker: where it is from.
        open: whether its licence lets it be learnt from.
        examples: as it is, and stretched a little along the sides of its box; strangers have the label ``STRANGE``.
    """

    maker: str
    open: bool
    examples: tuple[Example, ...]


@dataclass(frozen=True)
class ModelledPlant:
    """A plant that somebody modelled from what real ones look like, with nothing of the generator's; to learn from.

    Args:
        name: of its folder.
        modeller: of the folder above, whose plants are held out together.
        digest: of its files.
        examples: as it is, and stretched a little along the axes; what belongs to no plant has the label ``STRANGE``.
    """

    name: str
    modeller: str
    digest: str
    examples: tuple[Example, ...]


def read_real_plants(folder: Path) -> list[RealPlant]:
    """Reads the plants in the folders below one: each a ``scene.usdc`` with its ``scene.truth.json``."""
    found = []
    for truth in sorted(folder.glob("*/scene.truth.json")):
        scene = load(truth.with_name("scene.usdc"))
        example, parts = _example(scene, _labels_in(truth), truth.parent.name)
        found.append(RealPlant(truth.parent.name, example, parts))
    return found


def read_real_parts(folder: Path, keep: Path, workers: int = 2) -> list[RealPart]:
    """Reads single parts: files named in ``labels.csv`` with the label of each mesh, its source and licence.

    Args:
        folder: that holds ``labels.csv``.
        keep: folder that keeps what was read.
        workers: processes.
    """
    table = folder / "labels.csv"
    if not table.is_file():
        return []
    by_file: dict[str, list[dict[str, str]]] = {}
    with table.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            by_file.setdefault(row["file"], []).append(row)
    kept = keep / "real-parts.npz"
    if not kept.is_file():
        keep.mkdir(parents=True, exist_ok=True)
        with ProcessPoolExecutor(workers) as pool:
            jobs = [(folder, k, name, rows) for k, (name, rows) in enumerate(sorted(by_file.items()))]
            _keep([e for found in pool.map(_versions, jobs, chunksize=8) for e in found], kept)
    examples = read_examples(kept)
    found = []
    for k, (name, rows) in enumerate(sorted(by_file.items())):
        may = all(row["licence"].startswith(OPEN_LICENCES) and "SA" not in row["licence"] for row in rows)
        mine = tuple(examples[k * _STRETCHED : (k + 1) * _STRETCHED])
        found.append(RealPart(name.split("/")[0], may, mine))
    return found


def read_modelled_plants(folder: Path, keep: Path, workers: int = 2) -> list[ModelledPlant]:
    """Reads the plants ``MODELLER/NAME/scene.usdc`` with ``scene.truth.json`` beside it; none where there is no folder.

    Args:
        folder: that holds one of each modeller.
        keep: folder that keeps what was read, a file for each plant.
        workers: processes.
    """
    keep.mkdir(parents=True, exist_ok=True)
    truths = sorted(folder.glob("*/*/scene.truth.json"))
    digests = [_digest(truth.read_bytes(), truth.with_name("scene.usdc").read_bytes()) for truth in truths]
    paths = [keep / f"modelled-{digest}.npz" for digest in digests]
    with ProcessPoolExecutor(workers) as pool:
        list(pool.map(_keep_plant, truths, digests, paths))
    return [
        ModelledPlant(truth.parent.name, truth.parents[1].name, digest, tuple(read_examples(path)))
        for truth, digest, path in zip(truths, digests, paths, strict=True)
    ]


def _digest(*contents: bytes) -> str:
    return sha256(b"".join(contents)).hexdigest()[:12]


def _keep_plant(truth: Path, digest: str, path: Path) -> None:
    """Writes one plant as it is, and stretched, unless that was done before."""
    if not path.is_file():
        scene, source = load(truth.with_name("scene.usdc")), f"modeller {truth.parents[1].name}"
        _keep(_stretched_examples(scene, _labels_in(truth), source, int(digest, 16), _PLANT_STRETCHED), path)


def _keep(examples: list[Example], path: Path) -> None:
    """Writes examples beside their file, which is whole or not there."""
    beside = path.with_suffix(".part")
    write_examples(examples, beside)
    beside.replace(path)


def _versions(job: tuple[Path, int, str, list[dict[str, str]]]) -> list[Example]:
    """One file as it is, and stretched."""
    folder, k, name, rows = job
    labels = {row["mesh"]: _label(row["group"], row["name"]) for row in rows}
    return _stretched_examples(load(folder / name), labels, name.split("/")[0], k, _STRETCHED)


def _stretched_examples(scene: Scene, labels: dict[str, str], source: str, seed: int, versions: int) -> list[Example]:
    """As many versions of a scene, of which the first is as it is."""
    rng = np.random.default_rng([seed, 91])
    factors = [np.ones(3), *(np.exp(rng.normal(0, _STRETCH, 3)) for _ in range(versions - 1))]
    return [_example(_stretched(scene, factor), labels, source)[0] for factor in factors]


def _stretched(scene: Scene, factors: Floats) -> Scene:
    return scene.with_vertices(scene.vertices * factors)


def _labels_in(truth: Path) -> dict[str, str]:
    """The label of each mesh that a truth names."""
    known = json.loads(truth.read_text(encoding="utf-8"))["meshes"]
    return {row["mesh"]: _label(row["group"], row["name"]) for row in known if row.get("name")}


def _label(group: str, name: str) -> str:
    return STRANGE if group == "none" else f"{group}/{name}"


def _example(scene: Scene, labels: dict[str, str], source: str) -> tuple[Example, Scene]:
    parts, contacts = make_parts_from(scene)
    seen = observe(parts, contacts)
    around, n = seen.surroundings, parts.n_parts
    example = Example(
        seen.shapes.sizes.astype(np.float32), seen.shapes.forms.astype(np.float32), seen.shape_of_part,
        around.places.astype(np.float32), around.here, around.there, around.sides.astype(np.float32),
        _labels(scene, parts, labels), np.full(n, source),
        np.full(n, ""), np.full(n, source), parts.ground,
    )  # fmt: skip
    return example, parts.scene


def _labels(scene: Scene, parts: Parts, labels: dict[str, str]) -> Texts:
    """Of each part the label of the first of its meshes that has one."""
    known = [[labels.get(scene.paths[mesh], "") for mesh in meshes] for meshes in parts.meshes]
    return np.array([next((label for label in some if label), "") for some in known], np.str_)


def side_by_side(examples: Sequence[Example]) -> Example:
    """Several scenes as one, each with its own neighbours and places."""
    shapes = np.cumsum([0, *(len(e.forms) for e in examples)])
    parts = np.cumsum([0, *(len(e.label) for e in examples)])
    moved = [
        replace(e, shape=e.shape + shapes[k], here=e.here + parts[k], there=e.there + parts[k])
        for k, e in enumerate(examples)
    ]
    return Example(**{name: np.concatenate([getattr(e, name) for e in moved]) for name in Example.__annotations__})
