"""Proves a truth against the exact geometry of its scene."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.contact.pairs import distances, find_contacts
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Floats, Scene
from cadgraph.model.truth import Truth, TruthConnection, TruthLine, TruthUnit
from cadplants.model.contacts import APART

__all__ = ["Finding", "Proof", "prove"]

_TOUCH = 2e-6
"""What is at most this far apart touches [m] (ours: USD holds float32, which is 1e-6 m at 16 m)."""

_ROUND = 0.002
_COARSE, _COARSE_BEND = 0.2, 0.55
"""How far a pipe's surface may stand out of its nominal diameter [m], and a share of its radius, straight and in bends:
a bend of few pieces is drawn round its arc (ours: with two pieces for 90 degrees, at 3.5 diameters, that is 53 %)."""

_REACH = 0.06
"""How far from the axis of its line, beyond the pipe's skin, a device on it may begin [m]: the branch outlet and the
foot of an instrument (ours)."""

_SHIFT = 0.004
"""How exact lengths along a line have to be [m], and a share of them: chords of bends are shorter than their arcs."""
_STRETCH = 0.004

_SHOWN = 5

_BETWEEN = ("gasket", "bolt", "stud", "nut", "washer", "screw")
"""Names of what may join the pieces of a unit without belonging to it: the gasket under the lid of a manway."""

_ON_AXIS = ("pipe", "elbow", "reducer", "coupling", "pipe cap")
"""Names of what lies round the axis of its line and reaches no further out than the pipe."""


@dataclass(frozen=True)
class Finding:
    """Something in a truth that the geometry contradicts.

    Args:
        code: ``contact``, ``touch``, ``cluster``, ``apart``, ``tube``, ``order``, ``unit``, ``duplicate``, ``hidden``
            or ``part``.
        message: what is wrong, for people.
        meshes: paths that it is about.
    """

    code: str
    message: str
    meshes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Proof:
    """What was proven, and what was found wrong.

    Args:
        n_checked: how many statements of each code were checked.
        findings: what is wrong; none proves the truth.
        open: why some statements were not checked, for people: what the truth leaves open.
    """

    n_checked: Mapping[str, int]
    findings: tuple[Finding, ...]
    open: tuple[str, ...] = ()

    @property
    def holds(self) -> bool:
        """Nothing contradicts the truth."""
        return not self.findings

    def lines(self) -> tuple[str, ...]:
        """The findings for people: each kind with how often it occurs and examples."""
        told = []
        for code, n in Counter(finding.code for finding in self.findings).items():
            some = [finding.message for finding in self.findings if finding.code == code][:_SHOWN]
            told.append(f"{code}: {n} of {self.n_checked.get(code, n)}: {'; '.join(some)}")
        return tuple(told)


@dataclass(frozen=True)
class _Case:
    """A scene and a truth, laid over each other."""

    scene: Scene
    truth: Truth
    near: Contacts
    index: Mapping[str, int]
    original: Mapping[str, str]

    def told(self) -> dict[tuple[int, int], tuple[str, str]]:
        """The pairs that are said to touch; a copy touches what its original touches, and the original."""
        copies: dict[str, list[str]] = {}
        for copy, first in self.original.items():
            copies.setdefault(first, [first]).append(copy)
        pairs = list(self.truth.contacts or ())
        wide = [(x, y) for a, b in pairs for x in copies.get(a, [a]) for y in copies.get(b, [b])]
        wide += [(x, y) for same in copies.values() for k, x in enumerate(same) for y in same[k + 1 :]]
        return {self.key(a, b): (a, b) for a, b in wide}

    @cached_property
    def devices(self) -> Mapping[str, tuple[str, ...]]:
        """All meshes of the device that a mesh is of, by that mesh; of devices whose parameters are known."""
        rows = (self.truth.model_extra or {}).get("devices") or ()
        some = (tuple(mesh for mesh in row.get("meshes", ()) if mesh in self.index) for row in rows)
        return {mesh: device for device in some for mesh in device}

    def devices_of(self, unit: TruthUnit) -> set[str]:
        """The meshes of the devices that have meshes of a unit."""
        return {mesh for own in unit.meshes for mesh in self.devices.get(own, ())}

    def key(self, a: str, b: str) -> tuple[int, int]:
        one, other = self.index[a], self.index[b]
        return (one, other) if one < other else (other, one)

    def vertices(self, path: str) -> Floats:
        """``(n, 3)`` in the coordinates of the truth [m]."""
        vertices: Floats = self.scene.mesh(self.index[path])[0] + self.scene.origin
        return vertices

    def corners(self, path: str) -> Floats:
        """The vertices that faces use."""
        used: Floats = self.vertices(path)[np.unique(self.scene.mesh(self.index[path])[1])]
        return used


def prove(scene: Scene, truth: Truth) -> Proof:
    """Checks every statement of a truth that geometry can contradict; what it leaves open is not checked.

    Args:
        scene: as loaded from the plant's file.
        truth: of that scene.

    Returns:
        What was checked and what is wrong; the same for the same input.
    """
    index = {path: i for i, path in enumerate(scene.paths)}
    absent = [row.mesh for row in truth.meshes if row.mesh not in index]
    if absent:
        message = f"{len(absent)} meshes of the truth are not in the scene: {', '.join(absent[:_SHOWN])}"
        return Proof({"mesh": len(truth.meshes)}, (Finding("mesh", message, tuple(absent)),))
    original: dict[str, str] = {}
    for first, copy in truth.duplicates:
        original[copy] = original.get(first, first)
    case = _Case(scene, truth, find_contacts(scene, APART), index, original)
    n_checked: dict[str, int] = {}
    findings: list[Finding] = []
    for code, check in (
        ("contact", _contacts),
        ("touch", _touches),
        ("cluster", _clusters),
        ("apart", _apart),
        ("unit", _units),
        ("tube", _tubes),
        ("order", _order),
        ("duplicate", _duplicates),
        ("hidden", _hidden),
    ):
        outcomes = list(check(case))
        n_checked[code] = len(outcomes)
        findings += [Finding(code, message, meshes) for message, meshes in (o for o in outcomes if o is not None)]
    return Proof(n_checked, tuple(findings), _left_open(truth))


_NEEDS = {
    "contacts": "whether clusters and units hang together, and what touches",
    "clusters": "whether clusters are apart",
    "units": "whether units hang together",
    "lines": "whether pipes lie round their lines, and devices along them",
}
"""What can't be checked without a section."""


