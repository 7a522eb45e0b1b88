"""Scenes of any number of meshes for ``size.py``, written as USD: lines of pipes as instances, and teapots."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

sys.path.insert(0, str(Path(__file__).parent))

from scenes import Mesh, box, elbow, join, lathe, moved, tube

from cadgraph.model.scene import Floats

__all__ = ["PER_RUN", "write_lines", "write_teapots"]

PER_RUN = 10  # meshes of one run: four pipes, two flanges, two elbows, two supports
_PER_ROW = 20  # runs that make one line
_RISE = 0.6  # of every second run [m]
_SHAPES = 6  # of one kind of run
Placed = tuple[int, Floats]
"""A shape by its number and where it stands, 4 x 4 with the translation in its last row [m]."""


def shapes_of(kind: int) -> list[Mesh]:
    """Long pipe, riser, flange, elbow, high support, low support of one kind of run."""
    radius, wall, long = _sizes(kind)
    bend = 3 * radius
    sides = (12, 16, 20)[kind % 3]
    return [
        tube(radius, radius - wall, long, sides),
        tube(radius, radius - wall, _RISE + 0.001 * (kind % 97), sides),
        tube(1.8 * radius, radius - wall, 0.02, sides),
        elbow(bend, radius, 6, sides),
        box(0.1, 2 * radius, 0.5 + _RISE + 2 * bend + 0.001 * (kind % 97)),
        box(0.1, 2 * radius, 0.5),
    ]


def _sizes(kind: int) -> tuple[float, float, float]:
    radius = (0.0302, 0.0446, 0.0571)[kind % 3]
    return radius, 0.004, 0.8 + 0.0013 * kind


def _matrix(at: Floats, turn: Floats | None = None) -> Floats:
    full = np.eye(4)
    full[3, :3] = at
    if turn is not None:
        full[:3, :3] = turn
    return full


# Rows are where x, y, z of a shape go.
_ALONG_X = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], np.float64)
_DOWN = np.diag([1.0, -1.0, -1.0])
_X_TO_Z = np.array([[0, 0, 1], [0, -1, 0], [1, 0, 0]], np.float64)


def run(kind: int, start: Floats, up: bool) -> tuple[list[Placed], Floats]:
    """One run from a place along x, up or down and along x again; also where it ends."""
    radius, _, long = _sizes(kind)
    bend, rise = 3 * radius, _RISE + 0.001 * (kind % 97)
    flip = np.eye(3) if up else _DOWN
    way = 1.0 if up else -1.0
    x, z = np.array([1.0, 0, 0]), np.array([0, 0, way])
    height = start[2]
    placed, at = [], start.copy()

    def along(shape: int, length: float) -> None:
        nonlocal at
        placed.append((shape, _matrix(at, _ALONG_X)))
        at = at + x * length

    low, high = (5, 4) if up else (4, 5)
    low_tall = 0.5 if low == 5 else 0.5 + rise + 2 * bend
    high_tall = 0.5 if high == 5 else 0.5 + rise + 2 * bend
    placed.append((low, _matrix(at + x * long / 2 - [0, 0, radius + low_tall / 2])))
    along(0, long)
    along(2, 0.02)
    along(2, 0.02)
    along(0, long)
    placed.append((3, _matrix(at, _X_TO_Z @ flip)))
    at = at + bend * (x + z)
    placed.append((1, _matrix(at, flip)))
    at = at + rise * z
    placed.append((3, _matrix(at, flip)))
    at = at + bend * (x + z)
    placed.append((high, _matrix(at + x * long / 2 - [0, 0, radius + high_tall / 2])))
    along(0, long)
    assert abs(at[2] - height - way * (rise + 2 * bend)) < 1e-9
    return placed, at


def lines(n: int) -> Iterator[tuple[int, int, list[Placed]]]:
    """Number, kind and meshes of each line: rows of runs, chained end to end, about ``n`` meshes in all."""
    kinds = max(2, n // 3000)
    runs = max(1, n // PER_RUN)
    for row in range(-(-runs // _PER_ROW)):
        across = max(1, round((runs / _PER_ROW / 8) ** 0.5))  # rows that stand one beside another
        at = np.array([row // across * 70.0, row % across * 1.0, 0.6])
        placed: list[Placed] = []
        for k in range(min(_PER_ROW, runs - row * _PER_ROW)):
            more, at = run(row % kinds, at, up=k % 2 == 0)
            placed += more
        yield row, row % kinds, placed


def write_lines(path: Path, n: int, points: bool = False) -> None:
    """Writes about ``n`` meshes as instances of few shapes: native ones, or one point instancer for each line."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Plant").GetPrim())
    if not points:
        stage.CreateClassPrim("/Shapes")
    for kind in range(max(2, n // 3000)):
        for number, mesh in enumerate(shapes_of(kind)):
            over = stage.DefinePrim(f"/Shapes/S_{kind}_{number}", "Xform")
            write_mesh(stage, f"{over.GetPath()}/Body", mesh)
    if points:  # last, as what is defined below it defines it too, and all shapes would lie in a heap at the origin
        stage.GetPrimAtPath("/Shapes").SetSpecifier(Sdf.SpecifierOver)
    for row, kind, placed in lines(n):
        if points:
            _write_points(stage, row, kind, placed)
        else:
            _write_instances(stage.GetRootLayer(), row, kind, placed)
    stage.Save()


def _write_points(stage: Usd.Stage, row: int, kind: int, placed: list[Placed]) -> None:
    from scipy.spatial.transform import Rotation

    instancer = UsdGeom.PointInstancer.Define(stage, f"/Plant/Line_{row}")
    instancer.CreatePrototypesRel().SetTargets([f"/Shapes/S_{kind}_{k}" for k in range(_SHAPES)])
    instancer.CreateProtoIndicesAttr(Vt.IntArray([shape for shape, _ in placed]))
    at = np.array([matrix[3, :3] for _, matrix in placed], np.float32)
    turns = Rotation.from_matrix(np.array([matrix[:3, :3].T for _, matrix in placed])).as_quat()
    instancer.CreatePositionsAttr(Vt.Vec3fArray.FromNumpy(at))
    instancer.CreateOrientationsAttr(Vt.QuathArray([Gf.Quath(*map(float, q[[3, 0, 1, 2]])) for q in turns]))


def _write_instances(layer: Sdf.Layer, row: int, kind: int, placed: list[Placed]) -> None:
    with Sdf.ChangeBlock():
        line = Sdf.CreatePrimInLayer(layer, f"/Plant/Line_{row}")
        line.specifier, line.typeName = Sdf.SpecifierDef, "Xform"
        for number, (shape, matrix) in enumerate(placed):
            spec = Sdf.PrimSpec(line, f"P_{number}", Sdf.SpecifierDef, "Xform")
            spec.instanceable = True
            spec.referenceList.Prepend(Sdf.Reference(primPath=f"/Shapes/S_{kind}_{shape}"))
            where = Sdf.AttributeSpec(spec, "xformOp:transform", Sdf.ValueTypeNames.Matrix4d)
            where.default = Gf.Matrix4d(matrix.tolist())
            order = Sdf.AttributeSpec(spec, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
            order.default = Vt.TokenArray(["xformOp:transform"])


def write_mesh(stage: Usd.Stage, at: str, mesh: Mesh) -> None:
    """One mesh of triangles."""
    vertices, faces = mesh
    prim = UsdGeom.Mesh.Define(stage, at)
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(vertices.astype(np.float32)))
    prim.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
    prim.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(faces.astype(np.int32).reshape(-1)))
    prim.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)


