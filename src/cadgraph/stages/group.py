"""Grouping: very small meshes join a larger neighbour (paper, section III-B, step 2)."""

from __future__ import annotations

import numpy as np

from cadgraph.config import GroupConfig
from cadgraph.model.parts import Bools, Contacts, Properties
from cadgraph.model.scene import Floats, Ints

__all__ = ["group_meshes", "group_volume"]

_TOLERANCE = 1e-9  # distances this close are a tie [m]


def group_volume(properties: Properties, config: GroupConfig) -> Floats:
    """The volume ``(n_meshes,)`` [m3] that decides whether a mesh is small."""
    if config.volume == "aabb":
        boxes: Floats = np.prod(properties.aabb[:, 1] - properties.aabb[:, 0], axis=1)
        return boxes
    if config.volume == "mesh":
        return np.where(properties.closed, np.abs(properties.volume), properties.obb_volume)
    return properties.obb_volume


def group_meshes(properties: Properties, ground: Bools, near: Contacts, config: GroupConfig) -> Ints:
    """Which meshes act as one part.

    A mesh below the threshold joins the closest mesh that is not below it, within the proximity; ties go to the
    lower index. One that finds none stays on its own. Nothing joins the ground, or it would be lost with it.

    Args:
        properties: measurements of each mesh.
        ground: ``(n_meshes,)`` whether each mesh is ground.
        near: pairs of meshes with their distances, at least all within the proximity.
        config: settings with the thresholds.

    Returns:
        ``(n_meshes,)`` the mesh that heads the part of each mesh: itself, or the larger one that it joined.
    """
    small = (group_volume(properties, config) < config.max_volume) & ~ground
    head = np.arange(len(small))
    within = near.distance <= config.proximity + _TOLERANCE
    a, b, distance = near.pairs[within, 0], near.pairs[within, 1], near.distance[within]
    joining = np.concatenate([a, b])
    target = np.concatenate([b, a])
    distance = np.round(np.concatenate([distance, distance]) / _TOLERANCE)
    may_join = small[joining] & ~small[target] & ~ground[target]
    joining, target, distance = joining[may_join], target[may_join], distance[may_join]
    order = np.lexsort((target, distance, joining))
    first = np.unique(joining[order], return_index=True)[1]
    head[joining[order][first]] = target[order][first]
    return head
