"""A scene as a folder of arrays, for the way from a reading process to its caller."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from cadgraph._io.arrays import check_array, write_array
from cadgraph._io.limits import EXCHANGE_HEAD, read_text_within
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact, StatedLink
from cadgraph.model.scene import Ints, MeshArrays, Placement, Scene, Source

__all__ = ["read_scene", "write_scene"]

_SHAPES = ("vertices", "faces", "vertex_offsets", "face_offsets")
_PLACEMENT = ("shape", "turn", "shift")
_ARRAYS = ("colors", "origin")


def write_scene(scene: Scene, folder: Path) -> None:
    """Writes a scene into an existing folder: an ``.npy`` file for each array and ``scene.json``."""
    arrays = {name: getattr(scene.shapes, name) for name in _SHAPES}
    arrays |= {name: getattr(scene, name) for name in _ARRAYS}
    if scene.placement is not None:
        arrays |= {f"placed-{name}": getattr(scene.placement, name) for name in _PLACEMENT}
    # Facts repeat their paths and words many times over.
    texts: dict[str, int] = {}
    arrays |= {"facts": _numbered(scene.facts, texts), "links": _numbered(scene.links, texts)}
    for name, array in arrays.items():
        write_array(folder / f"{name}.npy", array)
    rest = {
        "placed": scene.placement is not None,
        "paths": scene.paths,
        "anchors": scene.anchors,
        "source": asdict(scene.source),
        "texts": list(texts),
        "diagnostics": [note.model_dump() for note in scene.diagnostics],
    }
    (folder / "scene.json").write_text(json.dumps(rest), encoding="utf-8")


def read_scene(folder: Path) -> Scene:
    """Reads what ``write_scene`` wrote.

    Raises:
        OSError, ValueError, KeyError: the folder doesn't hold a whole scene.
    """
    rest = json.loads(read_text_within(folder / "scene.json", EXCHANGE_HEAD, ValueError, "split the scene"))
    return Scene(
        MeshArrays(**{name: _array(folder / f"{name}.npy") for name in _SHAPES}),
        placement=Placement(**{name: _array(folder / f"placed-{name}.npy") for name in _PLACEMENT})
        if rest["placed"]
        else None,
        **{name: _array(folder / f"{name}.npy") for name in _ARRAYS},
        paths=tuple(rest["paths"]),
        anchors=tuple(rest["anchors"]),
        source=_source(rest["source"]),
        diagnostics=tuple(
            Diagnostic(note["code"], note["message"], tuple(note["meshes"])) for note in rest["diagnostics"]
        ),
        facts=tuple(map(Fact, *_columns(folder / "facts.npy", rest["texts"], len(Fact._fields)))),
        links=tuple(map(StatedLink, *_columns(folder / "links.npy", rest["texts"], len(StatedLink._fields)))),
    )


def _numbered(rows: Sequence[tuple[str, ...]], texts: dict[str, int]) -> Ints:
    """Rows of texts as an array of their numbers, ``(n, width)``; new texts are added."""
    numbers = np.array([texts.setdefault(text, len(texts)) for row in rows for text in row], np.int64)
    return numbers.reshape(len(rows), -1 if rows else 1)


def _columns(path: Path, texts: Sequence[str], width: int) -> list[list[str]]:
    """What ``_numbered`` made, as columns of texts."""
    numbers = _array(path)
    if not len(numbers):
        return [[] for _ in range(width)]
    if numbers.ndim != 2 or numbers.shape[1] != width or numbers.min() < 0 or numbers.max() >= len(texts):
        raise ValueError(f"{path.name}: not the numbers of texts")
    return [[texts[number] for number in column] for column in numbers.T.tolist()]


def _source(values: dict[str, Any]) -> Source:
    pairs = {key: tuple((name, value) for name, value in values[key]) for key in ("metadata", "referred")}
    return Source(**{**values, **pairs})


def _array(path: Path) -> Any:
    """An array, once it is known to be as large as its head says: a library that a damaged file led astray wrote it."""
    with path.open("rb") as file:
        check_array(file, path.stat().st_size, path.name)
    return np.load(path, allow_pickle=False)
