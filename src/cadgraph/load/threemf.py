"""3MF to a scene: each object with triangles that the build, or a component below it, places is a mesh.

Our own reader of the little XML that counts: ``trimesh`` (5.2) stops its walk over nested components after a number
of steps and so loses instances without a word, and flattens their tree. 3MF is in millimetres unless it says
otherwise, Z up (3MF Core Specification 1.3, 3.3 and 3.4).

Notes in ``Scene.diagnostics``:

- left out: ``other-purpose`` (supports of a print), ``broken-object``, ``missing-object``, ``too-deep``, and those of
  ``pack``;
- repaired: ``invalid-indices``, ``invalid-points``;
- guessed: ``invalid-units``.
"""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from cadgraph._io.limits import most_unpacked, size_text
from cadgraph.errors import LoadError
from cadgraph.load.budget import Budget
from cadgraph.load.naming import Names, clipped, name_fact, path_step
from cadgraph.load.packing import Notes, Piece, metres_z_up, pack
from cadgraph.load.triangles import clean_triangles, linear, main_color
from cadgraph.model.facts import Fact
from cadgraph.model.scene import Faces, Floats, Ints, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_UNITS = {
    "micron": 1e-6, "millimeter": 0.001, "centimeter": 0.01, "inch": 0.0254, "foot": 0.3048, "meter": 1.0
}  # fmt: skip
_MAX_DEPTH = 200  # of components in components; ours
_MOST_BYTES = 1 << 30  # of the XML unpacked; a triangle takes about 40
_MOST_PARTS = 10_000  # files in the package; ours
_SUPPORTS = ("support", "solidsupport")
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    SyntaxError,
    ValueError,
)

Key = tuple[str, str]  # part of the package and id


@dataclass
class _Object:
    name: str
    kind: str
    points: Floats
    corners: npt.NDArray[np.int64]
    group: Key | None
    index: str
    colors: list[tuple[int, str, str]]
    components: list[tuple[Key, Floats]]


@dataclass
class _Package:
    """What all parts of a package hold.

    Args:
        objects: by part and id.
        items: of the build: object and placement.
        colors: by part and id of a group: name and sRGB of each.
        unit: of the root part.
        size: of all parts unpacked [bytes].
    """

    objects: dict[Key, _Object] = field(default_factory=dict)
    items: list[tuple[Key, Floats]] = field(default_factory=list)
    colors: dict[Key, list[tuple[str, Floats]]] = field(default_factory=dict)
    unit: str = "millimeter"
    size: int = 0


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a 3MF package.

    Args:
        path: of the file.
        config: ``metadata`` says whether names of objects and materials are kept.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, or builds no triangle.
    """
    notes, package = Notes(), _Package()
    try:
        _unpack(path, package, notes)
    except _DAMAGE as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise LoadError(f"{path}: not readable as 3MF ({reason}); copy or export it again") from None
    unit = _UNITS.get(package.unit.strip().lower().removesuffix("s"))
    if unit is None:
        notes.add("invalid-units", f"{package.unit[:40]!r} is no unit of 3MF; taken as millimetres")
        unit = 0.001
    reading = _Reading(Budget(path, config, package.size), package, notes)
    reading.walk()
    kept = reading.facts if config.metadata != "off" else []
    scene = pack(
        reading.pieces, Source(meters_per_unit=unit, up_axis="Z", format="3mf"), metres_z_up(unit, "Z"), notes, (), kept
    )
    if not scene.n_meshes:
        codes = sorted({note.code for note in scene.diagnostics})
        told = f" ({', '.join(codes)})" if codes else ""
        raise LoadError(f"{path}: opens, but builds no triangle{told}; export it again")
    return scene


def _unpack(path: Path, package: _Package, notes: Notes) -> None:
    with zipfile.ZipFile(path) as archive:
        parts = [entry for entry in archive.infolist() if entry.filename.lower().endswith(".model")]
        most = most_unpacked(path.stat().st_size, _MOST_BYTES)
        if len(parts) > _MOST_PARTS or sum(entry.file_size for entry in parts) > most:
            raise LoadError(f"{path}: unpacks to more than {_MOST_PARTS:,} parts or {size_text(most)}; split the model")
        root = next((e for e in parts if e.filename.lower().endswith("3d/3dmodel.model")), parts[0] if parts else None)
        if root is None:
            raise ValueError("it holds no part that ends in .model")
        package.size = sum(entry.file_size for entry in parts)
        for entry in parts:
            with archive.open(entry) as file:
                _read_part(file, _absolute(entry.filename), entry is root, package, notes)


def _absolute(name: str) -> str:
    return "/" + name.replace("\\", "/").lstrip("/").lower()


def _local(tag: str) -> str:
    return tag.rpartition("}")[2]


def _read_part(file: IO[bytes], part: str, is_root: bool, package: _Package, notes: Notes) -> None:
    for event, element in ElementTree.iterparse(file, events=("start", "end")):
        tag = _local(element.tag)
        if event == "start":
            if tag == "model" and is_root:
                package.unit = element.get("unit", "millimeter")
            continue
        if tag == "object":
            try:
                package.objects[part, element.get("id", "")] = _object(element, part)
            except (ValueError, KeyError, OverflowError) as error:
                name = path_step(element.get("name"), f"object_{path_step(element.get('id'), '')}")
                notes.add(
                    "broken-object", f"left out: it can't be read ({' '.join(str(error).split())[:80]})", f"/{name}"
                )
            element.clear()
        elif tag in ("basematerials", "colorgroup"):
            package.colors[part, element.get("id", "")] = [
                (child.get("name", ""), _srgb(child.get("displaycolor") or child.get("color"))) for child in element
            ]
            element.clear()
        elif tag == "item" and is_root:
            package.items.append(_placement(element, part))


def _object(element: ElementTree.Element, part: str) -> _Object:
    vertices: list[tuple[str, str, str]] = []
    triangles: list[tuple[str, str, str]] = []
    components: list[tuple[Key, Floats]] = []
    colors: list[tuple[int, str, str]] = []
    for child in element.iter():
        tag = _local(child.tag)
        if tag == "vertex":
            vertices.append((child.attrib["x"], child.attrib["y"], child.attrib["z"]))
        elif tag == "triangle":
            if "p1" in child.attrib:
                colors.append((len(triangles), child.attrib.get("pid", ""), child.attrib["p1"]))
            triangles.append((child.attrib["v1"], child.attrib["v2"], child.attrib["v3"]))
        elif tag == "component":
            components.append(_placement(child, part))
    group = element.get("pid")
    return _Object(
        element.get("name", ""),
        element.get("type", "model"),
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(triangles, dtype=np.int64).reshape(-1, 3),
        (part, group) if group is not None else None,
        element.get("pindex", "0"),
        colors,
        components,
    )


def _placement(element: ElementTree.Element, part: str) -> tuple[Key, Floats]:
    """Which object an element places, and where: ``(4, 4)`` for row vectors."""
    other = next((value for name, value in element.attrib.items() if _local(name) == "path"), None)
    key = (_absolute(other) if other else part, element.get("objectid", ""))
    matrix = np.eye(4)
    text = element.get("transform")
    if text:
        try:
            matrix[:, :3] = np.array(text.split(), dtype=np.float64).reshape(4, 3)
        except ValueError:
            matrix[:] = np.nan  # is told when it is placed
    return key, matrix


def _srgb(text: str | None) -> Floats:
    """Linear RGB of ``#RRGGBB`` or ``#RRGGBBAA``, NaN for anything else."""
    try:
        value = bytes.fromhex((text or "").strip().removeprefix("#"))
    except ValueError:
        value = b""
    return linear(np.array(list(value[:3])) / 255) if len(value) in (3, 4) else np.full(3, np.nan)


