"""Plants as AVEVA RVM: a binary file of primitives, and the attributes of its elements beside it (``.att``).

What is exactly a primitive of PDMS is written as one, everything else as polygons. Straight pipes hang on their branch
as bare bodies, as PDMS writes its implied tube; every other mesh has an element of its own.
"""

from __future__ import annotations

import re

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import RGB, Plant
from cadplants.solids.mesh_ops import Solid, merge
from cadplants.writers.exact_shapes import Primitive, fit, surface
from cadplants.writers.inventory import take
from cadplants.writers.metadata import claim
from cadplants.writers.placing import Placed, place, shells
from cadplants.writers.plant_file import FileStyle, Written
from cadplants.writers.rvm_bytes import Body, RvmFile, facet_group, primitive
from cadplants.writers.rvm_tree import Element, grow

__all__ = ["write"]

_PROGRAM = "cadplants, after PDMS Design"
_DATE = "Thu Jan 1 00:00:00 2026"  # fixed, so that the same plant gives the same bytes
_MOST_PIECES = 400  # of one mesh that are looked at one by one; ours: soups have as many as triangles


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as binary RVM with its attributes.

    Args:
        plant: what to write.
        style: millimetres and Z up, as all such files are.
        stem: name of the file without its suffix, noted in it.

    Raises:
        ValueError: another unit or up axis is asked for.
    """
    if style.meters_per_unit not in (None, 0.001) or style.up_axis not in (None, "Z"):
        raise ValueError("RVM files are in millimetres and Z up; leave --unit and --up out")
    placed = place(plant)
    shapes: dict[int, _Shape] = {}
    for one in placed:
        if one.shape not in shapes:
            shapes[one.shape] = _Shape(one.solid)
    inventory = take(plant)
    claims = claim(plant, inventory, style.metadata)
    tubes = frozenset(
        i for i, c in enumerate(plant.components) if c.name == "pipe" and len(shapes[placed[i].shape].bodies) == 1
    )
    site = grow(plant, inventory, claims, tubes)
    writer = _Writer(plant, placed, shapes, stem)
    writer.fill(site)
    boxes = {i: box for i, one in enumerate(placed) if (box := shapes[one.shape].box(one)) is not None}
    files = {".rvm": writer.data, ".att": _attributes(plant, site).encode("ascii", "replace")}
    return Written(files, tuple(writer.paths), 0.001, "Z", boxes, claims.spoilt(writer.paths))


class _Shape:
    """The bodies of a mesh, each with its pose in the mesh's coordinates."""

    def __init__(self, solid: Solid) -> None:
        pieces = shells(solid)
        fitted = [fit(piece) for piece in pieces] if len(pieces) <= _MOST_PIECES else [None] * len(pieces)
        self._forms: list[Primitive] = [form for form in fitted if form is not None]
        rest = [piece for piece, form in zip(pieces, fitted, strict=True) if form is None]
        self.bodies: list[tuple[Body, Floats]] = [(primitive(form), form.pose) for form in self._forms]
        self._angular = merge(rest) if rest else None
        if self._angular is not None:
            self.bodies.append((facet_group(self._angular), np.eye(4)))

    def box(self, placed: Placed) -> Floats | None:
        """Where the bodies reach ``(2, 3)`` [m]; None where they are the mesh itself."""
        if not self._forms:
            return None
        clouds = [surface(form) for form in self._forms] + ([self._angular.vertices] if self._angular else [])
        points = np.concatenate(clouds) @ placed.pose[:3, :3].T + placed.pose[:3, 3]
        return np.array([points.min(axis=0), points.max(axis=0)])


class _Writer:
    """Fills a file with a tree; ``paths`` has each component's then."""

    def __init__(self, plant: Plant, placed: list[Placed], shapes: dict[int, _Shape], note: str) -> None:
        self._plant, self._placed, self._shapes = plant, placed, shapes
        colors = dict.fromkeys(component.color for component in plant.components)
        self._materials: dict[RGB, int] = {color: k + 1 for k, color in enumerate(colors)}
        self._file = RvmFile((_PROGRAM, note, _DATE, "cadplants"), ("PLANT", (plant.name or "plant").upper()))
        self.paths = [""] * plant.n_meshes
        self.data = b""

    def fill(self, site: Element) -> None:
        """Writes the whole tree, then the colours."""
        self._write(site, "")
        for color, number in self._materials.items():
            red, green, blue = (round(255 * _gamma(value)) for value in color)
            self._file.color(number, (red, green, blue))
        self.data = self._file.finish()

    def _write(self, element: Element, above: str) -> None:
        path = f"{above}/{re.sub(r'[^A-Za-z0-9_.-]+', '_', element.name).strip('_')}"
        indices = [element.component] if element.component is not None else []
        indices += [one for one in element.below if isinstance(one, int)]
        material = self._materials[self._plant.components[indices[0]].color] if indices else 1
        self._file.open(element.name, element.position, material)
        if element.component is not None:
            self._carry(element.component, path)
        tubes = 0
        for one in element.below:
            if isinstance(one, Element):
                self._write(one, path)
            else:
                tubes += 1
                self._carry(one, f"{path}/TUBE_{tubes}")
        self._file.close()

    def _carry(self, index: int, path: str) -> None:
        placed = self._placed[index]
        for body, pose in self._shapes[placed.shape].bodies:
            self._file.body(body, placed.pose @ pose)
        self.paths[index] = path


def _gamma(value: float) -> float:
    """A linear colour value as sRGB (IEC 61966-2-1)."""
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def _attributes(plant: Plant, site: Element) -> str:
    """The attribute file: every element with its attributes, nested as the tree is."""
    lines = [
        "CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&",
        "NEW Header Information",
        "  Source:= PDMS Data &end& Date:= 1 Jan 2026 &end& Time:= 00:00",
        f"  Project:= PLANT &end& MDB:= /{(plant.name or 'plant').upper()} &end& Element:= {site.name}",
        "END",
    ]
    stack: list[tuple[Element | None, int]] = [(site, 0)]
    while stack:
        element, depth = stack.pop()
        indent = "  " * depth
        if element is None:
            lines.append(f"{indent}END")
            continue
        lines.append(f"{indent}NEW {element.name}")
        owner = element.owner.name if element.owner is not None else "/*"
        for key, value in {"Name": element.name, **element.attributes, "Owner": owner}.items():
            lines.append(f"{indent}{key:>16}:=  {value}")
        stack.append((None, depth))
        stack.extend((one, depth + 1) for one in reversed(list(element.elements)))
    return "\n".join(lines) + "\n"
