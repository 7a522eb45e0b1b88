"""The triangles of a scene as files for the page: a manifest, where each mesh lies, and chunks of shapes.

The layout of the files is described with :func:`pack_scene`.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.color import to_srgb
from cadgraph.draw.web.encode import Encoded, encode
from cadgraph.draw.web.instances import Instances, find_instances, quaternions
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["HIDDEN", "INSTANCE", "MAGIC", "ROW", "PackedScene", "pack_scene"]

MAGIC = b"HCGC"
HIDDEN = 0xFFFFFFFF
"""The shape of a mesh that is not shown."""

INSTANCE = np.dtype(
    [("shape", "<u4"), ("color", "u1", (4,)), ("turn", "<f4", (4,)), ("shift", "<f4", (3,))]
)  # fmt: skip
"""One mesh: its shape, its sRGB colour (alpha 0: none), its rotation as ``x, y, z, w``, its translation [m]."""

ROW = np.dtype(
    [
        *((name, "<u4") for name in ("shape", "level", "n_vertices", "n_indices", "offset", "flags")),
        *((name, "<f4", (3,)) for name in ("low", "step")),
    ]
)
"""One shape in the directory of a chunk."""

_WIDE = 1  # flag: indices of 32 bits
_CHUNK = {1: 2_000_000, 0: 4_000_000}  # bytes of a chunk by level, about
_NAMES = {1: "coarse", 0: "full"}
_INSTANCES = "instances.bin"
_AT_ONCE = 16  # shapes that a thread encodes before it takes the next
_CLASSES = 4  # of size, each four times as large as the next


@dataclass(frozen=True)
class PackedScene:
    """A scene as the page loads it.

    Args:
        manifest: JSON-able, says what the files are.
        files: their content by name.
    """

    manifest: dict[str, Any]
    files: dict[str, bytes]


def pack_scene(scene: Scene, shown: npt.ArrayLike | None = None) -> PackedScene:
    """Packs the triangles of a scene: every distinct shape once, on a grid over its box, in full and in a coarse form.

    All positions are relative to the scene's origin. The same scene gives the same bytes.

    The file ``manifest["instances"]`` has a row (:data:`INSTANCE`) for each mesh in the order of the scene. A chunk
    is the word ``HCGC``, the number of its shapes as uint32, a directory (:data:`ROW`), and for each shape at its
    offset: positions (three uint16 for each vertex; ``low + step * value``), normals (two int8, octahedral) and
    indices (uint16, or uint32 by the flag), each padded to four bytes. Everything is little-endian. Level 1 is the
    coarse form, of at most about a quarter of the triangles; a shape of few triangles is in level 1 in full and not
    in level 0.

    Args:
        scene: any; meshes without a sound triangle are not shown.
        shown: ``(n_meshes,)`` bool, which meshes to show; all by default.
    """
    placed = find_instances(scene)
    wanted = np.ones(scene.n_meshes, np.bool_) if shown is None else np.asarray(shown, np.bool_).copy()
    forms = _encode_all(placed, np.unique(placed.shape[wanted]).tolist())
    wanted &= np.isin(placed.shape, list(forms))
    order = _order_of_loading(placed, wanted, list(forms))
    number = np.full(placed.n, HIDDEN, np.int64)
    number[order] = np.arange(len(order))
    shape_of = np.where(wanted, number[placed.shape], HIDDEN)
    files = {_INSTANCES: _instances(scene, placed, shape_of)}
    low, high = _boxes(shape_of[wanted], placed.low[wanted], placed.high[wanted], len(order))
    coarse = [(i, small or full) for i, (full, small) in enumerate(forms[shape] for shape in order)]
    fine = [(i, full) for i, (full, small) in enumerate(forms[shape] for shape in order) if small is not None]
    sizes = np.array([forms[shape][0].n_indices // 3 for shape in order], np.int64)
    forms.clear()
    chunks = []
    for level, rows in ((1, coarse), (0, fine)):
        for name, members, content in _chunks(level, rows):
            files[name] = content
            chunks.append(
                {
                    "file": name,
                    "bytes": len(content),
                    "level": level,
                    "n_shapes": len(members),
                    "low": low[members].min(axis=0).tolist(),
                    "high": high[members].max(axis=0).tolist(),
                }
            )
    manifest = {
        "low": low.min(axis=0).tolist() if order else [0.0, 0.0, 0.0],
        "high": high.max(axis=0).tolist() if order else [0.0, 0.0, 0.0],
        "n_meshes": scene.n_meshes,
        "n_shapes": len(order),
        "n_triangles": int(sizes[shape_of[wanted]].sum()),
        "instances": _INSTANCES,
        "chunks": chunks,
    }
    return PackedScene(manifest, files)


def _encode_all(placed: Instances, shapes: Sequence[int]) -> dict[int, tuple[_Form, _Form | None]]:
    """The forms of these shapes, but for those without a sound triangle; the full one, and the coarse one if any."""

    def encoded(some: Sequence[int]) -> list[tuple[int, tuple[_Form, _Form | None]]]:
        found = []
        for shape in some:
            vertices, faces = placed.shapes.mesh(int(placed.first[shape]))
            forms = encode(vertices - placed.center[shape], faces)
            if forms is not None:
                found.append((shape, (_packed(forms[0]), _packed(forms[1]) if forms[1] is not None else None)))
        return found

    batches = [shapes[i : i + _AT_ONCE] for i in range(0, len(shapes), _AT_ONCE)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(form for batch in pool.map(encoded, batches) for form in batch)


def _order_of_loading(placed: Instances, wanted: npt.NDArray[np.bool_], shapes: Sequence[int]) -> list[int]:
    """The shapes, the large ones first, and neighbours near each other; each stands where it first occurs."""
    if not shapes:
        return []
    first = np.full(placed.n, -1, np.int64)
    meshes = np.flatnonzero(wanted)[::-1]
    first[placed.shape[meshes]] = meshes
    heads = first[np.array(shapes)]
    size = np.linalg.norm(placed.high[heads] - placed.low[heads], axis=1)
    with np.errstate(divide="ignore"):
        rank = np.floor(np.log2(size.max() / size) / 2) if size.max() > 0 else np.zeros(len(size))
    middle = 0.5 * (placed.low[heads] + placed.high[heads])
    along = _morton(middle - middle.min(axis=0))
    order = np.lexsort((heads, along, np.minimum(rank, _CLASSES - 1)))
    return [shapes[i] for i in order.tolist()]


def _morton(points: Floats) -> Ints:
    """``(n,)`` numbers along a curve that keeps near points near each other (Morton 1966), of points from zero up."""
    steps = (1023 * points / max(float(points.max()), 1e-12)).astype(np.int64)
    code = np.zeros(len(points), np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= ((steps[:, axis] >> bit) & 1) << (3 * bit + axis)
    return code


def _instances(scene: Scene, placed: Instances, shape: Ints) -> bytes:
    rows = np.zeros(scene.n_meshes, INSTANCE)
    rows["shape"] = shape
    given = np.isfinite(scene.colors).all(axis=1)
    rows["color"][:, :3] = np.rint(255 * to_srgb(np.nan_to_num(scene.colors)))
    rows["color"][:, 3] = 255
    rows["color"][~given] = 0
    rows["turn"] = quaternions(placed.turn)
    rows["shift"] = placed.shift
    return rows.tobytes()


def _boxes(number: Ints, low: Floats, high: Floats, count: int) -> tuple[Floats, Floats]:
    """The box round all places of each shape."""
    least, most = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(least, number, low)
    np.maximum.at(most, number, high)
    return least, most


class _Form(NamedTuple):
    """One level of one shape, ready for its chunk."""

    low: npt.NDArray[np.float32]
    step: npt.NDArray[np.float32]
    n_vertices: int
    n_indices: int
    wide: bool
    block: bytes


def _packed(form: Encoded) -> _Form:
    wide = len(form.vertices) > 0xFFFF
    pieces = (
        form.vertices[:, :3].astype("<u2").tobytes(),
        form.vertices[:, 3].astype("<u2").tobytes(),
        form.indices.astype("<u4" if wide else "<u2").tobytes(),
    )
    block = b"".join(piece + bytes(-len(piece) % 4) for piece in pieces)
    return _Form(form.low, form.step, len(form.vertices), form.indices.size, wide, block)


def _chunks(level: int, rows: list[tuple[int, _Form]]) -> Iterator[tuple[str, list[int], bytes]]:
    """Name, shapes and content of each chunk; the rows are used up, so that no form is held twice for long."""
    rows.reverse()
    count = 0
    while rows:
        taken, size = [], 0
        while rows and size < _CHUNK[level]:
            taken.append(rows.pop())
            size += ROW.itemsize + len(taken[-1][1].block)
        yield f"{_NAMES[level]}-{count:04d}.bin", [shape for shape, _ in taken], _chunk(level, taken)
        count += 1


def _chunk(level: int, rows: Sequence[tuple[int, _Form]]) -> bytes:
    head = struct.pack("<4sI", MAGIC, len(rows))
    directory = np.zeros(len(rows), ROW)
    offset = len(head) + directory.nbytes
    for row, (shape, form) in zip(directory, rows, strict=True):
        row["shape"], row["level"], row["offset"] = shape, level, offset
        row["n_vertices"], row["n_indices"] = form.n_vertices, form.n_indices
        row["flags"] = _WIDE if form.wide else 0
        row["low"], row["step"] = form.low, form.step
        offset += len(form.block)
    return b"".join((head, directory.tobytes(), *(form.block for _, form in rows)))
