"""Turns an unlabelled industrial CAD scene into a semantic, multi-layer 3D scene graph.

::

    import cadgraph

    scene = cadgraph.load("plant.usd")
    graph = cadgraph.build(scene)
    for valve in graph.units("valve"):
        print(valve.tag, [unit.tag for unit in graph.neighbors(valve)])
    graph.save("out")
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from cadgraph.config import Config, read_config
from cadgraph.errors import CadGraphError, FormatError, LabelError, LoadError, MissingExtra, OutputError
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import GivenLabel, read_labels
from cadgraph.model.records import Adjacent, Cluster, Connected, Contains, Part, Related, Site, System, Terminal, Unit
from cadgraph.model.scene import Diagnostic, Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary, read_vocabulary

if TYPE_CHECKING:
    from cadgraph.pipeline import build
    from cadgraph.session.run import run

__version__ = "0.1.0"

__all__ = [
    "Adjacent",
    "CadGraphError",
    "Cluster",
    "Config",
    "Connected",
    "Contains",
    "Diagnostic",
    "FormatError",
    "GivenLabel",
    "LabelError",
    "LoadError",
    "MissingExtra",
    "OutputError",
    "Part",
    "Related",
    "Scene",
    "SceneGraph",
    "Site",
    "System",
    "Terminal",
    "Unit",
    "Vocabulary",
    "build",
    "default_vocabulary",
    "load",
    "read_config",
    "read_labels",
    "read_vocabulary",
    "run",
]


def __getattr__(name: str) -> Any:
    # These two bring compiled kernels with them; 'import cadgraph' stays quick without.
    if name == "build":
        from cadgraph.pipeline import build

        return build
    if name == "run":
        from cadgraph.session.run import run

        return run
    raise AttributeError(f"module 'cadgraph' has no attribute {name!r}")
