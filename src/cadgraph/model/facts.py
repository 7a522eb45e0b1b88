"""What a source file says of its own parts: types, names, tags, and which part it joins to which.

Kept beside the geometry and shown, but without any influence on labels and relations unless the user asks for it.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

__all__ = ["FACT_KEYS", "Fact", "FactKey", "StatedLink"]

FactKey = Literal["class", "predefined", "type", "name", "spec", "system", "size", "tag", "description", "layer"]
FACT_KEYS: tuple[FactKey, ...] = (
    "class",
    "predefined",
    "type",
    "name",
    "spec",
    "system",
    "size",
    "tag",
    "description",
    "layer",
)


class Fact(NamedTuple):
    """One thing that the source says of a node of its tree.

    Args:
        path: source path of a mesh, or of a node above meshes (an equipment that consists of several).
        key: what kind of thing: ``class`` (IfcValve, VALV), ``predefined`` (the enumeration that refines a class),
            ``type`` (name of a type or catalogue reference's words), ``name`` (of the element itself, where the path
            doesn't tell it), ``spec`` (catalogue or Isogen code), ``system`` (line, system), ``size`` (nominal bore
            [mm], as text), ``tag`` (what the plant calls it: P-101), ``description``, ``layer`` (layer, material).
        value: as it stands in the file.
        where: the place of it in the file: ``IfcValve.PredefinedType``, ``att TYPE``, ``IsogenData.SKEY``.
    """

    path: str
    key: FactKey
    value: str
    where: str


class StatedLink(NamedTuple):
    """Two nodes of the source that it says are joined along a pipe.

    Args:
        first: source path of a mesh or of a node above meshes.
        second: likewise.
        flow: what the source says of the flow; ``forward`` is from first to second.
        where: by what it says so: ``IfcRelConnectsPorts``, ``order in branch``, ``att HREF``.
    """

    first: str
    second: str
    flow: Literal["forward", "backward", "unknown"]
    where: str
