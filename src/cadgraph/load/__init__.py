"""Files to scenes: one module for each format, found through the table in ``_FORMATS``.

A new format is one module with ``read(path, config) -> Scene`` and one line in that table.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import stat
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.digest import sha256_of
from cadgraph.errors import LoadError, MissingExtra
from cadgraph.load.sandbox.signature import find_damage, kind_of, name_content

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig
    from cadgraph.model.scene import Scene

__all__ = ["Format", "formats", "load"]


@dataclass(frozen=True)
class Format:
    """A format that can be read.

    Args:
        name: short name, as recorded in ``Source.format``.
        title: what people call it.
        suffixes: of its files, lower case with the dot.
        module: holds ``read(path, config) -> Scene``.
        library: the third-party package that it needs, if any.
        extra: the optional dependency of cadgraph that brings this package; none: always installed.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    module: str
    library: str | None = None
    extra: str | None = None


_FORMATS = (
    Format("usd", "OpenUSD", (".usd", ".usda", ".usdc", ".usdz"), "cadgraph.load.usd", "pxr"),
    Format("step", "STEP", (".step", ".stp"), "cadgraph.load.step", "cascadio", "cad"),
    Format("iges", "IGES", (".iges", ".igs"), "cadgraph.load.step", "cascadio", "cad"),
    Format("ifc", "IFC", (".ifc", ".ifczip"), "cadgraph.load.ifc", "ifcopenshell", "ifc"),
    Format("rvm", "AVEVA RVM", (".rvm", ".rev"), "cadgraph.load.rvm"),
    Format("gltf", "glTF", (".glb", ".gltf"), "cadgraph.load.gltf"),
    Format("obj", "OBJ", (".obj",), "cadgraph.load.obj"),
    Format("stl", "STL", (".stl",), "cadgraph.load.stl"),
    Format("ply", "PLY", (".ply",), "cadgraph.load.ply", "trimesh", "mesh"),
    Format("3mf", "3MF", (".3mf",), "cadgraph.load.threemf"),
    Format("collada", "COLLADA", (".dae",), "cadgraph.load.collada", "collada", "mesh"),
)

_INSTEAD = {
    (".fbx", ".blend", ".max", ".3ds", ".ma", ".mb", ".c4d"): "export it as USD or glTF",
    (".jt",): "export it as STEP (AP242)",
    (".dwg", ".dxf", ".rvt", ".skp", ".pln"): "export it as IFC or STEP",
    (".ifcxml", ".ifcjson"): "export it as a STEP physical file (.ifc)",
    (".dgn",): "export it as IFC, from OpenPlant or MicroStation",
    (".nwd", ".nwc", ".nwf"): "export the models that it was made from, as IFC or STEP",
    (".vue",): "export it as IFC or STEP from Smart 3D or SmartPlant Review",
    (".sldprt", ".sldasm", ".catpart", ".catproduct", ".ipt", ".iam", ".prt", ".asm", ".par", ".x_t",
     ".x_b", ".xmt_txt", ".sat", ".sab", ".3dm", ".3dxml", ".cgr", ".f3d", ".fcstd", ".brep"): "export it as STEP",
    (".e57", ".las", ".laz", ".pts", ".rcp", ".pcd", ".xyz"): "they hold points; make a mesh of them first",
}  # fmt: skip
"""Formats that other programs turn into ones that are read, with what to export."""


def formats() -> tuple[Format, ...]:
    """All formats that can be read."""
    return _FORMATS


def load(path: str | os.PathLike[str], config: LoadConfig | None = None) -> Scene:
    """Reads a CAD file.

    With ``config.isolate`` the CAD library runs in a process of its own: no crash, no endless reading and no message
    of it reaches the caller. Without, it runs here, which is quicker by the half second of a start.

    Args:
        path: of the file; its suffix says which format it has.
        config: how to read it; the defaults if not given.

    Returns:
        All its meshes in metres, Z up, right-handed, sorted by path (``mesh_2`` before ``mesh_10``), at least one.

    Raises:
        TypeError: ``path`` is no path, or ``config`` no ``LoadConfig``.
        LoadError: the file is missing, damaged, of no known format, or holds no mesh; the text is one line.
        MissingExtra: the format needs a package that isn't installed.
    """
    from cadgraph.config import LoadConfig

    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"load takes the path of a file, not {path!r:.60}")
    if not isinstance(config, LoadConfig | None):
        raise TypeError(f"load takes a LoadConfig (config.load of a Config), not {type(config).__name__}")
    config = config or LoadConfig()
    file = Path(path)
    given = os.fspath(path)
    _check_file(file, given)
    form = _format_of(file, given)
    if form.library is not None and importlib.util.find_spec(form.library) is None:
        if form.extra is None:
            raise LoadError(f"{given}: reading {form.title} needs the package that brings {form.library!r}; reinstall")
        raise MissingExtra(f"reading {form.title} files", form.extra)
    damage = find_damage(file, form.name)
    if damage:
        raise LoadError(f"{given}: {damage}")
    if config.isolate:
        from concurrent.futures import ThreadPoolExecutor

        from cadgraph.load.sandbox.isolation import read_isolated

        # The hash is made here while the other process reads.
        with ThreadPoolExecutor(1) as threads:
            hashing = threads.submit(sha256_of, file)
            scene = read_isolated(form.module, file, given, config)
            digest = hashing.result()
    else:
        from cadgraph.load.finish import finish

        scene = finish(importlib.import_module(form.module).read(file, config), config, file)
        digest = sha256_of(file)
    if config.strict:
        from cadgraph.load.losses import refuse_losses

        refuse_losses(scene, given)
    source = replace(scene.source, path=given, sha256=digest, format=form.name, read_with=config.deciding())
    return replace(scene, source=source)


def _check_file(file: Path, given: str) -> None:
    try:
        if file.is_dir():
            raise LoadError(f"{given}: a folder; give one of the files in it ({_known_suffixes()})")
        status = file.stat()
        if not stat.S_ISREG(status.st_mode):
            raise LoadError(f"{given}: not a regular file but {kind_of(status.st_mode)}; give a file on a disk")
        with file.open("rb"):
            pass
    except FileNotFoundError:
        raise LoadError(f"{given}: no such file; check the path") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise LoadError(f"{given}: can't be opened ({reason}); check the path and its permissions") from None
    if status.st_size == 0:
        raise LoadError(f"{given}: the file is empty; export it again")


def _format_of(file: Path, given: str) -> Format:
    suffix = file.suffix.lower()
    for form in _FORMATS:
        if suffix in form.suffixes:
            return form
    for suffixes, remedy in _INSTEAD.items():
        if suffix in suffixes:
            raise LoadError(f"{given}: {suffix} files are not read; {remedy}")
    content = name_content(file)
    for form in _FORMATS:
        if form.name == content:
            raise LoadError(f"{given}: looks like {form.title}; rename it to end in {form.suffixes[0]}")
    raise LoadError(f"{given}: can't read files ending in {suffix or 'nothing'!r}; known are {_known_suffixes()}")


def _known_suffixes() -> str:
    return ", ".join(suffix for form in _FORMATS for suffix in form.suffixes)
