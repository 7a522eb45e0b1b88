"""AVEVA PDMS and E3D review files (RVM, binary or text) to a scene.

A mesh is a node without others below it, or one primitive of a node with others (the tubes of a branch hang on it
beside its fittings); ``granularity`` changes that. Paths are the names along the tree; an element without a name is
called by its type and number (``VALVE_1``), a primitive ``primitive_3``, the third one of its node.

Every primitive is cut by itself and closed at all its ends. Viewers leave out the caps between neighbours and turn
rings to match, which is right for drawing, but opens the solids.

Notes in ``Scene.diagnostics``: ``attributes-damaged``, ``attributes-of-another``, ``attributes-unread``,
``broken-chunk``, ``broken-link``, ``broken-node``, ``broken-primitive``, ``coarsened``, ``cut-short``,
``degenerate-mesh``, ``empty-mesh``, ``encoding-guessed``, ``flat-primitive``, ``invalid-transform``,
``left-out-lines``, ``left-out-type``, ``left-out-volume``, ``too-far``, ``unbalanced-tree``, ``unknown-chunk``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph.errors import LoadError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from cadgraph.config import LoadConfig
    from cadgraph.load.naming import Names
    from cadgraph.load.packing import Notes
    from cadgraph.load.rvm.chunks import Chunks, Words
    from cadgraph.load.rvm.placing import Meshes
    from cadgraph.load.rvm.primitives import Primitives
    from cadgraph.load.rvm.tree import Tree
    from cadgraph.model.facts import Fact, StatedLink
    from cadgraph.model.scene import Ints, Scene

__all__ = ["element_names", "read"]

_ABRIDGED = ("broken-primitive", "broken-node", "empty-mesh", "invalid-transform", "left-out-type")
_SKEW = 1e-4  # so far directions of binary files may be from a rotation: float32 and the sums of many turns


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads an RVM file, and the attribute file beside it.

    Args:
        path: of the model.
        config: ``granularity``, ``insulation``, ``max_gap``, ``max_angle``, ``max_triangles``, ``metadata``.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it is no RVM file, or holds no primitive with a surface.
    """
    import numpy as np

    from cadgraph.load.packing import Notes, pack_placed
    from cadgraph.load.rvm.attributes import find_attributes, read_attributes
    from cadgraph.load.rvm.colors import colors_of
    from cadgraph.load.rvm.placing import cut_shapes, place
    from cadgraph.load.rvm.primitives import read_primitives
    from cadgraph.load.rvm.shapes import Fineness
    from cadgraph.load.rvm.statements import Owner, find_facts, find_links
    from cadgraph.load.rvm.text import TEXT_SKEW, is_text
    from cadgraph.model.scene import Source

    notes = Notes()
    words, chunks, tree, taken = _opened(path, notes)
    skew = TEXT_SKEW if is_text(path) else _SKEW
    primitives = read_primitives(words, chunks, tree.path_of, notes, config.insulation, skew)
    primitives = primitives.without(_left_out(tree, chunks, notes))
    fineness = Fineness(config.max_gap * 1000, config.max_angle)
    shapes, shape = cut_shapes(words, primitives, fineness, config.max_triangles, tree.path_of, notes)
    meshes = place(primitives, shapes, shape, _joined(tree, primitives, config.granularity))
    paths = _paths(meshes, primitives, chunks, tree, taken)
    node = primitives.node[meshes.first]
    material = np.where(node >= 0, tree.material[node], 0) if len(tree.material) else np.zeros(len(node), np.int64)
    facts: list[Fact] = []
    links: tuple[StatedLink, ...] = ()
    if config.metadata == "keep":
        beside = find_attributes(path, notes)
        told = read_attributes(beside, notes) if beside else {}
        if beside and told and told.keys().isdisjoint(tree.names):
            notes.add(
                "attributes-of-another",
                f"none of the {len(told):,} elements of {beside.name} is in the model: it belongs to another",
            )
        owner = Owner(tree, paths, node, primitives.chunk[meshes.first], meshes.whole.tolist(), told)
        facts, links = list(find_facts(owner)), find_links(owner)
    scene = pack_placed(
        meshes.shapes,
        meshes.shape,
        meshes.matrix,
        paths,
        colors_of(material, words, chunks),
        Source(meters_per_unit=0.001, up_axis="Z", format="rvm", metadata=_metadata(words, chunks)),
        np.eye(4),
        notes,
        _ABRIDGED,
        facts,
        links,
    )
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but holds no primitive with a surface; export it with its geometry")
    return scene


