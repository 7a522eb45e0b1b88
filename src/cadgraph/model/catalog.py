"""Catalogues of a user's own parts on disk: labelled shapes in one file, portable and free of anything that could run.

A file is an npz: the text ``head`` (JSON: format, version, and what each entry is) beside plain arrays of the
triangles of all entries. It comes from anywhere, so nothing in it is trusted.
"""

from __future__ import annotations

import hashlib
import json
import struct
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from cadgraph._io.arrays import read_arrays
from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import CATALOG, read_bytes_within
from cadgraph.errors import LabelError
from cadgraph.model.scene import MeshArrays, Scene
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["SUFFIX", "Catalog", "Entry", "read_catalog", "rows_of", "write_catalog"]

SUFFIX = ".cadgraph-catalog"
"""How the name of a catalogue ends."""

_FORMAT, _VERSION = "cadgraph-catalog", 1
# What a file may hold at most; ours: a thousand times what a maker's catalogue has.
_MOST_ENTRIES, _MOST_TEXT = 100_000, 4096
_ARRAYS: Mapping[str, tuple[str, int]] = {
    "head": ("|u1", 1),
    "vertices": ("<f4", 2),
    "faces": ("<i4", 2),
    "vertex_offsets": ("<i8", 1),
    "face_offsets": ("<i8", 1),
}
# All that reading a damaged zip or array can end in.
_DAMAGE = (
    ValueError, KeyError, EOFError, OSError, NotImplementedError, RuntimeError, SyntaxError, struct.error, zlib.error,
    zipfile.BadZipFile,
)  # fmt: skip
_REMEDY = "make it anew with 'cadgraph catalog add'"


@dataclass(frozen=True)
class Entry:
    """What is known of one shape.

    Args:
        id: made from its triangles, the same wherever the file is made.
        group: of some vocabulary.
        name: in that group, or None.
        file: name of the file that it was taken from, without its folder.
        mesh: path in that file.
        said_by: who gave the label: ``user`` (with the command), else the source of a graph's label.
    """

    id: str
    group: str
    name: str | None
    file: str = ""
    mesh: str = ""
    said_by: str = "user"


@dataclass(frozen=True, repr=False)
class Catalog:
    """Labelled shapes.

    Args:
        entries: what each is.
        shapes: one mesh for each entry, about its own middle, single precision [m].
        file: where it was read from, as the user gave it.
    """

    entries: tuple[Entry, ...]
    shapes: Scene
    file: str = ""

    @classmethod
    def of(cls, shapes: Scene, labels: Sequence[Entry]) -> Catalog:
        """A catalogue of the meshes of a scene; their places are forgotten and entries get their ids.

        Args:
            shapes: one mesh for each entry.
            labels: what each is; their ids are not looked at.
        """
        meshes, entries = [], []
        for i, label in enumerate(labels):
            vertices, faces = shapes.mesh(i)
            used = vertices[np.unique(faces)] if len(faces) else vertices
            middle = (used.min(axis=0) + used.max(axis=0)) / 2 if len(used) else np.zeros(3)
            small = np.round(vertices - middle, 12).astype(np.float32)
            small[small == 0] = 0.0  # no negative zeros, so that equal shapes have equal bytes
            digest = hashlib.sha256(small.tobytes() + b"|" + faces.astype(np.int32).tobytes()).hexdigest()[:12]
            meshes.append((small, faces))
            entries.append(Entry(digest, label.group, label.name, label.file, label.mesh, label.said_by))
        return cls(tuple(entries), Scene.from_meshes(meshes))

    def select(self, rows: Sequence[int]) -> Catalog:
        """Some of the entries, in the order given."""
        return Catalog(tuple(self.entries[i] for i in rows), _renamed(self.shapes.select(list(rows))), self.file)

    def joined(self, other: Catalog) -> Catalog:
        """The entries of this catalogue, then those of another one."""
        meshes = [shapes.mesh(i) for shapes in (self.shapes, other.shapes) for i in range(shapes.n_meshes)]
        return Catalog((*self.entries, *other.entries), Scene.from_meshes(meshes), self.file)


def write_catalog(catalog: Catalog, path: str | Path) -> Path:
    """Writes a catalogue, whole or not at all; the same entries give the same bytes.

    Raises:
        OutputError: it can't be written.
    """
    head = {"format": _FORMAT, "version": _VERSION, "entries": [asdict(entry) for entry in catalog.entries]}
    shapes, target = catalog.shapes, Path(path)
    content = BytesIO()
    np.savez_compressed(
        content,
        allow_pickle=False,
        head=np.frombuffer(json.dumps(head, sort_keys=True, ensure_ascii=True).encode(), "|u1"),
        vertices=shapes.vertices.astype("<f4"),
        faces=shapes.faces.astype("<i4"),
        vertex_offsets=shapes.vertex_offsets.astype("<i8"),
        face_offsets=shapes.face_offsets.astype("<i8"),
    )
    write_atomically(target, content.getvalue())
    return target


