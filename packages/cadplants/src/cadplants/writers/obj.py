"""Plants as Wavefront OBJ: an object for each mesh, names without meaning, colours in a material file beside it."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import RGB, Plant
from cadplants.writers.placing import Frame, place
from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["write"]


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as OBJ and MTL.

    Args:
        plant: what to write.
        style: millimetres and Y up by default, as modelling programs export it; the file tells neither.
        stem: name of the file without its suffix, which the material file shares.
    """
    frame = Frame(style.meters_per_unit or 0.001, style.up_axis or "Y")
    numbers = np.random.default_rng([plant.seed, 7]).permutation(max(10 * plant.n_meshes, 10))[: plant.n_meshes]
    materials: dict[RGB, str] = {}
    blocks, paths, first = [f"mtllib {stem}.mtl"], [], 1
    for one, component, number in zip(place(plant), plant.components, numbers.tolist(), strict=True):
        pose = frame.pose(one.pose)
        points = frame.points(one.solid) @ pose[:3, :3].T + pose[:3, 3] + 0.0
        material = materials.setdefault(component.color, f"M_{len(materials):02d}")
        blocks.append(f"o Object_{number:05d}")
        blocks += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points.tolist()]
        blocks.append(f"usemtl {material}")
        blocks += [f"f {a} {b} {c}" for a, b, c in (one.solid.faces.astype(np.int64) + first).tolist()]
        first += len(points)
        paths.append(f"/Object_{number:05d}")
    painted = [
        f"newmtl {material}\nKd {red:.6g} {green:.6g} {blue:.6g}" for (red, green, blue), material in materials.items()
    ]
    files = {".obj": _text(blocks), ".mtl": _text(painted)}
    return Written(files, tuple(paths), frame.meters_per_unit, frame.up_axis)


def _text(lines: list[str]) -> bytes:
    return ("\n".join(lines) + "\n").encode("utf-8")
