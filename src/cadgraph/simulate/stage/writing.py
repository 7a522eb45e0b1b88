"""A plant whose valves turn, as a USD stage: ``simulation.usda``, with ``devices.json`` beside it.

The source stands untouched below ``/Plant/Scene``, in metres and Z up; what moves is taken out there, and referenced
again below bodies of its own, so that no body lies in another and none is scaled. One articulation holds all joints,
each called as the tag of its unit. All that a simulator references is below the default prim ``/Plant``; only the
``/PhysicsScene``, which simulators bring themselves, is beside it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from cadgraph._io.atomic import write_atomically
from cadgraph._io.run_folder import coming_into
from cadgraph._io.staging import result_path
from cadgraph.config import LoadConfig
from cadgraph.export.source import settings_of
from cadgraph.export.usd import is_split, prim_paths, write_semantics
from cadgraph.export.usd_labels import Said, dispositions_of, label_prim, said_of, trace_of
from cadgraph.export.usd_paths import is_usd
from cadgraph.export.usd_specs import apply_schemas, define_prim, set_attribute
from cadgraph.load import load
from cadgraph.load.packing import metres_z_up
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.scene import Floats, Scene
from cadgraph.query.mechanisms import Immovable
from cadgraph.simulate.devices import DEVICES, write_devices
from cadgraph.simulate.dynamics import Device, Moving, find_devices, without_joint
from cadgraph.simulate.stage.below import Below, Shown
from cadgraph.simulate.stage.bodies import add_articulation, add_body, body_matrix
from cadgraph.simulate.stage.colliders import (
    COLLIDERS,
    PLANT,
    SCENE,
    collide,
    make_collider,
    placed_at,
    without_collider,
)
from cadgraph.simulate.stage.faces import faces_of_pieces, faces_of_subset, keep_faces
from cadgraph.simulate.stage.specs import over, place, point_at

__all__ = ["Written", "write_stage"]

_NEEDLE = "gauge needle"


@dataclass(frozen=True)
class Written:
    """What was written.

    Args:
        files: ``simulation.usda``, ``devices.json``, and the layer of labels that the stage refers to.
        devices: the joints.
        immovable: valves that nobody can turn and gauges whose needle doesn't move, and why.
        n_colliders: meshes that stand still and can be touched.
    """

    files: tuple[Path, ...]
    devices: tuple[Device, ...]
    immovable: tuple[Immovable, ...]
    n_colliders: int


def write_stage(graph: SceneGraph, source: str | Path, folder: str | Path, needles: bool = False) -> Written:
    """Writes the stage with its table of joints; the same graph and source give the same bytes.

    The layer of labels (``semantics.usda``), and of a source that is not USD its geometry (``scene.usdc``), are
    written into the folder too, as the stage refers to them. All come into it together.

    Args:
        graph: the finished graph, whose units say what moves.
        source: the file that it was made from.
        folder: where to; made if missing.
        needles: whether gauges without a needle get one drawn, where their dial is known.

    Raises:
        FormatError: the graph was read with settings that aren't known any more.
        LoadError: the source can't be read any more, or is another one.
        OutputError: a file can't be written, or another process is at work in the folder.
        ValueError: the graph names a mesh that the source doesn't have.
    """
    settings = settings_of(graph)
    with coming_into(folder, graph.digest) as target:
        return _write_stage(graph, source, target, settings, needles)


def _write_stage(graph: SceneGraph, source: str | Path, target: Path, settings: LoadConfig, needles: bool) -> Written:
    scene = load(source, settings)
    devices = find_devices(graph, scene, needles)
    labels = write_semantics(scene, graph, source, target / "semantics.usda")
    converted = not is_usd(source) or is_split(scene)
    below = (
        Below(result_path(labels.with_name("scene.usdc")), LoadConfig(), prim_paths(scene))
        if converted
        else Below(Path(source), settings, scene.paths)
    )
    stage = _Stage(graph, scene, below, labels.name, converted)
    content = stage.write(devices)
    path = target / "simulation.usda"
    write_atomically(path, content)
    table = write_devices(graph, scene, devices, target / "devices.json")
    return Written((path, table, labels), devices, without_joint(graph, devices), stage.n_colliders)


class _Stage:
    """A stage while it is written."""

    def __init__(self, graph: SceneGraph, scene: Scene, below: Below, asset: str, converted: bool) -> None:
        self._graph, self._scene, self._below = graph, scene, below
        self._asset = f"./{asset}"
        self._layer = Sdf.Layer.CreateAnonymous(".usda")
        self._to_world = _to_stage(scene, converted)
        self._part_of_mesh = {mesh: part for part in graph.of_layer(Part) for mesh in part.meshes}
        self._dispositions = dispositions_of(graph)
        self.n_colliders = 0

    def write(self, devices: Sequence[Device]) -> str:
        """All of it, as text."""
        moving = [(device, each) for device in devices for each in device.moving]
        taken = [self._below.meshes[each.mesh] for _, each in moving]
        opened = self._below.open_instances(shown.instancer or shown.own for shown in taken)
        with Sdf.ChangeBlock():
            self._head()
            for root in opened:
                over(self._layer, placed_at(root)).instanceable = False
            self._take_out(moving)
            add_articulation(self._layer, devices)
            for device in devices:
                self._add_device(device)
            self._add_colliders(devices)
        return str(self._layer.ExportToString())

    def _head(self) -> None:
        layer = self._layer
        for key, value in (
            ("defaultPrim", PLANT[1:]), ("metersPerUnit", 1.0), ("kilogramsPerUnit", 1.0), ("upAxis", "Z"),
        ):  # fmt: skip
            layer.pseudoRoot.SetInfo(key, value)
        layer.customLayerData = {
            "cadgraph": {
                "source_sha256": self._scene.source.sha256,
                "origin": Gf.Vec3d(*self._scene.origin.tolist()),
            }
        }
        plant = define_prim(layer, Sdf.Path(PLANT), "Xform")
        plant.SetInfo("kind", "assembly")
        place(define_prim(layer, Sdf.Path(SCENE), "Xform"), self._to_world)
        for name in self._below.roots():
            root = over(layer, Sdf.Path(SCENE).AppendChild(name))
            root.specifier = Sdf.SpecifierDef
            root.referenceList.prependedItems = [Sdf.Reference(self._asset, Sdf.Path(f"/{name}"))]
        for prim, relationship, targets in self._below.strays():
            if not prim.IsInPrototype():
                point_at(over(layer, placed_at(prim.GetPath())), relationship, [placed_at(each) for each in targets])
        define_prim(layer, Sdf.Path(COLLIDERS), "Scope")
        physics = define_prim(layer, Sdf.Path("/PhysicsScene"), "PhysicsScene")
        set_attribute(physics, "physics:gravityDirection", "Vector3f", Gf.Vec3f(0, 0, -1))
        set_attribute(physics, "physics:gravityMagnitude", "Float", 9.81)

    # What moves is taken out of the source

    def _take_out(self, moving: Sequence[tuple[Device, Moving]]) -> None:
        gone: dict[str, Any] = {}
        items: dict[str, set[int]] = {}
        for _, each in moving:
            shown = self._below.meshes[each.mesh]
            if shown.instancer is not None:
                items.setdefault(shown.instancer, set()).add(shown.item)
            else:
                moves = self._moving_faces(each, shown)
                kept = None if moves is None else ~moves
                before = gone.get(shown.own)
                gone[shown.own] = kept if before is None or kept is None else before & kept
        for path, kept in gone.items():
            if kept is None:
                self._hide(path)
            else:
                keep_faces(self._layer, placed_at(path), self._below.stage.GetPrimAtPath(path), kept)
        for instancer, numbers in items.items():
            self._take_items(instancer, numbers)

    def _hide(self, path: str) -> None:
        """Switches a mesh off; one with others below it becomes a mere frame, so that they stay."""
        spec = over(self._layer, placed_at(path))
        below = self._below.stage.GetPrimAtPath(path).GetChildren()
        if any(child.GetTypeName() != "GeomSubset" for child in below):
            spec.typeName = "Xform"
        else:
            spec.active = False

    def _take_items(self, path: str, numbers: set[int]) -> None:
        prim = self._below.stage.GetPrimAtPath(path)
        ids = UsdGeom.PointInstancer(prim).GetIdsAttr().Get()
        operation = Sdf.Int64ListOp()
        operation.prependedItems = [int(ids[number]) if ids else number for number in sorted(numbers)]
        over(self._layer, placed_at(path)).SetInfo("inactiveIds", operation)

    def _moving_faces(self, moving: Moving, shown: Shown) -> Any:
        """``(n_polygons,)`` which polygons of a mesh move; None where all do."""
        prim = self._below.prim(shown)
        if shown.subset is not None:
            subset = faces_of_subset(prim, shown.subset)
            if moving.faces is None:
                return subset
        if moving.faces is None:
            return None
        vertices, faces = self._scene.mesh(moving.mesh)
        pieces = faces_of_pieces(prim, shown.matrix @ self._to_world, vertices, faces, moving.faces)
        return pieces if shown.subset is None else pieces & subset

    # Bodies

    def _add_device(self, device: Device) -> None:
        body = add_body(self._layer, device)
        for number, each in enumerate(device.moving):
            shown = self._below.meshes[each.mesh]
            path = body.path.AppendChild(f"mesh_{number}")
            spec = self._copy(path, each.mesh, body_matrix(device), device.is_needle)
            moves = self._moving_faces(each, shown)
            if moves is not None:
                keep_faces(self._layer, path, self._below.prim(shown), moves)
            if device.mechanism.kind == "lever":
                make_collider(spec, self._below.prim(shown).GetTypeName(), "convexDecomposition")
        if not device.moving:
            self._draw_needle(body.path.AppendChild("needle"), device.mechanism.radius)

    def _copy(self, path: Any, mesh: int, from_world: Floats, is_needle: bool = False) -> Any:
        """A mesh of the source anew, where it stood, with its material and label; returns its opinions."""
        shown = self._below.meshes[mesh]
        prim = self._below.prim(shown)
        spec = self._alone(path, prim)
        place(spec, shown.matrix @ self._to_world @ from_world)
        self._dress(spec, prim, mesh)
        part = self._part_of_mesh.get(self._scene.paths[mesh])
        said = None if part is None else said_of(part, self._dispositions.get(self._scene.paths[mesh], ()))
        if part is not None and said is not None:
            # What is too small for a part of its own was labelled as what it lies on.
            label_prim(spec, said._replace(name=_NEEDLE) if is_needle else said, trace_of(part))
        return spec

    def _alone(self, path: Any, prim: Any) -> Any:
        """A prim that refers to a mesh of the source, without what else lies below that; its opinions."""
        spec = over(self._layer, path)
        spec.specifier = Sdf.SpecifierDef
        spec.referenceList.prependedItems = [Sdf.Reference(self._asset, prim.GetPath())]
        for child in prim.GetFilteredChildren(Usd.TraverseInstanceProxies()):
            if child.GetTypeName() != "GeomSubset":
                over(self._layer, path.AppendChild(child.GetName())).active = False
        return spec

    def _dress(self, spec: Any, prim: Any, mesh: int) -> None:
        """Material, and what a mesh had from the prims above it, which a reference to itself alone doesn't bring."""
        self._bind(spec, prim)
        for child in prim.GetChildren():
            if child.GetTypeName() == "GeomSubset" and child.HasRelationship("material:binding"):
                self._bind(over(self._layer, spec.path.AppendChild(child.GetName())), child)
        for primvar in self._below.inherited(prim):
            kept = Sdf.AttributeSpec(spec, primvar.GetName(), primvar.GetTypeName())
            kept.default = primvar.ComputeFlattened()
            kept.SetInfo("interpolation", "constant")
        shown, color = self._below.meshes[mesh], self._scene.colors[mesh]
        colored = prim.HasAttribute("primvars:displayColor") and prim.GetAttribute("primvars:displayColor").HasValue()
        if shown.instancer is not None and not colored and np.isfinite(color).all():
            kept = set_attribute(spec, "primvars:displayColor", "Color3fArray", Vt.Vec3fArray.FromNumpy(color[None]))
            kept.SetInfo("interpolation", "constant")
        purpose = UsdGeom.Imageable(prim).ComputePurpose()
        if purpose != UsdGeom.Tokens.default_:
            set_attribute(spec, "purpose", "Token", purpose, uniform=True)
        if UsdGeom.Imageable(prim).ComputeVisibility() == UsdGeom.Tokens.invisible:
            set_attribute(spec, "visibility", "Token", "invisible")

    def _bind(self, spec: Any, prim: Any) -> None:
        plain = self._below.material(prim)
        for purpose in ("", "full", "preview"):
            material = self._below.material(prim, purpose) if purpose else plain
            if material is not None and (not purpose or material != plain):
                apply_schemas(spec, "MaterialBindingAPI")
                point_at(spec, "material:binding" + (f":{purpose}" if purpose else ""), [placed_at(material)])

    def _draw_needle(self, path: Any, reach: float) -> None:
        """A flat pointer along x of the body, with a tail."""
        spec = define_prim(self._layer, path, "Mesh")
        wide, tall = 0.05 * reach, 0.005 * reach
        outline = np.array([[-0.25, -1.0], [-0.25, 1.0], [0.0, 1.4], [1.0, 0.15], [1.0, -0.15], [0.0, -1.4]])
        outline = outline[::-1] * [reach, wide]
        n = len(outline)
        points = np.concatenate([np.column_stack([outline, np.full(n, z)]) for z in (-tall, tall)]).astype(np.float32)
        sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
        corners = [*range(n)][::-1] + [n + i for i in range(n)] + [corner for side in sides for corner in side]
        set_attribute(spec, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(points))
        set_attribute(spec, "faceVertexCounts", "IntArray", Vt.IntArray([n, n, *[4] * n]))
        set_attribute(spec, "faceVertexIndices", "IntArray", Vt.IntArray(corners))
        set_attribute(spec, "subdivisionScheme", "Token", "none", uniform=True)
        set_attribute(spec, "extent", "Float3Array", Vt.Vec3fArray.FromNumpy(np.array([points.min(0), points.max(0)])))
        shown = set_attribute(spec, "primvars:displayColor", "Color3fArray", Vt.Vec3fArray([Gf.Vec3f(0.01)]))
        shown.SetInfo("interpolation", "constant")
        label_prim(spec, Said(_NEEDLE, "Gauge assembly", ("readable",)))

    # What stands still

    def _add_colliders(self, devices: Sequence[Device]) -> None:
        whole = {each.mesh for device in devices for each in device.moving if each.faces is None}
        opened = {
            (shown.instancer, shown.item)
            for device in devices
            for shown in (self._below.meshes[each.mesh] for each in device.moving)
            if shown.instancer is not None
        }
        untouched = without_collider(self._graph)
        shapes: dict[str, Any] = {}
        reached: dict[int, Any] = {}
        for mesh, shown in enumerate(self._below.meshes):
            if mesh in whole:
                continue
            touched = self._scene.paths[mesh] not in untouched
            if (shown.instancer, shown.item) in opened:
                there = self._stand_in(mesh, touched, devices)
                reached |= {mesh: there} if touched else {}
            elif not touched:
                continue
            elif shown.instancer is not None:
                reached[mesh] = self._touch_item(mesh)
            else:
                shapes.setdefault(shown.own, self._below.prim(shown))
                reached[mesh] = placed_at(shown.own)
        collide(self._layer, list(shapes.values()))
        self.n_colliders = len(reached)
        self._filter(devices, reached)

    def _stand_in(self, mesh: int, touched: bool, devices: Sequence[Device]) -> Any:
        """What stands still of an item that was taken out because something of it moves."""
        path = Sdf.Path(COLLIDERS).AppendChild(f"still_{mesh}")
        spec = self._copy(path, mesh, np.eye(4))
        shown = self._below.meshes[mesh]
        moving = [each for device in devices for each in device.moving if each.mesh == mesh]
        if moving:
            moves = np.logical_or.reduce([self._moving_faces(each, shown) for each in moving])
            keep_faces(self._layer, path, self._below.prim(shown), ~moves)
        if touched:
            make_collider(spec, self._below.prim(shown).GetTypeName())
        return path

    def _touch_item(self, mesh: int) -> Any:
        """A copy of a point instancer's item for engines alone: an item is no prim that could be touched."""
        shown = self._below.meshes[mesh]
        path = Sdf.Path(COLLIDERS).AppendChild(f"item_{mesh}")
        prim = self._below.prim(shown)
        spec = self._alone(path, prim)
        place(spec, shown.matrix @ self._to_world)
        set_attribute(spec, "purpose", "Token", "guide", uniform=True)
        make_collider(spec, prim.GetTypeName())
        return path

    def _filter(self, devices: Sequence[Device], reached: dict[int, Any]) -> None:
        """Lets no wheel touch its own valve: the stem goes through its hub."""
        row = {path: i for i, path in enumerate(self._scene.paths)}
        meshes_of_part = {part.id: part.meshes for part in self._graph.of_layer(Part)}
        for device in devices:
            own = (row[mesh] for part in device.unit.parts for mesh in meshes_of_part.get(part, ()))
            targets = [reached[mesh] for mesh in own if mesh in reached]
            if targets and not device.is_needle:
                body = over(self._layer, Sdf.Path(DEVICES).AppendChild(device.joint))
                apply_schemas(body, "PhysicsFilteredPairsAPI")
                point_at(body, "physics:filteredPairs", targets)


def _to_stage(scene: Scene, converted: bool) -> Floats:
    """``(4, 4)`` for row vectors, from the world of the source to the stage: metres, Z up, about the scene's origin."""
    matrix = np.eye(4) if converted else metres_z_up(scene.source.meters_per_unit, scene.source.up_axis)
    matrix[3, :3] -= scene.origin
    return matrix
