"""Which way the face of a gauge looks, and where it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.visibility.front import FEATURES, sides_of
from cadgraph.model.derived import store_of
from cadgraph.model.labels import Label
from cadgraph.model.parts import Parts, UnitParts
from cadgraph.model.scene import Floats

__all__ = ["Face", "face_of", "kind_of_name", "scores_of"]

_READ = ("gauge face", "gauge needle", "gauge glass")
_CARRIERS = ("gauge stem", "siphon", "thermowell")
_FACELESS = ("transmitter", "flow meter", "level gauge", "sight glass")

# How much each thing that is seen of a side speaks for it, and how much it does against the opposite side. Fitted to
# instruments of the generator with a dial or a screen, half of them with all their parts named and half with none
# (packages/cadlab/benchmarks/facings.py --fit).
_WEIGHTS = (
    ("read", 0.170, 0.191),
    ("plate", 0.137, -0.631),
    ("recess", -0.947, -0.862),
    ("pocket", 0.187, 2.334),
    ("flat", 0.627, -2.278),
    ("stem", -0.289, -0.144),
    ("broad", 2.080, 0.000),
    ("level", 1.285, 0.000),
    ("down", -0.983, -0.085),
    ("fine", -1.353, -1.117),
    ("leaves", 0.959, 0.480),
    ("ahead", 1.038, 0.519),
    ("most read", 1.529, 0.953),
    ("most plate", 1.380, 0.430),
    ("most pocket", 0.193, 1.805),
)
_OWN = np.array([{key: own for key, own, _ in _WEIGHTS}[name] for name in FEATURES])
_AGAINST = np.array([{key: against for key, _, against in _WEIGHTS}[name] for name in FEATURES])


@dataclass(frozen=True, eq=False)
class Face:
    """The face of a gauge.

    Args:
        point: ``(3,)`` its middle [m].
        sides: unit vectors that it may look along with their probabilities, the likeliest first; none where it has
            nothing to be read from one side.
        radius: of its head, seen from there [m].
    """

    point: Floats
    sides: tuple[tuple[Floats, float], ...]
    radius: float = 0.0


def face_of(unit: UnitParts, parts: Parts, labels: Sequence[Label | None]) -> Face:
    """Where the face of a gauge is and which way it may look.

    Args:
        unit: of type gauge.
        parts: of the scene.
        labels: of each part.
    """
    names = [label.name if (label := labels[part]) is not None else None for part in unit.parts]
    kept = store_of(parts, "faces of gauges")
    key = unit.parts, tuple(kind_of_name(name) for name in names), _has_a_face(unit, names)
    if key not in kept:
        kept[key] = _face(unit, parts, key[1]) if key[2] else _middle(unit, parts)
    face: Face = kept[key]
    return face


def kind_of_name(name: str | None) -> int:
    """What a part is to the one who reads: 2 to be read, 0 a carrier, 1 a case or unknown."""
    return 2 if name in _READ else 0 if name in _CARRIERS else 1


def _has_a_face(unit: UnitParts, names: Sequence[str | None]) -> bool:
    """Whether there is something like a dial to look for."""
    if any(name in _READ or name == "gauge case" for name in names):
        return not any(word in (unit.kind or "") for word in _FACELESS)
    return not any(name in _FACELESS or name == "thermowell" for name in names)


def _middle(unit: UnitParts, parts: Parts) -> Face:
    boxes = parts.properties.aabb[list(unit.parts)]
    return Face(0.5 * (boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)), ())


def _face(unit: UnitParts, parts: Parts, kinds: Sequence[int]) -> Face:
    vertices, faces, of_face, n = [], [], [], 0
    for part, kind in zip(unit.parts, kinds, strict=True):
        own, triangles = parts.scene.mesh(part)
        inside = ((triangles >= 0) & (triangles < len(own))).all(axis=1)
        vertices.append(own)
        faces.append(triangles[inside] + n)
        of_face.append(np.full(int(inside.sum()), kind, np.int64))
        n += len(own)
    sides = sides_of(np.concatenate(vertices), np.concatenate(faces).astype(np.int32), np.concatenate(of_face))
    if not sides:
        return _middle(unit, parts)
    scores = scores_of(np.array([side.features for side in sides]))
    order = np.argsort(-scores, kind="stable")
    best = sides[order[0]]
    return Face(
        best.center + best.depth * best.direction,
        tuple((sides[k].direction, float(scores[k])) for k in order[:2].tolist()),
        best.radius,
    )


def scores_of(table: Floats) -> Floats:
    """The probability of each side that it is the one that is read.

    Args:
        table: ``(n, len(FEATURES))`` what each shows, opposite sides side by side.
    """
    other = table[np.arange(len(table)) ^ 1]
    speaks = table @ _OWN + (table - other) @ _AGAINST
    odds = np.exp(speaks - speaks.max())
    # Rounded, so that rounding noise does not choose between sides that look the same.
    share: Floats = np.round(odds / odds.sum(), 6)
    return share
