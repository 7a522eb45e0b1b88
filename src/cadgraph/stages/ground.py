"""Diagnostic the ground, which the paper excludes from clustering (section III-B, step 5)."""

from __future__ import annotations

import numpy as np

from cadgraph.config import GroundConfig
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Scene

__all__ = ["find_ground", "report_ground"]


_TOLERANCE = 1e-6  # what ends this little above the underside of a plate still lies below it [m]


def find_ground(scene: Scene, properties: Properties, config: GroundConfig) -> Bools:
    """Which meshes are the ground.

    Found by itself, the ground is large, flat and lowest: it spreads under nearly all of everything else, is thin
    for its size, and nothing else lies wholly below it. A base plate is no ground, since its feet or casters stand
    below it or it ends where its machine ends.

    Args:
        scene: all meshes, Z up.
        properties: of each mesh.
        config: thresholds, or the paths named by the user.

    Returns:
        ``(n_meshes,)`` bool.

    Raises:
        ValueError: a named path is not in the scene.
    """
    ground = np.zeros(scene.n_meshes, np.bool_)
    if config.find == "none" or scene.n_meshes == 0:
        return ground
    if config.find == "named":
        rank = {path: i for i, path in enumerate(scene.paths)}
        for path in config.meshes:
            if path not in rank:
                raise ValueError(
                    f"{scene.source.path}: ground {path!r} is not a mesh of the scene; {_remedy(path, scene)}"
                )
            ground[rank[path]] = True
    elif scene.n_meshes > 1:
        ground[_candidates(properties, config)] = True
    return ground


def report_ground(scene: Scene, ground: Bools, found: Bools) -> tuple[Diagnostic, ...]:
    """What is told of the ground.

    Args:
        scene: all meshes.
        ground: ``(n_meshes,)`` what it is.
        found: ``(n_meshes,)`` what it would be if no user had said otherwise.
    """
    notes = []
    for code, meshes, words in (
        ("ground", ground, "mesh(es) taken for the ground and left out of clusters"),
        ("ground-corrected", ground & ~found, "mesh(es) that are the ground as a user said so"),
        ("ground-corrected", found & ~ground, "mesh(es) that are no ground as a user said so"),
    ):
        paths = tuple(scene.paths[i] for i in np.flatnonzero(meshes))
        notes += [Diagnostic(code, f"{len(paths)} {words}", paths)] if paths else []
    return tuple(notes)


def _candidates(properties: Properties, config: GroundConfig) -> list[int]:
    low, high = properties.aabb[:, 0], properties.aabb[:, 1]
    size = high - low
    flat = size[:, 2] <= config.max_thickness_ratio * size[:, :2].min(axis=1)
    large = size[:, :2].min(axis=1) >= config.min_size
    chosen = []
    for i in np.flatnonzero(flat & large):
        others = np.ones(len(low), np.bool_)
        others[i] = False
        # A floor may be laid twice or in storeys of the same place: what is as flat and as large does not count.
        others &= ~(flat & large & (np.abs(high[:, 2] - high[i, 2]) <= size[i, 2] + config.max_thickness_ratio))
        if not others.any():
            continue
        spread_low, spread_high = low[others, :2].min(axis=0), high[others, :2].max(axis=0)
        covered = np.clip(np.minimum(high[i, :2], spread_high) - np.maximum(low[i, :2], spread_low), 0, None)
        cover = np.prod(covered / np.maximum(spread_high - spread_low, 1e-9))
        margin = np.prod(size[i, :2]) / max(np.prod(spread_high - spread_low), 1e-9)
        buried = np.mean(high[others, 2] < (low[i, 2] if size[i, 2] > 0 else high[i, 2]) + _TOLERANCE)
        if cover >= config.min_cover and margin >= config.min_margin and buried <= config.max_buried:
            chosen.append(int(i))
    return chosen


def _remedy(path: str, scene: Scene) -> str:
    below = [mesh for mesh in scene.paths if mesh.startswith(f"{path.rstrip('/')}/")]
    return f"give a mesh, as {below[0]!r} below it" if below else "give a path as in graph.json, or none at all"
