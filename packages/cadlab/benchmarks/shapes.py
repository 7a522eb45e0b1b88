"""Repeated shapes of a scene: ``python packages/cadlab/benchmarks/shapes.py [--scale S]``.

As exported, in random poses, and with vertices in any order and every fifth part mirrored. Beside it, what a user would
pick instead: trimesh's ``identifier_hash``, on a part of the scene and extrapolated, with the shapes that it splits.
"""

from __future__ import annotations

import argparse

import numpy as np
import scenes
import trimesh
from _timing import machine, once, timed
from scipy.spatial.transform import Rotation

from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.geometry.shape.similarity import find_near_shapes
from cadgraph.model.scene import Scene
from cadlab.markdown import table


def changed(scene: Scene, posed: bool, scrambled: bool) -> Scene:
    random = np.random.default_rng(0)
    turns = Rotation.random(scene.n_meshes, random_state=0).as_matrix()
    meshes = []
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        if posed:
            vertices = (vertices - vertices.mean(axis=0)) @ turns[i].T + random.uniform(-20, 20, 3)
        if scrambled:
            order = random.permutation(len(vertices))
            vertices = vertices[order]
            faces = np.argsort(order).astype(np.int32)[faces][random.permutation(len(faces))]
            if i % 5 == 0:
                vertices, faces = vertices * [1, 1, -1], faces[:, ::-1]
        meshes.append((vertices, faces))
    return Scene.from_meshes(meshes)


def hashes(scene: Scene) -> int:
    return len({trimesh.Trimesh(*scene.mesh(i), process=False).identifier_hash for i in range(scene.n_meshes)})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--sample", type=int, default=150, help="meshes given to trimesh")
    options = parser.parse_args()
    plain = scenes.plant(options.scale)
    print(f"{machine()}\n\n{plain.n_meshes:,} meshes, {plain.n_triangles:,} triangles; seconds, medians of 3, warm.\n")
    rows: list[list[object]] = []
    for name, posed, scrambled in (
        ("as exported", False, False),
        ("random poses", True, False),
        ("any vertex order, a fifth mirrored", True, True),
    ):
        scene = changed(plain, posed, scrambled) if posed or scrambled else plain
        properties = measure(scene)
        shapes = find_shapes(scene, properties)
        wall, spent = timed(lambda scene=scene, properties=properties: find_shapes(scene, properties))  # type: ignore[misc]
        part = scene.select(np.arange(min(options.sample, scene.n_meshes)))
        split: list[int] = []
        theirs = scene.n_meshes / part.n_meshes * once(lambda part=part, split=split: split.append(hashes(part)))  # type: ignore[misc]
        rows.append([
            name, f"{shapes.n_shapes:,}", f"{wall:.2f}", f"{spent:.2f}", f"{theirs:,.1f}", f"{theirs / spent:,.0f}",
            f"{find_shapes(part, measure(part)).n_shapes} / {split[0]}",
        ])  # fmt: skip
        wall, spent = timed(lambda s=scene, p=properties, h=shapes: find_near_shapes(s, p, h), 1)  # type: ignore[misc]
        rows.append([f"near repeats, {name}", "", f"{wall:.2f}", f"{spent:.2f}", "", "", ""])
    titles = ["", "shapes", "wall", "processor", "trimesh, processor", "trimesh / here", "of a part: here / trimesh"]
    print(*table(titles, rows, numbers=True), sep="\n")


if __name__ == "__main__":
    main()
