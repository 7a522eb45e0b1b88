"""All that the embedded labeler looks at: each shape once, and each part among its neighbours."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cadgraph.labelers.embedded.descriptor import Descriptors, describe_shapes
from cadgraph.labelers.embedded.shape_facts import Facts, find_facts
from cadgraph.labelers.embedded.surroundings import Surroundings, find_surroundings
from cadgraph.model.derived import kept_with
from cadgraph.model.parts import Contacts, Parts, Properties
from cadgraph.model.scene import Floats, Ints

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
    _, first, shape_of_part = np.unique(parts.shape, return_index=True, return_inverse=True)
    some = _only(parts, first.astype(np.int64))
    facts = find_facts(some)
    return Observation(
        tuple(facts),
        describe_shapes(some.scene, some.properties, facts),
        shape_of_part.reshape(-1).astype(np.int64),
        find_surroundings(parts, contacts),
    )


def _only(parts: Parts, rows: Ints) -> Parts:
    """Some of the parts."""
    chosen: dict[str, Floats] = {name: getattr(parts.properties, name)[rows] for name in Properties.__annotations__}
    return replace(
        parts,
        scene=parts.scene.select(rows),
        meshes=tuple(parts.meshes[i] for i in rows.tolist()),
        properties=Properties(**chosen),  # type: ignore[arg-type]
        shape=parts.shape[rows],
        ground=parts.ground[rows],
    )
