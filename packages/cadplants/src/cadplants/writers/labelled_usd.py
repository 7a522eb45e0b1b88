"""A truth out of a USD file that carries labels: cadgraph's own ``semantics.usda``, or anybody's ``class`` labels."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.model.scene import Floats, Scene
from cadgraph.model.truth import Truth, TruthCluster, TruthConnection, TruthMesh, TruthPoint, TruthUnit
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary

__all__ = ["truth_from_usd"]

# UsdSemantics.LabelsAPI keeps the labels of a taxonomy in this attribute.
_ATTRIBUTE = "semantics:labels:{}"
_CLASS, _GROUP, _UNIT = "class", "cad_group", "cad_unit"
_POINTS = {"Junctions": "junction", "Terminals": "terminal"}


def truth_from_usd(
    path: str | Path, vocabulary: Vocabulary | None = None, *, asset_roots: Sequence[str | Path] = ()
) -> Truth:
    """Reads the labels in a USD file as a truth.

    Labels are those of ``UsdSemantics.LabelsAPI``, on the mesh or else on the nearest prim above it: ``class`` with a
    name or group of the vocabulary (capitals, underscores and hyphens don't matter), and ``cad_group`` where a file
    has it. ``cad_unit`` on a prim makes a unit of the meshes that its ``cadgraph:parts`` names, else of all below it.
    Clusters, junctions, terminals and connections are read where cadgraph wrote them. What a file doesn't carry is
    absent from the truth; contacts always are.

    Args:
        path: the file, or a label layer over it (``semantics.usda``).
        vocabulary: the label tree; the built-in one if None.
        asset_roots: folders that the file may refer to beside its own, as a label layer does over a scene elsewhere.

    Returns:
        A row for each mesh, with the path that ``cadgraph.load`` gives it; without group where nothing in the
        vocabulary labels it.

    Raises:
        LoadError: the file can't be read, or no mesh in it carries a label of the vocabulary.
    """
    # Loading first also proves, in a process of its own, that the USD library survives the file.
    scene = load(path, LoadConfig(asset_roots=tuple(map(str, asset_roots))))
    return _read(path, scene, _Words(vocabulary or default_vocabulary()))


def _read(path: str | Path, scene: Scene, words: _Words) -> Truth:
    from pxr import Tf, Usd

    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise LoadError(f"{path}: the USD library can't open it ({str(error).strip().splitlines()[0]})") from error
    paths = _Paths(scene)
    meshes = tuple(_row(stage, mesh, anchor, words) for mesh, anchor in paths.pairs)
    if all(row.group is None for row in meshes):
        raise LoadError(
            f"{path}: no mesh carries a label of the vocabulary; label it with UsdSemantics.LabelsAPI, taxonomy 'class'"
        )
    prims = list(stage.Traverse())
    units, unit_ids = _units(prims, paths)
    points, point_ids = _points(prims, paths)
    nodes = {**unit_ids, **point_ids}
    return Truth(
        meshes=meshes,
        units=units or None,
        points=points,
        connections=_connections(prims, nodes),
        clusters=_clusters(prims, paths),
        meters_per_unit=scene.source.meters_per_unit,
        up_axis=scene.source.up_axis,
    )


class _Words:
    """The vocabulary by what people write: capitals, underscores and hyphens don't matter."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._groups = {_plain(group): group for group in vocabulary.groups}
        self._names: dict[str, list[tuple[str, str]]] = {}
        for group, content in vocabulary.groups.items():
            for name in content.names:
                self._names.setdefault(_plain(name), []).append((group, name))

    def label(self, classes: Iterable[str], groups: Iterable[str]) -> tuple[str | None, str | None]:
        """Group and name; a name that is in several groups counts only where a group is given."""
        group = next((self._groups[_plain(word)] for word in groups if _plain(word) in self._groups), None)
        for word in map(_plain, classes):
            fitting = [found for found in self._names.get(word, ()) if group in (None, found[0])]
            if len(fitting) == 1:
                return fitting[0]
            if group is None and word in self._groups:
                return self._groups[word], None
        return group, None


def _plain(word: str) -> str:
    return " ".join(re.sub(r"[_\-]", " ", word).lower().split())


@dataclass(frozen=True)
class _Paths:
    """The meshes of the scene by where they are in the file."""

    scene: Scene

    @cached_property
    def pairs(self) -> list[tuple[str, str]]:
        """Path of each mesh, and of the prim that can carry opinions on it."""
        return list(zip(self.scene.paths, self.scene.anchors or self.scene.paths, strict=True))

    @cached_property
    def below(self) -> Mapping[str, list[int]]:
        """The meshes at or below each prim."""
        found: dict[str, list[int]] = {}
        for index, pair in enumerate(self.pairs):
            for above in dict.fromkeys(step for path in pair for step in _prefixes(path)):
                found.setdefault(above, []).append(index)
        return found

    def held(self, prim: Any) -> list[int]:
        """The meshes that a prim's ``cadgraph:parts`` names; without it, those below the prim."""
        relationship = prim.GetRelationship("cadgraph:parts")
        places = [str(target) for target in relationship.GetTargets()] if relationship else [str(prim.GetPath())]
        return sorted({index for place in places for index in self.below.get(place, ())})

    def names(self, indices: Iterable[int]) -> tuple[str, ...]:
        """Their paths."""
        return tuple(self.scene.paths[i] for i in indices)

    def middle(self, indices: list[int]) -> Floats | None:
        """The middle of the common box of some meshes, in world coordinates [m]."""
        corners = [self.scene.mesh(i)[0] for i in indices]
        corners = [vertices for vertices in corners if len(vertices)]
        if not corners:
            return None
        low, high = np.min([c.min(axis=0) for c in corners], axis=0), np.max([c.max(axis=0) for c in corners], axis=0)
        middle: Floats = np.round((low + high) / 2 + self.scene.origin, 6)
        return middle


def _prefixes(path: str) -> list[str]:
    """The path and all above it; ``[item]`` of a point instancer is cut off as well."""
    steps = path.split("/")
    found = ["/".join(steps[: depth + 1]) for depth in range(1, len(steps))]
    return found + [bare for step in found if (bare := re.sub(r"\[\d+\].*", "", step)) != step]


def _row(stage: Any, mesh: str, anchor: str, words: _Words) -> TruthMesh:
    group, name = None, None
    for place in dict.fromkeys([mesh, *_above(anchor), *_above(mesh)]):
        prim = stage.GetPrimAtPath(place) if _is_path(place) else None
        if not prim:
            continue
        classes, groups = _labels(prim, _CLASS), _labels(prim, _GROUP)
        if classes or groups:
            # An instance that stands for several parts carries the label of its largest: not true of each mesh.
            shared = place != mesh and len((prim.GetCustomDataByKey("cadgraph") or {}).get("parts", ())) > 1
            group, name = (None, None) if shared else words.label(classes, groups)
            break
    return TruthMesh(mesh=mesh, group=group, name=name)


def _above(path: str) -> list[str]:
    steps = re.sub(r"\[\d+\].*", "", path).split("/")
    return ["/".join(steps[:depth]) for depth in range(len(steps), 1, -1)]


def _is_path(place: str) -> bool:
    from pxr import Sdf

    return bool(Sdf.Path.IsValidPathString(place)) and Sdf.Path(place).IsPrimPath()


def _labels(prim: Any, taxonomy: str) -> list[str]:
    attribute = prim.GetAttribute(_ATTRIBUTE.format(taxonomy))
    value = attribute.Get() if attribute else None
    return [str(word) for word in value] if value is not None and not isinstance(value, str) else []


def _string(prim: Any, name: str) -> str | None:
    attribute = prim.GetAttribute(name)
    value = attribute.Get() if attribute else None
    return value if isinstance(value, str) and value else None


def _units(prims: Iterable[Any], paths: _Paths) -> tuple[tuple[TruthUnit, ...], dict[str, str]]:
    """Units, and the id of each by its prim's path; a mesh stays with the first unit that names it."""
    units: list[TruthUnit] = []
    ids: dict[str, str] = {}
    taken: set[int] = set()
    for prim in prims:
        types = _labels(prim, _UNIT)
        held = [index for index in paths.held(prim) if index not in taken] if types else []
        if not held:
            continue
        taken.update(held)
        tag = _string(prim, "cadgraph:tag")
        ids[str(prim.GetPath())] = _claim(tag or prim.GetName(), ids.values())
        units.append(
            TruthUnit(
                id=ids[str(prim.GetPath())],
                type=types[0],
                kind=_string(prim, "cadgraph:kind"),
                tag=tag or prim.GetName(),
                meshes=paths.names(held),
            )
        )
    return tuple(units), ids


def _points(prims: Iterable[Any], paths: _Paths) -> tuple[tuple[TruthPoint, ...], dict[str, str]]:
    points: list[TruthPoint] = []
    ids: dict[str, str] = {}
    for prim in prims:
        kind = _POINTS.get(prim.GetParent().GetName())
        if kind is not None and _string(prim, "cadgraph:id"):
            place = str(prim.GetPath())
            # The path can't be the name of a unit, so ids stay apart.
            ids[place] = place
            middle = paths.middle(paths.held(prim))
            point = None if middle is None else tuple(float(x) for x in middle)
            points.append(TruthPoint.model_validate({"id": place, "kind": kind, "point": point}))
    return tuple(points), ids


def _connections(prims: Iterable[Any], nodes: Mapping[str, str]) -> tuple[TruthConnection, ...] | None:
    """Edges, each once; None where no node has any."""
    flows: set[tuple[str, str]] = set()
    pairs: dict[tuple[str, str], None] = {}
    for prim in prims:
        source = nodes.get(str(prim.GetPath()))
        if source is None:
            continue
        for kind in ("connected", "flowsTo"):
            relationship = prim.GetRelationship(f"cadgraph:{kind}")
            for target in relationship.GetTargets() if relationship else ():
                other = nodes.get(str(target))
                if other is not None and kind == "flowsTo":
                    flows.add((source, other))
                if other is not None:
                    pairs[min(source, other), max(source, other)] = None
    found = []
    for a, b in pairs:
        forth, back = (a, b) in flows, (b, a) in flows
        direction = "unknown" if forth == back else "forward" if forth else "backward"
        found.append(TruthConnection.model_validate({"from": a, "to": b, "direction": direction}))
    return tuple(found) or None


def _clusters(prims: Iterable[Any], paths: _Paths) -> tuple[TruthCluster, ...] | None:
    found: list[TruthCluster] = []
    taken: set[int] = set()
    for prim in prims:
        if prim.GetParent().GetName() == "Clusters" and _string(prim, "cadgraph:id"):
            held = [index for index in paths.held(prim) if index not in taken]
            taken.update(held)
            if held:
                found.append(TruthCluster(id=prim.GetName(), meshes=paths.names(held)))
    return tuple(found) or None


def _claim(name: str, taken: Iterable[str]) -> str:
    names, number, free = set(taken), 2, name
    while free in names:
        free, number = f"{name}-{number}", number + 1
    return free
