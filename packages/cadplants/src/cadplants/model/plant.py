"""The generated plant: components, units, nodes of the functional graph and their connections."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import chain, combinations, count
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats, Scene
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.transforms import IDENTITY
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "RGB",
    "Assembly",
    "Component",
    "Connection",
    "Device",
    "Line",
    "Plant",
    "Point",
    "Turning",
    "Unit",
    "free_name",
    "gather",
    "turned_front",
]

RGB = tuple[float, float, float]


@dataclass(frozen=True)
class Turning:
    """What turns at a device, and about which axis.

    Args:
        kind: ``handwheel``, ``lever``, ``gear operator`` (a handwheel beside the stem), ``needle``, or ``dial`` where a
            gauge has no needle of its own.
        axis: unit vector out of the device, towards the one who turns or reads.
        point: on the axis [m].
    """

    kind: str
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def placed(self, pose: Floats) -> Turning:
        """The same, moved by a ``(4, 4)`` pose, which may shrink it a little, as what leaves gaps does."""
        axis = pose[:3, :3] @ self.axis
        x, y, z = (float(value) for value in axis / np.linalg.norm(axis))
        a, b, c = (float(value) for value in pose[:3, :3] @ self.point + pose[:3, 3])
        return Turning(self.kind, (x, y, z), (a, b, c))


@dataclass(frozen=True, eq=False)
class Component:
    """One mesh of a plant.

    Args:
        solid: its shape in a frame of its own [m]; repeats share it.
        group: of the vocabulary.
        name: in that group.
        color: linear RGB, 0..1.
        pose: ``(4, 4)`` outer from local coordinates, rigid or mirrored.
        unit: id of the functional unit that it belongs to, or "".
        line: tag of the pipe run that it belongs to, or "".
        cluster: name of the connected structure that it belongs to, or "" (the ground).
        flaws: what was spoilt about its mesh (``flipped``, ``soup``, ``degenerate``).
        family: what kind of device or structure it was built as (``"ball valve/two-piece"``), or "".
        granularity: how finely that was modelled: ``one``, ``few`` or ``pieces``, or "".
        style: name of the modelling style, or "".
        holds: id of the unit that it clamps into its line (bolts of the counter-flanges), or "".
        gap: what was taken off its sides so that it no longer reaches its neighbours; negative: overlap [m].
        front: ``(3,)`` unit vector out of what is read on it, in the solid's frame; None where nothing is.
        turns: what of it turns, in the solid's frame: all of it, or pieces of it where a device is one mesh; None where
            nothing does, or where that was not annotated.
        params: what its device was built from, as plain JSON values, shared by all meshes of that device; None where
            that is not recorded.
        made_in: the style that its device was built in, where it is recorded what from.
    """

    solid: Solid
    group: str
    name: str
    color: RGB
    pose: Floats = field(default_factory=lambda: IDENTITY)
    unit: str = ""
    line: str = ""
    cluster: str = ""
    flaws: tuple[str, ...] = ()
    family: str = ""
    granularity: str = ""
    style: str = ""
    holds: str = ""
    gap: float = 0.0
    front: tuple[float, float, float] | None = None
    turns: Turning | None = None
    params: Mapping[str, Any] | None = field(default=None, compare=False)
    made_in: ModelingStyle | None = field(default=None, compare=False)

    @property
    def vertices(self) -> Floats:
        """``(n, 3)`` placed vertices [m]."""
        return self.solid.vertices @ self.pose[:3, :3].T + self.pose[:3, 3]

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """``(m, 3)`` triangles, counter-clockwise seen from outside."""
        return moved(self.solid, self.pose).faces


def turned_front(front: tuple[float, float, float] | None, pose: Floats) -> tuple[float, float, float] | None:
    """A unit vector, or None, turned by a ``(4, 4)`` pose."""
    if front is None:
        return None
    x, y, z = (float(value) for value in pose[:3, :3] @ front)
    return x, y, z


@dataclass(frozen=True)
class Unit:
    """A functional unit.

    Args:
        id: unique in its plant, also its tag (``"V-101"``).
        type: as the vocabulary calls it (``"valve"``).
        kind: ``"ball valve"``, ``"globe valve"``, ``"pressure gauge"``...
    """

    id: str
    type: str
    kind: str


@dataclass(frozen=True)
class Point:
    """A node of the functional graph that is no unit.

    Args:
        id: unique in its plant.
        kind: ``"terminal"`` (end of a run) or ``"junction"`` (three or more branches meet).
        point: ``(3,)`` where it is [m].
        end: of a terminal: ``"open"`` (a pipe's mouth or an open flange) or ``"blind"``; else "".
    """

    id: str
    kind: str
    point: tuple[float, float, float]
    end: str = ""


@dataclass(frozen=True, eq=False)
class Line:
    """The centreline of a run.

    Args:
        id: tag of the run.
        points: ``(n, 3)``; chords of its bends lie on them [m].
        outer: greatest outside diameter of its pipe [m].
    """

    id: str
    points: Floats
    outer: float


@dataclass(frozen=True)
class Connection:
    """Two nodes that follow each other along a run.

    Args:
        source: id of a unit or point.
        target: likewise.
        line: tag of the run.
        length: along the centreline [m].
        diameter: nominal bore [m].
        direction: ``forward`` (source to target), ``backward`` or ``unknown``.
        reason: what fixes the direction, or "".
    """

    source: str
    target: str
    line: str
    length: float
    diameter: float
    direction: str = "unknown"
    reason: str = ""


def _moved(pose: Floats, point: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in pose[:3, :3] @ point + pose[:3, 3])
    return x, y, z


@dataclass(frozen=True)
class Assembly:
    """Components that were built together, with what touches what and which functional truth they carry.

    Args:
        components: in order.
        contacts: pairs of indices into ``components`` that touch by design.
        units: that the components refer to.
        points: terminals and junctions.
        connections: in order along their runs.
        lines: centrelines of the runs.
    """

    components: tuple[Component, ...] = ()
    contacts: tuple[tuple[int, int], ...] = ()
    units: tuple[Unit, ...] = ()
    points: tuple[Point, ...] = ()
    connections: tuple[Connection, ...] = ()
    lines: tuple[Line, ...] = ()

    def placed(self, pose: Floats) -> Assembly:
        """The whole assembly moved by a 4x4 matrix."""
        return replace(
            self,
            components=tuple(replace(c, pose=pose @ c.pose) for c in self.components),
            points=tuple(replace(p, point=_moved(pose, p.point)) for p in self.points),
            lines=tuple(replace(one, points=one.points @ pose[:3, :3].T + pose[:3, 3]) for one in self.lines),
        )

    def prefixed(self, prefix: str) -> Assembly:
        """The assembly with ``prefix-`` before every id, line and cluster, so that several stand side by side."""

        def named(name: str) -> str:
            return f"{prefix}-{name}" if name else ""

        return replace(
            self,
            components=tuple(
                replace(c, unit=named(c.unit), line=named(c.line), cluster=named(c.cluster), holds=named(c.holds))
                for c in self.components
            ),
            units=tuple(replace(u, id=named(u.id)) for u in self.units),
            points=tuple(replace(p, id=named(p.id)) for p in self.points),
            connections=tuple(
                replace(c, source=named(c.source), target=named(c.target), line=named(c.line)) for c in self.connections
            ),
            lines=tuple(replace(one, id=named(one.id)) for one in self.lines),
        )

    def marked(
        self,
        unit: str | None = None,
        line: str | None = None,
        cluster: str | None = None,
        style: str | None = None,
        holds: str | None = None,
    ) -> Assembly:
        """The assembly with its components' unit, line, cluster, style or clamped unit set."""
        given = {"unit": unit, "line": line, "cluster": cluster, "style": style, "holds": holds}
        changes: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
        return replace(self, components=tuple(replace(c, **changes) for c in self.components))


@dataclass(frozen=True)
class Device:
    """An assembly that sits in a run: its inlet face at x = 0, its outlet face at x = ``length``.

    Args:
        assembly: what it is made of.
        length: face to face [m].
        inlet: index of the component with the inlet face.
        outlet: index of the component with the outlet face.
        wafer: whether it has no flanges and is held by bolts that reach from one counter-flange to the other.
    """

    assembly: Assembly
    length: float
    inlet: int = 0
    outlet: int = 0
    wafer: bool = False


def free_name(name: str, taken: Collection[str]) -> str:
    """A name, with a number behind it where it is taken."""
    return next(one for one in chain([name], (f"{name}/{k}" for k in count(2))) if one not in taken)


def gather(assemblies: Iterable[Assembly], joints: Sequence[tuple[int, int]] = ()) -> Assembly:
    """One assembly out of several, in order.

    Args:
        assemblies: their contact pairs are shifted along.
        joints: further pairs that touch, as indices into all components.
    """
    components: list[Component] = []
    contacts: list[tuple[int, int]] = []
    units: list[Unit] = []
    points: list[Point] = []
    connections: list[Connection] = []
    lines: list[Line] = []
    for assembly in assemblies:
        shift = len(components)
        contacts += [(a + shift, b + shift) for a, b in assembly.contacts]
        components += assembly.components
        units += assembly.units
        points += assembly.points
        connections += assembly.connections
        lines += assembly.lines
    contacts += joints
    return Assembly(tuple(components), tuple(contacts), tuple(units), tuple(points), tuple(connections), tuple(lines))


def _renumbered(pairs: Iterable[tuple[int, int]], place: Mapping[int, int]) -> tuple[tuple[int, int], ...]:
    """Pairs of indices by where they are now, but for those that are gone."""
    return tuple((place[a], place[b]) for a, b in pairs if a in place and b in place)


@dataclass(frozen=True)
class Plant(Assembly):
    """A finished plant.

    Args:
        name: of the preset.
        seed: that it was made from.
        styles: names of the modelling styles in it.
        looseness: greatest gap that was left between parts that touch by design [m].
        duplicates: pairs of components, the second an exact copy of the first.
        hidden: components that can't be seen from anywhere.
        colors: how it is painted: ``own`` (by what things are or belong to), ``gray`` or ``random``.
    """

    name: str = ""
    seed: int = 0
    styles: tuple[str, ...] = ()
    looseness: float = 0.0
    duplicates: tuple[tuple[int, int], ...] = ()
    hidden: tuple[int, ...] = ()
    colors: str = "own"

    @classmethod
    def of(cls, whole: Assembly, name: str, seed: int, styles: Iterable[ModelingStyle]) -> Plant:
        """A finished plant of what was built in some styles.

        Args:
            whole: all of it.
            name: of the preset.
            seed: that it was made from.
            styles: in it, the main one first.
        """
        built = {one.name: getattr(whole, one.name) for one in fields(Assembly)}
        used = tuple(styles)
        names, looseness = tuple(dict.fromkeys(style.name for style in used)), max(style.looseness for style in used)
        return cls(**built, name=name, seed=seed, styles=names, looseness=looseness)

    @property
    def n_meshes(self) -> int:
        """How many meshes there are."""
        return len(self.components)

    def device_styles(self) -> dict[ModelingStyle, str]:
        """What the style of each device is called: its name, with a number behind it where another one has that."""
        styles = dict.fromkeys(one.made_in for one in self.components if one.made_in is not None)
        found: dict[ModelingStyle, str] = {}
        for style in sorted(styles, key=lambda style: not style.published):
            found[style] = free_name(style.name, found.values())
        return found

    def paths(self) -> tuple[str, ...]:
        """Meaningless paths in component order, as ``scene()`` uses them."""
        return tuple(f"/World/Geo_{i:05d}" for i in range(self.n_meshes))

    def scene(self) -> Scene:
        """The plant's meshes as a scene, in metres and Z up, in component order."""
        return Scene.from_meshes(
            [(c.vertices, c.faces) for c in self.components], self.paths(), [c.color for c in self.components]
        )

    def without(self, gone: Collection[int], bridged: bool = True) -> Plant:
        """The plant without some components.

        Args:
            gone: their indices.
            bridged: whether what touched one of them then counts as touching each other: a gap is left in a joint.
        """
        if not gone:
            return self
        kept = [i for i in range(self.n_meshes) if i not in gone]
        place = {old: new for new, old in enumerate(kept)}
        pairs = list(self.contacts)
        for one in sorted(gone) if bridged else ():
            beside = sorted({b if a == one else a for a, b in self.contacts if one in (a, b)})
            pairs += combinations(beside, 2)
        return replace(
            self,
            components=tuple(self.components[i] for i in kept),
            contacts=_renumbered(dict.fromkeys(pairs), place),
            duplicates=_renumbered(self.duplicates, place),
            hidden=tuple(place[i] for i in self.hidden if i in place),
        )
