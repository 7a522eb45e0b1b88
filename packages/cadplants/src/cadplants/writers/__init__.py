"""Plants in the formats of other authoring systems, each with its truth beside it: one module for each format.

Names in a file may be read in more than one way, so the truth of these formats also has where each mesh lies; see
``cadplants.writers.matching``.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cadgraph.errors import MissingExtra
from cadplants.writers.together import together
from cadplants.writers.usd import truth_path, write_usd
from cadplants.writers.usd_style import UsdStyle

if TYPE_CHECKING:
    from cadgraph.model.scene import Floats
    from cadplants.model.plant import Component, Plant
    from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["FORMATS", "PlantFormat", "format_of", "write_plant"]


@dataclass(frozen=True)
class PlantFormat:
    """A format that plants are written in.

    Args:
        name: short name.
        suffixes: of its files, lower case with the dot.
        module: holds ``write(plant, style, stem) -> Written``; "": the USD writer.
        library: the third-party package that it needs, if any.
        extra: the optional dependency of cadgraph that brings this package.
    """

    name: str
    suffixes: tuple[str, ...]
    module: str = ""
    library: str = ""
    extra: str = ""


FORMATS = (
    PlantFormat("usd", (".usd", ".usda", ".usdc")),
    PlantFormat("rvm", (".rvm",), "cadplants.writers.rvm"),
    PlantFormat("ifc", (".ifc",), "cadplants.writers.ifc", "ifcopenshell", "ifc"),
    PlantFormat("glb", (".glb",), "cadplants.writers.glb"),
    PlantFormat("obj", (".obj",), "cadplants.writers.obj"),
    PlantFormat("stl", (".stl",), "cadplants.writers.stl"),
    PlantFormat("step", (".step", ".stp"), "cadplants.writers.step"),
)
"""All formats that plants are written in."""

_PIECES = 400  # of one mesh whose boxes are told; ours: soups have as many as triangles


def format_of(path: str | Path, name: str | None = None) -> PlantFormat:
    """The format that a plant is to be written in.

    Args:
        path: of the file; its suffix decides where no name is given, and must fit one that is.
        name: of a format.

    Raises:
        ValueError: there is no such format, or the suffix is of none or of another.
    """
    suffix = Path(path).suffix.lower()
    every = ", ".join(one.name for one in FORMATS)
    if name is not None and name not in {one.name for one in FORMATS}:
        raise ValueError(f"format {name!r}: give one of {every}")
    for one in FORMATS:
        if name in (None, one.name) and suffix in one.suffixes:
            return one
    known = [end for one in FORMATS if name in (None, one.name) for end in one.suffixes]
    what = f"as {name} a plant ends" if name else "a plant ends"
    raise ValueError(f"{path}: {what} in {', '.join(known)}, not {suffix or 'without suffix'!r}")


def write_plant(
    plant: Plant, path: str | Path, style: UsdStyle | FileStyle | None = None, name: str | None = None
) -> Path:
    """Writes a plant in any format, and its truth beside it; all files or none.

    Args:
        plant: what to write.
        path: of the file; its suffix says which format it has.
        style: how; a ``UsdStyle`` for USD, a ``FileStyle`` for the others; what is usual in the format by default.
        name: of the format, where the suffix alone shall not decide.

    Returns:
        The path of the truth file.

    Raises:
        ValueError: the format is unknown, the style is of another, or it asks for what the format can't say.
        MissingExtra: the format needs a package that isn't installed.
        OutputError: a file can't be written.
    """
    from cadplants.writers.plant_file import FileStyle

    form = format_of(path, name)
    if not form.module:
        if isinstance(style, FileStyle):
            raise ValueError("USD is written in a UsdStyle, not a FileStyle")
        return write_usd(plant, path, style)
    if isinstance(style, UsdStyle):
        raise ValueError(f"{form.name} is written in a FileStyle, not a UsdStyle")
    style = style or FileStyle()
    if style.layout != "nodes" and form.name != "glb":
        raise ValueError(f"layout {style.layout!r} is one of glb; leave it out for {form.name}")
    spoilt = style.metadata.wrong_classes or style.metadata.missing_names
    if spoilt and form.name not in ("rvm", "ifc"):
        raise ValueError(
            f"{form.name} files have no classes; wrong classes and missing names are settings of rvm and ifc"
        )
    if form.library and importlib.util.find_spec(form.library) is None:
        raise MissingExtra(f"writing {form.name.upper()} files", form.extra)
    target = Path(path)
    written: Written = importlib.import_module(form.module).write(plant, style, target.stem)
    files = {target if k == 0 else target.with_suffix(end): data for k, (end, data) in enumerate(written.files.items())}
    truth = _truth(plant, written, form.name)
    files[truth_path(target)] = (json.dumps(truth, indent=1, sort_keys=False) + "\n").encode()
    with together(*files) as beside:
        for place, data in zip(beside, files.values(), strict=True):
            place.write_bytes(data)
    return truth_path(target)


def _truth(plant: Plant, written: Written, form: str) -> dict[str, Any]:
    """The truth of a plant with the place of each mesh."""
    from cadplants.truth.truth_writer import truth_of

    truth = truth_of(plant, written.paths)
    for index, (row, component) in enumerate(zip(truth["meshes"], plant.components, strict=True)):
        row |= _placed(component, written.boxes.get(index))
    return truth | {
        "colors": plant.colors if written.painted else "none",
        "meters_per_unit": written.meters_per_unit,
        "up_axis": written.up_axis,
        "file_format": form,
        **written.extra,
    }


def _placed(component: Component, box: Floats | None) -> dict[str, Any]:
    """Where a mesh lies [m]: its box, its surface's centre, and the boxes of its pieces where it has several."""
    from cadplants.solids.mesh_ops import Solid, moved
    from cadplants.writers.placing import centroid, shells

    vertices = component.vertices
    whole = _box(vertices[np.unique(component.solid.faces)]) if box is None else box
    pieces = shells(component.solid)
    boxes = [_box(moved(Solid(one.vertices, one.faces), component.pose).vertices) for one in pieces]
    said = {"bounds": _told(whole), "centroid": _told(centroid(vertices, component.solid.faces))}
    return said | ({"pieces": [_told(one) for one in boxes]} if 1 < len(boxes) <= _PIECES else {})


def _box(points: Floats) -> Floats:
    return np.array([points.min(axis=0), points.max(axis=0)])


def _told(values: Floats) -> Any:
    return (np.round(values, 6) + 0.0).tolist()
