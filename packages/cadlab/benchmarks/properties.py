"""Properties of all meshes of a scene, and who can be seen: ``python benchmarks/properties.py [--scale S]``.

Beside it, what a user would write instead: trimesh's properties and oriented boxes, mesh by mesh, on a part of the
scene and extrapolated by the number of meshes.
"""

from __future__ import annotations

import argparse

import numpy as np
import scenes
import trimesh
from _timing import machine, once, timed

from cadgraph.geometry.mesh.duplicates import find_duplicates
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.visibility.outside import find_visible
from cadgraph.model.scene import Scene
from cadlab.markdown import table


def with_trimesh(scene: Scene, boxes: bool) -> None:
    for i in range(scene.n_meshes):
        mesh = trimesh.Trimesh(*scene.mesh(i), process=False)
        _ = mesh.area, mesh.volume, mesh.center_mass, mesh.moment_inertia, mesh.bounds, mesh.is_watertight
        if boxes:
            _ = mesh.bounding_box_oriented


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--sample", type=int, default=150, help="meshes given to trimesh")
    options = parser.parse_args()
    scene = scenes.plant(options.scale)
    properties = measure(scene)
    print(f"{machine()}\n\n{scene.n_meshes:,} meshes, {scene.n_triangles:,} triangles; seconds, medians of 3, warm.\n")
    rows: list[list[object]] = []
    chosen = np.random.default_rng(0).choice(scene.n_meshes, min(options.sample, scene.n_meshes), replace=False)
    part = scene.select(np.sort(chosen))
    share = scene.n_meshes / part.n_meshes
    theirs = {boxes: share * once(lambda boxes=boxes: with_trimesh(part, boxes)) for boxes in (False, True)}  # type: ignore[misc]
    for name, act, other in (
        ("all but oriented boxes", lambda: measure(scene, boxes=False), theirs[False]),
        ("all, 1 thread", lambda: measure(scene, workers=1), theirs[True]),
        ("all, every thread", lambda: measure(scene), theirs[True]),
        ("duplicates", lambda: find_duplicates(scene, properties), None),
        ("visible from outside", lambda: find_visible(scene), None),
    ):
        wall, spent = timed(act)
        ratio = f"{other / spent:,.0f}" if other else ""
        rows.append([name, f"{wall:.2f}", f"{spent:.2f}", f"{other:,.1f}" if other else "", ratio])
    print(*table(["", "wall", "processor", "trimesh, processor", "trimesh / here"], rows, numbers=True), sep="\n")


if __name__ == "__main__":
    main()
