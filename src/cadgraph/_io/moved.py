"""Where modules of version 0.1.0 are now: the old names work for one more version, with a warning."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

__all__ = ["MOVED", "keep_old_names"]

MOVED = {
    "cadgraph.amendment": ("cadgraph.session.correct",),
    "cadgraph.atomic": ("cadgraph._io.atomic",),
    "cadgraph.catalog": ("cadgraph.model.catalog",),
    "cadgraph.corrections": ("cadgraph.model.corrections",),
    "cadgraph.diagram": ("cadgraph.draw.schematic",),
    "cadgraph.environment": ("cadplants",),
    "cadgraph.evaluate": ("cadlab.evaluate",),
    "cadgraph.explanation": ("cadgraph.query.explain",),
    "cadgraph.functional": ("cadgraph.query",),
    "cadgraph.graph": ("cadgraph.model.graph",),
    "cadgraph.intake": ("cadgraph.session.catalog_builder",),
    "cadgraph.job": ("cadgraph.session.run",),
    "cadgraph.labels": ("cadgraph.model.given_labels",),
    "cadgraph.lvlm": ("cadgraph.labelers.lvlm",),
    "cadgraph.parts": ("cadgraph.model.parts", "cadgraph.model.labels"),
    "cadgraph.records": ("cadgraph.model.records",),
    "cadgraph.relabel": ("cadgraph.session.reopen",),
    "cadgraph.report": ("cadgraph.draw.report",),
    "cadgraph.reproduce": ("cadlab.reproduce",),
    "cadgraph.scene": ("cadgraph.model.scene",),
    "cadgraph.summary": ("cadgraph.query.summary",),
    "cadgraph.truth": ("cadgraph.model.truth",),
    "cadgraph.vocabulary": ("cadgraph.model.vocabulary",),
}
"""Old name of a module, and the modules that hold its names now."""


class _Moved(ModuleType):
    """Stands in for a module that has moved, and looks its names up where they are now."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        for target in MOVED[self.__name__]:
            module = import_module(target)
            if hasattr(module, name):
                return getattr(module, name)
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")


class _Finder(MetaPathFinder, Loader):
    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Finds what has moved."""
        return ModuleSpec(fullname, self) if fullname in MOVED else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Makes the stand-in."""
        return _Moved(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """Says where it is now, and needs that to be there."""
        now = MOVED[module.__name__]
        import_module(now[0])
        warnings.warn(f"{module.__name__} is now {' and '.join(now)}", DeprecationWarning, stacklevel=2)


def keep_old_names() -> None:
    """Lets old names of modules be imported; once is enough."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.append(_Finder())