@dataclass
class _Reading:
    """The walk from the build down the components."""

    budget: Budget
    package: _Package
    notes: Notes
    pieces: list[Piece] = field(default_factory=list)
    facts: list[Fact] = field(default_factory=list)
    _shapes: dict[Key, tuple[npt.NDArray[np.floating], Faces, Floats | None, tuple[str, ...]]] = field(
        default_factory=dict
    )
    _triangles: int = 0

    def walk(self) -> None:
        """Takes up every object that is built, as often as it is placed."""
        n = 0
        stack = list(self._named(self.package.items, "", np.eye(4), 0))[::-1]
        while stack:
            key, path, matrix, depth = stack.pop()
            n += 1
            self.budget.check_meshes(n)
            self.budget.check_placed(self._triangles)
            built = self.package.objects.get(key)
            if built is None:
                self.notes.add("missing-object", "left out: the package doesn't hold the object that it places", path)
            elif built.kind in _SUPPORTS:
                self.notes.add("other-purpose", "left out: a support of the print, no part", path)
            elif depth >= _MAX_DEPTH:
                self.notes.add("too-deep", f"left out: deeper than {_MAX_DEPTH} components", path)
            else:
                self._place(key, built, path, matrix)
                stack += list(self._named(built.components, path, matrix, depth + 1))[::-1]

    def _named(
        self, placements: list[tuple[Key, Floats]], above: str, matrix: Floats, depth: int
    ) -> Iterator[tuple[Key, str, Floats, int]]:
        taken = Names()
        for key, own in placements:
            built = self.package.objects.get(key)
            name = path_step(built.name if built else None, f"object_{path_step(key[1], '')}")
            with np.errstate(over="ignore", invalid="ignore"):
                yield key, f"{above}/{taken.take(name)}", own @ matrix, depth

    def _place(self, key: Key, built: _Object, path: str, matrix: Floats) -> None:
        self.facts += name_fact(path, built.name, "object name")
        if not len(built.corners):
            return
        if key not in self._shapes:
            self._shapes[key] = self._shape(key, built, path)
        points, faces, color, materials = self._shapes[key]
        if not len(faces):
            self.notes.add("empty-mesh", "left out: it has no triangle that can be used", path)
            return
        self._triangles += len(faces)
        # The same array for every instance: what is shared can be told from it.
        self.pieces.append(Piece(path, points, faces, matrix, color))
        self.facts += [Fact(path, "layer", clipped(name), "basematerials") for name in materials]

    def _shape(
        self, key: Key, built: _Object, path: str
    ) -> tuple[npt.NDArray[np.floating], Faces, Floats | None, tuple[str, ...]]:
        points, faces, kept = clean_triangles(built.points, built.corners, path, self.notes)
        found: dict[tuple[Key, str] | None, int] = {(built.group, built.index) if built.group else None: 0}
        color_of_face: Ints = np.zeros(len(built.corners), np.int64)
        for triangle, group, index in built.colors:
            own = (key[0], group) if group else built.group
            color_of_face[triangle] = found.setdefault((own, index) if own else None, len(found))
        entries = [self._material(which) for which in found]
        palette = np.array([color for _, color in entries])
        used = np.unique(color_of_face[kept]).tolist()
        names = tuple(dict.fromkeys(entries[number][0] for number in used if entries[number][0].strip()))
        return points, faces, main_color(points, faces, palette, color_of_face[kept]), names

    def _material(self, which: tuple[Key, str] | None) -> tuple[str, Floats]:
        if which is not None:
            group, index = self.package.colors.get(which[0], []), which[1]
            if index.isdecimal() and len(index) < 10 and int(index) < len(group):
                return group[int(index)]
        return "", np.full(3, np.nan)
