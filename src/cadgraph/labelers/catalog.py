"""Labels from a user's catalogues: parts whose shape is that of an entry, in any pose, triangles or size."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import Shapes, find_shapes
from cadgraph.geometry.shape.similarity import find_alike
from cadgraph.model.catalog import Catalog, Entry
from cadgraph.model.derived import kept_with, store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import CatalogEvidence, Label
from cadgraph.model.parts import Bools, Parts, Properties
from cadgraph.model.scene import Ints, Scene, mesh_of_face
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Match", "apply_catalogs", "decide_matches", "find_matches", "matches_of_shape"]

# Least similarity of another tessellation: of shapes of a form of their own in the same size; of plain ones, or where
# sizes differ. Ours, measured on pairs of shapes of generated plants in different styles; see docs/catalog.md.
LEAST_RICH, LEAST_OTHER = 0.90, 0.95
# The plain ones: prisms, plates, tubes and rings of any section are all alike but for their sizes: a scaled washer is a
# gasket. From this share of the area along or across one axis on a shape is one of them.
_PRISM = 0.985
# Entries of different labels that fit about equally well decide nothing.
_MARGIN = 0.02
_SAME_SIZE = 0.03
_CONFIDENCE = {"exact": 0.99, "mirrored": 0.97, "near": 0.95, "scaled": 0.93}


@dataclass(frozen=True)
class Match:
    """How a shape agrees with an entry.

    Args:
        entry: index.
        kind: ``exact`` (in any pose), ``mirrored`` (exactly its mirror image), ``near`` (other triangles) or
            ``scaled`` (the same proportions).
        similarity: 0..1, 1 where exact.
        scale: size of the shape over that of the entry.
    """

    entry: int
    kind: str
    similarity: float
    scale: float

    @property
    def confidence(self) -> float:
        """Of the label that follows."""
        return _CONFIDENCE[self.kind] * (0.5 + 0.5 * self.similarity)


def apply_catalogs(
    labels: Sequence[Label | None], catalogs: Sequence[Catalog], parts: Parts, vocabulary: Vocabulary
) -> tuple[tuple[Label | None, ...], tuple[Diagnostic, ...]]:
    """Labels the parts that catalogues know, whatever they were labelled before.

    Args:
        labels: of each part so far.
        catalogs: the first that knows a shape counts.
        parts: with their geometry.
        vocabulary: entries with labels outside are left out, and reported.

    Returns:
        The labels of each part, and what is to be reported.
    """
    if not catalogs:
        return tuple(labels), ()
    whole, files, foreign = _gathered(catalogs, vocabulary)
    diagnostics = [
        Diagnostic(
            "catalog-outside-vocabulary",
            f"entries with labels that the vocabulary lacks are not used: {', '.join(foreign)}; add them to the "
            "vocabulary (--vocabulary)",
        )
    ] if foreign else []  # fmt: skip
    rows, shape = np.unique(parts.shape, return_index=True, return_inverse=True)[1:]
    matches, torn = find_matches(whole, parts.scene.select(rows))
    result = list(labels)
    for part, row in enumerate(shape.reshape(-1).tolist()):
        match = matches[row]
        if match is not None and not parts.ground[part]:
            result[part] = _label(whole.entries[match.entry], files[match.entry], match)
    if torn:
        heads = tuple(parts.scene.paths[int(rows[row])] for row in torn)
        diagnostics.append(
            Diagnostic(
                "catalog-ambiguous",
                f"{len(torn)} shapes fit entries of different labels about equally well, so no catalogue decides",
                heads,
            )
        )
    return tuple(result), tuple(diagnostics)


def find_matches(
    catalog: Catalog, shapes: Scene, workers: int | None = None
) -> tuple[tuple[Match | None, ...], tuple[int, ...]]:
    """Finds the entry that each shape agrees with.

    Args:
        catalog: any.
        shapes: distinct meshes.
        workers: threads; the outcome does not depend on it.

    Returns:
        For each mesh how it agrees, None where it doesn't; and the meshes for which entries contradict each other.
    """
    n, m = len(catalog.entries), shapes.n_meshes
    if not n or not m:
        return (None,) * m, ()
    both = _about_middles(catalog.shapes, shapes)
    table = _Table.of(both, measure(both, workers), workers)
    found = _agreeing(table, np.arange(n), np.arange(n, n + m), workers)
    return decide_matches([(entry.group, entry.name) for entry in catalog.entries], found)


def matches_of_shape(parts: Parts, shape: int) -> Mapping[int, Match]:
    """How shapes of some parts agree with one of them, by shape; found once for the same parts.

    Args:
        parts: of a scene.
        shape: as in ``parts.shape``; it is entry 0.
    """
    known = store_of(parts, "matches of shapes")
    if shape not in known:
        shapes, heads, table = _shapes_of(parts)
        entry = np.flatnonzero(shapes == shape)
        found = _agreeing(table, entry, np.arange(len(heads)))
        known[shape] = {int(other): matches[0] for other, matches in zip(shapes, found, strict=True) if matches}
    matches: Mapping[int, Match] = known[shape]
    return matches


@dataclass(frozen=True, eq=False)
class _Table:
    """Meshes that are compared, each about its own middle.

    Args:
        scene: the meshes.
        properties: of each.
        same: which repeat each other.
        rigid: ``(n_meshes,)`` whether each looks like others of its own size only.
    """

    scene: Scene
    properties: Properties
    same: Shapes
    rigid: Bools

    @classmethod
    def of(cls, scene: Scene, properties: Properties, workers: int | None = None) -> _Table:
        return cls(scene, properties, find_shapes(scene, properties, workers), _prisms(scene, properties))


@kept_with
def _shapes_of(parts: Parts) -> tuple[Ints, Ints, _Table]:
    """The distinct shapes of some parts, the first part of each, and their table."""
    shapes, heads = np.unique(parts.shape, return_index=True)
    alone = _about_middles(parts.scene.select(heads))
    return shapes, heads, _Table.of(alone, measure(alone))


def _agreeing(table: _Table, entries: Ints, others: Ints, workers: int | None = None) -> list[list[Match]]:
    """How each of some meshes agrees with entries, which the matches name by their place among them; of entries that
    repeat each other with the first.
    """
    same, found = table.same, [list[Match]() for _ in others]
    first: dict[int, int] = {}
    for entry, k in enumerate(same.shape[entries].tolist()):
        first.setdefault(k, entry)
    # Of two shapes that mirror each other only the later one says so.
    image = {int(same.mirror_of[k]): entry for k, entry in first.items() if same.mirror_of[k] >= 0}
    image |= {k: first[int(of)] for k, of in enumerate(same.mirror_of) if int(of) in first}
    for row, k in enumerate(same.shape[others].tolist()):
        if k in first:
            found[row].append(Match(first[k], "exact", 1.0, 1.0))
        elif k in image:
            found[row].append(Match(image[k], "mirrored", 1.0, 1.0))
    rest = np.array([row for row in range(len(others)) if not found[row]], np.int64)
    row_of, entry_of = dict(zip(others[rest].tolist(), rest.tolist(), strict=True)), {}
    for entry in first.values():
        entry_of[int(entries[entry])] = entry
    rigid, heads = table.rigid, np.array(sorted(entry_of), np.int64)
    least = min(LEAST_RICH, LEAST_OTHER)
    alike = find_alike(table.scene, table.properties, heads, others[rest], rigid, least, workers)
    for (entry, mesh), similarity, scale in zip(
        alike.pairs.tolist(), alike.similarity.tolist(), alike.scale.tolist(), strict=True
    ):
        kind = "near" if abs(np.log(scale)) <= _SAME_SIZE else "scaled"
        rich = kind == "near" and not rigid[entry] and not rigid[mesh]
        if similarity >= (LEAST_RICH if rich else LEAST_OTHER):
            found[row_of[mesh]].append(Match(entry_of[entry], kind, min(1.0, similarity), scale))
    return found


def decide_matches(
    said: Sequence[tuple[str, str | None]], found: Sequence[Sequence[Match]]
) -> tuple[tuple[Match | None, ...], tuple[int, ...]]:
    """The best of the matches of each shape, none where others of its kind say something else.

    Args:
        said: group and name of each entry.
        found: matches of each shape.

    Returns:
        As ``find_matches``.
    """
    chosen: list[Match | None] = []
    torn = []
    for row, matches in enumerate(found):
        best = min(matches, key=_rank, default=None)
        if best is not None:
            rivals = [
                match
                for match in matches
                if match.kind == best.kind
                and match.similarity >= best.similarity - _MARGIN
                and said[match.entry] != said[best.entry]
            ]
            if rivals:
                torn.append(row)
                best = None
        chosen.append(best)
    return tuple(chosen), tuple(torn)


def _rank(match: Match) -> tuple[int, float, float, int]:
    """The kind first, then how alike, then how near in size, then the order of the entries."""
    kinds = tuple(_CONFIDENCE)
    return kinds.index(match.kind), -round(match.similarity, 6), abs(float(np.log(match.scale))), match.entry


def _label(entry: Entry, file: str, match: Match) -> Label:
    how = {
        "exact": "exactly this shape",
        "mirrored": "exactly the mirror image of this shape",
        "near": f"this shape and size with other triangles ({match.similarity:.0%} alike)",
        "scaled": f"this shape at {match.scale:.3g} times its size ({match.similarity:.0%} alike)",
    }[match.kind]
    evidence = CatalogEvidence(
        why=f"{how}: entry {entry.id} of {file}",
        entry=entry.id,
        catalog=file,
        match=match.kind,
        similarity=round(match.similarity, 4),
        taken_from=f"{entry.file} {entry.mesh}".strip() if entry.file else None,
        scale=round(match.scale, 4) if match.kind == "scaled" else None,
    )
    return Label(entry.group, entry.name, match.confidence, "catalog", evidence)


def _gathered(catalogs: Sequence[Catalog], vocabulary: Vocabulary) -> tuple[Catalog, list[str], list[str]]:
    """All usable entries, the name of the file of each, and the labels of the others."""
    whole = Catalog((), Scene.from_meshes([]))
    files: list[str] = []
    foreign: dict[str, None] = {}
    for catalog in catalogs:
        usable = []
        for i, entry in enumerate(catalog.entries):
            if vocabulary.holds(entry.group, entry.name):
                usable.append(i)
            else:
                foreign[f"{entry.group}/{entry.name or ''}".rstrip("/")] = None
        whole = whole.joined(catalog.select(usable))
        files += [catalog.file.replace("\\", "/").rsplit("/", 1)[-1]] * len(usable)
    return whole, files, list(foreign)


def _about_middles(*scenes: Scene) -> Scene:
    """The meshes of all scenes, each about its own middle: far from the origin positions lose digits."""
    meshes = []
    for scene in scenes:
        for i in range(scene.n_meshes):
            vertices, faces = scene.mesh(i)
            finite = vertices[np.isfinite(vertices).all(axis=1)]
            middle = (finite.min(axis=0) + finite.max(axis=0)) / 2 if len(finite) else np.zeros(3)
            meshes.append((vertices - middle, faces))
    return Scene.from_meshes(meshes)


def _prisms(scene: Scene, properties: Properties) -> Bools:
    """``(n_meshes,)`` whether nearly all of the surface runs along or across one axis of the oriented box."""
    corners = scene.triangles()
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1)
    owner: Ints = mesh_of_face(scene)
    along = np.abs(np.einsum("nk,njk->nj", normals, properties.obb_axes[owner]))
    straight = (along <= 0.02 * area[:, None]) | (along >= 0.98 * area[:, None])
    share = np.zeros((scene.n_meshes, 3))
    np.add.at(share, owner, np.where(straight, np.nan_to_num(area)[:, None], 0.0))
    total = np.bincount(owner, np.nan_to_num(area), minlength=scene.n_meshes)
    prisms: Bools = share.max(axis=1, initial=0.0) >= _PRISM * np.maximum(total, 1e-300)
    return prisms
