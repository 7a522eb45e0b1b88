"""Small pieces of a USD layer that is authored with Sdf."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from pxr import Gf, Sdf, Vt

from cadgraph.model.scene import Floats

__all__ = ["apply", "attribute", "define", "over", "place", "relate"]


def define(layer: Any, path: Any, type_name: str) -> Any:
    """A prim of this type."""
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    return prim


def over(layer: Any, path: Any) -> Any:
    """The opinions on a prim that is defined elsewhere."""
    return Sdf.CreatePrimInLayer(layer, path)


def apply(prim: Any, *schemas: str) -> None:
    """Adds API schemas to a prim, each once."""
    listed = list(prim.GetInfo("apiSchemas").prependedItems) if prim.HasInfo("apiSchemas") else []
    operation = Sdf.TokenListOp()
    operation.prependedItems = [*listed, *(schema for schema in schemas if schema not in listed)]
    prim.SetInfo("apiSchemas", operation)


def attribute(prim: Any, name: str, type_name: str, value: Any, uniform: bool = False) -> Any:
    """An attribute with a value for all times."""
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    spec = prim.attributes.get(name) or Sdf.AttributeSpec(
        prim, name, getattr(Sdf.ValueTypeNames, type_name), variability
    )
    spec.default = value
    return spec


def relate(prim: Any, name: str, targets: Iterable[Any]) -> None:
    """A relationship to these paths and no others."""
    spec = prim.relationships.get(name) or Sdf.RelationshipSpec(prim, name, custom=False)
    spec.targetPathList.explicitItems = list(dict.fromkeys(targets))


def place(prim: Any, matrix: Floats) -> None:
    """Puts a prim where a matrix ``(4, 4)`` for row vectors says, whatever moved it before."""
    attribute(prim, "xformOp:transform:placed", "Matrix4d", Gf.Matrix4d(*matrix.reshape(-1).tolist()))
    attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:transform:placed"]), uniform=True)
