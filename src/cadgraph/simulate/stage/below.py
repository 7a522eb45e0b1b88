"""The source as USD composes it: which prim each mesh of a scene is, where it stands, what it is made of."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, UsdGeom, UsdShade, UsdUtils

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load.packing import Notes
from cadgraph.load.usd_assets import open_stage
from cadgraph.load.usd_walk import Walk
from cadgraph.model.scene import Floats

__all__ = ["Below", "Shown"]

_ITEM = re.compile(r"^([^\[]*)\[(\d+)\]")


@dataclass(frozen=True, eq=False)
class Shown:
    """A mesh of the scene as a prim.

    Args:
        own: path of the mesh or shape; of an item, in the prototype.
        matrix: ``(4, 4)`` for row vectors, to the world of the source.
        instancer: path of the point instancer that shows it; None where it is a prim itself.
        item: its number there.
        subset: the subset of the prim's faces that it is; None where it is all of it.
    """

    own: str
    matrix: Floats
    instancer: str | None = None
    item: int = 0
    subset: str | None = None


class Below:
    """An open source.

    Args:
        file: the layer; all opinions that this makes go to the session of its stage.
        settings: how the scene was read from it.
        targets: the path of each mesh of the scene in it.

    Raises:
        LoadError: it can't be composed any more, or lacks a mesh.
    """

    def __init__(self, file: Path, settings: LoadConfig, targets: Sequence[str]) -> None:
        # While a delegate listens, the library prints nothing; what it says was noted when the scene was read.
        delegate = UsdUtils.CoalescingDiagnosticDelegate()
        try:
            known = Sdf.Layer.Find(str(file))
            if known is not None:
                known.Reload()  # it may have been written anew since this process read it
            self.stage, budget = open_stage(file, settings, Notes())
            walk = Walk(
                self.stage, settings.purposes, settings.invisible, settings.time, settings.sides, Notes(), budget
            )
            placements = {each.path: each for each in walk.placements()}
        except Tf.ErrorException as error:
            raise LoadError(
                f"{file}: can't be read as USD any more ({_first_line(error)}); build the graph anew"
            ) from None
        finally:
            delegate.TakeUncoalescedDiagnostics()
        self.meshes: list[Shown] = []
        for target in targets:
            subset = None
            found = placements.get(target)
            if found is None:
                above, _, subset = target.rpartition("/")
                found = placements.get(above)
            if found is None:
                raise LoadError(f"{file}: has no mesh {target!r} any more; build the graph anew")
            item = _ITEM.match(found.path)
            self.meshes.append(
                Shown(
                    found.own_path,
                    found.matrix,
                    item[1] if item else None,
                    int(item[2]) if item else 0,
                    subset,
                )
            )
        self._bound: dict[tuple[Any, str], Any] = {}

    def prim(self, shown: Shown) -> Any:
        """The mesh or shape as it is composed now; maybe an instance proxy."""
        return self.stage.GetPrimAtPath(shown.own)

    def open_instances(self, paths: Iterable[str]) -> list[Any]:
        """Makes the instances above these paths plain prims, in this session; their paths, the outermost first."""
        roots: dict[Any, None] = {}
        for path in paths:
            for prefix in Sdf.Path(path).GetPrefixes():
                prim = self.stage.GetPrimAtPath(prefix)
                if prim and prim.IsInstance():
                    roots[prefix] = None
        session = self.stage.GetSessionLayer()
        with Sdf.ChangeBlock():
            for root in roots:
                Sdf.CreatePrimInLayer(session, root).instanceable = False
        return sorted(roots)

    def roots(self) -> list[str]:
        """The names of the root prims that a stage shows."""
        return [prim.GetName() for prim in self.stage.GetPseudoRoot().GetChildren()]

    def strays(self) -> Iterator[tuple[Any, str, list[Any]]]:
        """Relationships that leave the root prim that they stand below: prim, name, targets.

        A reference to one root prim would lose them.
        """
        shown = {Sdf.Path(f"/{name}") for name in self.roots()}
        if len(shown) < 2:
            return
        for prim in self.stage.Traverse():
            own = prim.GetPath().GetPrefixes()[0]
            for relationship in prim.GetAuthoredRelationships():
                targets = relationship.GetTargets()
                above = {target.GetPrefixes()[0] for target in targets}
                if above - {own} and above <= shown:
                    yield prim, relationship.GetName(), targets

    def material(self, prim: Any, purpose: str = "") -> Any:
        """The path of the material that a prim is made of, else None."""
        key = prim.GetPath(), purpose
        if key not in self._bound:
            bound = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(purpose or UsdShade.Tokens.allPurpose)[0]
            self._bound[key] = bound.GetPath() if bound else None
        return self._bound[key]

    def inherited(self, prim: Any) -> list[Any]:
        """The primvars that a prim has from those above it."""
        own = {name for name in prim.GetAuthoredPropertyNames() if name.startswith("primvars:")}
        found = UsdGeom.PrimvarsAPI(prim).FindPrimvarsWithInheritance()
        return [primvar for primvar in found if primvar.GetName() not in own and primvar.HasAuthoredValue()]


def _first_line(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return lines[0][:200] if lines else "no reason given"
