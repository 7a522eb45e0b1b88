"""What the stages found, and how it is written down: in world coordinates, rounded."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.facts.places import Places
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact
from cadgraph.model.labels import Guess, Label
from cadgraph.model.mechanisms import UnitMotion
from cadgraph.model.parts import Contacts, Network, Parts
from cadgraph.model.places import FoundPlaces
from cadgraph.model.records import Point, SourceFact, points
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["Results", "extent_of", "fact_records", "in_world", "rounded"]

_LONGEST_FACT = 1000  # characters of a value that are kept; a file may hold anything


@dataclass(frozen=True)
class Results:
    """What the stages found.

    Args:
        scene: the source meshes.
        parts: made from them.
        contacts: pairs of adjacent parts.
        cluster: ``(n_parts,)`` -1 for the ground and for noise.
        pipe_systems: the clusters that hold a connector part.
        labels: of each part.
        guesses: of each part that has no label because nobody is sure enough.
        network: functional units, and what follows what along the lines between them.
        related: pairs of unit indices.
        diagnostics: of all stages.
        places: where what the file says of its parts stands; None where it says nothing.
        reached: levels, ways up, how people get at the units; None where not looked for.
        motions: what moves or is read at each unit; likewise.
    """

    scene: Scene
    parts: Parts
    contacts: Contacts
    cluster: Ints
    pipe_systems: frozenset[int]
    labels: Sequence[Label | None]
    guesses: Sequence[Sequence[Guess]]
    network: Network
    related: Sequence[tuple[int, int]]
    diagnostics: Sequence[Diagnostic]
    places: Places | None = None
    reached: FoundPlaces | None = None
    motions: Sequence[UnitMotion] = ()


def extent_of(
    results: Results, members: Sequence[int]
) -> tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]:
    """The area-weighted centroid of some parts, and the corners of their common box, in world coordinates."""
    measured, index = results.parts.properties, np.asarray(members)
    weight: Floats = measured.area[index]
    weight = weight if weight.sum() > 0 else np.ones(len(index))
    centroid = np.average(measured.centroid[index], axis=0, weights=weight)
    corners = [centroid, measured.aabb[index, 0].min(axis=0), measured.aabb[index, 1].max(axis=0)]
    middle, low, high = points(np.array(corners) + results.scene.origin)
    return middle, low, high


def fact_records(facts: Sequence[Fact], own: Collection[str] = ()) -> tuple[SourceFact, ...]:
    """Facts as records, each once; ``own`` are the paths that need not be told."""
    rows = ((f.key, f.value[:_LONGEST_FACT], f.where, None if f.path in own else f.path) for f in facts)
    return tuple(SourceFact(key=k, value=v, where=w, path=p) for k, v, w, p in dict.fromkeys(rows))


def in_world(point: Point, origin: Floats) -> Point:
    """A point of the scene in world coordinates, rounded."""
    return points(np.asarray(point) + origin)[0]


def rounded(value: float) -> float:
    """Nine significant digits: below that lies rounding noise."""
    return float(f"{float(value):.9g}")
