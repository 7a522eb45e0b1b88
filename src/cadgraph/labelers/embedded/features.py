"""All that the embedded labeler looks at: each shape once, and each part among its neighbours."""

from __future__ import annotations

from dataclasses import dataclass

from cadgraph.geometry.shape.analysis import shapes_of
from cadgraph.labelers.embedded.descriptor import Descriptors, describe_shapes
from cadgraph.labelers.embedded.surroundings import Surroundings, find_surroundings
from cadgraph.model.derived import kept_with
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Ints
from cadgraph.model.shapes import Facts

__all__ = ["Observation", "observe"]


@dataclass(frozen=True)
class Observation:
    """What is known of the parts of a scene before anything has a label.

    Args:
        facts: of each distinct shape.
        shapes: numbers that describe each distinct shape.
        shape_of_part: ``(n_parts,)`` row of the two above.
        surroundings: of each part.
    """

    facts: tuple[Facts, ...]
    shapes: Descriptors
    shape_of_part: Ints
    surroundings: Surroundings


@kept_with
def observe(parts: Parts, contacts: Contacts) -> Observation:
    """Looks at each distinct shape, and at how the parts touch; once for the same parts and contacts.

    Args:
        parts: with their geometry.
        contacts: pairs of parts that are adjacent.
    """
    known = shapes_of(parts)
    shapes = describe_shapes(parts.scene.select(known.first), parts.properties.select(known.first), known.facts)
    around = find_surroundings(parts, contacts, known, shapes.points)
    return Observation(known.facts, shapes, known.shape, around)
