"""The files that a stage shows without being composed of them: textures and the like, as seen from another place."""

from __future__ import annotations

import io
import os
import re
import zipfile
from pathlib import Path
from typing import Any

from pxr import Ar, UsdUtils

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import size_text
from cadgraph.export.usd_paths import is_usd, relative_path
from cadgraph.model.diagnostic import Diagnostic

__all__ = ["Files"]

_UDIM = "<UDIM>"  # stands for four digits: one file for each tile of a texture
_MOST = 2 << 30  # bytes of one file in a package
_NETWORK = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")  # one letter alone is a drive


class Files:
    """Makes the file names in a layer right for the place that the layer is written to.

    Args:
        target: the layer to write.
    """

    def __init__(self, target: Path) -> None:
        self._target = target
        self._folder = target.with_name(f"{target.stem}_files")
        self._outside: set[str] = set()
        self._missing: set[str] = set()

    def move(self, layer: Any) -> None:
        """Rewrites all file names of a flattened layer, in which those that were relative have become absolute.

        Raises:
            OutputError: a file from a package can't be written beside the layer.
        """
        UsdUtils.ModifyAssetPaths(layer, self._moved)

    def notes(self) -> list[Diagnostic]:
        """What is to be said of the files."""
        found = []
        if self._outside:
            first = min(self._outside)
            message = f"{len(self._outside):,} files stay where they are, as {first}; take them along with the stage"
            found.append(Diagnostic("outside-files", message))
        if self._missing:
            first = min(self._missing)
            message = f"{len(self._missing):,} files of the source were not found, as {first}"
            found.append(Diagnostic("missing-files", message))
        return found

    def _moved(self, asset: str) -> str:
        if Ar.IsPackageRelativePath(asset):
            return self._unpacked(asset)
        if not os.path.isabs(asset) or _NETWORK.match(asset):
            # An address, or a name that renderers look for in places of their own (OmniPBR.mdl).
            return asset
        moved = relative_path(Path(asset), self._target)
        # Layers that were resolved are still named in what the source says of itself.
        if not is_usd(asset):
            (self._outside if _is_there(Path(asset)) else self._missing).add(moved)
        return moved

    def _unpacked(self, asset: str) -> str:
        """The name of a copy beside the layer of what lies in a package."""
        package, inner = Ar.SplitPackageRelativePathOuter(asset)
        moved = relative_path(self._folder.joinpath(*_steps(inner)), self._target)
        contents = _contents(package, inner)
        if not contents:
            self._missing.add(moved)
        for name, content in contents.items():
            write_atomically(self._folder.joinpath(*_steps(name)), content)
        return moved


def _steps(inner: str) -> list[str]:
    """The steps of a path within packages, none of which leads anywhere else."""
    steps = (re.sub(r"[^\w.<>-]+", "_", step) for step in re.split(r"[/\\\[\]]+", inner))
    return [step for step in steps if step.strip(".")] or ["file"]


def _contents(package: str, inner: str) -> dict[str, bytes]:
    """What a package holds by a name, which may lie in a package within it, or stand for the tiles of a texture."""
    source: str | io.BytesIO = package
    prefix = ""
    try:
        while Ar.IsPackageRelativePath(inner):
            outer, inner = Ar.SplitPackageRelativePathOuter(inner)
            source = io.BytesIO(_read(source, outer))
            prefix += f"{outer}/"
        before, udim, behind = inner.partition(_UDIM)
        if not udim:
            return {f"{prefix}{inner}": _read(source, inner)}
        tile = re.compile(rf"{re.escape(before)}\d{{4}}{re.escape(behind)}")
        with zipfile.ZipFile(source) as archive:
            names = [name for name in archive.namelist() if tile.fullmatch(name)]
        return {f"{prefix}{name}": _read(source, name) for name in sorted(names)}
    except (OSError, KeyError, zipfile.BadZipFile, NotImplementedError, RuntimeError):
        return {}


def _read(source: str | io.BytesIO, name: str) -> bytes:
    with zipfile.ZipFile(source) as archive:
        info = archive.getinfo(name)
        if info.file_size > _MOST:
            raise OSError(f"{name}: {size_text(info.file_size)}")
        return archive.read(info)


def _is_there(path: Path) -> bool:
    if _UDIM not in path.name:
        return path.exists()
    before, _, behind = path.name.partition(_UDIM)
    return any(path.parent.glob(f"{_literal(before)}[0-9][0-9][0-9][0-9]{_literal(behind)}"))


def _literal(text: str) -> str:
    return re.sub(r"([\[\]*?])", r"[\1]", text)
