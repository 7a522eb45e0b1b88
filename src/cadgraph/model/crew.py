"""Who does the work that can be dealt out: this process alone, or a crew of others."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from cadgraph._io.progress import Progress, quiet
from cadgraph.model.parts import Contacts, Properties
from cadgraph.model.scene import Scene
from cadgraph.model.shapes import Facts

__all__ = ["Crew"]


class Crew(Protocol):
    """Does the costly steps of an analysis. What it hands back is, to the last bit, what this process would find."""

    def contacts(self, scene: Scene, properties: Properties, limit: float, progress: Progress = quiet) -> Contacts:
        """All pairs of meshes whose surfaces are at most ``limit`` apart [m]."""
        ...

    def facts(self, scene: Scene, properties: Properties) -> Sequence[Facts]:
        """What is measured of each mesh of a scene that holds one for each shape."""
        ...
