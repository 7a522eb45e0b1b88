"""Which meshes of a plant act as one part: very small ones join a larger one (paper, section III-B, step 2).

The rule is written down here a second time, apart from the stage that is measured against it.
"""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Plant

__all__ = ["PROXIMITY", "SMALL", "find_parts"]

SMALL = 1e-6
"""A mesh whose oriented box is smaller than this joins another [m3] (paper, section III-B: 1 cm3)."""

PROXIMITY = 0.01
"""No further away than this [m] (ours, as ``GroupConfig.proximity``; the paper gives no figure)."""

_TIE = 1e-9  # m; of larger meshes as near as each other the first is taken


def find_parts(plant: Plant) -> tuple[tuple[int, ...], ...]:
    """The parts that consist of several meshes.

    Args:
        plant: finished; its ground takes nobody in.

    Returns:
        For each such part the large mesh, then those that join it, as indices into the plant's components.
    """
    from cadgraph.geometry.contact.pairs import find_contacts
    from cadgraph.geometry.mesh.properties import measure

    scene = plant.scene()
    small = measure(scene).obb_volume < SMALL
    taking = ~small & np.array([component.name != "ground" for component in plant.components], np.bool_)
    near = find_contacts(scene, PROXIMITY, between=(small, taking))
    best: dict[int, tuple[float, int]] = {}
    for (a, b), distance in zip(near.pairs.tolist(), near.distance.tolist(), strict=True):
        one, other = (a, b) if small[a] else (b, a)
        offer = (round(distance / _TIE), other)
        best[one] = min(best.get(one, offer), offer)
    joined: dict[int, list[int]] = {}
    for one, (_, other) in sorted(best.items()):
        joined.setdefault(other, []).append(one)
    return tuple((head, *meshes) for head, meshes in sorted(joined.items()))
