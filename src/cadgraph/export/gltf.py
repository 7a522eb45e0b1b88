"""A copy of a glTF file with the labels in its nodes; only the JSON changes, all buffers stay as they are."""

from __future__ import annotations

import json
import os
import shutil
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any
from urllib.parse import quote, unquote, urlsplit

from cadgraph._io.atomic import replacing, write_atomically
from cadgraph._io.limits import GRAPH, read_bytes_within, size_text
from cadgraph._io.text import natural_key
from cadgraph.errors import LoadError
from cadgraph.export.labels import MeshLabel, mesh_labels
from cadgraph.export.source import refuse_source
from cadgraph.load.gltf_file import Gltf
from cadgraph.load.gltf_nodes import node_paths
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph

__all__ = ["write_gltf"]

_JSON = 0x4E4F534A  # chunk type, glTF 2.0 section 4.4.3
_HEAD = struct.Struct("<4sII")
_CHUNK = struct.Struct("<II")
_LARGEST = 0xFFFFFFFF  # bytes of a binary glTF file: its length is 32 bits wide


def write_gltf(graph: SceneGraph, source: str | Path, path: str | Path) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes a copy of a glTF file in which every labelled node says what it is.

    ``node.extras.cadgraph`` is ``{group, name, confidence, state, source, part, unit, tag}``; where one node holds
    meshes of several labels (instances, split bodies), it is that of the largest part, with all of them by the rest of
    their path in ``meshes``. Extras that are there stay. Files that the source refers to are referred to from the new
    place.

    Args:
        graph: the finished graph.
        source: the ``.glb`` or ``.gltf`` file that it was made from, see :func:`find_source`.
        path: the copy, of the same kind.

    Returns:
        The file, and notes: ``unmatched-mesh`` names labelled meshes that no node was found for.

    Raises:
        LoadError: the source is no glTF 2.0 file, or damaged.
        OutputError: the copy can't be written, or would replace the source.
    """
    origin, target = Path(source), Path(path)
    refuse_source(origin, target)
    try:
        with origin.open("rb") as file:
            if file.read(4) == b"glTF":
                file.seek(0)
                return target, _write_binary(graph, origin, file, target)
    except OSError as error:
        raise LoadError(f"{origin}: can't be read ({error.strerror}); check the path") from error
    tree = _parsed(read_bytes_within(origin, GRAPH, LoadError, "export it as .glb"), origin)
    notes = _annotate(tree, origin, graph)
    _move_references(tree, origin, target)
    write_atomically(target, _json_bytes(tree))
    return target, notes


def _write_binary(graph: SceneGraph, origin: Path, file: IO[bytes], target: Path) -> tuple[Diagnostic, ...]:
    damaged = LoadError(f"{origin}: damaged binary glTF; export it again")
    head = file.read(_HEAD.size + _CHUNK.size)
    if len(head) < _HEAD.size + _CHUNK.size:
        raise damaged
    _, version, total = _HEAD.unpack_from(head)
    length, kind = _CHUNK.unpack_from(head, _HEAD.size)
    rest = total - len(head) - length
    if version != 2 or kind != _JSON or rest < 0 or origin.stat().st_size < total:
        raise damaged
    if length > GRAPH.most:
        raise LoadError(f"{origin}: {size_text(length)} of JSON, and at most {size_text(GRAPH.most)} are read")
    tree = _parsed(file.read(length), origin)
    notes = _annotate(tree, origin, graph)
    _move_references(tree, origin, target)
    text = _json_bytes(tree)
    text += b" " * (-len(text) % 4)
    size = _HEAD.size + _CHUNK.size + len(text) + rest
    if size > _LARGEST:
        raise LoadError(f"{origin}: too large for a binary glTF file with labels in it; export it as .gltf")
    with replacing(target) as beside, beside.open("wb") as out:
        out.write(_HEAD.pack(b"glTF", 2, size) + _CHUNK.pack(len(text), _JSON) + text)
        shutil.copyfileobj(file, out)
        out.truncate(size)
    return notes


def _parsed(data: bytes, origin: Path) -> dict[str, Any]:
    try:
        tree = json.loads(data.decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise LoadError(f"{origin}: not glTF ({error}); export it again") from None
    if not isinstance(tree, dict) or not isinstance(tree.get("asset"), Mapping):
        raise LoadError(f"{origin}: not glTF 2.0 (no asset); export it again")
    return tree


def _annotate(tree: dict[str, Any], origin: Path, graph: SceneGraph) -> tuple[Diagnostic, ...]:
    """Puts the labels into the nodes of a parsed file."""
    paths = dict(node_paths(Gltf(tree, origin, None)))
    labels = {label.mesh: label for label in mesh_labels(graph)}
    at_node: dict[int, list[tuple[str, MeshLabel]]] = {}
    lost = []
    for mesh, label in labels.items():
        owner = _owner(mesh, paths)
        if owner is None:
            lost.append(mesh)
        else:
            at_node.setdefault(paths[owner], []).append((mesh[len(owner) :].lstrip("/"), label))
    rank = {part.id: part.area for part in graph.parts()}
    for number, found in at_node.items():
        main = max(found, key=lambda item: rank[item[1].part])
        said = _said(main[1])
        if len({_said_key(label) for _, label in found}) > 1:
            said["meshes"] = {
                rest: _said(label) for rest, label in sorted(found, key=lambda item: natural_key(item[0]))
            }
        node = tree["nodes"][number]
        extras = node.get("extras")
        # Extras may be anything by the standard; what is no object is kept beside the labels.
        kept = extras if isinstance(extras, dict) else {} if extras is None else {"value": extras}
        node["extras"] = {**kept, "cadgraph": said}
    if not lost:
        return ()
    return (Diagnostic("unmatched-mesh", "labelled meshes that no node of the file was found for", tuple(lost)),)


def _owner(mesh: str, paths: Mapping[str, int]) -> str | None:
    """The longest of the paths that a mesh's path is or lies below."""
    while mesh:
        if mesh in paths:
            return mesh
        mesh = mesh.rpartition("/")[0]
    return None


def _said(label: MeshLabel) -> dict[str, Any]:
    said = {key: value for key, value in label._asdict().items() if key != "mesh"}
    return {**said, "confidence": round(label.confidence, 6)}


def _said_key(label: MeshLabel) -> tuple[Any, ...]:
    return label[1:]


def _move_references(tree: dict[str, Any], origin: Path, target: Path) -> None:
    """Makes references to files beside the source right as seen from the copy."""
    here, there = origin.resolve().parent, target.resolve().parent
    if here == there:
        return
    lists = [tree.get(name) for name in ("buffers", "images")]
    for item in (item for rows in lists if isinstance(rows, list) for item in rows):
        uri = item.get("uri") if isinstance(item, dict) else None
        if not isinstance(uri, str) or urlsplit(uri).scheme or uri.startswith("/"):
            continue
        try:
            moved = os.path.relpath(here / unquote(uri), there)
        except ValueError:
            # On Windows there is no way from one drive to another.
            item["uri"] = (here / unquote(uri)).as_uri()
        else:
            item["uri"] = quote(moved.replace(os.sep, "/"))


def _json_bytes(tree: Mapping[str, Any]) -> bytes:
    return json.dumps(tree, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "surrogatepass")
