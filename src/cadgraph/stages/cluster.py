"""Clustering: DBSCAN on the sparse graph of contacts (paper, section III-B, step 5)."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.components import first_of_component
from cadgraph.model.parts import Bools, Contacts
from cadgraph.model.scene import Ints

__all__ = ["cluster_parts"]


def cluster_parts(n_parts: int, contacts: Contacts, ground: Bools, min_samples: int = 1) -> Ints:
    """The connected structure that each part belongs to.

    A part with at least ``min_samples`` parts within reach, itself included, is a core part; core parts in contact
    share a cluster; another part joins the cluster of its core neighbour (the lowest cluster, where there are
    several) or is noise. With ``min_samples = 1`` clusters are the connected components.

    Args:
        n_parts: how many parts there are.
        contacts: pairs of parts within DBSCAN's eps.
        ground: ``(n_parts,)`` parts that take no part in it.
        min_samples: DBSCAN's least number of neighbours, itself included.

    Returns:
        ``(n_parts,)`` cluster, numbered by their lowest part; -1 for the ground and for noise.
    """
    pairs = contacts.pairs[~ground[contacts.pairs].any(axis=1)]
    n_near = np.bincount(pairs.reshape(-1), minlength=n_parts) + 1
    core = (n_near >= min_samples) & ~ground
    inner = pairs[core[pairs].all(axis=1)]
    cluster = np.full(n_parts, -1, np.int64)
    _, cluster[core] = np.unique(first_of_component(n_parts, inner)[core], return_inverse=True)
    border = pairs[core[pairs].sum(axis=1) == 1]
    outer = np.where(core[border[:, 0]], border[:, 1], border[:, 0])
    joined = cluster[np.where(core[border[:, 0]], border[:, 0], border[:, 1])]
    order = np.lexsort((joined, outer))
    first = np.unique(outer[order], return_index=True)[1]
    cluster[outer[order][first]] = joined[order][first]
    clustered = cluster >= 0
    _, cluster[clustered] = np.unique(_by_first(cluster[clustered]), return_inverse=True)
    return cluster


def _by_first(labels: Ints) -> Ints:
    """Renames labels by the position at which each first stands."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    renamed: Ints = first[inverse.reshape(-1)]
    return renamed
