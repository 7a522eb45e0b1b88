"""Bodies: a mesh, some meshes or some pieces of one, as what may turn about an axis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.geometry.mesh.pieces import pieces_of
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Scene

__all__ = ["Body", "Frame", "bodies_of", "frame_of", "join", "middle_of", "split", "unit_vector"]

_MOST_PIECES = 4000  # of a mesh; one of more is taken as a whole: a scan, or a soup of triangles
_TINY = 1e-12


def unit_vector(vector: Floats) -> Floats:
    """A vector of length 1; zeros stay."""
    found: Floats = vector / max(float(np.linalg.norm(vector)), _TINY)
    return found


@dataclass(frozen=True, eq=False)
class Body:
    """A surface that moves or stands still as one.

    Args:
        meshes: numbers of its source meshes, the largest first.
        pieces: of its one mesh, ascending; none where it is whole meshes.
        corners: ``(n, 3, 3)`` its triangles [m].
        names: what labels call its parts.
        points: ``(m, 3)`` the vertices that its triangles have [m].
    """

    meshes: tuple[int, ...]
    pieces: tuple[int, ...]
    corners: Floats
    names: frozenset[str]
    points: Floats

    @cached_property
    def _cross(self) -> Floats:
        a, b = self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        # By hand: numpy's own takes thrice as long on the few triangles of most bodies.
        return np.column_stack(
            [
                a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
                a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
                a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
            ]
        )

    @cached_property
    def areas(self) -> Floats:
        """``(n,)`` of its triangles [m2]."""
        found: Floats = 0.5 * np.linalg.norm(self._cross, axis=1)
        return found

    @cached_property
    def normals(self) -> Floats:
        """``(n, 3)`` unit normals of its triangles; zeros where one has no area."""
        found: Floats = self._cross / np.maximum(2 * self.areas, _TINY**2)[:, None]
        return found

    @cached_property
    def area(self) -> float:
        """Of its surface [m2]."""
        return float(self.areas.sum())

    @cached_property
    def center(self) -> Floats:
        """``(3,)`` centroid of its surface [m]."""
        middles = self.corners.mean(axis=1)
        found: Floats = self.areas @ middles / self.area if self.area > _TINY else middles.mean(axis=0)
        return found

    @cached_property
    def _moments(self) -> tuple[Floats, Floats]:
        apart = self.corners - self.center
        total = apart.sum(axis=1)
        flat = apart.reshape(-1, 3)
        square = (flat * np.repeat(self.areas, 3)[:, None]).T @ flat + (total * self.areas[:, None]).T @ total
        values, axes = np.linalg.eigh(square / (12 * max(self.area, _TINY)))
        return values, axes.T

    @property
    def spread(self) -> Floats:
        """``(3,)`` mean squares of the distances from its centroid along its axes, ascending [m2]."""
        return self._moments[0]

    @property
    def axes(self) -> Floats:
        """``(3, 3)`` its principal axes as rows: the thinnest first."""
        return self._moments[1]

    @cached_property
    def extents(self) -> Floats:
        """``(3,)`` full sizes along its axes [m]."""
        along = self.points @ self.axes.T
        found: Floats = np.ptp(along, axis=0)
        return found

    @cached_property
    def reach(self) -> float:
        """Diagonal of its upright box [m]."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    @cached_property
    def dense(self) -> Floats:
        """``(n, 3)`` points on the sides of its triangles, close to each other [m]."""
        share = np.linspace(0.0, 1.0, 6, endpoint=False)[:, None, None, None]
        return (self.corners * (1 - share) + np.roll(self.corners, -1, axis=1) * share).reshape(-1, 3)


def bodies_of(scene: Scene, meshes: Iterable[int], name_of: Sequence[str]) -> list[Body]:
    """Source meshes as bodies, in their order; those without a triangle are left out.

    Args:
        scene: of source meshes.
        meshes: their numbers.
        name_of: what labels call the part of each, "" where they don't.
    """
    found = []
    for mesh, name in zip(meshes, name_of, strict=True):
        vertices, faces = scene.mesh(mesh)
        whole = ((faces >= 0) & (faces < len(vertices))).all(axis=1)
        rows = faces[whole]
        finite = np.asarray(np.isfinite(vertices).all(axis=1))
        body = _body((mesh,), (), vertices, rows[finite[rows].all(axis=1)], frozenset({name} if name else ()))
        if len(body.points):
            found.append(body)
    return found


