"""What geometry knows about a part, in words: its form, how often it is there, what it touches."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

import numpy as np

from cadgraph.geometry.shape.primitive import KINDS, Primitives, fit_primitives
from cadgraph.labelers.lvlm.prompt import size_text
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Parts, Properties

__all__ = ["Hints", "neighbors_of"]

_MOST_NEIGHBORS = 8
_FORMS = {
    "plane": "a sheet without thickness",
    "box": "a box",
    "sphere": "a sphere",
    "cylinder": "a cylinder",
    "cone": "a cone",
    "torus": "a torus",
    "extrusion": "a constant section along an axis",
    "revolved": "a body of revolution",
}


def neighbors_of(parts: Parts, contacts: Contacts) -> Mapping[int, tuple[int, ...]]:
    """For each part those that it touches, the ground left out, ascending."""
    near: dict[int, list[int]] = {}
    for a, b in contacts.pairs.tolist():
        if not parts.ground[a] and not parts.ground[b]:
            near.setdefault(a, []).append(b)
            near.setdefault(b, []).append(a)
    return {part: tuple(sorted(others)) for part, others in near.items()}


class Hints:
    """Lines for the prompts of one scene.

    Args:
        parts: of the scene.
        near: what each part touches.
    """

    def __init__(self, parts: Parts, near: Mapping[int, tuple[int, ...]]) -> None:
        self._parts, self._near = parts, near
        self._fits: dict[int, Primitives] = {}

    def lines(self, part: int, repeats: int, labels: Sequence[Label | None]) -> tuple[str, ...]:
        """What is known about a part.

        Args:
            part: which.
            repeats: how many parts are of this shape, in this role.
            labels: of all parts as far as they are known.
        """
        found = [self._form(part)]
        found.append(f"it is there {repeats} times in the plant" if repeats > 1 else "there is only one of it")
        neighbors = self._near.get(part, ())
        if not neighbors:
            found.append("it touches no other part")
            return tuple(found)
        named = Counter(_named(labels[other]) for other in neighbors)
        most = sorted(named.items(), key=lambda row: (-row[1], row[0]))[:_MOST_NEIGHBORS]
        found.append(
            f"it touches {len(neighbors)} part{'s' * (len(neighbors) != 1)}, which were taken for: "
            + ", ".join(f"{count} x {name}" for name, count in most)
        )
        return tuple(found)

    def _form(self, part: int) -> str:
        if part not in self._fits:
            scene = self._parts.scene.select([part])
            self._fits[part] = fit_primitives(scene, _row(self._parts, part), 1)
        fit = self._fits[part]
        kind = int(fit.kind[0])
        if kind < 0:
            return "its form is none of the simple solids"
        words = f"its form is {_FORMS[KINDS[kind]]}"
        if KINDS[kind] in ("cylinder", "cone", "torus", "revolved"):
            words += f", outer diameter {size_text(2 * float(fit.radius[0]))}, {size_text(float(fit.height[0]))} long"
            bore = float(fit.bore[0])
            words += f", open along its axis with a bore of {size_text(2 * bore)}" if bore > 0 else ", without a bore"
        return words


def _named(label: Label | None) -> str:
    return "unknown" if label is None else label.name or label.group


def _row(parts: Parts, part: int) -> Properties:
    measured = parts.properties
    rows = {field.name: np.asarray(getattr(measured, field.name))[[part]] for field in fields(measured)}
    return replace(measured, **rows)
