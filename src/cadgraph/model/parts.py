"""The typed values that flow from stage to stage."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["Contacts", "Joint", "Link", "Network", "Opening", "Parts", "Place", "Properties", "UnitParts", "owners_of"]

Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Properties:
    """Geometric properties of all meshes of a scene (or of all parts), one row each.

    Args:
        area: ``(n,)`` surface area [m2].
        volume: ``(n,)`` enclosed volume [m3], taken about the area centroid, positive where faces look outward;
            meaningful where ``closed``.
        closed: ``(n,)`` whether every edge has a partner in the opposite sense, equal positions being one vertex.
        centroid: ``(n, 3)`` area centroid [m], relative to the scene's origin, like all positions here.
        aabb: ``(n, 2, 3)`` least and greatest corner [m].
        obb_center: ``(n, 3)`` centre of the oriented box [m].
        obb_axes: ``(n, 3, 3)`` its unit axes as rows, right-handed, longest extent first.
        obb_extents: ``(n, 3)`` its full side lengths [m], descending.
        inertia: ``(n, 3, 3)`` inertia tensor of the surface about its centroid, for 1 kg/m2 [m4].
        n_triangles: ``(n,)``.
        n_degenerate: ``(n,)`` triangles without area, or that refer to a vertex that isn't there.
        n_nonfinite: ``(n,)`` vertices with a NaN or infinite coordinate.
    """

    area: Floats
    volume: Floats
    closed: Bools
    centroid: Floats
    aabb: Floats
    obb_center: Floats
    obb_axes: Floats
    obb_extents: Floats
    inertia: Floats
    n_triangles: Ints
    n_degenerate: Ints
    n_nonfinite: Ints

    @property
    def obb_volume(self) -> Floats:
        """``(n,)`` volume of the oriented box [m3]."""
        volume: Floats = np.prod(self.obb_extents, axis=1)
        return volume

    def select(self, rows: npt.ArrayLike) -> Properties:
        """The properties of some of the meshes, in the order given."""
        index = np.asarray(rows, np.int64)
        return Properties(**{column.name: getattr(self, column.name)[index] for column in fields(self)})


@dataclass(frozen=True, eq=False)
class Parts:
    """The parts of a scene: groups of meshes that act as one item.

    Args:
        scene: the merged scene, one mesh for each part.
        meshes: for each part its source mesh indices, the largest first.
        part_of_mesh: ``(n_meshes,)`` part of each source mesh.
        properties: of each part.
        shape: ``(n_parts,)`` equal for parts of the same shape in any pose.
        ground: ``(n_parts,)`` whether a part is the ground.
        inside: the innermost part around each part that lies inside another one.
    """

    scene: Scene
    meshes: tuple[tuple[int, ...], ...]
    part_of_mesh: Ints
    properties: Properties
    shape: Ints
    ground: Bools
    inside: Mapping[int, int] = field(default_factory=dict)

    @property
    def n_parts(self) -> int:
        """How many parts there are."""
        return len(self.meshes)


@dataclass(frozen=True, eq=False)
class Contacts:
    """All pairs that are within the contact distance of each other.

    Args:
        pairs: ``(n_pairs, 2)`` indices, first < second, in ascending order, each pair once.
        distance: ``(n_pairs,)`` between the surfaces [m]; 0 where they touch or overlap.
        points: ``(n_pairs, 2, 3)`` the closest points found, on the first and on the second [m].
    """

    pairs: Ints
    distance: Floats
    points: Floats

    @cached_property
    def plain_pairs(self) -> tuple[tuple[int, int], ...]:
        """The pairs as plain numbers, for what looks at each by itself."""
        return tuple((a, b) for a, b in self.pairs.tolist())

    @cached_property
    def row_of(self) -> Mapping[tuple[int, int], int]:
        """The row of each pair."""
        return {pair: row for row, pair in enumerate(self.plain_pairs)}

    @cached_property
    def neighbors(self) -> Mapping[int, list[int]]:
        """The parts that are near each part, ascending."""
        found: dict[int, list[int]] = {}
        for a, b in self.plain_pairs:
            found.setdefault(a, []).append(b)
            found.setdefault(b, []).append(a)
        return {part: sorted(near) for part, near in found.items()}


@dataclass(frozen=True)
class UnitParts:
    """One functional unit: connected parts of one functional group.

    Args:
        unit_type: as the vocabulary calls it (``"valve"``).
        tag: ``V-001``, ``G-001``...
        parts: part indices, ascending.
        kind: ``"ball valve"``, ``"pressure gauge"``...; None where unknown.
        openings: where lines join it.
        kind_guesses: the likeliest kinds with their confidences where ``kind`` is open.
    """

    unit_type: str
    tag: str
    parts: tuple[int, ...]
    kind: str | None = None
    openings: tuple[Opening, ...] = ()
    kind_guesses: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Opening:
    """Where a line joins a unit.

    Args:
        point: its middle, ``(x, y, z)`` [m], relative to the scene's origin.
        direction: unit vector out of the unit, or None.
        diameter: bore, else outer diameter, of the line that joins [m], or None.
    """

    point: tuple[float, float, float]
    direction: tuple[float, float, float] | None = None
    diameter: float | None = None


@dataclass(frozen=True)
class Place:
    """A node of the functional network that is no unit.

    Args:
        kind: ``junction``, or how a run ends there: ``open``, ``blind`` or ``unknown``.
        point: ``(x, y, z)`` [m], relative to the scene's origin.
        parts: that meet or end there.
    """

    kind: str
    point: tuple[float, float, float]
    parts: tuple[int, ...]


@dataclass(frozen=True)
class Link:
    """Two nodes that follow each other along a run.

    Nodes are numbered: first the units, then the places.

    Args:
        source: node.
        target: node.
        via: parts in order.
        path: along the centreline from the source to the target [m], relative to the scene's origin.
        length: along the centreline [m].
        sizes: nominal sizes (DN) along the way, where they begin.
        size: of most of its length, or None.
        diameter: nominal bore [m], or None.
        source_port: index of the source's opening, -1 where it is no unit.
        target_port: likewise of the target.
        confidence: of the connection, 0..1.
        direction: of the flow: ``forward`` (source to target), ``backward`` or ``unknown``.
        reason: why, or None.
        direction_confidence: 0..1, or None.
    """

    source: int
    target: int
    via: tuple[int, ...]
    path: tuple[tuple[float, float, float], ...]
    length: float
    sizes: tuple[int, ...] = ()
    size: int | None = None
    diameter: float | None = None
    source_port: int = -1
    target_port: int = -1
    confidence: float = 1.0
    direction: Literal["forward", "backward", "unknown"] = "unknown"
    reason: str | None = None
    direction_confidence: float | None = None


@dataclass(frozen=True)
class Joint:
    """A place where two parts join, or might have.

    Args:
        first: part that carries the line that ends there, or a solid.
        second: the other part.
        kind: ``face`` (end to end), ``corner`` (likewise, at an angle), ``tap`` (an end on the side of a line),
            ``mount`` (an end at a solid), ``side`` (a solid on the side of a line) or ``flange`` (solid to solid).
        point: ``(x, y, z)`` [m], relative to the scene's origin.
        gap: between the two [m], negative where one lies in the other.
        score: how sure it is that they join, 0..1.
        made: whether the network joins them.
        reasons: what speaks for and against it, in words.
    """

    first: int
    second: int
    kind: Literal["face", "corner", "tap", "mount", "side", "flange"]
    point: tuple[float, float, float]
    gap: float
    score: float
    made: bool
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True)
class Network:
    """The functional network.

    Args:
        units: with their openings.
        places: junctions and terminals.
        links: between units and places.
        systems: for each connected network its nodes, ascending; units that nothing joins are in none.
        joints: where lines and units join, and the likeliest places where ends that stayed free might have.
    """

    units: tuple[UnitParts, ...] = ()
    places: tuple[Place, ...] = ()
    links: tuple[Link, ...] = ()
    systems: tuple[tuple[int, ...], ...] = ()
    joints: tuple[Joint, ...] = ()


def owners_of(units: Iterable[UnitParts]) -> dict[int, int]:
    """The number of the unit that each part is in; parts without one are left out."""
    return {part: number for number, unit in enumerate(units) for part in unit.parts}
