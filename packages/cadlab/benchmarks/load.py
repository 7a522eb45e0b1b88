"""CPU seconds to load large generated USD stages: ``python benchmarks/load.py [--scale N] [--repeats N]``.

Each stage is read here, in a process of its own (the default of ``cadgraph.load``), and by the straightforward script
that one would write instead: ``Usd.PrimRange``, ``UsdGeom.XformCache``, a fan for each polygon in numpy, arrays for
each mesh. That script yields geometry only: no colours, no purposes, no visibility, no checks of the file, no shapes
but meshes. Prints a table in Markdown with a description of the machine.
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

import cadgraph
from cadgraph.config import LoadConfig
from cadgraph.model.scene import Scene
from cadlab.markdown import head, row

Arrays = tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]

MESHES = 8_000
LINES = 100  # units of the plant, each with a placement of its own
SIDES, RINGS = 20, 22  # 440 points, 420 quads or 840 triangles a tube


def tube_quads() -> npt.NDArray[np.int32]:
    """Of a tube of ``RINGS`` rings, open at its ends."""
    i, j = np.meshgrid(np.arange(RINGS - 1), np.arange(SIDES), indexing="ij")
    a, b = i * SIDES + j, i * SIDES + (j + 1) % SIDES
    return np.stack([a, b, b + SIDES, a + SIDES], -1).reshape(-1, 4).astype(np.int32)


def tube_points(radius: float, length: float) -> npt.NDArray[np.float32]:
    """Along z from 0."""
    angle = np.arange(SIDES) * 2 * np.pi / SIDES
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    points = [np.column_stack([ring, np.full(SIDES, height)]) for height in np.linspace(0, length, RINGS)]
    return np.concatenate(points).astype(np.float32)


def new_stage(path: Path) -> tuple[Usd.Stage, list[UsdShade.Material]]:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 0.001)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.Xform.Define(stage, "/Plant")
    materials = []
    for i in range(12):
        material = UsdShade.Material.Define(stage, f"/Looks/Paint_{i}")
        shader = UsdShade.Shader.Define(stage, f"/Looks/Paint_{i}/Surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(i / 12, 0.5, 1 - i / 12))
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        materials.append(material)
    return stage, materials


def place(prim: Any, i: int, n: int) -> None:
    """In one of the lines, each item turned and shifted by its number."""
    across = max(1, n // LINES)
    shape = UsdGeom.Xformable(prim)
    shape.AddTranslateOp().Set(Gf.Vec3d(300.0 * (i % across), 400.0 * (i // across), 50.0 * (i % 7)))
    shape.AddRotateXYZOp().Set(Gf.Vec3f(0, 90, i % 360))


def line_of(stage: Usd.Stage, i: int, n: int) -> str:
    path = f"/Plant/Line_{i // max(1, n // LINES)}"
    if not stage.GetPrimAtPath(path):
        UsdGeom.Xformable(UsdGeom.Xform.Define(stage, path)).AddTranslateOp().Set(Gf.Vec3d(0, 0, 1000))
    return path


def write_meshes(path: Path, n: int, corners: int) -> None:
    """``n`` tubes of triangles or quads, each a mesh of its own, with bound materials."""
    stage, materials = new_stage(path)
    faces = tube_quads()
    if corners == 3:
        faces = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    counts = Vt.IntArray.FromNumpy(np.full(len(faces), corners, np.int32))
    for i in range(n):
        mesh = UsdGeom.Mesh.Define(stage, f"{line_of(stage, i, n)}/Pipe_{i}")
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(tube_points(40 + i * 0.01, 250 + i % 400)))
        mesh.CreateFaceVertexCountsAttr(counts)
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(faces.reshape(-1)))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(mesh.GetPointsAttr().Get()))
        place(mesh, i, n)
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[i % len(materials)])
    stage.Save()


def write_shapes(path: Path, n: int) -> None:
    """Boxes: a third meshes, a third Cubes, a third instances of one of 20 prototypes."""
    stage, materials = new_stage(path)
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32)
    quads = Vt.IntArray([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])

    def box(at: str, i: int) -> UsdGeom.Mesh:
        mesh = UsdGeom.Mesh.Define(stage, at)
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(signs * np.float32(20 + i % 60)))
        mesh.CreateFaceVertexCountsAttr(Vt.IntArray([4] * 6))
        mesh.CreateFaceVertexIndicesAttr(quads)
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[i % len(materials)])
        return mesh

    for k in range(20):
        stage.CreateClassPrim(f"/Prototypes/Part_{k}")
        box(f"/Prototypes/Part_{k}/Body", k)
    for i in range(n):
        at = f"{line_of(stage, i, n)}/Box_{i}"
        if i % 3 == 0:
            place(box(at, i), i, n)
        elif i % 3 == 1:
            cube = UsdGeom.Cube.Define(stage, at)
            cube.CreateSizeAttr(20 + i % 60)
            cube.CreateDisplayColorAttr([Gf.Vec3f(0.2, 0.4, 0.6)])
            place(cube, i, n)
        else:
            instance = UsdGeom.Xform.Define(stage, at)
            instance.GetPrim().GetReferences().AddInternalReference(f"/Prototypes/Part_{i % 20}")
            instance.GetPrim().SetInstanceable(True)
            place(instance, i, n)
    stage.Save()


def straightforward(path: Path) -> list[Arrays]:
    """What one writes instead: a world-space triangle mesh for each mesh of the stage."""
    stage = Usd.Stage.Open(str(path))
    placements = UsdGeom.XformCache()
    scale = UsdGeom.GetStageMetersPerUnit(stage)
    found: list[Arrays] = []
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Mesh):
            continue
        mesh = UsdGeom.Mesh(prim)
        points = np.asarray(mesh.GetPointsAttr().Get(), np.float64)
        counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get())
        indices = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(), np.int64)
        matrix = np.asarray(placements.GetLocalToWorldTransform(prim))
        corners = np.cumsum(counts - 2) - (counts - 2)
        at = np.repeat(np.cumsum(counts) - counts, counts - 2)
        step = np.arange(len(at)) - np.repeat(corners, counts - 2)
        faces = np.column_stack([indices[at], indices[at + step + 1], indices[at + step + 2]])
        found.append(((points @ matrix[:3, :3] + matrix[3, :3]) * scale, faces))
    return found


def cpu() -> float:
    """Seconds of processor time of this process and of its children that have ended."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def timed(act: Callable[[], object], repeats: int) -> tuple[float, float]:
    """Median processor time and median wall time [s]."""
    spent, passed = [], []
    for _ in range(repeats):
        gc.collect()
        start, clock = cpu(), time.perf_counter()
        act()
        spent.append(cpu() - start)
        passed.append(time.perf_counter() - clock)
    return statistics.median(spent), statistics.median(passed)


