"""Labels in the prims of a flattened layer: in prototypes too, which are split where their instances differ.

A flattened layer holds each prototype of native instances once, as a root prim that its instances refer to. What is
labelled the same goes on sharing one; each other way to label a prototype gets a copy of it, or stands opened in its
place where only one instance is labelled so. Prototypes of point instancers are split in the same way, and their items
sent to the copy with their label.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from pxr import Sdf, Vt

from cadgraph.export.usd_labels import Said, label_prim, said_of, shared_parts, trace_of
from cadgraph.export.usd_specs import apply_schemas, claim
from cadgraph.load.usd_shapes import SHAPES
from cadgraph.model.records import Part
from cadgraph.model.scene import Ints

__all__ = ["LayerLabels"]

_MESHES = ("Mesh", *SHAPES)
_INSTANCER = "PointInstancer"
_PLACE = "__cadgraph_opened"
_BINDING = "material:binding"
_NOWHERE = "\0"  # no path of a scene begins so
Signature = tuple[tuple[str, Said], ...]


class LayerLabels:
    """Labels the prims of a flattened layer.

    Args:
        layer: changed in place.
        parts: the part of each mesh by its path in the scene, None where it belongs to none.
        dispositions: what can be done at meshes, by path.
        open_all: whether to open all native instances.

    After :meth:`write`, ``n_kept`` and ``n_opened`` count native instances, ``n_split`` the prototypes that were added
    to point instancers, and ``mixed`` names point instancers whose items keep labels that not all of them have.
    """

    def __init__(
        self,
        layer: Any,
        parts: Mapping[str, Part | None],
        dispositions: Mapping[str, tuple[str, ...]],
        open_all: bool = False,
    ) -> None:
        self._open_all = open_all
        self._layer = layer
        self._parts = parts
        self._said = {
            path: said_of(part, dispositions.get(path, ())) if part is not None else None
            for path, part in parts.items()
        }
        self._paths = sorted(parts)
        self._uses: Counter[tuple[Any, Signature]] = Counter()
        self._made: dict[tuple[Any, Signature], Any] = {}
        self._taken = {prim.name for prim in layer.rootPrims}
        self._ways: Counter[Any] = Counter()
        self._within: list[Any] = []
        self.n_kept = self.n_opened = self.n_split = 0
        self.mixed: list[str] = []

    def write(self) -> None:
        """Labels all prims."""
        found = {_prototype_of(spec) for spec in _specs(self._layer.pseudoRoot)}
        old = {path for path in found if path is not None and self._layer.GetPrimAtPath(path)}
        roots = [spec for spec in self._layer.rootPrims if spec.path not in old]
        for spec in roots:
            self._survey(spec, str(spec.path))
        self._ways = Counter(prototype for prototype, _ in self._uses)
        for spec in roots:
            self._visit(spec, str(spec.path), shared=False)
        for spec in _specs(self._layer.pseudoRoot):
            # What stands below an instancer without being one of its prototypes is drawn nowhere, but there.
            prototype = _prototype_of(spec)
            if prototype in old and not any(spec.path.HasPrefix(path) for path in old):
                self._instance(spec, prototype, _NOWHERE, shared=True)
        for path in sorted(old, key=str):
            del self._layer.rootPrims[path.name]

    # What stands at a path of the scene

    def _own(self, scene: str, type_name: str) -> Said | None:
        """What the prim at a path of the scene is said to be."""
        if scene in self._said and (not scene.endswith("]") or type_name in _MESHES):
            return self._said[scene]
        item = self._item_of(scene) if type_name in _MESHES else None
        return self._said[item] if item is not None else None

    def _item_of(self, scene: str) -> str | None:
        """The item that a path lies in, where the whole item is one mesh of the scene."""
        end = scene.rfind("]")
        while end >= 0:
            if scene[: end + 1] in self._said:
                return scene[: end + 1]
            end = scene.rfind("]", 0, end)
        return None

    def _below(self, scene: str) -> Iterator[str]:
        """The paths of the scene below one."""
        for first, behind in (("/", "0"), ("[", "\\")):
            yield from self._paths[bisect_left(self._paths, scene + first) : bisect_left(self._paths, scene + behind)]

    def _signature(self, scene: str, whole: bool) -> Signature:
        """All labels below a path of the scene, and its own where the whole of it is asked for."""
        # An item that is one mesh of the scene may be an instance, or hold one, with that mesh somewhere in it.
        item = self._item_of(scene)
        own = scene if whole and scene in self._said else item
        found = ((path[len(scene) :], self._said[path]) for path in (own, *self._below(scene)) if path is not None)
        return tuple((rest, said) for rest, said in found if said is not None)

    def _common(self, scene: str) -> Said | None:
        """What all meshes below a path are said to be, if it is the same."""
        found = {self._said[path] for path in self._below(scene)}
        return found.pop() if len(found) == 1 else None

    # How often each prototype is labelled in the same way

    def _survey(self, spec: Any, scene: str) -> None:
        prototype = _prototype_of(spec)
        if prototype is not None:
            key = prototype, self._signature(scene, whole=False)
            self._uses[key] += 1
            if self._uses[key] == 1:
                self._survey_inside(self._layer.GetPrimAtPath(prototype), scene)
            return
        self._survey_inside(spec, scene)

    def _survey_inside(self, spec: Any, scene: str) -> None:
        if spec is None:
            return
        if spec.typeName == _INSTANCER:
            for target, groups in self._items(spec, scene):
                for items in groups.values():
                    self._survey_item(target, f"{scene}[{items[0]}]")
            return
        for child in spec.nameChildren:
            self._survey(child, f"{scene}/{child.name}")

    def _survey_item(self, target: Any, scene: str) -> None:
        prim = self._layer.GetPrimAtPath(target)
        if prim is not None and target not in self._within:
            self._within.append(target)
            self._survey(prim, scene)
            self._within.pop()

    # Labels

    def _visit(self, spec: Any, scene: str, shared: bool) -> None:
        said = self._own(scene, spec.typeName)
        if said is not None:
            part = self._parts.get(scene)
            label_prim(spec, said, trace_of(part) if part is not None and not shared else None)
        prototype = _prototype_of(spec)
        if prototype is not None:
            self._instance(spec, prototype, scene, shared)
        else:
            self._inside(spec, scene, shared)

    def _inside(self, spec: Any, scene: str, shared: bool) -> None:
        if spec.typeName == _INSTANCER:
            self._instancer(spec, scene, shared)
            return
        for child in list(spec.nameChildren):
            self._visit(child, f"{scene}/{child.name}", shared)

    def _instance(self, spec: Any, prototype: Any, scene: str, shared: bool) -> None:
        key = prototype, self._signature(scene, whole=False)
        alone = self._uses[key] == 1 and self._ways[prototype] > 1
        if self._open_all or alone or spec.typeName == _INSTANCER:
            self.n_opened += 1
            self._inside(self._open(spec, prototype), scene, shared)
            return
        self.n_kept += 1
        if key not in self._made:
            self._made[key] = path = Sdf.Path.absoluteRootPath.AppendChild(claim("Prototype", self._taken))
            Sdf.CopySpec(self._layer, prototype, self._layer, path)
            self._inside(self._layer.GetPrimAtPath(path), scene, shared=True)
        spec.SetInfo("references", _one_reference(self._made[key]))
        self._stand_for(spec, scene, shared)

    def _open(self, spec: Any, prototype: Any) -> Any:
        """Puts what an instance shows into it; its own opinions stay."""
        path, place = spec.path, Sdf.Path.absoluteRootPath.AppendChild(_PLACE)
        Sdf.CopySpec(self._layer, prototype, self._layer, place)
        opened = self._layer.GetPrimAtPath(place)
        for key in spec.ListInfoKeys():
            if key not in ("references", "instanceable"):
                opened.SetInfo(key, spec.GetInfo(key))
        for own in list(spec.properties):
            Sdf.CopySpec(self._layer, own.path, self._layer, place.AppendProperty(own.name))
        # Whatever of it points into the prototype now points into this prim.
        Sdf.CopySpec(self._layer, place, self._layer, path)
        del self._layer.rootPrims[_PLACE]
        return self._layer.GetPrimAtPath(path)

    def _stand_for(self, spec: Any, scene: str, shared: bool) -> None:
        """Labels what carries others, where they are all the same, and names their parts."""
        common = self._common(scene)
        if common is not None and self._own(scene, spec.typeName) is None:
            label_prim(spec, common)
        found = (self._parts[path] for path in self._below(scene))
        parts = list({part.id: part for part in found if part is not None}.values())
        if parts and not shared:
            spec.customData = {**dict(spec.customData), "cadgraph": shared_parts(parts)}

    # Point instancers

    def _items(self, spec: Any, scene: str) -> list[tuple[Any, dict[Signature, list[int]]]]:
        """The items of each prototype of an instancer by their labels; those that aren't shown are with the first."""
        prototypes = spec.relationships.get("prototypes")
        if prototypes is None:
            return []
        found: list[tuple[Any, dict[Signature, list[int]]]] = []
        indices, _ = _indices(spec)
        for number, target in enumerate(prototypes.targetPathList.GetAddedOrExplicitItems()):
            groups: dict[Signature, list[int]] = {}
            unseen = []
            for item in np.flatnonzero(indices == number).tolist():
                path = f"{scene}[{item}]"
                if path in self._said or next(self._below(path), None) is not None or self._item_of(path):
                    groups.setdefault(self._signature(path, whole=True), []).append(item)
                else:
                    unseen.append(item)
            if unseen:
                first = next(iter(groups), ())
                groups.setdefault(first, []).extend(unseen)
            found.append((target, groups))
        return found

    def _instancer(self, spec: Any, scene: str, shared: bool) -> None:
        indices, sampled = _indices(spec)
        moved = np.full_like(indices, -1)
        names = {child.name for child in spec.nameChildren}
        placed: list[tuple[Any, str]] = []
        targets: list[Any] = []
        for target, groups in self._items(spec, scene):
            first = len(targets)
            targets.append(target)
            by_size = sorted(groups.items(), key=lambda group: (-len(group[1]), group[1][0]))
            if sampled and len(by_size) > 1:
                # To send an item elsewhere, all its samples would have to be.
                self.mixed.append(scene)
                by_size = [(by_size[0][0], [item for _, items in by_size for item in items])]
            for number, (signature, items) in enumerate(by_size):
                at = target
                if number or (signature and not target.HasPrefix(spec.path)):
                    at = self._copied(target, spec.path, names)
                if number:
                    self.n_split += 1
                    targets.append(at)
                    moved[items] = len(targets) - 1
                else:
                    targets[first] = at
                    moved[items] = first
                placed.append((at, f"{scene}[{items[0]}]"))
        if not sampled and not np.array_equal(moved, indices):
            values = Vt.IntArray.FromNumpy(moved.astype(np.int32))
            spec.attributes["protoIndices"].default = values
        self._finish_instancer(spec, scene, targets, placed, shared)

    def _finish_instancer(
        self, spec: Any, scene: str, targets: Sequence[Any], placed: Sequence[tuple[Any, str]], shared: bool
    ) -> None:
        if targets:
            spec.relationships["prototypes"].targetPathList.explicitItems = list(targets)
        for at, item in placed:
            prim = self._layer.GetPrimAtPath(at)
            if prim is not None and at not in self._within:
                self._within.append(at)
                self._visit(prim, item, shared=True)
                self._within.pop()
        self._stand_for(spec, scene, shared)

    def _copied(self, target: Any, below: Any, names: set[str]) -> Any:
        """A copy of a prototype below its instancer, with the material that it inherited where it was."""
        path = below.AppendChild(claim(target.name, names))
        prim = self._layer.GetPrimAtPath(target)
        if prim is None or below.HasPrefix(target):
            return target
        Sdf.CopySpec(self._layer, target, self._layer, path)
        above = prim.nameParent
        while _BINDING not in prim.relationships and above is not None and above.path != below:
            if _BINDING in above.relationships:
                copy = self._layer.GetPrimAtPath(path)
                bound, own = above.path.AppendProperty(_BINDING), path.AppendProperty(_BINDING)
                Sdf.CopySpec(self._layer, bound, self._layer, own)
                apply_schemas(copy, "MaterialBindingAPI")
                break
            above = above.nameParent
        return path


