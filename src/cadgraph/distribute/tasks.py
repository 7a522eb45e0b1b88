"""The tasks: pure functions of files. Each reads arrays of a run folder, and writes one file with what it found."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.distribute.packing import pack_facts
from cadgraph.distribute.store import open_arrays, open_scene, read_result, write_result
from cadgraph.errors import FormatError
from cadgraph.geometry.contact.pairs import contacts_among
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Ints, Scene

__all__ = ["find_contacts_of_tile", "measure_range", "result_of"]


def result_of(folder: Path, number: int) -> Path:
    """The file that a task writes its result to."""
    return folder / f"result-{number:06d}.npz"


def find_contacts_of_tile(scene_folder: str, folder: str, number: int, eps: float) -> None:
    """Decides the pairs that a tile owns.

    Args:
        scene_folder: holds the arrays of the scene.
        folder: of this step; ``pairs-NUMBER.npz`` holds the pairs of the tile.
        number: of the tile.
        eps: greatest distance [m].

    Raises:
        FormatError: an input is damaged.
        OutputError: the result can't be written.
    """
    scene, _ = open_scene(open_arrays(Path(scene_folder)))
    given = read_result(Path(folder) / f"pairs-{number:06d}.npz")
    if given is None:
        raise FormatError(f"{folder}: the pairs of tile {number} are damaged; remove the folder, then build again")
    pairs = given["pairs"]
    meshes, rows = np.unique(pairs, return_inverse=True)
    found = contacts_among(part_of(scene, meshes), rows.reshape(-1, 2).astype(np.int64), eps)
    arrays = {"pairs": meshes[found.pairs], "distance": found.distance, "points": found.points}
    write_result(result_of(Path(folder), number), arrays)


def measure_range(scene_folder: str, folder: str, number: int, first: int, last: int) -> None:
    """Measures a range of shapes, which begins where a chunk of the whole begins.

    Args:
        scene_folder: holds the arrays of the shapes and what was measured of them.
        folder: of this step.
        number: of the task.
        first: the first shape.
        last: the one after the last.

    Raises:
        FormatError: an input is damaged.
        OutputError: the result can't be written.
    """
    scene, properties = _measured(scene_folder)
    rows = np.arange(first, last)
    facts = measure_shapes(part_of(scene, rows), properties.select(rows))
    write_result(result_of(Path(folder), number), pack_facts(facts))


def part_of(scene: Scene, meshes: Ints) -> Scene:
    """Some meshes of a scene; of one that lies in files only these are read."""
    return scene.select(meshes)


def _measured(folder: str) -> tuple[Scene, Properties]:
    arrays: dict[str, npt.NDArray[Any]] = open_arrays(Path(folder))
    scene, properties = open_scene(arrays)
    if properties is None:
        raise FormatError(f"{folder}: what was measured of its meshes is missing; remove the folder, then build again")
    return scene, properties
