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

from importlib import import_module
from typing import TYPE_CHECKING, Any

from cadgraph._io.moved import keep_old_names
from cadgraph.errors import (
    CadGraphError,
    FormatError,
    LabelError,
    LoadError,
    MissingExtra,
    MissingPackage,
    OutputError,
    Unconnected,
    UnknownNode,
)
from cadgraph.load import load

if TYPE_CHECKING:
    from cadgraph.config import Config, read_config
    from cadgraph.hydraulics.process import Process
    from cadgraph.labelers.base import Labeling
    from cadgraph.model.diagnostic import Diagnostic
    from cadgraph.model.given_labels import GivenLabel, read_labels
    from cadgraph.model.graph import SceneGraph
    from cadgraph.model.labels import Guess, Label
    from cadgraph.model.records import (
        Adjacent,
        Cluster,
        Connected,
        Contains,
        Joint,
        Junction,
        Part,
        Related,
        Site,
        System,
        Terminal,
        Unit,
    )
    from cadgraph.model.scene import Scene
    from cadgraph.model.vocabulary import Vocabulary, default_vocabulary, read_vocabulary
    from cadgraph.pipeline import analyse, build, interpret
    from cadgraph.session.run import run
    from cadgraph.session.session import Session

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
    "Guess",
    "Joint",
    "Junction",
    "Label",
    "LabelError",
    "Labeling",
    "LoadError",
    "MissingExtra",
    "MissingPackage",
    "OutputError",
    "Part",
    "Process",
    "Related",
    "Scene",
    "SceneGraph",
    "Session",
    "Site",
    "System",
    "Terminal",
    "Unconnected",
    "Unit",
    "UnknownNode",
    "Vocabulary",
    "analyse",
    "build",
    "default_vocabulary",
    "interpret",
    "load",
    "read_config",
    "read_labels",
    "read_vocabulary",
    "run",
]

keep_old_names()

# 'import cadgraph' brings no library with it but what reading a file needs: processes that only read start quickly.
_LATER = {
    "cadgraph.config": ("Config", "read_config"),
    "cadgraph.hydraulics.process": ("Process",),
    "cadgraph.labelers.base": ("Labeling",),
    "cadgraph.model.diagnostic": ("Diagnostic",),
    "cadgraph.model.given_labels": ("GivenLabel", "read_labels"),
    "cadgraph.model.graph": ("SceneGraph",),
    "cadgraph.model.labels": ("Guess", "Label"),
    "cadgraph.model.records": (
        *("Adjacent", "Cluster", "Connected", "Contains", "Joint", "Junction", "Part", "Related", "Site", "System"),
        *("Terminal", "Unit"),
    ),
    "cadgraph.model.scene": ("Scene",),
    "cadgraph.model.vocabulary": ("Vocabulary", "default_vocabulary", "read_vocabulary"),
    "cadgraph.pipeline": ("analyse", "build", "interpret"),
    "cadgraph.session.run": ("run",),
    "cadgraph.session.session": ("Session",),
}
_HOLDER = {name: module for module, names in _LATER.items() for name in names}


def __getattr__(name: str) -> Any:
    if name in _HOLDER:
        return getattr(import_module(_HOLDER[name]), name)
    raise AttributeError(f"module 'cadgraph' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOLDER})