def _specs(spec: Any) -> Iterator[Any]:
    """A prim and all below it."""
    waiting = [spec]
    while waiting:
        here = waiting.pop()
        yield here
        waiting.extend(reversed(list(here.nameChildren)))


def _prototype_of(spec: Any) -> Any:
    """The root prim that an instance refers to within its layer; None where a prim is no instance."""
    if not spec.HasInfo("instanceable") or not spec.GetInfo("instanceable") or not spec.HasInfo("references"):
        return None
    references = spec.GetInfo("references").GetAddedOrExplicitItems()
    return references[0].primPath if len(references) == 1 and not references[0].assetPath else None


def _one_reference(path: Any) -> Any:
    references = Sdf.ReferenceListOp()
    references.explicitItems = [Sdf.Reference("", path)]
    return references


def _indices(spec: Any) -> tuple[Ints, bool]:
    """The prototype of each item, and whether that changes over time: then as it is first."""
    attribute = spec.attributes.get("protoIndices")
    if attribute is None:
        return np.zeros(0, np.int64), False
    times = sorted(attribute.layer.ListTimeSamplesForPath(attribute.path))
    value = attribute.default
    if value is None and times:
        value = attribute.layer.QueryTimeSample(attribute.path, times[0])
    numbers: Ints = np.asarray(value if value is not None else (), np.int64)
    return numbers, bool(times)
