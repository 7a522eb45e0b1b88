"""Writes a plant as USD the way unlabelled plants come: meaningless names, nested frames, any unit and up axis."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from cadgraph.atomic import replacing, write_atomically
from cadgraph.environment.frame import at, spun
from cadgraph.environment.plant import RGB, Component, Plant
from cadgraph.scene import Floats

__all__ = ["UsdStyle", "truth_path", "write_usd"]

_Z_TO_Y = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class UsdStyle:
    """How a plant is put down in USD.

    Args:
        meters_per_unit: length of an authored unit [m]; 0.001 and 0.01 are common.
        up_axis: authored up axis.
        instances: whether repeated shapes are native instances of one prototype.
        nested: how many levels of frames lie above a mesh, each level with a frame of its own.
        colors: whether colours are written.
        shuffle: whether meshes come in random order.
    """

    meters_per_unit: float = 0.001
    up_axis: Literal["Y", "Z"] = "Z"
    instances: bool = False
    nested: int = 2
    colors: bool = True
    shuffle: bool = True


def truth_path(path: str | Path) -> Path:
    """Where the truth of a plant file lies: ``plant.usdc`` -> ``plant.truth.json``."""
    return Path(path).with_suffix(".truth.json")


def write_usd(plant: Plant, path: str | Path, style: UsdStyle | None = None) -> Path:
    """Writes a plant as USD with meaningless names, and its truth beside it.

    Both are written beside their targets first, then renamed over them.

    Args:
        plant: what to write.
        path: ends in ``.usd``, ``.usda`` or ``.usdc``.
        style: millimetres, Z up, no instances by default.

    Returns:
        The path of the truth file.

    Raises:
        ValueError: the suffix is none of these.
        OutputError: a file can't be written.
    """
    target = Path(path)
    if target.suffix not in (".usd", ".usda", ".usdc"):
        raise ValueError(
            f"{target}: a plant is written as .usd, .usda or .usdc, not {target.suffix or 'without suffix'!r}"
        )
    layout = style or UsdStyle()
    with replacing(target) as beside:
        paths = _write(plant, beside, layout)
    truth = {**plant.truth(paths), "meters_per_unit": layout.meters_per_unit, "up_axis": layout.up_axis}
    write_atomically(truth_path(target), json.dumps(truth, indent=1, sort_keys=False) + "\n")
    return truth_path(target)


def _write(plant: Plant, path: Path, style: UsdStyle) -> list[str]:
    """Fills the file; returns the path of each component in order."""
    from pxr import Sdf, Usd, UsdGeom

    rng = np.random.default_rng([plant.seed, 7])
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageMetersPerUnit(stage, style.meters_per_unit)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if style.up_axis == "Y" else UsdGeom.Tokens.z)
    root = UsdGeom.Xform.Define(stage, "/World")
    stage.SetDefaultPrim(root.GetPrim())
    frames = _frames(stage, style, rng)
    order = rng.permutation(plant.n_meshes) if style.shuffle else np.arange(plant.n_meshes)
    numbers = rng.permutation(max(10 * plant.n_meshes, 10))[: plant.n_meshes]
    repeats = Counter(id(component.solid) for component in plant.components)
    prototypes: dict[tuple[int, RGB], str] = {}
    paths = [""] * plant.n_meshes
    for rank, index in enumerate(order):
        component = plant.components[index]
        parent, inverse = frames[rank % len(frames)]
        path_here = f"{parent}/Geo_{int(numbers[index]):05d}"
        pose = inverse @ _authored(component.pose, style)
        if style.instances and repeats[id(component.solid)] > 1:
            key = (id(component.solid), component.color)
            if key not in prototypes:
                prototypes[key] = f"/Library/Item_{len(prototypes):04d}"
                stage.CreateClassPrim(prototypes[key])
                _write_mesh(stage, f"{prototypes[key]}/Geo", component, None, style)
            paths[index] = _write_instance(stage, path_here, prototypes[key], pose)
        else:
            paths[index] = path_here
            _write_mesh(stage, path_here, component, pose, style)
    if prototypes:
        stage.GetPrimAtPath("/Library").SetSpecifier(Sdf.SpecifierClass)
    layer.Export(str(path))
    return paths


def _authored(pose: Floats, style: UsdStyle) -> Floats:
    """A pose of the plant in the authored unit and up axis; it stays rigid."""
    result = pose.copy()
    result[:3, 3] /= style.meters_per_unit
    return _Z_TO_Y @ result if style.up_axis == "Y" else result


def _frames(stage: Any, style: UsdStyle, rng: np.random.Generator) -> list[tuple[str, Floats]]:
    """Nested frames without meaning: the path of each of the lowest, and local from authored world."""
    from pxr import UsdGeom

    level: list[tuple[str, Floats]] = [("/World", np.eye(4))]
    for depth in range(style.nested):
        below = []
        for parent, world in level:
            for k in range(3):
                path = f"{parent}/Node_{int(rng.integers(100, 1000)):03d}_{depth}{k}"
                node = UsdGeom.Xform.Define(stage, path)
                pose = np.eye(4)
                if k > 0:
                    pose = at(*(rng.uniform(-2, 2, 3) / style.meters_per_unit))
                    pose = pose @ spun("xyz"[int(rng.integers(3))], float(rng.integers(4)) * np.pi / 2)
                    _set_pose(node, pose)
                below.append((path, world @ pose))
        level = below
    return [(path, np.asarray(np.linalg.inv(world), np.float64)) for path, world in level]


def _set_pose(node: Any, pose: Floats) -> None:
    from pxr import Gf

    # USD multiplies row vectors, so its matrices are the transposes of ours.
    node.AddTransformOp().Set(Gf.Matrix4d(*pose.T.reshape(-1).tolist()))


def _write_instance(stage: Any, path: str, prototype: str, pose: Floats) -> str:
    """A native instance; returns the path of the mesh in it."""
    from pxr import UsdGeom

    node = UsdGeom.Xform.Define(stage, path)
    node.GetPrim().GetReferences().AddInternalReference(prototype)
    node.GetPrim().SetInstanceable(True)
    _set_pose(node, pose)
    return f"{path}/Geo"


def _write_mesh(stage: Any, path: str, component: Component, pose: Floats | None, style: UsdStyle) -> None:
    from pxr import UsdGeom, Vt

    solid = component.solid
    points = np.ascontiguousarray(solid.vertices / style.meters_per_unit, np.float32)
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(solid.faces.reshape(-1), np.int32)))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(solid.faces), 3, np.int32)))
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.array([points.min(axis=0), points.max(axis=0)])))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    if style.colors:
        mesh.CreateDisplayColorAttr(Vt.Vec3fArray.FromNumpy(np.array([component.color], np.float32)))
    if pose is not None:
        _set_pose(mesh, pose)
