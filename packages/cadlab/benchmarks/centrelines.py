"""Centrelines and the analysis of shapes: ``python packages/cadlab/benchmarks/centrelines.py [--parts N]``.

Nobody ships a peer: trimesh fits a least cylinder around a mesh, which is timed beside the analysis on a few parts
and extrapolated. The error of each kind of tube is that of the length along its centreline.
"""

from __future__ import annotations

import argparse

import numpy as np
import scenes
import trimesh
from _timing import machine, once, timed
from scipy.spatial.transform import Rotation

from cadgraph.geometry.line.centreline import Centreline
from cadgraph.geometry.line.trace import trace_centrelines
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.geometry.shape.solid import name_solid
from cadgraph.model.scene import Scene
from cadlab.markdown import table

KINDS: list[tuple[str, scenes.Mesh, float | None]] = [
    ("straight pipe, 6 sides", scenes.tube(0.05, 0.045, 2.0, 6), 2.0),
    ("straight pipe, 64 sides", scenes.tube(0.05, 0.045, 2.0, 64), 2.0),
    ("straight pipe, 40 rings", scenes.tube(0.05, 0.045, 2.0, 32, 40), 2.0),
    ("elbow, 6 segments, 12 sides", scenes.elbow(0.15, 0.05, 6, 12), 0.15 * np.pi / 2),
    ("elbow, 24 segments, 48 sides", scenes.elbow(0.15, 0.05, 24, 48), 0.15 * np.pi / 2),
    ("flange", scenes.tube(0.08, 0.05, 0.02, 48), 0.02),
    ("gasket", scenes.tube(0.065, 0.05, 0.003, 48), 0.003),
    ("bolt", scenes.bolt(20), None),
    ("box", scenes.box(0.3, 0.2, 0.1), None),
    ("sphere", scenes.sphere(0.07, 48, 36), None),
]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--parts", type=int, default=2000)
    parser.add_argument("--sample", type=int, default=20, help="parts given to trimesh")
    options = parser.parse_args()
    turns = Rotation.random(options.parts, random_state=0).as_matrix()
    meshes = [scenes.moved(KINDS[i % len(KINDS)][1], turns[i], (0.5 * i, 0, 0)) for i in range(options.parts)]
    scene = Scene.from_meshes(meshes)
    properties = measure(scene)
    print(f"{machine()}\n\n{scene.n_meshes:,} parts, {scene.n_triangles:,} triangles; seconds, medians of 3, warm.\n")

    part = scene.select(np.arange(min(options.sample, scene.n_meshes)))
    bounds = [trimesh.Trimesh(*part.mesh(i), process=False) for i in range(part.n_meshes)]
    theirs = scene.n_meshes / part.n_meshes * once(lambda: [mesh.bounding_cylinder for mesh in bounds])
    rows: list[list[object]] = []
    for name, act, other in (
        ("analysis of each shape", lambda: measure_shapes(scene, properties), theirs),
        ("centrelines", lambda: trace_centrelines(scene, properties), None),
    ):
        wall, spent = timed(act)
        ratio = f"{other / spent:,.0f}" if other else ""
        rows.append([name, f"{wall:.2f}", f"{spent:.2f}", f"{other:,.1f}" if other else "", ratio])
    print(
        *table(["", "wall", "processor", "trimesh least cylinder, processor", "trimesh / here"], rows, numbers=True),
        sep="\n",
    )

    lines, shapes = trace_centrelines(scene, properties), measure_shapes(scene, properties)
    rows = []
    for k, (name, mesh, length) in enumerate(KINDS):
        found = [line for line in lines[k :: len(KINDS)] if isinstance(line, Centreline)]
        worst = max((abs(line.length / length - 1) for line in found), default=np.nan) if length else np.nan
        tubes = f"{len(found)} of {len(lines[k :: len(KINDS)])}"
        kinds = ", ".join(sorted({str(name_solid(shapes[i])) for i in range(k, scene.n_meshes, len(KINDS))}))
        rows.append([name, f"{len(mesh[1]):,}", tubes, f"{worst:.1e}" if length else "", kinds])
    print(
        "",
        *table(["part", "triangles", "has a centreline", "worst error of length", "is a"], rows, numbers=True),
        sep="\n",
    )


if __name__ == "__main__":
    main()
