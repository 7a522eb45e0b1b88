"""What the page of the viewer is fed with: ``python packages/cadlab/benchmarks/web_scene.py [--meshes N]``.

For the demo plant, the generated ``field``, and copies of that one beside each other: seconds to pack it, triangles by
level, bytes and bytes deflated. Of the copies, as they are, and each mesh made a little larger or smaller by chance, so
that few are exact copies any more.
"""

from __future__ import annotations

import argparse
import resource
import tempfile
import time
import zlib
from pathlib import Path

import numpy as np
from _timing import machine

from cadgraph.draw.web.packing import ROW, PackedScene, pack_scene
from cadgraph.load import load
from cadgraph.model.scene import MeshArrays, Scene
from cadgraph.session.demo import DEMO_SCENE
from cadlab.markdown import table
from cadplants import make, write_usd


def tiled(scene: Scene, count: int, spread: float = 0.0) -> Scene:
    """Copies of a scene in a square, with at least so many meshes; sizes vary by a share."""
    copies = -(-count // scene.n_meshes)
    side = int(np.ceil(np.sqrt(copies)))
    extent = np.ptp(scene.vertices, axis=0)[:2] + 2.0
    random = np.random.default_rng(0)
    n_vertices, n_faces = np.diff(scene.vertex_offsets), np.diff(scene.face_offsets)
    middle = np.repeat(
        np.add.reduceat(scene.vertices, scene.vertex_offsets[:-1]) / n_vertices[:, None], n_vertices, axis=0
    )
    vertices = []
    for i in range(copies):
        scale = np.repeat(random.uniform(1 - spread, 1 + spread, scene.n_meshes), n_vertices)[:, None]
        at = np.array([extent[0] * (i % side), extent[1] * (i // side), 0.0])
        vertices.append(middle + scale * (scene.vertices - middle) + at)
    arrays = MeshArrays(
        np.concatenate(vertices),
        np.tile(scene.faces, (copies, 1)),
        np.concatenate([[0], np.cumsum(np.tile(n_vertices, copies))]),
        np.concatenate([[0], np.cumsum(np.tile(n_faces, copies))]),
    )
    paths = tuple(f"/copy_{i}{path}" for i in range(copies) for path in scene.paths)
    return Scene(arrays, paths, np.tile(scene.colors, (copies, 1)))


def row(name: str, scene: Scene) -> list[object]:
    start = time.perf_counter()
    packed = pack_scene(scene)
    seconds = time.perf_counter() - start
    full, coarse = (triangles(packed, level) for level in (0, 1))
    size = sum(len(data) for data in packed.files.values())
    deflated = sum(len(zlib.compress(data, 6)) for data in packed.files.values())
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    return [
        name, f"{scene.n_meshes:,}", f"{packed.manifest['n_triangles']:,}", f"{packed.manifest['n_shapes']:,}",
        f"{full:,}", f"{coarse:,}", f"{size / 1e6:.1f}", f"{deflated / 1e6:.1f}", f"{seconds:.2f}", f"{peak:.1f}",
    ]  # fmt: skip


def triangles(packed: PackedScene, level: int) -> int:
    """Of the chunks of a level, each shape once."""
    total = 0
    for chunk in packed.manifest["chunks"]:
        if chunk["level"] == level:
            rows = np.frombuffer(packed.files[chunk["file"]], ROW, chunk["n_shapes"], 8)
            total += int(rows["n_indices"].sum()) // 3
    return total


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--meshes", type=int, default=100_000, help="of the copies, at least")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "field.usdc"
        write_usd(make("field"), file)
        field = load(file)
    demo = load(DEMO_SCENE)
    pack_scene(demo)  # compiles
    rows = [row("demo", demo), row("field", field)]
    rows.append(row("copies of field", tiled(field, options.meshes)))
    rows.append(row("copies, sizes varied by 3 %", tiled(field, options.meshes, 0.03)))
    heads = [
        "scene", "meshes", "triangles", "shapes", "triangles of shapes", "of coarse ones", "MB", "MB deflated",
        "seconds", "GB at most so far",
    ]  # fmt: skip
    print(f"{machine()}\n")
    print(*table(heads, rows), sep="\n")


if __name__ == "__main__":
    main()
