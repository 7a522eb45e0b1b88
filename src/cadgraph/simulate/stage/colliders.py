"""Colliders of what stands still, as opinions over the source: triangle meshes, which cost nothing until touched.

An instance shares its meshes with all others of its kind and hides them from opinions. It is given a reference to a
prim of ours that holds them, so that it stays an instance.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pxr import Sdf

from cadgraph.export.usd_specs import apply_schemas, set_attribute
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.simulate.stage.specs import over

__all__ = ["COLLIDERS", "PLANT", "SCENE", "collide", "make_collider", "placed_at", "without_collider"]

PLANT, SCENE, COLLIDERS = "/Plant", "/Plant/Scene", "/Plant/Colliders"
"""The plant, its source in it, and what the source has no place for."""

_UNTOUCHED = frozenset(
    ("bolt", "nut", "washer", "stud", "screw", "gasket", "gauge face", "gauge needle", "gauge glass")
)  # fmt: skip


def placed_at(path: Any) -> Any:
    """Where a prim of the source is in the stage."""
    return Sdf.Path(f"{SCENE}{path}")


def without_collider(graph: SceneGraph) -> set[str]:
    """The source paths of meshes that nobody bumps into: bolts, gaskets, dials, and what is enclosed on all sides."""
    found: set[str] = set()
    for part in graph.of_layer(Part):
        if part.inside is not None or (part.label is not None and part.label.name in _UNTOUCHED):
            found.update(part.meshes)
    return found


def collide(layer: Any, prims: Sequence[Any]) -> None:
    """Gives each of these prims of the source, which may be instance proxies, its collider."""
    inside: dict[Any, list[Any]] = {}
    for prim in prims:
        root = _instance_above(prim)
        if root is None:
            make_collider(over(layer, placed_at(prim.GetPath())), prim.GetTypeName())
        else:
            inside.setdefault(root, []).append(prim)
    holders = _Holders(layer)
    for root, meshes in inside.items():
        spec = over(layer, placed_at(root.GetPath()))
        spec.referenceList.prependedItems = [Sdf.Reference("", holders.over_instance(root.GetPath(), meshes))]


def make_collider(spec: Any, type_name: str, approximation: str = "none") -> None:
    """Lets a prim be touched: a mesh by its triangles, unless it moves; a sphere or cylinder as such."""
    apply_schemas(spec, "PhysicsCollisionAPI")
    if type_name == "Mesh":
        apply_schemas(spec, "PhysicsMeshCollisionAPI")
        set_attribute(spec, "physics:approximation", "Token", approximation, uniform=True)


def _instance_above(prim: Any) -> Any:
    """The outermost instance that a prim lies in, or None."""
    if not prim.IsInstanceProxy():
        return None
    while prim.IsInstanceProxy():
        prim = prim.GetParent()
    return prim


class _Holders:
    """What instances refer to, each once for all instances with the same colliders."""

    def __init__(self, layer: Any) -> None:
        self._layer = layer
        self._made: dict[tuple[Any, ...], Any] = {}

    def over_instance(self, root: Any, meshes: Sequence[Any]) -> Any:
        """What an instance refers to, of which these meshes get colliders."""
        direct: list[tuple[str, str]] = []
        nested: dict[Any, list[Any]] = {}
        for mesh in meshes:
            inner = _first_instance_between(root, mesh)
            if inner is None:
                direct.append((str(mesh.GetPath().MakeRelativePath(root)), mesh.GetTypeName()))
            else:
                nested.setdefault(inner, []).append(mesh)
        deeper = [
            (str(inner.MakeRelativePath(root)), self.over_instance(inner, below)) for inner, below in nested.items()
        ]
        key = (*sorted(direct), None, *sorted(deeper))
        if key not in self._made:
            self._made[key] = self._make(direct, deeper)
        return self._made[key]

    def _make(self, direct: Sequence[tuple[str, str]], deeper: Sequence[tuple[str, Any]]) -> Any:
        path = Sdf.Path(COLLIDERS).AppendChild(f"Instance_{len(self._made):03d}")
        # Not even a class: it would make classes of the instances, and a stage shows none.
        over(self._layer, path)
        for relative, type_name in direct:
            make_collider(over(self._layer, path.AppendPath(relative)), type_name)
        for relative, held in deeper:
            inner = over(self._layer, path.AppendPath(relative))
            inner.referenceList.prependedItems = [Sdf.Reference("", held)]
        return path


def _first_instance_between(root: Any, mesh: Any) -> Any:
    """The path of the outermost instance strictly below a root and above a mesh, or None."""
    found, prim = None, mesh.GetParent()
    while prim.GetPath() != root:
        if prim.IsInstance():
            found = prim.GetPath()
        prim = prim.GetParent()
    return found
