"""Writes a plant as USD the way unlabelled plants come: meaningless names, nested frames, any unit and up axis."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from cadgraph._io.atomic import replacing, write_atomically
from cadgraph.model.scene import Floats
from cadplants.mesh_ops import Solid
from cadplants.plant import RGB, Component, Plant
from cadplants.tessellate import facets
from cadplants.transforms import at, spun
from cadplants.truth_writer import truth_of

__all__ = ["Instances", "UsdStyle", "draw_style", "truth_path", "write_usd"]

Instances = Literal["none", "native", "nested", "point", "mixed"]

_WAYS: tuple[Instances, ...] = ("none", "native", "nested", "point")
_UNITS = (1.0, 0.01, 0.001, 0.0254, 0.3048, 0.1)  # m, cm, mm, inch, foot, dm

_Z_TO_Y = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class UsdStyle:
    """How a plant is put down in USD.

    Args:
        meters_per_unit: length of an authored unit [m]; 0.001 and 0.01 are common.
        up_axis: authored up axis.
        instances: what becomes of repeated shapes: ``none`` (each is a mesh), ``native`` instances of one prototype,
            ``nested`` ones (an instance in a prototype of another), items of ``point`` instancers, or ``mixed``.
        nested: how many levels of frames lie above a mesh, each level with a frame of its own.
        skewed: whether these frames are turned by any angle and scaled, rather than by quarters.
        colors: whether colours are written.
        shuffle: whether meshes come in random order.
        polygons: share of meshes with polygons (quads, concave outlines, whole caps) instead of triangles.
    """

    meters_per_unit: float = 0.001
    up_axis: Literal["Y", "Z"] = "Z"
    instances: Instances = "none"
    nested: int = 2
    skewed: bool = False
    colors: bool = True
    shuffle: bool = True
    polygons: float = 0.0


def draw_style(seed: int) -> UsdStyle:
    """A way to put a plant down at random: unit, up axis, instances, frames, polygons."""
    rng = np.random.default_rng([seed, 10])
    ways: tuple[Instances, ...] = (*_WAYS, "mixed", "mixed")
    return UsdStyle(
        meters_per_unit=_UNITS[int(rng.integers(len(_UNITS)))],
        up_axis="Y" if rng.random() < 0.5 else "Z",
        instances=ways[int(rng.integers(len(ways)))],
        nested=int(rng.integers(0, 5)),
        skewed=bool(rng.random() < 0.5),
        colors=bool(rng.random() < 0.85),
        polygons=float(rng.choice([0.0, 0.5, 1.0])),
    )


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
        writer = _Writer(plant, layout)
        writer.save(beside)
    truth = truth_of(plant, writer.paths)
    for index in sorted(writer.polygonal):
        truth["flaws"].setdefault(writer.paths[index], []).append("polygons")
    truth |= {
        "colors": plant.colors if layout.colors else "none",
        "instances": layout.instances,
        "nested": layout.nested,
        "meters_per_unit": layout.meters_per_unit,
        "up_axis": layout.up_axis,
    }
    write_atomically(truth_path(target), json.dumps(truth, indent=1, sort_keys=False) + "\n")
    return truth_path(target)


class _Writer:
    """Fills a layer with a plant; ``paths`` has each component's then, ``polygonal`` those with polygons."""

    def __init__(self, plant: Plant, style: UsdStyle) -> None:
        from pxr import Sdf, Usd, UsdGeom

        self._plant, self._style = plant, style
        self._rng = np.random.default_rng([plant.seed, 7])
        self._layer = Sdf.Layer.CreateAnonymous(".usda")
        self._stage = Usd.Stage.Open(self._layer)
        UsdGeom.SetStageMetersPerUnit(self._stage, style.meters_per_unit)
        UsdGeom.SetStageUpAxis(self._stage, UsdGeom.Tokens.y if style.up_axis == "Y" else UsdGeom.Tokens.z)
        self._stage.SetDefaultPrim(UsdGeom.Xform.Define(self._stage, "/World").GetPrim())
        self._prototypes: dict[tuple[int, RGB, bool], str] = {}
        self._facets: dict[int, Any] = {}
        self.paths = [""] * plant.n_meshes
        self.polygonal: set[int] = set()
        self._fill()

    def save(self, path: Path) -> None:
        """Writes the layer."""
        self._layer.Export(str(path))

    def _fill(self) -> None:
        from pxr import Sdf

        plant, style, rng = self._plant, self._style, self._rng
        frames = _frames(self._stage, style, rng)
        order = rng.permutation(plant.n_meshes) if style.shuffle else np.arange(plant.n_meshes)
        numbers = rng.permutation(max(10 * plant.n_meshes, 10))[: plant.n_meshes]
        repeats = Counter(id(component.solid) for component in plant.components)
        drawn = np.random.default_rng([plant.seed, 11])
        angular = set(np.flatnonzero(drawn.random(plant.n_meshes) < style.polygons).tolist())
        way_of: dict[tuple[int, RGB], Instances] = {}
        scattered: dict[tuple[int, RGB], list[int]] = {}
        for rank, index in enumerate(order.tolist()):
            component = plant.components[index]
            key = (id(component.solid), component.color)
            if key not in way_of:
                way = _WAYS[int(drawn.integers(len(_WAYS)))] if style.instances == "mixed" else style.instances
                way_of[key] = way if repeats[key[0]] > 1 else "none"
            if way_of[key] == "point":
                scattered.setdefault(key, []).append(index)
                continue
            parent, inverse = frames[rank % len(frames)]
            path = f"{parent}/Geo_{int(numbers[index]):05d}"
            pose = inverse @ _authored(component.pose, style)
            if way_of[key] == "none":
                self._write_mesh(path, component, pose, index in angular)
                self.paths[index] = path
                if index in angular:
                    self.polygonal.add(index)
            else:
                self._instance(path, component, pose, nested=way_of[key] == "nested")
                self.paths[index] = path + ("/Inner/Geo" if way_of[key] == "nested" else "/Geo")
        for rank, (_, items) in enumerate(scattered.items()):
            parent, inverse = frames[rank % len(frames)]
            path = f"{parent}/Set_{int(numbers[items[0]]):05d}"
            self._scatter(path, items, inverse, items[0] in angular)
            for item, index in enumerate(items):
                self.paths[index] = f"{path}[{item}]"
            self.polygonal.update(items if items[0] in angular else ())
        if self._stage.GetPrimAtPath("/Library"):
            self._stage.GetPrimAtPath("/Library").SetSpecifier(Sdf.SpecifierClass)

    def _prototype(self, component: Component, nested: bool) -> str:
        """A class that holds the shape as ``Geo``; a nested one holds an instance ``Inner`` of that class."""
        from pxr import UsdGeom

        key = (id(component.solid), component.color, nested)
        if key not in self._prototypes:
            path = f"/Library/Item_{len(self._prototypes):04d}"
            self._prototypes[key] = path
            self._stage.CreateClassPrim(path)
            if nested:
                inner = UsdGeom.Xform.Define(self._stage, f"{path}/Inner").GetPrim()
                inner.GetReferences().AddInternalReference(self._prototype(component, False))
                inner.SetInstanceable(True)
            else:
                self._write_mesh(f"{path}/Geo", component, None, False)
        return self._prototypes[key]

    def _instance(self, path: str, component: Component, pose: Floats, nested: bool) -> None:
        """A native instance of the component's shape."""
        from pxr import UsdGeom

        node = UsdGeom.Xform.Define(self._stage, path)
        node.GetPrim().GetReferences().AddInternalReference(self._prototype(component, nested))
        node.GetPrim().SetInstanceable(True)
        _set_pose(node, pose)

    def _scatter(self, path: str, items: list[int], inverse: Floats, angular: bool) -> None:
        """A point instancer with the components as its items."""
        from pxr import Gf, Sdf, UsdGeom, Vt

        first = self._plant.components[items[0]]
        node = UsdGeom.PointInstancer.Define(self._stage, path)
        _set_pose(node, inverse)
        self._write_mesh(f"{path}/Shape", first, None, angular)
        poses = [_authored(self._plant.components[index].pose, self._style) for index in items]
        sizes = [np.linalg.norm(pose[:3, :3], axis=0) * (np.linalg.det(pose[:3, :3]) > 0 or -1) for pose in poses]
        turns = [Gf.Matrix3d(*(p[:3, :3] / s).T.ravel().tolist()) for p, s in zip(poses, sizes, strict=True)]
        node.CreatePrototypesRel().SetTargets([Sdf.Path(f"{path}/Shape")])
        node.CreateProtoIndicesAttr(Vt.IntArray([0] * len(items)))
        node.CreatePositionsAttr(Vt.Vec3fArray.FromNumpy(np.array([p[:3, 3] for p in poses], np.float32)))
        node.CreateOrientationsfAttr(Vt.QuatfArray([Gf.Quatf(turn.ExtractRotation().GetQuat()) for turn in turns]))
        node.CreateScalesAttr(Vt.Vec3fArray.FromNumpy(np.array(sizes, np.float32)))

    def _write_mesh(self, path: str, component: Component, pose: Floats | None, angular: bool) -> None:
        from pxr import UsdGeom, Vt

        solid = component.solid
        points = np.ascontiguousarray(solid.vertices / self._style.meters_per_unit, np.float32)
        counts, indices = self._polygons(solid) if angular else _triangles(solid)
        mesh = UsdGeom.Mesh.Define(self._stage, path)
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(indices))
        mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
        mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.array([points.min(axis=0), points.max(axis=0)])))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        if self._style.colors:
            mesh.CreateDisplayColorAttr(Vt.Vec3fArray.FromNumpy(np.array([component.color], np.float32)))
        if pose is not None:
            _set_pose(mesh, pose)

    def _polygons(self, solid: Solid) -> Any:
        if id(solid) not in self._facets:
            self._facets[id(solid)] = facets(solid)
        return self._facets[id(solid)]


