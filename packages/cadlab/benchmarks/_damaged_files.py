"""Small files of every format that is read, to be damaged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from cadgraph.config import LoadConfig
from cadgraph.load import load
from cadgraph.model.scene import Scene
from cadplants import Plant, make
from cadplants.writers import write_plant

_LARGE = 6000  # triangles of a file that is quick to read
_SMALL = 700  # of one whose reader is slow: 300 copies take a minute or two
_OURS = {"usdc": _LARGE, "usda": _LARGE, "rvm": _LARGE, "glb": _LARGE, "obj": _LARGE, "stl": _LARGE,
         "ifc": _SMALL, "step": _SMALL}  # fmt: skip
_OTHERS = ("ply", "3mf", "dae")


def write_files(folder: Path, suffixes: tuple[str, ...] = ()) -> Iterator[Path]:
    """Writes a piece of the riser in each format, one after the other.

    Args:
        folder: where to.
        suffixes: of the formats; all if none are given.
    """
    plant = make("riser", 3)
    for suffix, most in _OURS.items():
        if not suffixes or suffix in suffixes:
            path = folder / f"plant.{suffix}"
            write_plant(piece_of(plant, most), path)
            yield path
    wanted = [suffix for suffix in _OTHERS if not suffixes or suffix in suffixes]
    if wanted:
        write_plant(piece_of(plant, _LARGE), folder / "source.usdc")
        scene = load(folder / "source.usdc", LoadConfig(isolate=False))
        for suffix in wanted:
            path = folder / f"plant.{suffix}"
            _write_with_trimesh(scene, path)
            yield path


def piece_of(plant: Plant, triangles: int) -> Plant:
    """The simplest components of a plant, with so many triangles at most."""
    order = sorted(range(len(plant.components)), key=lambda i: (len(plant.components[i].solid.faces), i))
    some = [plant.components[i] for i in order]
    ends = np.cumsum([len(component.solid.faces) for component in some])
    kept = tuple(some[: max(2, int(np.searchsorted(ends, triangles)))])
    names = {component.unit for component in kept}
    return Plant(kept, units=tuple(unit for unit in plant.units if unit.id in names), name=plant.name)


def _write_with_trimesh(scene: Scene, path: Path) -> None:
    """Writes a scene in a format that plants are not written in, in millimetres where the format has a unit."""
    import trimesh
    from trimesh.exchange.dae import export_collada

    meshes = []
    for mesh in range(scene.n_meshes):
        vertices, faces = scene.mesh(mesh)
        name = scene.paths[mesh].rpartition("/")[2]
        meshes.append(trimesh.Trimesh(1000 * vertices, faces, metadata={"name": name}, process=False))
    if path.suffix == ".dae":
        content = export_collada(meshes)
    elif path.suffix == ".ply":
        content = trimesh.util.concatenate(meshes).export(file_type="ply")
    else:
        content = trimesh.Scene(meshes).export(file_type=path.suffix[1:])
    path.write_bytes(content)
