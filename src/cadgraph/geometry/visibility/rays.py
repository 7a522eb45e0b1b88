"""Rays from anywhere to many triangles, by Embree.

The package ``embreex`` brings the library. Its own interface copies meshes number by number while it holds the
interpreter's lock, which takes longer than to build the tree, and spends as long on each ray as Embree does. So the
library is called through its C interface where its file is found beside the package, and through the package elsewhere.
"""

from __future__ import annotations

import ctypes
import sys
import weakref
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import llvmlite.binding
import numpy as np
import numpy.typing as npt
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from numba import types

from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.model.scene import Faces

__all__ = ["Hits", "RayTree", "ray_tree"]

Singles = npt.NDArray[np.float32]
Reals = npt.NDArray[np.floating[Any]]


class Hits(NamedTuple):
    """What rays met first.

    Args:
        face: ``(n,)`` int32 index of the triangle, -1 where a ray met nothing.
        u: ``(n,)`` float32 barycentric weight of the face's second corner.
        v: ``(n,)`` float32 barycentric weight of its third corner.
        distance: ``(n,)`` float32 along the ray [m]; anything where it met nothing.
        normal: ``(n, 3)`` float32 normal of the face, either way round and of any length.
    """

    face: Faces
    u: Singles
    v: Singles
    distance: Singles
    normal: Singles


class RayTree(Protocol):
    """Triangles that rays meet from both sides. Casting leaves the interpreter free for other threads."""

    def first(self, origins: Reals, directions: Reals) -> Hits:
        """What each ray meets first; origins ``(n, 3)`` [m] and directions ``(n, 3)``."""
        ...

    def blocked(self, origins: Reals, directions: Reals, lengths: Reals) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether anything lies on each ray before its length, in lengths of its direction."""
        ...


def ray_tree(corners: Reals, faces: Faces) -> RayTree:
    """Builds the tree of some triangles; no ray slips through between two that share an edge.

    Args:
        corners: ``(n, 3)`` finite [m]; taken as float32, as are rays.
        faces: ``(m, 3)`` indices of corners.

    Raises:
        MemoryError: Embree has no room for them.
    """
    library = _library()
    return _Wrapped(corners, faces) if library is None else _Direct(library, corners, faces)


class _Wrapped:
    """A tree by the package's own interface."""

    def __init__(self, corners: Reals, faces: Faces) -> None:
        self._scene = rtcore_scene.EmbreeScene(robust=True)
        self._mesh = TriangleMesh(self._scene, np.ascontiguousarray(corners, np.float32), readable(faces, np.int32))
        # The first ray makes it build the tree; done here, so that threads find it finished.
        self._scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))

    def first(self, origins: Reals, directions: Reals) -> Hits:
        found = self._scene.run(
            np.ascontiguousarray(origins, np.float32), np.ascontiguousarray(directions, np.float32), output=1
        )
        return Hits(found["primID"], found["u"], found["v"], found["tfar"], found["Ng"])

    def blocked(self, origins: Reals, directions: Reals, lengths: Reals) -> npt.NDArray[np.bool_]:
        if not len(origins):
            return np.zeros(0, bool)
        answer: npt.NDArray[Any] = self._scene.run(
            np.ascontiguousarray(origins, np.float32),
            np.ascontiguousarray(directions, np.float32),
            dists=np.ascontiguousarray(lengths, np.float32),
            query="OCCLUDED",
        )
        return answer >= 0


# Numbers of rtcore.h of Embree 4.
_VERSIONS = range(40_000, 50_000)
_VERSION = 0  # a property of a device
_ROBUST = 4  # a flag of a scene
_TRIANGLES = 0  # a type of geometry
_INDEX, _VERTEX = 0, 1  # types of buffers
_INTEGERS, _FLOATS = 0x5003, 0x9003  # formats: three of each
_ROW = 12  # bytes of three

_pointer, _size, _enum, _unsigned = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_uint
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "rtcNewDevice": (_pointer, (ctypes.c_char_p,)),
    "rtcGetDeviceProperty": (ctypes.c_ssize_t, (_pointer, _enum)),
    "rtcGetDeviceError": (_enum, (_pointer,)),
    "rtcNewScene": (_pointer, (_pointer,)),
    "rtcSetSceneFlags": (None, (_pointer, _enum)),
    "rtcNewGeometry": (_pointer, (_pointer, _enum)),
    "rtcSetSharedGeometryBuffer": (None, (_pointer, _enum, _unsigned, _enum, _pointer, _size, _size, _size)),
    "rtcCommitGeometry": (None, (_pointer,)),
    "rtcAttachGeometry": (_unsigned, (_pointer, _pointer)),
    "rtcReleaseGeometry": (None, (_pointer,)),
    "rtcCommitScene": (None, (_pointer,)),
    "rtcReleaseScene": (None, (_pointer,)),
}
_CALLED_BY_KERNELS = ("rtcIntersect1", "rtcOccluded1")


class _Library(NamedTuple):
    """Embree's functions, and the device that its scenes are made on."""

    functions: Any
    device: int


@cache
def _library() -> _Library | None:
    """Embree, of which the process has one; None where its file isn't found or is of another version."""
    for path in _files():
        try:
            functions = ctypes.CDLL(str(path))
            for name, (result, arguments) in _FUNCTIONS.items():
                function = getattr(functions, name)
                function.restype, function.argtypes = result, arguments
            addresses = [ctypes.cast(getattr(functions, name), _pointer).value for name in _CALLED_BY_KERNELS]
        except (OSError, AttributeError):  # not for this system, or not Embree's
            continue
        device = functions.rtcNewDevice(None)
        if device and functions.rtcGetDeviceProperty(device, _VERSION) in _VERSIONS:
            for name, address in zip(_CALLED_BY_KERNELS, addresses, strict=True):
                llvmlite.binding.add_symbol(name, address)
            return _Library(functions, device)
    return None