def _left_open(truth: Truth) -> tuple[str, ...]:
    """What a truth says too little for, with the section that it lacks."""
    return tuple(f"{what} (no {section!r})" for section, what in _NEEDS.items() if getattr(truth, section) is None)


_Outcomes = Iterator[tuple[str, tuple[str, ...]] | None]
"""For each statement None where it holds, else what is wrong and with which meshes."""


def _contacts(case: _Case) -> _Outcomes:
    """Pairs that are said to touch come within the looseness."""
    told = case.told()
    limit = (case.truth.looseness or 0.0) + _TOUCH
    found, _ = distances(case.scene, np.array(list(told), np.int64).reshape(-1, 2), max(2 * limit, APART))
    for (a, b), distance in zip(told.values(), found.tolist(), strict=True):
        wrong = f"{a} and {b} are {1000 * distance:.3f} mm apart, not {1000 * limit:.3f}"
        yield None if distance <= limit else (wrong, (a, b))


def _touches(case: _Case) -> _Outcomes:
    """No other pair touches."""
    if case.truth.contacts is None:
        return
    told = case.told()
    paths, known = case.scene.paths, {row.mesh for row in case.truth.meshes}
    for (a, b), distance in zip(case.near.pairs.tolist(), case.near.distance.tolist(), strict=True):
        if distance <= 0 and paths[a] in known and paths[b] in known:
            wrong = f"{paths[a]} and {paths[b]} touch"
            yield None if (a, b) in told else (wrong, (paths[a], paths[b]))


