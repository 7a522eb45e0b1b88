"""The way from an IFC file to a scene."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from cadgraph._io.spf import unzipped
from cadgraph.errors import LoadError
from cadgraph.load.ifc.entities import open_model
from cadgraph.load.ifc.facts import element_facts, file_metadata, length_unit
from cadgraph.load.ifc.links import stated_links
from cadgraph.load.ifc.shapes import shape_products
from cadgraph.load.ifc.tree import plant_tree
from cadgraph.load.packing import Notes, pack
from cadgraph.model.scene import Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_ABRIDGED = ("listed-twice", "no-geometry", "no-surface", "not-built", "open-link")


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads an IFC file: one mesh for each built product, without openings and spaces.

    About thirty products of a building model take a second (IfcOpenShell 0.9); where a sound file takes longer than
    ``config.timeout``, raise that.

    Args:
        path: of the file, ``.ifc`` or ``.ifczip``.
        config: ``max_gap`` and ``max_angle`` say how fine curved surfaces are cut, ``metadata`` whether facts and
            links are read.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, its schema is unknown, or nothing that is built has a shape.
    """
    notes = Notes()
    with unzipped(path, str(path)) as plain:
        model = open_model(plain, str(path), notes)
    tree = plant_tree(model, notes)
    pieces = shape_products(model, tree, config, notes)
    if not pieces:
        why = "; ".join(f"{notes.count(code)} {what}" for code, what in _WHY if notes.count(code))
        raise LoadError(
            f"{path}: opens, but no product in it has a solid or a surface ({why or 'it holds no product'}); "
            "export it with its geometry"
        )
    keep = config.metadata == "keep"
    unit, stated = length_unit(model)
    source = Source(
        meters_per_unit=unit,
        up_axis="Z",
        format="ifc",
        unit_stated=stated,
        metadata=file_metadata(model) if keep else (),
    )
    shown = _with_nodes_above({piece.path for piece in pieces}) if keep else frozenset()
    facts = element_facts(model, tree, shown) if keep else ()
    links = stated_links(model, tree, shown, notes) if keep else ()
    # The library gives metres and Z up, whatever the file's unit.
    scene = pack(pieces, source, np.eye(4), notes, _ABRIDGED, facts, links)
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but all its shapes are without area; export it with its geometry")
    return scene


def _with_nodes_above(paths: Iterable[str]) -> frozenset[str]:
    """Paths, and those of all nodes above them."""
    whole = frozenset(paths)
    return whole | {path[:end] for path in whole for end in range(1, len(path)) if path[end] == "/"}


_WHY = (
    ("no-geometry", "without a shape"),
    ("no-surface", "of curves or points"),
    ("not-built", "spaces, zones or annotations"),
    ("unreadable", "that can't be made"),
    ("empty-mesh", "empty"),
)