def read_catalog(path: str | Path) -> Catalog:
    """Reads what ``write_catalog`` wrote.

    Raises:
        LabelError: the file is missing, damaged, too large, or of another version.
    """
    content = read_bytes_within(
        path,
        CATALOG,
        LabelError,
        "split the catalogue",
        "check the path, or make a catalogue with 'cadgraph catalog add'",
    )
    arrays = _arrays(content, path)
    try:
        head = json.loads(arrays["head"].tobytes().decode())
    except (ValueError, RecursionError) as error:
        raise LabelError(f"{path}: the catalogue is damaged (its head is no JSON); {_REMEDY}") from error
    if not isinstance(head, Mapping) or head.get("format") != _FORMAT:
        raise LabelError(f"{path}: no catalogue of cadgraph; {_REMEDY}")
    if head.get("version") != _VERSION:
        raise LabelError(
            f"{path}: a catalogue of version {str(head.get('version'))[:20]}, but this cadgraph reads version "
            f"{_VERSION}; update it"
        )
    entries = _entries(head.get("entries"), path)
    return Catalog(entries, _shapes(arrays, len(entries), path), str(path))


def rows_of(catalog: Catalog) -> list[dict[str, Any]]:
    """The entries as plain values: what each is, where it comes from, its size [m] along its axes and its triangles."""
    rows = []
    for i, entry in enumerate(catalog.entries):
        vertices, faces = catalog.shapes.mesh(i)
        extents = np.ptp(vertices, axis=0) if len(vertices) else np.zeros(3)
        size = [round(x, 6) for x in sorted(extents.tolist(), reverse=True)]
        rows.append({**asdict(entry), "size": size, "n_triangles": len(faces)})
    return rows


def _arrays(content: bytes, path: str | Path) -> dict[str, Any]:
    """The arrays, once their sizes are known to be what the file really holds."""
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            infos = archive.infolist()
            if sorted(info.filename for info in infos) != sorted(f"{name}.npy" for name in _ARRAYS):
                raise LabelError(f"{path}: no catalogue of cadgraph (it holds other things); {_REMEDY}")
        arrays = read_arrays(content, CATALOG)
        for name, (kind, n_axes) in _ARRAYS.items():
            own = arrays[name]
            if own.dtype != np.dtype(kind) or own.ndim != n_axes or (n_axes == 2 and own.shape[1] != 3):
                raise ValueError(f"{name}.npy is of another form")
        return arrays
    except _DAMAGE as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0][:120]
        raise LabelError(f"{path}: the catalogue is damaged ({reason}); {_REMEDY}") from error


def _entries(rows: Any, path: str | Path) -> tuple[Entry, ...]:
    if not isinstance(rows, list) or len(rows) > _MOST_ENTRIES:
        raise LabelError(f"{path}: the catalogue is damaged (no list of at most {_MOST_ENTRIES:,} entries); {_REMEDY}")
    entries = []
    for i, row in enumerate(rows):
        if not isinstance(row, Mapping):
            raise LabelError(f"{path}: the catalogue is damaged (entry {i}); {_REMEDY}")
        texts = [row.get(key) or "" for key in ("id", "group", "name", "file", "mesh", "said_by")]
        if not all(isinstance(text, str) and len(text) <= _MOST_TEXT for text in texts):
            raise LabelError(f"{path}: the catalogue is damaged (entry {i}); {_REMEDY}")
        digest, group, name, file, mesh, said_by = map(str, texts)
        # What a label may hold, the vocabulary knows best.
        Vocabulary.from_json({group: {"names": [name] if name else []}}, f"{path}: entry {i}")
        entries.append(Entry(digest, group, name or None, file, mesh, said_by))
    return tuple(entries)


def _shapes(arrays: Mapping[str, Any], n: int, path: str | Path) -> Scene:
    vertices, faces = arrays["vertices"], arrays["faces"]
    ends = {"vertex_offsets": len(vertices), "face_offsets": len(faces)}
    for name, end in ends.items():
        offsets = arrays[name]
        if len(offsets) != n + 1 or offsets[0] != 0 or offsets[-1] != end or np.any(np.diff(offsets) < 0):
            raise LabelError(f"{path}: the catalogue is damaged ({name} don't fit); {_REMEDY}")
    most = np.repeat(np.diff(arrays["vertex_offsets"]), np.diff(arrays["face_offsets"]))
    if len(faces) and (faces.min() < 0 or np.any(faces >= most[:, None])):
        raise LabelError(f"{path}: the catalogue is damaged (a face refers to no vertex); {_REMEDY}")
    if not np.isfinite(vertices).all():
        raise LabelError(f"{path}: the catalogue is damaged (a vertex is not finite); {_REMEDY}")
    return _renamed(
        Scene(
            MeshArrays(
                vertices.astype(np.float64),
                faces.astype(np.int32),
                arrays["vertex_offsets"].astype(np.int64),
                arrays["face_offsets"].astype(np.int64),
            ),
            tuple(f"/{i}" for i in range(n)),
            np.full((n, 3), np.nan, np.float32),
        )
    )


def _renamed(shapes: Scene) -> Scene:
    """The same meshes under plain names."""
    return Scene(shapes.shapes, tuple(f"/mesh_{i}" for i in range(shapes.n_meshes)), shapes.colors)