def _body(
    meshes: tuple[int, ...], pieces: tuple[int, ...], vertices: Floats, faces: Faces, names: frozenset[str]
) -> Body:
    return Body(meshes, pieces, vertices[faces], names, vertices[np.unique(faces)])


def split(scene: Scene, body: Body) -> list[Body]:
    """The pieces of a body of one mesh, in their order; none where it is one piece."""
    vertices, faces = scene.mesh(body.meshes[0])
    piece = pieces_of(vertices, faces)
    n = int(piece.max(initial=-1)) + 1
    if not 1 < n <= _MOST_PIECES:
        return []
    order = np.argsort(piece, kind="stable")
    bounds = np.searchsorted(piece[order], np.arange(n + 1))
    found = [_body(body.meshes, (k,), vertices, faces[order[bounds[k] : bounds[k + 1]]], body.names) for k in range(n)]
    return found


def middle_of(bodies: Sequence[Body]) -> Floats:
    """``(3,)`` centroid of the surface of some bodies [m]."""
    areas = np.array([max(body.area, _TINY) for body in bodies])
    found: Floats = areas @ np.array([body.center for body in bodies]) / areas.sum()
    return found


def join(bodies: Sequence[Body]) -> Body:
    """Several bodies as one, the largest mesh first."""
    order = sorted(bodies, key=lambda one: (-one.area, one.meshes, one.pieces))
    meshes = tuple(dict.fromkeys(mesh for one in order for mesh in one.meshes))
    pieces = tuple(sorted(piece for one in bodies for piece in one.pieces))
    corners = np.concatenate([one.corners for one in bodies])
    points = np.concatenate([one.points for one in bodies])
    return Body(meshes, pieces, corners, frozenset().union(*(one.names for one in bodies)), points)


@dataclass(frozen=True, eq=False)
class Frame:
    """An axis with a plane across it.

    Args:
        origin: ``(3,)`` on the axis [m].
        axis: ``(3,)`` unit vector.
        across: ``(2, 3)`` unit vectors of the plane; with the axis right-handed.
    """

    origin: Floats
    axis: Floats
    across: Floats

    def height(self, points: Floats) -> Floats:
        """``(n,)`` along the axis [m]."""
        found: Floats = (points - self.origin) @ self.axis
        return found

    def flat(self, points: Floats) -> Floats:
        """``(n, 2)`` in the plane [m]."""
        found: Floats = (points - self.origin) @ self.across.T
        return found

    def away(self, points: Floats) -> Floats:
        """``(n,)`` distance from the axis [m]."""
        found: Floats = np.linalg.norm(self.flat(points), axis=1)
        return found

    def covered(self, corners: Floats, radii: Sequence[float], n: int = 24) -> Bools:
        """Which points on circles about the axis lie over or under a triangle.

        Args:
            corners: ``(m, 3, 3)`` [m].
            radii: of the circles [m].
            n: points on each.

        Returns:
            ``(len(radii), n)``.
        """
        turns = 2 * np.pi * np.arange(n) / n
        spots = (np.array(radii)[:, None, None] * np.column_stack([np.cos(turns), np.sin(turns)])[None]).reshape(-1, 2)
        flat = self.flat(corners.reshape(-1, 3)).reshape(-1, 3, 2)
        # The triangles whose boxes reach over the circles at all; those of a rim are most, and don't.
        low, high = flat.min(axis=1), flat.max(axis=1)
        nearest = np.linalg.norm(np.maximum(np.maximum(low, -high), 0.0), axis=1)
        a, b, c = (flat[nearest <= max(radii), k] for k in range(3))
        signs = []
        for first, second in ((a, b), (b, c), (c, a)):
            side = second - first
            apart = spots[:, None] - first[None]
            signs.append(side[None, :, 0] * apart[..., 1] - side[None, :, 1] * apart[..., 0])
        inside = (np.minimum.reduce(signs) >= 0) | (np.maximum.reduce(signs) <= 0)
        wide = np.abs(signs[0] + signs[1] + signs[2]) > _TINY
        found: Bools = (inside & wide).any(axis=1).reshape(len(radii), n)
        return found


def frame_of(origin: Floats, axis: Floats) -> Frame:
    """A frame about an axis; the same for the same axis."""
    other = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = unit_vector(np.cross(axis, other))
    return Frame(origin, axis, np.array([first, np.cross(axis, first)]))