def _files() -> list[Path]:
    """Where wheels for Linux and Windows, wheels for macOS, and conda keep the library of the package."""
    package = Path(rtcore_scene.__file__).parent
    prefix = Path(sys.prefix)
    folders = (package.parent / "embreex.libs", package / ".dylibs", prefix / "lib", prefix / "Library" / "bin")
    return [path for folder in folders for path in sorted(folder.glob("*embree4*"))]


class _Direct:
    """A tree by the C interface."""

    def __init__(self, library: _Library, corners: Reals, faces: Faces) -> None:
        functions, device = library
        # Embree reads them where they lie, and four numbers for a corner of three.
        self._corners = np.zeros((len(corners) + 1, 3), np.float32)
        self._corners[:-1] = corners
        self._faces = readable(faces, np.int32)
        self._scene: int = functions.rtcNewScene(device)
        weakref.finalize(self, functions.rtcReleaseScene, self._scene).atexit = False
        functions.rtcSetSceneFlags(self._scene, _ROBUST)
        geometry = functions.rtcNewGeometry(device, _TRIANGLES)
        for kind, form, rows, count in (
            (_VERTEX, _FLOATS, self._corners, len(corners)),
            (_INDEX, _INTEGERS, self._faces, len(faces)),
        ):
            functions.rtcSetSharedGeometryBuffer(geometry, kind, 0, form, rows.ctypes.data, 0, _ROW, count)
        functions.rtcCommitGeometry(geometry)
        functions.rtcAttachGeometry(self._scene, geometry)
        functions.rtcReleaseGeometry(geometry)
        functions.rtcCommitScene(self._scene)
        if functions.rtcGetDeviceError(device):
            raise MemoryError(f"no memory for a tree of {len(faces):,} triangles that rays can be cast at")

    def first(self, origins: Reals, directions: Reals) -> Hits:
        n = len(directions)
        found = Hits(
            np.empty(n, np.int32),
            np.empty(n, np.float32),
            np.empty(n, np.float32),
            np.empty(n, np.float32),
            np.empty((n, 3), np.float32),
        )
        rays = readable(origins, np.float32), readable(directions, np.float32)
        _first(np.uintp(self._scene), _record(), *rays, *found)
        return found

    def blocked(self, origins: Reals, directions: Reals, lengths: Reals) -> npt.NDArray[np.bool_]:
        answer = np.empty(len(directions), np.bool_)
        rays = readable(origins, np.float32), readable(directions, np.float32), readable(lengths, np.float32)
        _blocked(np.uintp(self._scene), _record(), *rays, answer)
        return answer


# Numbers of 4 bytes in RTCRayHit: origin, start, direction, time, end, mask, id, flags; normal, u, v, triangle,
# geometry, and instances up to what a later version may add.
_DIRECTION, _END, _MASK, _NORMAL, _U, _V, _FACE, _GEOMETRY, _INSTANCE = 4, 8, 9, 12, 15, 16, 17, 18, 19
_NUMBERS, _ALIGNED = 32, 16
_NONE = -1

_address = types.uintp
_intersect = types.ExternalFunction("rtcIntersect1", types.void(_address, _address, _address))
_occluded = types.ExternalFunction("rtcOccluded1", types.void(_address, _address, _address))


def _record() -> Singles:
    """Room for one ray and its hit, as Embree wants it: zeros, on a boundary of 16 bytes at least."""
    room = np.zeros(_NUMBERS + _ALIGNED, np.float32)
    first = -(room.ctypes.data // 4) % _ALIGNED
    return room[first : first + _NUMBERS]


@compiled
def _aim(record: Any, origins: Any, directions: Any, ray: int, end: float) -> None:
    """Writes a ray up to its end, the mask apart, which stays."""
    for i in range(3):
        record[i] = origins[ray, i]
        record[_DIRECTION + i] = directions[ray, i]
    record[_END] = end


@compiled
def _first(
    scene: Any, record: Any, origins: Any, directions: Any, face: Any, u: Any, v: Any, distance: Any, normal: Any
) -> None:
    """Casts rays one by one, and writes what each meets first."""
    whole = record.view(np.int32)
    whole[_MASK] = _NONE
    address, default = record.ctypes.data, np.uintp(0)
    for ray in range(len(face)):
        _aim(record, origins, directions, ray, np.inf)
        whole[_FACE] = whole[_GEOMETRY] = whole[_INSTANCE] = _NONE
        _intersect(scene, address, default)
        face[ray], distance[ray] = whole[_FACE], record[_END]
        u[ray], v[ray] = record[_U], record[_V]
        for i in range(3):
            normal[ray, i] = record[_NORMAL + i]


@compiled
def _blocked(scene: Any, record: Any, origins: Any, directions: Any, lengths: Any, answer: Any) -> None:
    """Casts rays one by one, and writes whether each meets anything before its length."""
    whole = record.view(np.int32)
    whole[_MASK] = _NONE
    address, default = record.ctypes.data, np.uintp(0)
    for ray in range(len(answer)):
        _aim(record, origins, directions, ray, lengths[ray])
        _occluded(scene, address, default)
        answer[ray] = record[_END] < 0  # Embree sets it to minus infinity
