"""The files that a USD file refers to, looked at before the USD library composes them."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Any

from pxr import Ar, Sdf, Tf

from cadgraph.errors import LoadError
from cadgraph.load.sandbox.signature import kind_of

__all__ = ["is_there", "open_layers"]


def open_layers(path: Path) -> list[Any]:
    """Opens a layer and all that it refers to, so that composing them reads nothing else.

    The library opens whatever a reference names; to open a named pipe or a terminal would wait for ever.

    Args:
        path: of the root layer.

    Returns:
        The layers; as long as they are held, the library doesn't read them anew.

    Raises:
        LoadError: a layer is named that is no regular file.
    """
    try:
        os.fspath(path).encode("utf-8")
    except UnicodeEncodeError:
        raise LoadError(f"{path}: its path is not UTF-8, which USD needs; rename it") from None
    try:
        root = Sdf.Layer.FindOrOpen(str(path))
    except Tf.ErrorException:
        # To open the stage meets the same error, and tells it.
        return []
    if root is None:
        return []
    layers, seen = [root], {root.identifier}
    for layer in layers:
        for asset in layer.GetCompositionAssetDependencies():
            identifier = Sdf.ComputeAssetPathRelativeToLayer(layer, asset) if asset else ""
            if not identifier or identifier in seen:
                continue
            seen.add(identifier)
            found = _opened(identifier, asset, path)
            if found is not None:
                layers.append(found)
    return layers


def _opened(identifier: str, asset: str, path: Path) -> Any:
    resolved = str(Ar.GetResolver().Resolve(identifier.partition(":SDF_FORMAT_ARGS:")[0]))
    try:
        mode = os.stat(resolved).st_mode
    except (OSError, ValueError):
        # Missing, within a package, or no file at all: for the library to say.
        return None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise LoadError(
            f"{path}: refers to {asset!r}, which is not a regular file but {kind_of(mode)}; "
            "put a USD file there or remove the reference"
        )
    try:
        return Sdf.Layer.FindOrOpen(identifier)
    except Tf.ErrorException:
        return None


def is_there(path: Path) -> bool:
    """Whether a file exists, whatever it is."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False