def _triangles(solid: Solid) -> Any:
    return np.full(len(solid.faces), 3, np.int32), np.ascontiguousarray(solid.faces.reshape(-1), np.int32)


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
            for k in range(3 if depth < 3 else 1):
                path = f"{parent}/Node_{int(rng.integers(100, 1000)):03d}_{depth}{k}"
                node = UsdGeom.Xform.Define(stage, path)
                pose = np.eye(4)
                if k > 0 or depth >= 3:
                    pose = at(*(rng.uniform(-2, 2, 3) / style.meters_per_unit))
                    pose = pose @ spun("xyz"[int(rng.integers(3))], float(rng.integers(4)) * np.pi / 2)
                    if style.skewed:
                        pose = pose @ spun("xyz"[int(rng.integers(3))], float(rng.uniform(0, 2 * np.pi)))
                        pose = pose @ np.diag([*[float(rng.choice([0.1, 0.5, 1.0, 2.0, 25.4]))] * 3, 1.0])
                    _set_pose(node, pose)
                below.append((path, world @ pose))
        level = below
    return [(path, np.asarray(np.linalg.inv(world), np.float64)) for path, world in level]


def _set_pose(node: Any, pose: Floats) -> None:
    from pxr import Gf

    # USD multiplies row vectors, so its matrices are the transposes of ours.
    node.AddTransformOp().Set(Gf.Matrix4d(*pose.T.reshape(-1).tolist()))
