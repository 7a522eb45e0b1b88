"""The truth of a plant for a loaded scene, found by where its meshes lie: names are read in more than one way."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.truth import Truth, TruthMesh
from cadplants.writers.placing import centroid

__all__ = ["Match", "match", "truth_for"]

_TOLERANCE = 0.001
"""How far the sides of two boxes of one mesh may be apart [m] (ours: a reader cuts round shapes to half of that)."""


@dataclass(frozen=True)
class Match:
    """Which meshes of a truth are which of a scene.

    Args:
        same: path in the scene by path in the truth, where one is one.
        split: paths in the scene by path in the truth, where one became several.
        merged: paths in the truth by path in the scene, where several became one.
        missing: paths in the truth that nothing in the scene is.
        surplus: paths in the scene that the truth has nothing of.
    """

    same: dict[str, str]
    split: dict[str, tuple[str, ...]]
    merged: dict[str, tuple[str, ...]]
    missing: tuple[str, ...]
    surplus: tuple[str, ...]

    def lines(self) -> tuple[str, ...]:
        """What did not go one to one, for people; empty where everything did."""
        said = (
            ("meshes of the truth are several of the scene", len(self.split)),
            ("meshes of the scene are several of the truth", len(self.merged)),
            ("meshes of the truth are not in the scene", len(self.missing)),
            ("meshes of the scene are not in the truth", len(self.surplus)),
        )
        return tuple(f"{count} {what}" for what, count in said if count)


def match(scene: Scene, truth: Truth, tolerance: float = _TOLERANCE) -> Match:
    """Finds the meshes of a truth in a scene.

    A mesh is the one whose box has its sides in the same places; of several that of the nearest centre. One of many
    pieces is looked for as these first: one, say the rim of a wheel, may have the box of the whole. What is left
    is looked for as any of its pieces, then as a part of what is larger.

    Args:
        scene: as loaded from the file beside the truth.
        truth: with the ``bounds`` of its meshes, as ``write_plant`` writes it.
        tolerance: how far the sides of two boxes may be apart [m].

    Raises:
        ValueError: the truth does not say where its meshes lie.
    """
    rows = _rows(truth)
    boxes, centers = _of_scene(scene)
    wanted = np.array([row.box for row in rows]).reshape(-1, 6)
    middles = np.array([row.center for row in rows]).reshape(-1, 3)
    every = np.arange(len(rows))
    plain = np.array([not row.pieces for row in rows], np.bool_)

    def whole(left: Ints, free: Ints) -> dict[int, int]:
        found = _pairs(wanted[left], middles[left], boxes, centers, free, tolerance)
        return {int(left[k]): i for k, i in found.items()}

    free = np.arange(scene.n_meshes)
    same = whole(every[plain], free)
    free = _without(free, same.values())
    split = _apart(rows, every[~plain], boxes, free, tolerance)
    free, left = _without(free, *split.values()), _without(every, same, split)
    same |= whole(left, free)
    free, left = _without(free, same.values()), _without(left, same)
    for k, some in _pieces(rows, left, list(split), boxes, free, tolerance).items():
        split[k] = sorted([*split.get(k, ()), *some])
    free, left = _without(free, *split.values()), _without(left, split)
    merged = _unions(rows, left, boxes, free, tolerance)
    return _named(rows, scene.paths, same, split, merged, _without(left, *merged.values()), _without(free, merged))


def _without(numbers: Iterable[int], *gone: Iterable[int]) -> Ints:
    """Ascending numbers, less those that are gone."""
    return np.array(sorted(set(numbers).difference(*gone)), np.int64)


def _named(
    rows: Sequence[_Row],
    paths: Sequence[str],
    same: Mapping[int, int],
    split: Mapping[int, list[int]],
    merged: Mapping[int, list[int]],
    missing: Ints,
    surplus: Ints,
) -> Match:
    """What was found, by paths instead of numbers."""
    return Match(
        same={rows[k].path: paths[i] for k, i in sorted(same.items())},
        split={rows[k].path: tuple(paths[i] for i in some) for k, some in sorted(split.items())},
        merged={paths[i]: tuple(rows[k].path for k in some) for i, some in sorted(merged.items())},
        missing=tuple(rows[k].path for k in missing.tolist()),
        surplus=tuple(paths[i] for i in surplus.tolist()),
    )


def _paths_now(found: Match) -> dict[str, tuple[str, ...]]:
    """The paths that each mesh of a truth has in the scene."""
    now: dict[str, tuple[str, ...]] = {old: (new,) for old, new in found.same.items()} | found.split
    return now | {old: (new,) for new, some in found.merged.items() for old in some}


def truth_for(scene: Scene, truth: Truth, tolerance: float = _TOLERANCE) -> Truth:
    """The truth in terms of a scene's own paths.

    Pieces of one mesh have its label, unit and cluster each, and are one part. What several meshes became one of has
    their label where they agree, and none where they don't. Contacts are left out where anything was split or merged,
    as it isn't known which pieces touch; else the looseness grows to what a reader's facets leave between parts. A unit
    of which nothing is there is left out with its connections.

    Args:
        scene: as loaded from the file beside the truth.
        truth: with the ``bounds`` of its meshes.
        tolerance: how far the sides of two boxes may be apart [m].

    Raises:
        ValueError: the truth does not say where its meshes lie.
    """
    found = match(scene, truth, tolerance)
    now = _paths_now(found)
    data = truth.to_json()
    data["meshes"] = _labels(scene, data["meshes"], now)
    _map_units(data, now)
    data["clusters"] = _grouped(data["clusters"], "meshes", now)
    data["parts"] = _parts(data["parts"], found, now)
    data["contacts"] = None if found.split or found.merged else _mapped_pairs(data["contacts"], now)
    if data["contacts"]:
        data["looseness"] = max(data["looseness"] or 0.0, _gap(scene, data["contacts"], tolerance))
    data["duplicates"] = _mapped_pairs(data["duplicates"], now) or []
    if "devices" in data:
        data["devices"] = [row for row in _grouped(data["devices"], "meshes", now) or () if row["meshes"]]
    for section in {"hidden", "wrong_classes", "missing_names"} & data.keys():
        data[section] = list(_flat(data[section], now))
    for section in ("flaws", "gaps"):
        data[section] = {path: value for old, value in data[section].items() for path in now.get(old, ())}
    return Truth.from_json(data)


def _gap(scene: Scene, pairs: Sequence[Sequence[str]], most: float) -> float:
    """The widest gap of pairs of meshes, rounded up to a micrometre, of those that a reader may have made [m]."""
    from cadgraph.geometry.contact.pairs import distances

    number = {path: i for i, path in enumerate(scene.paths)}
    found, _ = distances(scene, [(number[a], number[b]) for a, b in pairs], 2 * most)
    small = found[found <= most]
    return float(np.ceil(small.max() * 1e6) / 1e6) if len(small) else 0.0


def _map_units(data: dict[str, Any], now: _Now) -> None:
    """Units with new paths; those of which nothing is there go, and their connections with them."""
    units = _grouped(data["units"], "meshes", now)
    if units is None:
        return
    for unit in units:
        unit["fasteners"] = sorted(_flat(unit.get("fasteners", ()), now))
        turns = unit.get("turns")
        if turns is not None:
            paths = now.get(turns["mesh"], ())
            unit["turns"] = {**turns, "mesh": paths[0]} if paths else None
    gone = {unit["id"] for unit in units if not unit["meshes"]}
    data["units"] = [unit for unit in units if unit["id"] not in gone]
    if data["connections"] is not None:
        data["connections"] = [one for one in data["connections"] if not {one["from"], one["to"]} & gone]


@dataclass(frozen=True)
class _Row:
    path: str
    box: Floats
    center: Floats
    pieces: tuple[Floats, ...]


def _rows(truth: Truth) -> list[_Row]:
    rows = []
    for mesh in truth.meshes:
        bounds = _extra(mesh, "bounds")
        if bounds is None:
            raise ValueError(
                f"the truth does not say where {mesh.mesh} lies (key 'bounds'); write the plant with write_plant"
            )
        box = np.asarray(bounds, np.float64).reshape(6)
        middle = _extra(mesh, "centroid")
        center = box.reshape(2, 3).mean(axis=0) if middle is None else np.asarray(middle, np.float64)
        pieces = tuple(np.asarray(one, np.float64).reshape(6) for one in _extra(mesh, "pieces") or ())
        rows.append(_Row(mesh.mesh, box, center, pieces))
    return rows


def _extra(mesh: TruthMesh, key: str) -> Any:
    return (mesh.model_extra or {}).get(key)


def _of_scene(scene: Scene) -> tuple[Floats, Floats]:
    """``(n, 6)`` boxes and ``(n, 3)`` centres of the meshes' surfaces, in world coordinates [m]."""
    boxes, centers = np.zeros((scene.n_meshes, 6)), np.zeros((scene.n_meshes, 3))
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        used = vertices[np.unique(faces)] + scene.origin
        boxes[i] = [*used.min(axis=0), *used.max(axis=0)]
        centers[i] = centroid(vertices, faces) + scene.origin
    return boxes, centers


