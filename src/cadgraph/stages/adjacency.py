"""What touches what: by the exact distance of surfaces, or as the paper decides it."""

from __future__ import annotations

import numpy as np

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config
from cadgraph.geometry.contact.pairs import find_contacts
from cadgraph.geometry.contact.points import find_point_contacts, sample_surface
from cadgraph.model.crew import Crew
from cadgraph.model.parts import Contacts, Properties
from cadgraph.model.scene import Ints, Scene

__all__ = ["find_near_meshes", "join_contacts"]


def find_near_meshes(
    scene: Scene,
    properties: Properties,
    limit: float,
    config: Config,
    progress: Progress = quiet,
    crew: Crew | None = None,
) -> Contacts:
    """All pairs of meshes at most ``limit`` apart [m], decided by the method that is set.

    Args:
        scene: all meshes.
        properties: of each.
        limit: greatest distance [m].
        config: says which method.
        progress: called with the share that is done.
        crew: does the exact method's work in place of this process.
    """
    if config.method == "exact":
        return find_contacts(scene, limit) if crew is None else crew.contacts(scene, properties, limit, progress)
    surface = sample_surface(scene, config.preprocess.voxel, config.preprocess.spacing)
    return find_point_contacts(surface, limit, progress)


def join_contacts(near: Contacts, part_of_mesh: Ints, eps: float) -> Contacts:
    """The contacts between parts, from those between meshes.

    Args:
        near: pairs of meshes.
        part_of_mesh: ``(n_meshes,)`` the part of each mesh.
        eps: greatest distance that counts [m].

    Returns:
        For each pair of parts with meshes within ``eps`` the closest of these.
    """
    parts = part_of_mesh[near.pairs]
    keep = (near.distance <= eps + 1e-9) & (parts[:, 0] != parts[:, 1])
    parts, distance, points = parts[keep], near.distance[keep], near.points[keep]
    swapped = parts[:, 0] > parts[:, 1]
    parts = np.sort(parts, axis=1)
    points = np.where(swapped[:, None, None], points[:, ::-1], points)
    order = np.lexsort((np.arange(len(parts)), distance, parts[:, 1], parts[:, 0]))
    ordered = parts[order]
    is_first = np.ones(len(order), np.bool_)
    is_first[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    chosen = order[is_first]
    return Contacts(parts[chosen], distance[chosen], points[chosen])
