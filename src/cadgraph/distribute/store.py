"""The run folder: what tasks read and what they write, as plain arrays in files that several processes can share.

Arrays are ``.npy`` files that are mapped into memory, so that a process reads of a site what its task touches.
Nothing in these files can run when it is read.
"""

from __future__ import annotations

import hashlib
import io
import shutil
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from cadgraph._io.arrays import check_array, read_arrays, write_array
from cadgraph._io.atomic import replacing, write_atomically
from cadgraph._io.limits import Limit
from cadgraph.errors import FormatError
from cadgraph.model.parts import Properties
from cadgraph.model.scene import MeshArrays, Placement, Scene

__all__ = [
    "Arrays",
    "digest_of",
    "open_arrays",
    "open_scene",
    "read_result",
    "save_arrays",
    "scene_arrays",
    "write_result",
]

Arrays = Mapping[str, npt.NDArray[Any]]

_DONE = "done"
_RESULT = Limit(1 << 34, "the result of a tile")


def scene_arrays(scene: Scene, properties: Properties | None = None) -> dict[str, npt.NDArray[Any]]:
    """The geometry of a scene, and what was measured of its meshes, by name. Paths and colours are left out."""
    shapes = scene.shapes
    arrays: dict[str, npt.NDArray[Any]] = {
        "vertices": np.ascontiguousarray(shapes.vertices, np.float64),
        "faces": np.ascontiguousarray(shapes.faces, np.int32),
        "vertex_offsets": np.ascontiguousarray(shapes.vertex_offsets, np.int64),
        "face_offsets": np.ascontiguousarray(shapes.face_offsets, np.int64),
    }
    if scene.placement is not None:
        arrays |= {f"placement_{name}": getattr(scene.placement, name) for name in ("shape", "turn", "shift")}
    if properties is not None:
        arrays |= {f"measured_{name}": getattr(properties, name) for name in Properties.__dataclass_fields__}
    return arrays


def open_scene(arrays: Arrays) -> tuple[Scene, Properties | None]:
    """The scene of ``scene_arrays``, its meshes named by their numbers; and what was measured, where it is there."""
    meshes = MeshArrays(arrays["vertices"], arrays["faces"], arrays["vertex_offsets"], arrays["face_offsets"])
    placement = None
    if "placement_shape" in arrays:
        placement = Placement(*(arrays[f"placement_{name}"] for name in ("shape", "turn", "shift")))
    n = meshes.n if placement is None else len(placement.shape)
    scene = Scene(meshes, tuple(map(str, range(n))), np.broadcast_to(np.float32(np.nan), (n, 3)), placement=placement)
    measured = {
        name: arrays[f"measured_{name}"] for name in Properties.__dataclass_fields__ if f"measured_{name}" in arrays
    }
    return scene, Properties(**measured) if measured else None


def digest_of(arrays: Arrays, *words: object) -> str:
    """A name for what a task is given: the same arrays and words have the same, others another one."""
    digest = hashlib.blake2b(repr(words).encode(), digest_size=12)
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(array.reshape(-1).view(np.uint8).data)
    return digest.hexdigest()


def save_arrays(folder: Path, arrays: Arrays, digest: str) -> None:
    """Writes arrays into a folder of their own, unless they are there already, to the last bit.

    They are on the disk before the folder is said to be whole. Where a crash or a disk spoilt them all the same, they
    are written anew.

    Args:
        folder: that nobody else is at work in.
        arrays: by name.
        digest: of them, as ``digest_of`` makes it.

    Raises:
        OutputError: a file can't be written.
    """
    if _holds(folder, digest):
        return
    shutil.rmtree(folder, ignore_errors=True)
    try:
        for name, array in arrays.items():
            with replacing(folder / f"{name}.npy", durable=True) as beside:
                write_array(beside, array)
        # Last: a folder without it is that of a run which was stopped while it wrote.
        write_atomically(folder / _DONE, f"{digest}\n", durable=True)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def _holds(folder: Path, digest: str) -> bool:
    """Whether a folder holds just the arrays of a digest; each is read whole."""
    try:
        return (folder / _DONE).read_bytes().strip() == digest.encode() and digest_of(open_arrays(folder)) == digest
    except (OSError, FormatError):
        return False


def open_arrays(folder: Path) -> dict[str, npt.NDArray[Any]]:
    """The arrays of a folder, mapped into memory: what is never looked at is never read.

    Raises:
        FormatError: an array is damaged.
    """
    arrays = {}
    for file in sorted(folder.glob("*.npy")):
        try:
            with file.open("rb") as opened:
                shape, _, _ = check_array(opened, file.stat().st_size, file.name)
            # What holds nothing can't be mapped.
            mode: Literal["r"] | None = None if 0 in shape else "r"
            arrays[file.stem] = np.asarray(np.load(file, mmap_mode=mode, allow_pickle=False))
        except (OSError, ValueError, EOFError) as error:
            raise FormatError(f"{file}: damaged ({error}); remove the folder, then build again") from error
    return arrays


def write_result(file: Path, arrays: Arrays) -> None:
    """Writes what a task found, whole or not at all.

    Raises:
        OutputError: it can't be written.
    """
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, **dict(arrays))
    write_atomically(file, content.getvalue())


def read_result(file: Path) -> dict[str, npt.NDArray[Any]] | None:
    """What a task found; None where it isn't there, or is damaged and so to be found anew."""
    try:
        return read_arrays(file.read_bytes(), _RESULT)
    except (OSError, ValueError, KeyError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):
        return None