def _pairs(
    wanted: Floats, middles: Floats, boxes: Floats, centers: Floats, free: Ints, tolerance: float
) -> dict[int, int]:
    """What is nearest to what, each once: number of a mesh of the scene by number of what is wanted."""
    if not len(wanted) or not len(free):
        return {}
    close: Sequence[list[int]] = cKDTree(boxes[free]).query_ball_point(wanted, tolerance, p=np.inf)  # type: ignore[assignment]
    cases = []
    for k, near in enumerate(close):
        for j in near:
            i = int(free[j])
            apart = float(np.abs(boxes[i] - wanted[k]).max() + np.linalg.norm(centers[i] - middles[k]))
            cases.append((round(apart, 9), k, i))
    found: dict[int, int] = {}
    used: set[int] = set()
    for _, k, i in sorted(cases):
        if k not in found and i not in used:
            found[k] = i
            used.add(i)
    return found


def _apart(rows: Sequence[_Row], left: Ints, boxes: Floats, free: Ints, tolerance: float) -> dict[int, list[int]]:
    """Meshes of the scene that are most of the pieces of one of the truth, by its number."""
    found = _of_boxes(rows, left, free, boxes, tolerance)
    return {k: some for k, some in found.items() if len(some) > max(1, len(rows[k].pieces) // 2)}


def _of_boxes(rows: Sequence[_Row], left: Ints, free: Ints, boxes: Floats, tolerance: float) -> dict[int, list[int]]:
    """Meshes of the scene whose boxes are those of pieces of one of the truth, by its number."""
    owners = [k for k in left.tolist() for _ in rows[k].pieces]
    wanted = np.array([piece for k in left.tolist() for piece in rows[k].pieces]).reshape(-1, 6)
    middles = (wanted[:, :3] + wanted[:, 3:]) / 2
    inner = (boxes[:, :3] + boxes[:, 3:]) / 2
    found: dict[int, list[int]] = defaultdict(list)
    for piece, i in _pairs(wanted, middles, boxes, inner, free, tolerance).items():
        found[owners[piece]].append(i)
    return {k: sorted(some) for k, some in found.items()}


def _pieces(
    rows: Sequence[_Row], left: Ints, begun: Sequence[int], boxes: Floats, free: Ints, tolerance: float
) -> dict[int, list[int]]:
    """Further meshes of the scene that are pieces of one of the truth, by its number; some are found in part."""
    found = defaultdict(list, _of_boxes(rows, left, free, boxes, tolerance))
    used = {i for some in found.values() for i in some}
    # What is cut otherwise lies within the mesh that it is from; the smallest that holds it is the likeliest.
    whole = [*left.tolist(), *begun]
    sizes = {k: float(np.linalg.norm(rows[k].box[3:] - rows[k].box[:3])) for k in whole}
    for i in free.tolist():
        holders = [k for k in whole if i not in used and _within(boxes[i], rows[k].box, tolerance)]
        if holders:
            found[min(holders, key=lambda k: (sizes[k], k))].append(i)
    return {k: sorted(some) for k, some in found.items()}


def _unions(rows: Sequence[_Row], left: Ints, boxes: Floats, free: Ints, tolerance: float) -> dict[int, list[int]]:
    """Meshes of the truth that are one of the scene together, by its number."""
    sizes = np.linalg.norm(boxes[:, 3:] - boxes[:, :3], axis=1)
    found: dict[int, list[int]] = defaultdict(list)
    for k in left.tolist():
        holders = [i for i in free.tolist() if _within(rows[k].box, boxes[i], tolerance)]
        if holders:
            found[min(holders, key=lambda i: (sizes[i], i))].append(k)
    return dict(found)


def _within(inner: Floats, outer: Floats, tolerance: float) -> bool:
    return bool((inner[:3] >= outer[:3] - tolerance).all() and (inner[3:] <= outer[3:] + tolerance).all())


_Now = dict[str, tuple[str, ...]]


def _labels(scene: Scene, rows: list[dict[str, Any]], now: _Now) -> list[dict[str, Any]]:
    """A row for each mesh of the scene, in its order."""
    of: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in rows:
        for path in now.get(row["mesh"], ()):
            of[path].append(row)
    made = []
    for path in scene.paths:
        some = of.get(path, [])
        label: dict[str, Any] = {"mesh": path, "group": None, "name": None}
        for key in ("group", "name", "line", "family", "build", "granularity", "hand"):
            values = {one.get(key) for one in some}
            if len(values) == 1 and (value := values.pop()) is not None:
                label[key] = value
        made.append(label)
    return made


def _flat(old: Iterable[str], now: _Now) -> Iterator[str]:
    """New paths of old ones, each once."""
    return iter(dict.fromkeys(path for one in old for path in now.get(one, ())))


def _grouped(rows: list[dict[str, Any]] | None, key: str, now: _Now) -> list[dict[str, Any]] | None:
    """Rows with new paths, each path in the first row that has it."""
    if rows is None:
        return None
    used: set[str] = set()
    made = []
    for row in rows:
        paths = [path for path in _flat(row[key], now) if path not in used]
        used.update(paths)
        made.append({**row, key: paths})
    return made


def _parts(parts: list[list[str]] | None, found: Match, now: _Now) -> list[list[str]] | None:
    if parts is None:
        return None
    known = {old for part in parts for old in part}
    every = [*parts, *([old] for old in found.split if old not in known)]
    used: set[str] = set()
    made = []
    for part in every:
        paths = [path for path in _flat(part, now) if path not in used]
        used.update(paths)
        if len(paths) > 1:
            made.append(paths)
    return sorted(made, key=lambda paths: (-len(paths), paths))


def _mapped_pairs(pairs: list[list[str]] | None, now: _Now) -> list[list[str]] | None:
    """Pairs of new paths, of those whose both ends are one mesh each and not the same."""
    if pairs is None:
        return None
    ends = [(now.get(a, ()), now.get(b, ())) for a, b in pairs]
    return [[a[0], b[0]] for a, b in ends if len(a) == len(b) == 1 and a[0] != b[0]]
