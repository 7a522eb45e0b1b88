"""How a correction finds its part again in another export of a model: by shape and place, else by shape and path."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.parts import Parts, Properties
from cadgraph.model.scene import Floats, Scene

__all__ = ["Anchor", "Anchored", "Fingerprint", "anchor_of", "anchored_meshes", "anchored_parts", "fingerprint_of"]

_SLACK = 1e-3  # of a length; ours: another writer rounds to single precision, another tessellation differs by more
_LEAST = 1e-5  # m
_PLACE = 0.01  # m; what was renamed lies where it lay


@dataclass(frozen=True)
class Fingerprint:
    """What of a shape stays in any pose.

    Args:
        n_triangles: of the part.
        lengths: square root of the area, then the extents of the oriented box, descending [m].
    """

    n_triangles: int
    lengths: tuple[float, float, float, float]

    def agrees(self, other: Fingerprint) -> bool:
        """Whether both may be of one shape."""
        return self.n_triangles == other.n_triangles and all(
            abs(a - b) <= _LEAST + _SLACK * max(a, b) for a, b in zip(self.lengths, other.lengths, strict=True)
        )


@dataclass(frozen=True)
class Anchor:
    """What a part, or a mesh, is found again by.

    Args:
        mesh: source path of the mesh, of a part that of its largest one.
        fingerprint: of its shape.
        centroid: world coordinates [m].
    """

    mesh: str
    fingerprint: Fingerprint
    centroid: tuple[float, float, float]


def fingerprint_of(properties: Properties, row: int) -> Fingerprint:
    """What of a part's, or a mesh's, shape stays in any pose.

    Args:
        properties: of all of them.
        row: its number.
    """
    extents = [float(x) for x in properties.obb_extents[row]]
    lengths = (float(np.sqrt(max(properties.area[row], 0.0))), extents[0], extents[1], extents[2])
    return Fingerprint(int(properties.n_triangles[row]), lengths)


def anchor_of(path: str, properties: Properties, row: int, origin: Floats) -> Anchor:
    """What a part, or a mesh, is found again by.

    Args:
        path: of its largest mesh.
        properties: of all of them.
        row: its number.
        origin: of the scene, ``(3,)`` [m].
    """
    x, y, z = (float(v) for v in properties.centroid[row] + origin)
    return Anchor(path, fingerprint_of(properties, row), (x, y, z))


@dataclass(frozen=True, eq=False)
class Anchored:
    """The parts, or the meshes, of a scene, to be found by anchors.

    Args:
        row_of: the number of what each source path belongs to.
        properties: of each.
        origin: of the scene, ``(3,)`` [m].
    """

    row_of: Mapping[str, int]
    properties: Properties
    origin: Floats

    def find(self, anchor: Anchor) -> int | None:
        """What an anchor means: what of its shape lies in its place, that of its path first; else that of its path.

        Place goes before path where both say otherwise: an export that numbers equal parts anew after one of them is
        gone gives each the name of its neighbour, and none of them has moved.

        Returns:
            Its number; None where there is none.
        """
        here = self.row_of.get(anchor.mesh)
        if here is not None and not fingerprint_of(self.properties, here).agrees(anchor.fingerprint):
            here = None
        place = np.asarray(anchor.centroid) - self.origin
        if here is not None and self._apart(here, place) <= _PLACE:
            return here
        alike = [
            (self._apart(row, place), row)
            for row in self._of_count.get(anchor.fingerprint.n_triangles, ())
            if fingerprint_of(self.properties, row).agrees(anchor.fingerprint)
        ]
        far, nearest = min(alike, default=(np.inf, -1))
        return nearest if far <= _PLACE else here

    def _apart(self, row: int, place: Floats) -> float:
        return float(np.linalg.norm(self.properties.centroid[row] - place))

    def find_all(self, anchors: Sequence[Anchor]) -> list[int]:
        """What anchors mean, each once; what is not there is left out."""
        found = (self.find(anchor) for anchor in anchors)
        return list(dict.fromkeys(row for row in found if row is not None))

    @cached_property
    def _of_count(self) -> Mapping[int, list[int]]:
        """Those of each number of triangles."""
        found: dict[int, list[int]] = {}
        for row, count in enumerate(self.properties.n_triangles.tolist()):
            found.setdefault(count, []).append(row)
        return found


def anchored_parts(scene: Scene, parts: Parts) -> Anchored:
    """The parts of a scene, to be found by anchors.

    Args:
        scene: the source meshes.
        parts: made from them.
    """
    rows = dict(zip(scene.paths, parts.part_of_mesh.tolist(), strict=True))
    return Anchored(rows, parts.properties, scene.origin)


def anchored_meshes(scene: Scene, properties: Properties) -> Anchored:
    """The meshes of a scene, to be found by anchors.

    Args:
        scene: the source meshes.
        properties: of each.
    """
    return Anchored({path: row for row, path in enumerate(scene.paths)}, properties, scene.origin)