def _clusters(case: _Case) -> _Outcomes:
    """A cluster hangs together by pairs that touch; hidden bodies hang in what hides them."""
    if case.truth.contacts is None:
        return
    joined = [(case.scene.paths[a], case.scene.paths[b]) for a, b in case.told()]
    hidden = set(case.truth.hidden)
    for cluster in case.truth.clusters or ():
        pieces = connected_sets([mesh for mesh in cluster.meshes if mesh not in hidden], joined)
        wrong = f"{cluster.id or 'a cluster'} falls into {len(pieces)} pieces"
        yield None if len(pieces) <= 1 else (wrong, tuple(piece[0] for piece in pieces))


def _apart(case: _Case) -> _Outcomes:
    """Meshes of two clusters are further apart than the contact distance."""
    cluster_of = {mesh: k for k, cluster in enumerate(case.truth.clusters or ()) for mesh in cluster.meshes}
    paths = case.scene.paths
    for a, b in case.near.pairs.tolist():
        one, other = cluster_of.get(paths[a]), cluster_of.get(paths[b])
        if one is not None and other is not None:
            wrong = f"{paths[a]} and {paths[b]} of two clusters come within {1000 * APART:.0f} mm"
            yield None if one == other else (wrong, (paths[a], paths[b]))


def _units(case: _Case) -> _Outcomes:
    """The meshes of a unit hang together, be it by gaskets and bolts or by what else its device has, a pallet, say."""
    if case.truth.contacts is None:
        return
    hidden = set(case.truth.hidden)
    taken = {mesh for unit in case.truth.units or () for mesh in unit.meshes}
    loose = {row.mesh for row in case.truth.meshes if row.name in _BETWEEN} - taken
    beside = _neighbors((case.scene.paths[a], case.scene.paths[b]) for a, b in case.told())
    for unit in case.truth.units or ():
        own = [mesh for mesh in unit.meshes if mesh not in hidden]
        n_pieces = _count_pieces(own, loose | case.devices_of(unit), beside)
        yield None if n_pieces <= 1 else (f"{unit.id} falls into {n_pieces} pieces", unit.meshes)


def _count_pieces(own: Sequence[str], loose: Collection[str], beside: Mapping[str, Collection[str]]) -> int:
    """Into how many pieces some meshes fall that loose ones may hold together."""
    between = {mesh for one in own for mesh in beside.get(one, ()) if mesh in loose} - set(own)
    near = [(a, b) for a in (*own, *between) for b in beside.get(a, ())]
    return sum(not set(own).isdisjoint(piece) for piece in connected_sets([*own, *sorted(between)], near))


