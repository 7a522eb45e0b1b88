"""Diagnostic what is odd about the meshes: twice there, never seen, inside out, open, without area.

The paper excludes nine meshes as modelling artifacts by hand (section IV) and names redundant and invisible meshes as
a challenge of CAD (section V-A). Here they are found, kept and reported; a setting leaves them out.
"""

from __future__ import annotations

import numpy as np

from cadgraph.config import InspectConfig
from cadgraph.geometry.mesh.duplicates import find_duplicates, findings
from cadgraph.geometry.visibility.outside import find_visible
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Scene

__all__ = ["inspect_meshes"]


def inspect_meshes(
    scene: Scene, properties: Properties, config: InspectConfig
) -> tuple[Scene, Properties, tuple[Diagnostic, ...]]:
    """Looks for odd meshes.

    Args:
        scene: all meshes.
        properties: of each.
        config: what to look for, and what to leave out.

    Returns:
        The scene and its properties without the meshes that are left out, and the findings; among these, one that
        names every mesh left out.
    """
    duplicates = find_duplicates(scene, properties) if config.duplicates else None
    visible = find_visible(scene) if config.hidden else None
    diagnostics = list(findings(scene, properties, duplicates, visible))
    out = np.zeros(scene.n_meshes, np.bool_)
    if "duplicate" in config.exclude and duplicates is not None:
        out |= duplicates.exact
    if "hidden" in config.exclude and visible is not None:
        out |= ~visible & (properties.area > 0)
    if not out.any():
        return scene, properties, tuple(diagnostics)
    paths = tuple(scene.paths[i] for i in np.flatnonzero(out))
    message = f"{len(paths)} meshes left out, as set (inspect.exclude = {list(config.exclude)})"
    diagnostics.append(Diagnostic("excluded", message, paths))
    keep = np.flatnonzero(~out)
    return scene.select(keep), properties.select(keep), tuple(diagnostics)
