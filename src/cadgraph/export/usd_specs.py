"""Prims, attributes and names of a USD layer, authored with Sdf alone: no stage is composed."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from pxr import Sdf

from cadgraph.export.usd_paths import CONTROL

__all__ = [
    "apply_schemas",
    "claim",
    "define_prim",
    "identifier",
    "relate",
    "safe_text",
    "set_attribute",
    "set_string",
    "token",
    "unused",
]

_FORBIDDEN = re.compile(r"[:;,&|!]")


def safe_text(text: str) -> str:
    """Text that is safe in a layer: no control characters, no lone surrogates."""
    return " ".join(CONTROL.sub(" ", text).split())


@lru_cache(1 << 12)  # the names of a vocabulary come over and over
def token(text: str) -> str:
    """A label without the characters that semantics readers split at."""
    return safe_text(_FORBIDDEN.sub(" ", text)) or "unnamed"


def identifier(name: str) -> str:
    """A name as USD allows it: letters, digits, underscores, no leading digit."""
    cleaned = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return f"_{cleaned}" if not cleaned or cleaned[0].isdigit() else cleaned


def unused(name: str, taken: set[str]) -> str:
    """The name, or the first of ``name_2``, ``name_3``... that isn't taken."""
    if name not in taken:
        return name
    number = 2
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"


def claim(name: str, taken: set[str]) -> str:
    """Likewise; it is taken afterwards."""
    free = unused(name, taken)
    taken.add(free)
    return free


def define_prim(layer: Any, path: Any, type_name: str, display_name: str | None = None) -> Any:
    """Makes a prim; what it is called in the source is kept as its display name where the path can't say it."""
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    if display_name is not None and safe_text(display_name) != path.name:
        prim.SetInfo("displayName", safe_text(display_name))
    return prim


def apply_schemas(prim: Any, *schemas: str) -> None:
    """Adds applied schemas behind those that a prim has, each once."""
    listed = prim.GetInfo("apiSchemas") if prim.HasInfo("apiSchemas") else Sdf.TokenListOp()
    have = listed.GetAddedOrExplicitItems()
    new = [schema for schema in schemas if schema not in have]
    if listed.isExplicit:
        listed.explicitItems = [*listed.explicitItems, *new]
    else:
        listed.prependedItems = [*listed.prependedItems, *new]
    prim.SetInfo("apiSchemas", listed)


def set_attribute(prim: Any, name: str, type_name: str, value: Any, uniform: bool = False, custom: bool = False) -> Any:
    """Gives a prim an attribute with a default value, in place of one of that name."""
    if name in prim.attributes:
        prim.RemoveProperty(prim.attributes[name])
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    attribute = Sdf.AttributeSpec(prim, name, getattr(Sdf.ValueTypeNames, type_name), variability, custom)
    attribute.default = value
    return attribute


def set_string(prim: Any, name: str, value: str | None) -> None:
    """Gives a prim a custom text, unless there is none."""
    if value is not None:
        set_attribute(prim, name, "String", safe_text(value), custom=True)


def relate(prim: Any, kind: str, targets: Iterable[Any]) -> None:
    """Points from a prim to others, as ``cadgraph:KIND``."""
    relationship = Sdf.RelationshipSpec(prim, f"cadgraph:{kind}", custom=True)
    relationship.targetPathList.explicitItems = list(dict.fromkeys(targets))