def element_names(path: Path) -> dict[str, str]:
    """What the elements of an RVM file are called in it, by their paths in the scene, in the order of the file.

    Args:
        path: of the model.

    Raises:
        LoadError: it is no RVM file, or can't be read.
    """
    from cadgraph.load.packing import Notes

    try:
        _, _, tree, _ = _opened(path, Notes())
    except OSError as error:
        raise LoadError(f"{path}: can't be read ({error.strerror or error}); check the path") from error
    return dict(zip(tree.paths, tree.names, strict=True))


def _opened(path: Path, notes: Notes) -> tuple[Words, Chunks, Tree, Names]:
    """The words and chunks of a file, its nodes, and the paths that these take."""
    from cadgraph.load.rvm.chunks import find_chunks, map_words
    from cadgraph.load.rvm.text import is_text, read_words
    from cadgraph.load.rvm.tree import read_tree

    words = read_words(path, notes) if is_text(path) else map_words(path)
    chunks = find_chunks(words, path, notes)
    return words, chunks, *read_tree(words, chunks, str(path), notes)


def _left_out(tree: Tree, chunks: Chunks, notes: Notes) -> npt.NDArray[np.bool_]:
    """``(n_nodes,)`` whether all of it stays out; noted where there is something in it."""
    import numpy as np

    at = chunks.of("PRIM")
    filled = np.unique(chunks.node[at])
    for node in filled[filled >= 0].tolist():
        if tree.left_out[node]:
            notes.add("left-out-type", "left out: drawn frames and welds are no parts of a plant", tree.paths[node])
    return tree.left_out


def _joined(tree: Tree, primitives: Primitives, granularity: str) -> npt.NDArray[np.bool_]:
    """Of each primitive, whether it becomes one mesh with the others of its node."""
    import numpy as np

    inside = primitives.node >= 0
    if granularity == "auto" and len(tree.names):
        return inside & ~tree.has_children()[primitives.node]
    return inside if granularity == "node" else np.zeros(len(inside), bool)


def _paths(meshes: Meshes, primitives: Primitives, chunks: Chunks, tree: Tree, taken: Names) -> list[str]:
    place = _places(chunks)
    paths = []
    numbers = place[primitives.chunk[meshes.first]].tolist()
    for whole, node, number in zip(meshes.whole.tolist(), primitives.node[meshes.first].tolist(), numbers, strict=True):
        above = tree.paths[node] if node >= 0 else ""
        paths.append(above if whole else taken.take(f"{above}/primitive_{number}"))
    return paths


def _places(chunks: Chunks) -> Ints:
    """``(n_chunks,)`` of each primitive, the how manieth of its node it is, from 1."""
    import numpy as np

    at = np.sort(np.concatenate([chunks.of(tag) for tag in ("PRIM", "OBST", "INSU")]))
    order = np.argsort(chunks.node[at], kind="stable")
    node = chunks.node[at][order]
    starts = np.searchsorted(node, node)
    place = np.zeros(len(chunks.tag), np.int64)
    place[at[order]] = np.arange(len(at)) - starts + 1
    return place


def _metadata(words: Words, chunks: Chunks) -> tuple[tuple[str, str], ...]:
    """What the file says of itself."""
    from cadgraph._io.text import printable
    from cadgraph.load.rvm.chunks import read_text
    from cadgraph.load.rvm.tree import decode

    found: dict[str, str] = {}
    for tag, names in (("HEAD", ("program", "note", "date", "user")), ("MODL", ("project", "name"))):
        for chunk in chunks.of(tag)[:1].tolist():
            at, end = int(chunks.start[chunk]) + 1, int(chunks.end[chunk])
            for name in names:
                try:
                    raw, at = read_text(words, at, end)
                except ValueError:
                    break
                value = printable(decode(raw)[0]).strip()[:1000]
                if value:
                    found[name] = value
    return tuple(sorted(found.items()))
