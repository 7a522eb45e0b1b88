"""Fills a USD layer with a plant: meaningless names, nested frames, meshes, instances, point instancers."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Vt

from cadgraph.export.usd_specs import define_prim, set_attribute
from cadgraph.model.scene import Floats
from cadplants.model.plant import RGB, Component, Plant
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.tessellate import facets
from cadplants.solids.transforms import at, spun
from cadplants.writers.usd_style import WAYS, Instances, UsdStyle

__all__ = ["LayerWriter"]

_Z_TO_Y = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


class LayerWriter:
    """Fills a layer with a plant; ``paths`` has each component's then, ``polygonal`` those with polygons."""

    def __init__(self, plant: Plant, style: UsdStyle) -> None:
        self._plant, self._style = plant, style
        self._rng = np.random.default_rng([plant.seed, 7])
        # No stage composes the layer while it is filled: with thousands of prims that takes most of the time.
        self._layer = Sdf.Layer.CreateAnonymous(".usda")
        self._prototypes: dict[tuple[int, RGB, bool], str] = {}
        self._facets: dict[int, Any] = {}
        self.paths = [""] * plant.n_meshes
        self.polygonal: set[int] = set()
        with Sdf.ChangeBlock():
            self._fill()

    def save(self, path: Path) -> None:
        """Writes the layer."""
        self._layer.Export(str(path))

    def _fill(self) -> None:
        plant, style, rng = self._plant, self._style, self._rng
        _open_world(self._layer, style)
        frames = _frames(self._layer, style, rng)
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
                way = WAYS[int(drawn.integers(len(WAYS)))] if style.instances == "mixed" else style.instances
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

    def _prototype(self, component: Component, nested: bool) -> str:
        """A class that holds the shape as ``Geo``; a nested one holds an instance ``Inner`` of that class."""
        key = (id(component.solid), component.color, nested)
        if key not in self._prototypes:
            path = f"/Library/Item_{len(self._prototypes):04d}"
            self._prototypes[key] = path
            for place in ("/Library", path):
                Sdf.CreatePrimInLayer(self._layer, place).specifier = Sdf.SpecifierClass
            if nested:
                self._refer(f"{path}/Inner", self._prototype(component, False))
            else:
                self._write_mesh(f"{path}/Geo", component, None, False)
        return self._prototypes[key]

    def _instance(self, path: str, component: Component, pose: Floats, nested: bool) -> None:
        """A native instance of the component's shape."""
        _set_pose(self._refer(path, self._prototype(component, nested)), pose)

    def _refer(self, path: str, prototype: str) -> Any:
        """A prim that is an instance of a prototype."""
        node = define_prim(self._layer, path, "Xform")
        node.referenceList.Prepend(Sdf.Reference(primPath=prototype))
        node.instanceable = True
        return node

    def _scatter(self, path: str, items: list[int], inverse: Floats, angular: bool) -> None:
        """A point instancer with the components as its items."""
        first = self._plant.components[items[0]]
        node = define_prim(self._layer, path, "PointInstancer")
        _set_pose(node, inverse)
        self._write_mesh(f"{path}/Shape", first, None, angular)
        poses = [_authored(self._plant.components[index].pose, self._style) for index in items]
        sizes = [np.linalg.norm(pose[:3, :3], axis=0) * (np.linalg.det(pose[:3, :3]) > 0 or -1) for pose in poses]
        turns = [Gf.Matrix3d(*(p[:3, :3] / s).T.ravel().tolist()) for p, s in zip(poses, sizes, strict=True)]
        prototypes = Sdf.RelationshipSpec(node, "prototypes", custom=False)
        prototypes.targetPathList.explicitItems = [Sdf.Path(f"{path}/Shape")]
        set_attribute(node, "protoIndices", "IntArray", Vt.IntArray([0] * len(items)))
        places = np.array([pose[:3, 3] for pose in poses], np.float32)
        set_attribute(node, "positions", "Point3fArray", Vt.Vec3fArray.FromNumpy(places))
        ways = Vt.QuatfArray([Gf.Quatf(turn.ExtractRotation().GetQuat()) for turn in turns])
        set_attribute(node, "orientationsf", "QuatfArray", ways)
        set_attribute(node, "scales", "Float3Array", Vt.Vec3fArray.FromNumpy(np.array(sizes, np.float32)))

    def _write_mesh(self, path: str, component: Component, pose: Floats | None, angular: bool) -> None:
        solid = component.solid
        points = np.ascontiguousarray(solid.vertices / self._style.meters_per_unit, np.float32)
        counts, indices = self._polygons(solid) if angular else _triangles(solid)
        extent = np.array([points.min(axis=0), points.max(axis=0)])
        mesh = define_prim(self._layer, path, "Mesh")
        set_attribute(mesh, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(points))
        set_attribute(mesh, "faceVertexIndices", "IntArray", Vt.IntArray.FromNumpy(indices))
        set_attribute(mesh, "faceVertexCounts", "IntArray", Vt.IntArray.FromNumpy(counts))
        set_attribute(mesh, "extent", "Float3Array", Vt.Vec3fArray.FromNumpy(extent))
        set_attribute(mesh, "subdivisionScheme", "Token", "none", uniform=True)
        if self._style.colors:
            color = Vt.Vec3fArray.FromNumpy(np.array([component.color], np.float32))
            set_attribute(mesh, "primvars:displayColor", "Color3fArray", color)
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


def _open_world(layer: Any, style: UsdStyle) -> None:
    """The root of a layer, its unit and its up axis."""
    layer.pseudoRoot.SetInfo("metersPerUnit", style.meters_per_unit)
    layer.pseudoRoot.SetInfo("upAxis", style.up_axis)
    layer.defaultPrim = define_prim(layer, Sdf.Path("/World"), "Xform").name


def _frames(layer: Any, style: UsdStyle, rng: np.random.Generator) -> list[tuple[str, Floats]]:
    """Nested frames without meaning: the path of each of the lowest, and local from authored world."""
    level: list[tuple[str, Floats]] = [("/World", np.eye(4))]
    for depth in range(style.nested):
        below = []
        for parent, world in level:
            for k in range(3 if depth < 3 else 1):
                path = f"{parent}/Node_{int(rng.integers(100, 1000)):03d}_{depth}{k}"
                node = define_prim(layer, path, "Xform")
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
    # USD multiplies row vectors, so its matrices are the transposes of ours.
    set_attribute(node, "xformOp:transform", "Matrix4d", Gf.Matrix4d(*pose.T.reshape(-1).tolist()))
    set_attribute(node, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:transform"]), uniform=True)