def teapot(scale: Floats) -> Mesh:
    """A pot of 6,000 triangles or so with lid, spout and handle, stretched along the axes."""
    body = [(1e-4, 0.0), *((0.1 + 0.06 * np.sin(t), 0.05 * t) for t in np.linspace(0, 3, 24)), (1e-4, 0.16)]
    lid = [(1e-4, 0.15), *((0.1 * np.cos(t), 0.15 + 0.05 * np.sin(t)) for t in np.linspace(0, 1.5, 12))]
    turn = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], np.float64)
    whole = join(
        lathe(body, 64),
        lathe(lid, 48),
        moved(elbow(0.08, 0.02, 24, 24), shift=(0.12, 0, 0.05)),
        moved(elbow(0.06, 0.012, 24, 16), turn, (-0.14, 0, 0.1)),
        moved(elbow(0.06, 0.012, 24, 16), shift=(-0.2, 0, 0.05)),
    )
    return whole[0] * scale, whole[1]


def write_teapots(path: Path, n: int) -> None:
    """``n`` teapots of which no two are alike, side by side."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    random = np.random.default_rng(0)
    across = int(np.ceil(n**0.5))
    for k in range(n):
        mesh = moved(teapot(random.uniform(0.6, 1.6, 3)), shift=(0.9 * (k % across), 0.9 * (k // across), 0))
        write_mesh(stage, f"/Teapot_{k}", mesh)
    stage.Save()
