"""What the pictures of one mesh can show: the mesh and what lies about it, cut out of the scene, in a fixed form.

Pictures that are drawn of this cutout alone follow from it and from nothing else. So its digest says when they are the
same: after a change further away, in another place, in another order of the meshes, or with other noise in the last
digits of the coordinates.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.color import to_linear, to_srgb
from cadgraph.model.scene import Floats, Ints, MeshArrays, Scene

__all__ = ["Surroundings", "reach"]

Bools = npt.NDArray[np.bool_]

_PLACE = 1e-4  # [m] to which the place of a mesh is rounded, relative to the one that is looked at
_SHAPE = 1e-5  # [m] to which its vertices are, relative to its own lowest corner
_UNEVEN = 0.3183098862  # of a step, added before rounding down: no length that people choose lies at the limit then
_REACH = (4.0, 0.4, 0.6, 2.0)  # see ``reach``
_NO_COLOR = 255


def reach(extent: float) -> float:
    """How far round a mesh its pictures show others [m].

    Four times its own length, but of what is longer than some 20 cm only 0.6 m and 0.4 lengths, and never more than
    2 m: what pictures from further back hold at the mesh (see ``target``).

    Args:
        extent: the longest side of its box [m].
    """
    times, share, room, most = _REACH
    return min(times * extent, share * extent + room, most)


@dataclass(frozen=True)
class _Rounded:
    """A scene's meshes, each about its own lowest corner.

    Args:
        low: ``(n_meshes, 3)`` lowest corners [m]; NaN where a mesh has no triangle that can be drawn.
        shape: ``(n_vertices, 3)`` int32 in steps.
        size: ``(n_meshes, 3)`` of the boxes, in steps of places.
        color: ``(n_meshes, 4)`` uint8 sRGB, and whether there is none.
        digest: ``(n_meshes,)`` of shape and colour, 16 bytes each.
    """

    low: Floats
    shape: npt.NDArray[np.int32]
    size: Ints
    color: npt.NDArray[np.uint8]
    digest: tuple[bytes, ...]


class Surroundings:
    """Cuts out what the pictures of a mesh can show. Safe for threads: nothing changes once it is made.

    Args:
        scene: the scene.
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rounded = _rounded(scene)
        self._drawable: Bools = ~np.isnan(self._rounded.low[:, 0])

    def recipe(self, mesh: int) -> str:
        """Thirty-two hexadecimal digits: of equal ones the cutouts are equal.

        A mesh without a triangle that can be drawn has one, too, though no cutout.
        """
        if not self._drawable[mesh]:
            return self._rounded.digest[mesh].hex()
        members, places = self._members(mesh)
        h = hashlib.sha256()
        for member, place in zip(members, places, strict=True):
            h.update(self._rounded.digest[member] + place.tobytes())
        return h.hexdigest()[:32]

    def cutout(self, mesh: int) -> Scene:
        """The mesh, first, and what lies about it, each whole, relative to the lowest corner of the mesh.

        Raises:
            ValueError: the mesh has no triangle with finite corners.
        """
        members, places = self._members(mesh)
        part = self._scene.select(members)
        starts = self._scene.vertex_offsets
        shape = np.concatenate([self._rounded.shape[starts[i] : starts[i + 1]] for i in members])
        counts = np.diff(part.vertex_offsets)
        color = self._rounded.color[members]
        known = color[:, 3] != _NO_COLOR
        return Scene(
            MeshArrays(
                vertices=shape * _SHAPE + np.repeat(places * _PLACE, counts, axis=0),
                faces=self._faces(members, part),
                vertex_offsets=part.vertex_offsets,
                face_offsets=part.face_offsets,
            ),
            paths=tuple(f"/{i}" for i in range(len(members))),
            colors=np.where(known[:, None], to_linear(color[:, :3] / np.float32(255)), np.float32(np.nan)),
        )

    def _faces(self, members: Ints, part: Scene) -> npt.NDArray[np.int32]:
        """Those with a corner that isn't finite shrink to a point."""
        finite = np.asarray(np.isfinite(part.vertices).all(axis=1))
        return _shrunk(part.faces, np.asarray(finite[part.global_faces()].all(axis=1)))

    def _members(self, mesh: int) -> tuple[Ints, Ints]:
        """The mesh and what lies about it, in an order that follows from shapes and places, and their places."""
        if not self._drawable[mesh]:
            raise ValueError(f"{self._scene.paths[mesh]} can't be looked at: it has no triangle with finite corners")
        low, size = self._rounded.low, self._rounded.size
        offset = low - low[mesh]
        room = round(reach(float(size[mesh].max()) * _PLACE) / _PLACE)
        with np.errstate(invalid="ignore"):
            near = self._drawable & (np.abs(offset) < 1e9).all(axis=1)
        place = np.zeros(offset.shape, np.int64)
        place[near] = np.floor(offset[near] / _PLACE + _UNEVEN).astype(np.int64)
        near &= ((place <= size[mesh] + room) & (place + size >= -room)).all(axis=1)
        near[mesh] = False
        digest = self._rounded.digest
        order = sorted(np.flatnonzero(near).tolist(), key=lambda i: (digest[i], place[i].tolist()))
        members = np.array([mesh, *order], np.int64)
        return members, place[members]


def _shrunk(faces: npt.NDArray[np.int32], sound: Bools) -> npt.NDArray[np.int32]:
    """Faces, those that aren't sound as a point."""
    return np.where(sound[:, None], faces, np.int32(0))


def _rounded(scene: Scene) -> _Rounded:
    n = scene.n_meshes
    low = np.full((n, 3), np.nan)
    size = np.zeros((n, 3), np.int64)
    shape = np.zeros((len(scene.vertices), 3), np.int32)
    color = np.zeros((n, 4), np.uint8)
    known = np.isfinite(scene.colors).all(axis=1)
    color[known, :3] = np.floor(to_srgb(scene.colors[known]) * 255 + 0.5).astype(np.uint8)
    color[~known, 3] = _NO_COLOR
    digest = []
    for mesh in range(n):
        vertices, faces = scene.mesh(mesh)
        finite = np.asarray(np.isfinite(vertices).all(axis=1))
        sound = np.asarray(finite[faces].all(axis=1))
        corners = np.unique(faces[sound])
        h = hashlib.sha256(color[mesh].tobytes())
        if len(corners):
            low[mesh] = vertices[corners].min(axis=0)
            steps = np.zeros(vertices.shape, np.int32)
            steps[finite] = np.floor(
                np.clip((vertices[finite] - low[mesh]) / _SHAPE + _UNEVEN, -2e9, 2e9)
            ).astype(np.int32)  # fmt: skip
            shape[scene.vertex_offsets[mesh] : scene.vertex_offsets[mesh + 1]] = steps
            size[mesh] = -(-steps[corners].max(axis=0).astype(np.int64) // round(_PLACE / _SHAPE))
            h.update(steps.tobytes())
            h.update(np.int64(len(steps)).tobytes())
            h.update(_shrunk(faces, sound).tobytes())
        digest.append(h.digest()[:16])
    return _Rounded(low, shape, size, color, tuple(digest))
