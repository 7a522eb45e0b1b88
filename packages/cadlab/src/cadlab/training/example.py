"""Generated plants as training examples: what the labeler sees of their parts, and what these are."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from cadgraph.config import Config
from cadgraph.labelers.embedded.features import observe
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.pipeline import analyse
from cadplants.model.plant import Plant

__all__ = ["Example", "make_example", "make_parts_from", "read_examples", "write_examples"]

Texts = npt.NDArray[np.str_]


@dataclass(frozen=True)
class Example:
    """The parts of one plant.

    Args:
        sizes: ``(n_shapes, n_sizes)``.
        forms: ``(n_shapes, n_forms)``.
        shape: ``(n_parts,)`` row of the two above.
        places: ``(n_parts, n_places)``.
        here: ``(n_sides,)``.
        there: ``(n_sides,)``.
        sides: ``(n_sides, n_side_inputs)``.
        label: ``(n_parts,)`` ``group/name``, empty where not known.
        family: ``(n_parts,)`` what kind of thing it is a piece of.
        flaws: ``(n_parts,)`` what was spoilt, joined by commas.
        style: ``(n_parts,)`` in whose style it is modelled.
        ground: ``(n_parts,)`` bool.
    """

    sizes: Floats
    forms: Floats
    shape: Ints
    places: Floats
    here: Ints
    there: Ints
    sides: Floats
    label: Texts
    family: Texts
    flaws: Texts
    style: Texts
    ground: npt.NDArray[np.bool_]


def make_parts_from(scene: Scene, config: Config | None = None) -> tuple[Parts, Contacts]:
    """The parts of a scene and what touches what, as the pipeline finds them."""
    # What is odd about meshes changes no part.
    quick = (config or Config()).replace({"inspect.duplicates": False, "inspect.hidden": False})
    analysis = analyse(scene, quick)
    return analysis.parts, analysis.contacts


def make_example(plant: Plant, style: str = "") -> Example:
    """Looks at a plant as the labeler does, and writes beside it what each part is.

    Args:
        plant: generated.
        style: the name of its style where the plant's components don't tell.
    """
    parts, contacts = make_parts_from(plant.scene())
    seen = observe(parts, contacts)
    rank = {path: i for i, path in enumerate(plant.paths())}
    heads = [plant.components[rank[parts.scene.paths[i]]] for i in range(parts.n_parts)]
    around = seen.surroundings
    return Example(
        sizes=seen.shapes.sizes.astype(np.float32),
        forms=seen.shapes.forms.astype(np.float32),
        shape=seen.shape_of_part,
        places=around.places.astype(np.float32),
        here=around.here,
        there=around.there,
        sides=around.sides.astype(np.float32),
        label=np.array([f"{c.group}/{c.name}" for c in heads], np.str_),
        family=np.array([c.family or f"{c.group}/{c.name}" for c in heads], np.str_),
        flaws=np.array([",".join(c.flaws) for c in heads], np.str_),
        style=np.array([c.style or style for c in heads], np.str_),
        ground=parts.ground,
    )


def write_examples(examples: list[Example], path: Path) -> None:
    """Keeps examples in one file."""
    arrays = {f"{k}/{name}": getattr(e, name) for k, e in enumerate(examples) for name in Example.__annotations__}
    with path.open("wb") as file:
        np.savez(file, allow_pickle=False, **arrays)


def read_examples(path: Path) -> list[Example]:
    """Reads what ``write_examples`` wrote."""
    with np.load(path, allow_pickle=False) as file:
        count = 1 + max((int(name.split("/")[0]) for name in file.files), default=-1)
        return [Example(**{name: file[f"{k}/{name}"] for name in Example.__annotations__}) for k in range(count)]
