"""Opinions over prims that are defined elsewhere: where they stand, what they relate to."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from pxr import Gf, Sdf, Vt

from cadgraph.export.usd_specs import set_attribute
from cadgraph.model.scene import Floats

__all__ = ["over", "place", "point_at", "stand"]


def over(layer: Any, path: Any) -> Any:
    """The opinions of a layer on a prim."""
    return Sdf.CreatePrimInLayer(layer, path)


def point_at(prim: Any, name: str, targets: Iterable[Any]) -> None:
    """Gives a prim a relationship to these paths and no others."""
    spec = prim.relationships.get(name) or Sdf.RelationshipSpec(prim, name, custom=False)
    spec.targetPathList.explicitItems = list(dict.fromkeys(targets))


def place(prim: Any, matrix: Floats) -> None:
    """Puts a prim where a matrix ``(4, 4)`` for row vectors says, whatever moved it before."""
    set_attribute(prim, "xformOp:transform:placed", "Matrix4d", Gf.Matrix4d(*matrix.reshape(-1).tolist()))
    set_attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:transform:placed"]), uniform=True)


def stand(prim: Any, where: Any, turn: Any) -> None:
    """Puts a prim at a point ``(3,)``, turned by a quaternion, without scale."""
    set_attribute(prim, "xformOp:translate", "Double3", Gf.Vec3d(*where.tolist()))
    set_attribute(prim, "xformOp:orient", "Quatd", turn)
    order = Vt.TokenArray(["xformOp:translate", "xformOp:orient"])
    set_attribute(prim, "xformOpOrder", "TokenArray", order, uniform=True)
