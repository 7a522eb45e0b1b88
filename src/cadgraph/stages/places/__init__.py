"""Places: the levels of a plant, the ways up to them, and how people get at its units."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph.model.labels import Label
from cadgraph.model.parts import Parts, UnitParts
from cadgraph.model.places import FoundPlaces
from cadgraph.stages.places.reach import find_access
from cadgraph.stages.places.site import find_site

__all__ = ["find_places"]


def find_places(parts: Parts, labels: Sequence[Label | None], units: Sequence[UnitParts]) -> FoundPlaces:
    """Finds the places of a plant, and how people get at each of its units.

    Args:
        parts: of the scene.
        labels: of each part.
        units: of the functional network.
    """
    if not parts.n_parts:
        return FoundPlaces()
    places, levels, numbers = find_site(parts, labels)
    return FoundPlaces(tuple(places), find_access(units, parts, labels, levels, numbers))