def _neighbors(joined: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    beside: dict[str, set[str]] = {}
    for a, b in joined:
        beside.setdefault(a, set()).add(b)
        beside.setdefault(b, set()).add(a)
    return beside


def _tubes(case: _Case) -> _Outcomes:
    """Pipes and elbows lie round the axis of their line; those of devices, and spools with their flanges, need not."""
    lines = {line.id: line for line in case.truth.lines or ()}
    slack = _ROUND + (case.truth.looseness or 0.0)
    free = {*case.truth.hidden, *case.devices}
    for row in case.truth.meshes:
        line = lines.get(row.line or "")
        if line is None or line.outer is None or row.name not in _ON_AXIS or row.mesh in free:
            continue
        if row.build == "spool":
            continue
        apart, along = _to_axis(case.vertices(row.mesh), line)
        coarse = _COARSE_BEND if _has_bend(line, float(along.min()), float(along.max())) else _COARSE
        room = slack + coarse * line.outer / 2 + max(0.0, -case.truth.gaps.get(row.mesh, 0.0))
        away = float(apart.max())
        wrong = f"{row.mesh} reaches {1000 * away:.1f} mm from the axis of {line.id}, more than {500 * line.outer:.1f}"
        yield None if away <= line.outer / 2 + room else (wrong, (row.mesh,))


def _order(case: _Case) -> _Outcomes:
    """Nodes of the functional graph lie on their line where the lengths of the connections put them."""
    for line in case.truth.lines or ():
        chain = [c for c in case.truth.connections or () if c.line == line.id]
        if chain and all(c.length is not None for c in chain):
            yield from _order_along(case, line, chain)


def _order_along(case: _Case, line: TruthLine, chain: Sequence[TruthConnection]) -> _Outcomes:
    """The same of the nodes of one line, whose connections all have a length."""
    units = {unit.id: unit for unit in case.truth.units or ()}
    points = {point.id: point for point in case.truth.points}
    s = 0.0
    for k, (node, length) in enumerate([(chain[0].source, 0.0), *((c.target, c.length or 0.0) for c in chain)]):
        s += length
        if k and chain[k - 1].source == chain[k - 1].target:
            yield f"{line.id}: {node} follows itself", ()
        place, slack = _at(line, s), _SHIFT + _STRETCH * s
        if node in points:
            known = points[node].point
            away = 0.0 if known is None else float(np.linalg.norm(np.subtract(known, place)))
        else:
            slack += _REACH if line.outer is None else line.outer / 2 + _REACH
            away = _to_unit(case, units[node], place)
        wrong = f"{node} is {1000 * away:.1f} mm from where {line.id} puts it, {s:.3f} m along"
        yield None if away <= slack else (wrong, ())


def _duplicates(case: _Case) -> _Outcomes:
    """A copy lies exactly on its original; the middles of caps may go unused in one of them."""
    from scipy.spatial import cKDTree

    for first, copy in case.truth.duplicates:
        fewer, more = sorted((case.corners(first), case.corners(copy)), key=len)
        boxes = [np.concatenate([places.min(axis=0), places.max(axis=0)]) for places in (fewer, more)]
        same = np.abs(boxes[0] - boxes[1]).max() <= _TOUCH and np.max(cKDTree(more).query(fewer)[0]) <= _TOUCH
        yield None if same else (f"{copy} is no copy of {first}", (first, copy))


def _hidden(case: _Case) -> _Outcomes:
    """A hidden body touches nothing but, where it is one, its original."""
    paths = case.scene.paths
    touched: dict[str, list[str]] = {}
    told = case.told()
    for (a, b), distance in zip(case.near.pairs.tolist(), case.near.distance.tolist(), strict=True):
        if distance <= 0 and (a, b) not in told:
            touched.setdefault(paths[a], []).append(paths[b])
            touched.setdefault(paths[b], []).append(paths[a])
    for mesh in case.truth.hidden:
        wrong = f"{mesh} is said to be hidden, but touches {', '.join(touched.get(mesh, ())[:_SHOWN])}"
        yield None if mesh not in touched else (wrong, (mesh,))


def _to_axis(places: Floats, line: TruthLine) -> tuple[Floats, Floats]:
    """Distance of each place ``(n, 3)`` from the axis of a line, and how far along it the nearest point is [m]."""
    points = np.array(line.points)
    low, way = points[:-1], np.diff(points, axis=0)
    lengths = np.linalg.norm(way, axis=1)
    starts = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    squares = np.maximum(lengths**2, 1e-18)
    share = np.clip(np.einsum("nlj,lj->nl", places[:, None] - low, way) / squares, 0, 1)
    away = np.linalg.norm(places[:, None] - (low + share[..., None] * way), axis=2)
    best = away.argmin(axis=1)
    row = np.arange(len(places))
    return away[row, best], starts[best] + share[row, best] * lengths[best]


def _has_bend(line: TruthLine, low: float, high: float) -> bool:
    """Whether the axis of a line turns between two chainages [m]."""
    points = np.array(line.points)
    starts = np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))[:-1]
    return bool(((low < starts) & (starts < high)).any())


def _at(line: TruthLine, s: float) -> Floats:
    """The point at a chainage [m]; its ends beyond them."""
    points = np.array(line.points)
    starts = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    place: Floats = np.array([np.interp(s, starts, points[:, axis]) for axis in range(3)])
    return place


def _to_unit(case: _Case, unit: TruthUnit, place: Floats) -> float:
    """How far a place is from the nearest box of the meshes of a unit, or of what else its device has [m]."""
    least = np.inf
    for mesh in {*unit.meshes, *case.devices_of(unit)}:
        vertices = case.vertices(mesh)
        outside = np.maximum(np.maximum(vertices.min(axis=0) - place, place - vertices.max(axis=0)), 0.0)
        least = min(least, float(np.linalg.norm(outside)))
    return float(least)
