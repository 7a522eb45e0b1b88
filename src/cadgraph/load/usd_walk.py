"""The walk over a USD stage: which meshes there are, where they stand, what they inherit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from pxr import Tf, Usd, UsdGeom, UsdShade

from cadgraph.load.budget import Budget
from cadgraph.load.packing import Notes
from cadgraph.load.usd_color import usable_color
from cadgraph.load.usd_mesh import RawMesh
from cadgraph.load.usd_shapes import SHAPES
from cadgraph.model.scene import Floats, Ints

__all__ = ["Placement", "Walk", "message_of"]

Color = npt.NDArray[np.float64]
Varying = tuple[Floats, str]
Bindings = tuple[str, ...]

_VISIBLE_SCENE = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
# Prototypes of a point instancer are often kept under an over or a class, where no prim counts as defined.
_PROTOTYPE = Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsLoaded & Usd.PrimHasDefiningSpecifier)
_WATCHED = 1000  # prims from one look at the memory to the next; they take a few megabytes
_HIDDEN = ("hidden", "left out: hidden in the file; set load.invisible = true to load it")
_INACTIVE = (
    "inactive-item",
    "left out: the point instancer says that this item is inactive; activate it in the source",
)
_IDENTITY: Floats = np.eye(4)
_NO_INTS: Ints = np.zeros(0, np.int64)


class Placement(NamedTuple):
    """One mesh in one place.

    Args:
        path: in the scene; within the prototype of a point instancer: below that prototype.
        own_path: of the prim.
        geometry: key into ``Walk.geometries``; None where the mesh is not to be loaded.
        matrix: ``(4, 4)`` for row vectors, to the world (or to the parent of the prototype).
        color: ``displayColor``: one colour, or values with their interpolation.
        binding: paths of the prims that bind a material plainly, the mesh or the nearest above it first.
        anchor: path that carries opinions; None: ``path``.
        skipped: code and reason where it is not to be loaded.
    """

    path: str
    own_path: str
    geometry: str | None
    matrix: Floats
    color: Color | Varying | None
    binding: Bindings
    anchor: str | None
    skipped: tuple[str, str] | None = None


class _Place(NamedTuple):
    """What a prim has from those above it."""

    matrix: Floats = _IDENTITY
    visible: bool = True
    purpose: str = "default"
    color: Color | Varying | None = None
    binding: Bindings = ()
    anchor: str | None = None


class _Own(NamedTuple):
    """What a prim says of itself.

    Args:
        matrix: ``(4, 4)`` to the parent; None where it says nothing.
        resets: whether the matrix leads to the world instead.
        hidden: whether it is.
        purpose: None where it says nothing.
        color: likewise.
        binds: whether it binds a material plainly.
        instance: whether it is a native instance.
    """

    matrix: Floats | None
    resets: bool
    hidden: bool
    purpose: str | None
    color: Color | Varying | None
    binds: bool
    instance: bool

    def under(self, above: _Place, path: str, own_path: str) -> _Place:
        """What the prim hands down, at a path of the scene."""
        matrix = above.matrix
        if self.matrix is not None:
            matrix = self.matrix if self.resets else self.matrix @ matrix
        return _Place(
            matrix,
            above.visible and not self.hidden,
            self.purpose or above.purpose,
            above.color if self.color is None else self.color,
            (own_path, *above.binding) if self.binds else above.binding,
            path if self.instance and above.anchor is None else above.anchor,
        )


class _Inner(NamedTuple):
    """A prim below a native instance, as all instances of the same prototype have it.

    Args:
        path: from the instance on.
        above: number of the one above it among all below the instance; -1: the instance itself.
        own: what it says of itself.
        kind: of geometry; empty: none.
        type_name: of the prim.
        geometry: key of its shape.
    """

    path: str
    above: int
    own: _Own
    kind: str
    type_name: str
    geometry: str


class Walk:
    """Goes over a stage once and gathers all its meshes.

    Args:
        stage: the open stage.
        purposes: what counts as geometry.
        invisible: whether what is hidden is loaded too.
        time: time code, or None for the default time, else the first sample.
        sides: of round shapes.
        notes: gets what was skipped or repaired.
        budget: how much its meshes may be.

    ``geometries`` holds each mesh of the file once, however often it is placed; ``has_bindings`` says whether any
    prim binds a material.
    """

    def __init__(
        self,
        stage: Any,
        purposes: Sequence[str],
        invisible: bool,
        time: float | None,
        sides: int,
        notes: Notes,
        budget: Budget,
    ) -> None:
        self._stage = stage
        self._purposes = frozenset(purposes)
        self._invisible = invisible
        self._time = None if time is None else Usd.TimeCode(time)
        self._sides = sides
        self._notes = notes
        self._budget = budget
        self._visited = 0
        self._sampled = _is_sampled(stage)
        self._transforms = UsdGeom.XformCache(self._time or Usd.TimeCode.Default())
        self._kinds: dict[str, str] = {}
        self._placeable: dict[str, bool] = {}
        self._fallbacks: dict[tuple[str, str], Any] = {}
        self._open_instancers: list[str] = []
        self._prototypes: dict[tuple[str, bool], list[_Inner] | None] = {}
        self.geometries: dict[str, RawMesh] = {}
        self.has_bindings = False

    def placements(self) -> list[Placement]:
        """All meshes of the stage.

        Raises:
            LoadError: they are more than the settings allow.
        """
        try:
            return self._below(self._stage.GetPseudoRoot(), _Place(), _VISIBLE_SCENE, 0)
        except MemoryError:
            self._budget.refuse_arrays()
            raise
        finally:
            self._budget.unwatch()

    def _below(self, root: Any, place: _Place, predicate: Any, cut: int) -> list[Placement]:
        """All meshes at or below a prim; ``cut`` characters are taken off the front of their paths."""
        found: list[Placement] = []
        stack = [(root, place)]
        while stack:
            prim, above = stack.pop()
            self._count(1)
            own_path = str(prim.GetPath())
            path = own_path[cut:]
            try:
                own = self._own(prim)
                here = own.under(above, path, own_path)
                kind = self._kind(prim)
                if kind == "instancer":
                    found.extend(self._instances(prim, here, path))
                    self._budget.check_meshes(len(found))
                    continue
                if kind:
                    key = _key(prim, own_path)
                    found.append(self._placed(path, own_path, kind, prim.GetTypeName(), key, here, predicate, found))
                children = prim.GetFilteredChildren(predicate)
                if not children:
                    continue
                below = _handed_down(here, above)
                inner = self._inner(prim, predicate) if own.instance else None
                if inner is None:
                    stack.extend((child, below) for child in children)
                else:
                    self._place_inner(inner, below, own_path, cut, predicate, found)
            except (Tf.ErrorException, UnicodeDecodeError) as error:
                self._note_unreadable(error, own_path)
        return found

    def _count(self, prims: int) -> None:
        """Counts prims that are visited, and looks at the memory from time to time."""
        before = self._visited
        self._visited += prims
        if before % _WATCHED == 0 or before // _WATCHED < self._visited // _WATCHED:
            self._budget.watch()
        if self._visited > self._budget.most_prims:
            self._budget.check_prims(self._visited)

    def _inner(self, instance: Any, predicate: Any) -> list[_Inner] | None:
        """What stands below a native instance, each prim before those below it; read once for all that share it.

        None where it has to be walked through for each: it holds point instancers, or something can't be read.
        """
        key = str(instance.GetPrototype().GetPath()), predicate is _PROTOTYPE
        if key not in self._prototypes:
            try:
                self._prototypes[key] = self._read_inner(instance, predicate)
            except (Tf.ErrorException, UnicodeDecodeError):
                self._prototypes[key] = None
        return self._prototypes[key]

    def _read_inner(self, instance: Any, predicate: Any) -> list[_Inner] | None:
        found: list[_Inner] = []
        cut = len(str(instance.GetPath()))
        stack = [(child, -1) for child in instance.GetFilteredChildren(predicate)]
        while stack:
            prim, above = stack.pop()
            if len(found) % _WATCHED == 0:
                self._budget.watch()
                self._budget.check_prims(self._visited + len(found))
            kind, path = self._kind(prim), str(prim.GetPath())
            if kind == "instancer":
                return None
            key = _key(prim, path) if kind else ""
            found.append(_Inner(path[cut:], above, self._own(prim), kind, prim.GetTypeName(), key))
            stack.extend((child, len(found) - 1) for child in prim.GetFilteredChildren(predicate))
        return found

    def _place_inner(
        self, inner: list[_Inner], place: _Place, instance: str, cut: int, predicate: Any, found: list[Placement]
    ) -> None:
        """Adds the meshes below an instance at a path, as a walk through it would find them."""
        self._count(len(inner))
        handed: list[_Place | None] = []
        for each in inner:
            above = place if each.above < 0 else handed[each.above]
            if above is None:
                handed.append(None)
                continue
            own_path = instance + each.path
            here = each.own.under(above, own_path[cut:], own_path)
            below: _Place | None = _handed_down(here, above)
            if each.kind:
                try:
                    placed = self._placed(
                        own_path[cut:], own_path, each.kind, each.type_name, each.geometry, here, predicate, found
                    )
                    found.append(placed)
                except (Tf.ErrorException, UnicodeDecodeError) as error:
                    self._note_unreadable(error, own_path)
                    below = None
            handed.append(below)

    def _placed(
        self, path: str, own_path: str, kind: str, type_name: str, key: str, here: _Place, predicate: Any,
        found: list[Placement],
    ) -> Placement:  # fmt: skip
        """A mesh in its place; its shape is read if it is new."""
        if len(found) >= self._budget.most_meshes:
            self._budget.check_meshes(len(found) + 1)
        skipped = self._reason_to_skip(kind, here, type_name)
        if not skipped and key not in self.geometries:
            prim = self._stage.GetPrimAtPath(own_path)
            self.geometries[key] = self._mesh(prim, predicate) if kind == "mesh" else self._shape(prim, kind, own_path)
        return Placement(
            path, own_path, None if skipped else key, here.matrix, here.color, here.binding, here.anchor, skipped
        )

    def _note_unreadable(self, error: Exception, path: str) -> None:
        self._notes.add("unreadable", f"left out with all below: {_first_line(error)}", path)

    def _kind(self, prim: Any) -> str:
        name = prim.GetTypeName()
        if name not in self._kinds:
            self._kinds[name] = _kind_of(prim, name)
        return self._kinds[name]

    def _is_placeable(self, prim: Any) -> bool:
        name = prim.GetTypeName()
        if name not in self._placeable:
            self._placeable[name] = bool(prim.IsA(UsdGeom.Xformable))
        return self._placeable[name]

    def _own(self, prim: Any) -> _Own:
        """What a prim says of itself."""
        names = frozenset(prim.GetAuthoredPropertyNames())
        matrix, resets = None, False
        if "xformOpOrder" in names and self._is_placeable(prim):
            matrix, resets = self._local(prim)
        binds = "material:binding" in names or "material:binding:full" in names
        if not self.has_bindings:
            self.has_bindings = any(name.startswith("material:binding") for name in names)
        return _Own(
            matrix,
            resets,
            "visibility" in names and self._value(prim, "visibility") == "invisible",
            self._value(prim, "purpose") if "purpose" in names else None,
            self._display_color(prim) if "primvars:displayColor" in names else None,
            binds,
            prim.IsInstance(),
        )

    def _value(self, prim: Any, name: str) -> Any:
        return self._read(prim.GetAttribute(name))

    def _read(self, attribute: Any) -> Any:
        """The value at the time asked for, else the default, else the first sample."""
        if not attribute:
            return None
        if self._time is not None:
            return attribute.Get(self._time)
        value = attribute.Get()
        if self._sampled and attribute.GetNumTimeSamples() and (value is None or not _has_default(attribute)):
            value = attribute.Get(Usd.TimeCode.EarliestTime())
        return value

    def _local(self, prim: Any) -> tuple[Floats, bool]:
        """The matrix to the parent, and whether it leads straight to the world instead."""
        ops = UsdGeom.Xformable(prim).GetOrderedXformOps() if self._sampled and self._time is None else ()
        if not any(op.GetNumTimeSamples() for op in ops):
            matrix, resets = self._transforms.GetLocalTransformation(prim)
            return np.array(matrix), resets
        local = np.eye(4)
        for op in ops:
            sampled = op.GetNumTimeSamples() and not _has_default(op.GetAttr())
            time = Usd.TimeCode.EarliestTime() if sampled else Usd.TimeCode.Default()
            local = np.array(op.GetOpTransform(time)) @ local
        return local, UsdGeom.Xformable(prim).GetResetXformStack()

    def _display_color(self, prim: Any) -> Color | Varying | None:
        attribute = prim.GetAttribute("primvars:displayColor")
        values = _rows(self._read(attribute))
        if values is None or not len(values):
            return None
        indices = prim.GetAttribute("primvars:displayColor:indices")
        if indices and indices.HasAuthoredValue():
            order = _ints(self._read(indices))
            values = values[order[(order >= 0) & (order < len(values))]]
        interpolation = attribute.GetMetadata("interpolation") or "constant"
        if len(values) == 1:
            return usable_color(values[0])
        if interpolation == "constant":
            return usable_color(values.mean(axis=0)) if len(values) else None
        return values.astype(np.float64), str(interpolation)

    def _reason_to_skip(self, kind: str, place: _Place, type_name: str) -> tuple[str, str] | None:
        if kind == "unsupported":
            return "unsupported-geometry", f"left out: {type_name} is no mesh; convert it in the source"
        if place.purpose not in self._purposes:
            return "other-purpose", f"left out: purpose {place.purpose!r}; add it to load.purposes to load it"
        if not place.visible and not self._invisible:
            return _HIDDEN
        return None

    def _mesh(self, prim: Any, predicate: Any) -> RawMesh:
        names = frozenset(prim.GetAuthoredPropertyNames())
        points, indices = _rows(self._value(prim, "points")), _ints(self._value(prim, "faceVertexIndices"))
        counts = _ints(self._value(prim, "faceVertexCounts"))
        # A polygon of n corners becomes n - 2 triangles; what is damaged takes memory, too.
        self._budget.take_triangles(max(len(indices) - 2 * len(counts), len(indices) // 3, len(counts) // 3))
        return RawMesh(
            points=np.zeros((0, 3)) if points is None else points,
            counts=counts,
            indices=indices,
            left_handed=self._choice(prim, "orientation", names) == "leftHanded",
            holes=_ints(self._choice(prim, "holeIndices", names)),
            subdivided=self._choice(prim, "subdivisionScheme", names) != "none",
            subsets=tuple(
                (child.GetName(), _ints(self._value(child, "indices")))
                for child in prim.GetFilteredChildren(predicate)
                if child.GetTypeName() == "GeomSubset" and self._is_material_subset(child)
            ),
        )

    def _choice(self, prim: Any, name: str, names: frozenset[str]) -> Any:
        """The value of an attribute that files seldom author; else what its type falls back to, looked up once."""
        if name in names:
            return self._value(prim, name)
        key = (prim.GetTypeName(), name)
        if key not in self._fallbacks:
            self._fallbacks[key] = self._value(prim, name)
        return self._fallbacks[key]

    def _is_material_subset(self, prim: Any) -> bool:
        family = self._value(prim, "familyName")
        return self._value(prim, "elementType") == "face" and (
            family == UsdShade.Tokens.materialBind or (not family and prim.HasRelationship("material:binding"))
        )

    def _shape(self, prim: Any, kind: str, own_path: str) -> RawMesh:
        names, make = SHAPES[kind]
        sizes = {name: self._value(prim, name) for name in names}
        numbers = [value for value in sizes.values() if not isinstance(value, str)]
        if not all(isinstance(value, int | float) and np.isfinite(value) and value >= 0 for value in numbers):
            said = ", ".join(f"{name} {value}" for name, value in sizes.items() if not isinstance(value, str))
            self._notes.add("invalid-size", f"no surface can be made of it: {said}", own_path)
            return RawMesh(np.zeros((0, 3)), np.zeros(0, np.int64), np.zeros(0, np.int64))
        points, faces = make(sizes, self._sides)
        return RawMesh(
            points=points,
            counts=np.full(len(faces), 3, np.int64),
            indices=faces.reshape(-1).astype(np.int64),
            left_handed=self._value(prim, "orientation") == "leftHanded",
        )

    def _instances(self, prim: Any, place: _Place, path: str) -> list[Placement]:
        """The meshes of all items of a point instancer: ``path[item]``, with what follows in the prototype."""
        own = str(prim.GetPath())
        if own in self._open_instancers:
            self._notes.add("invalid-instancer", "left out: a point instancer that holds itself", path)
            return []
        self._open_instancers.append(own)
        try:
            return self._items(prim, place, path)
        finally:
            self._open_instancers.pop()

    def _items(self, prim: Any, place: _Place, path: str) -> list[Placement]:
        instancer = UsdGeom.PointInstancer(prim)
        prototype_of_item = _ints(self._read(instancer.GetProtoIndicesAttr()))
        self._budget.check_meshes(len(prototype_of_item))
        matrices = self._item_matrices(instancer, len(prototype_of_item))
        if len(matrices) < len(prototype_of_item):
            message = "items without a position, or with a wrong number of orientations or scales, were repaired"
            self._notes.add("invalid-instancer", message, path)
        own = None if isinstance(place.color, tuple) else place.color
        inherited = place._replace(matrix=_IDENTITY, color=own, anchor=place.anchor or path)
        prototypes = [
            self._prototype(target, inherited) for target in instancer.GetPrototypesRel().GetForwardedTargets()
        ]
        if len(prototype_of_item) and not (0 <= prototype_of_item.min() <= prototype_of_item.max() < len(prototypes)):
            self._notes.add("invalid-instancer", "items that name a prototype which doesn't exist were dropped", path)
        named, items = np.unique(prototype_of_item, return_counts=True)
        self._budget.check_meshes(
            sum(
                len(prototypes[which]) * n
                for which, n in zip(named.tolist(), items.tolist(), strict=True)
                if 0 <= which < len(prototypes)
            )
        )
        hidden = self._hidden_items(instancer, len(prototype_of_item))
        item_colors = None
        if isinstance(place.color, tuple) and len(place.color[0]) == len(prototype_of_item):
            item_colors = place.color[0]
        found = []
        for item, matrix in enumerate(matrices):
            which = int(prototype_of_item[item])
            if not 0 <= which < len(prototypes):
                continue
            color = own if item_colors is None else item_colors[item]
            skipped = hidden.get(item)
            for part in prototypes[which]:
                found.append(
                    part._replace(
                        path=f"{path}[{item}]{part.path if len(prototypes[which]) > 1 else ''}",
                        matrix=part.matrix @ matrix @ place.matrix,
                        color=part.color if part.color is not None else color,
                        geometry=part.geometry if skipped is None else None,
                        skipped=part.skipped if skipped is None else skipped,
                    )
                )
        return found

    def _prototype(self, target: Any, place: _Place) -> list[Placement]:
        prim = self._stage.GetPrimAtPath(target)
        if not prim:
            self._notes.add("missing-prototype", "a point instancer names a prototype that doesn't exist", str(target))
            return []
        return self._below(prim, place, _PROTOTYPE, len(str(target)))

    def _hidden_items(self, instancer: Any, n: int) -> dict[int, tuple[str, str]]:
        """Items that are deactivated, and those that the file hides unless they are asked for, with what is said."""
        inactive = instancer.GetPrim().GetMetadata("inactiveIds")
        off = set(inactive.GetAddedOrExplicitItems()) if inactive else set()
        hidden = () if self._invisible else _ints(self._read(instancer.GetInvisibleIdsAttr())).tolist()
        known = _ints(self._read(instancer.GetIdsAttr()))
        numbers = known.tolist() if len(known) == n else range(n)
        why = dict.fromkeys(hidden, _HIDDEN) | dict.fromkeys(off, _INACTIVE)
        return {i: why[number] for i, number in enumerate(numbers) if number in why}

    def _item_matrices(self, instancer: Any, n: int) -> Floats:
        """``(m, 4, 4)`` for row vectors, m the number of items that have a position, at most n."""
        positions = _rows(self._read(instancer.GetPositionsAttr()))
        positions = np.zeros((0, 3)) if positions is None else positions[:n].astype(np.float64)
        matrices = np.tile(_IDENTITY, (len(positions), 1, 1))
        orientations = self._read(instancer.GetOrientationsfAttr()) or self._read(instancer.GetOrientationsAttr())
        turns = np.asarray(orientations if orientations else np.zeros((0, 4)), np.float64).reshape(-1, 4)
        if len(turns) >= len(positions):
            matrices[:, :3, :3] = _rotations(turns[: len(positions)])
        scales = _rows(self._read(instancer.GetScalesAttr()))
        if scales is not None and len(scales) >= len(positions):
            matrices[:, :3, :3] = scales[: len(positions), :, None].astype(np.float64) * matrices[:, :3, :3]
        matrices[:, 3, :3] = positions
        return matrices


def _key(prim: Any, path: str) -> str:
    """By which its shape is known: that of the prototype for what stands below an instance."""
    return str(prim.GetPrimInPrototype().GetPath()) if prim.IsInstanceProxy() else path


def _handed_down(here: _Place, above: _Place) -> _Place:
    """What the prims below have: of the primvars only constant ones are inherited."""
    return here._replace(color=above.color) if isinstance(here.color, tuple) else here


def _is_sampled(stage: Any) -> bool:
    """Whether anything on a stage may vary over time; to ask each attribute costs as much as to read it."""
    if any(layer.ListAllTimeSamples() for layer in stage.GetUsedLayers()):
        return True
    # The layers of value clips are opened only when something is read from them.
    everywhere = [stage.TraverseAll(), *map(Usd.PrimRange.AllPrims, stage.GetPrototypes())]
    return any(prim.HasAuthoredMetadata("clips") for prims in everywhere for prim in prims)


def _kind_of(prim: Any, name: str) -> str:
    if prim.IsA(UsdGeom.Mesh):
        return "mesh"
    if name in SHAPES:
        return str(name)
    if prim.IsA(UsdGeom.PointInstancer):
        return "instancer"
    return "unsupported" if prim.IsA(UsdGeom.Gprim) else ""


def _has_default(attribute: Any) -> bool:
    return bool(attribute.GetResolveInfo(Usd.TimeCode.Default()).GetSource() == Usd.ResolveInfoSourceDefault)


def _rows(value: Any) -> npt.NDArray[np.floating] | None:
    """An array of 3-vectors, or None where the value is none."""
    if value is None:
        return None
    rows = np.asarray(value)
    if rows.ndim != 2 or rows.shape[1] != 3 or rows.dtype.kind not in "fiu":
        return None
    return rows if rows.dtype.kind == "f" else rows.astype(np.float64)


def _ints(value: Any) -> Ints:
    """An array of signed integers, of 32 bits where the file has them so; empty where the value is none."""
    if value is None:
        return _NO_INTS
    numbers = np.asarray(value)
    if numbers.ndim != 1 or numbers.dtype.kind not in "iu":
        return _NO_INTS
    return numbers if numbers.dtype in (np.int32, np.int64) else numbers.astype(np.int64)


def _rotations(quaternions: Floats) -> Floats:
    """``(n, 3, 3)`` rotations for row vectors of quaternions x, y, z, w; of length zero: none."""
    length = np.linalg.norm(quaternions, axis=1, keepdims=True)
    unit = np.where(length > 0, quaternions / np.where(length > 0, length, 1), [0, 0, 0, 1])
    x, y, z, w = unit.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
        [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
        [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(rows).transpose(2, 0, 1)


def message_of(say: Callable[[], str]) -> str:
    """What the USD library says, on one line; its text may quote bytes of the file that are not UTF-8."""
    try:
        return " ".join(say().split())
    except UnicodeDecodeError:
        return "it holds text that is not UTF-8 where the reader stumbled; save it as UTF-8"


def _first_line(error: Exception) -> str:
    text = message_of(lambda: str(error))
    if "exception thrown unpacking a value" in text:
        return "a value can't be unpacked: it is damaged, or takes more memory than any real one"
    quoted = text.split(": '", 1)
    return (quoted[1] if len(quoted) == 2 else text)[:200].rstrip("'")