def measure(name: str, path: Path, repeats: int) -> str:
    here = LoadConfig(isolate=False)
    scene: Scene = cadgraph.load(path, here)
    plain, _ = timed(lambda: straightforward(path), repeats)
    own, own_wall = timed(lambda: cadgraph.load(path, here), repeats)
    isolated, isolated_wall = timed(lambda: cadgraph.load(path), repeats)
    megabytes = path.stat().st_size / 1e6
    cells = [name, f"{scene.n_meshes:,}", f"{len(scene.vertices):,}", f"{scene.n_triangles:,}", f"{megabytes:.0f}"]
    cells += [f"{seconds:.2f}" for seconds in (plain, own, own_wall, isolated, isolated_wall)]
    return row([*cells, f"{own / plain:.2f}", f"{isolated / plain:.2f}"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scale", type=float, default=1.0, help="share of the 8,000 meshes")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    n = max(LINES, int(MESHES * options.scale))
    print(
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}, "
        f"numpy {np.__version__}, OpenUSD {'.'.join(map(str, Usd.GetVersion()))}"
    )
    print(f"\nSeconds, median of {options.repeats}; 'script' is the straightforward script, processor time.\n")
    titles = ["stage", "meshes", "vertices", "triangles", "MB", "script", "here", "here, wall", "isolated"]
    titles += ["isolated, wall", "here / script", "isolated / script"]
    print(*head(titles, numbers=True), sep="\n")
    with tempfile.TemporaryDirectory() as folder:
        stages: dict[str, Callable[[Path], None]] = {
            "triangles": lambda path: write_meshes(path, n, 3),
            "quads": lambda path: write_meshes(path, n, 4),
            "boxes, Cubes, instances": lambda path: write_shapes(path, n),
        }
        for i, (name, write) in enumerate(stages.items()):
            path = Path(folder) / f"stage_{i}.usdc"
            write(path)
            print(measure(name, path, options.repeats), flush=True)


if __name__ == "__main__":
    main()
