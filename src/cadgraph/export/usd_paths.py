"""Where a USD layer lies beside its source, and whether it may; without the USD library, which takes long to import."""

from __future__ import annotations

import os
import re
from pathlib import Path

from cadgraph.errors import OutputError

__all__ = ["CONTROL", "check_source", "is_usd", "refuse_overwriting", "relative_path"]

_USD_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")

CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
"""Characters that no text in a layer may hold."""


def is_usd(source_path: str | Path) -> bool:
    """Whether a file is USD by its name, so that a layer can lie over it."""
    return Path(source_path).suffix.lower() in _USD_SUFFIXES


def check_source(source_path: str | Path, path: str | Path) -> None:
    """Makes sure that a layer can lie over a source, before any work is done for it.

    Args:
        source_path: the file that the scene comes from.
        path: the layer to write.

    Raises:
        OutputError: the layer would overwrite the source, or USD can't refer to the source by its name.
    """
    source, target = Path(source_path), Path(path)
    refuse_overwriting(source, target)
    if is_usd(source) and CONTROL.search(relative_path(source, target)):
        raise OutputError(
            f"{source}: no USD layer can refer to it, as its path holds control characters or broken text; rename it"
        )


def refuse_overwriting(source: Path, target: Path) -> None:
    """Makes sure that the source stays as it is.

    Raises:
        OutputError: the target is the source.
    """
    if os.path.realpath(source) == os.path.realpath(target):
        raise OutputError(f"{target}: this is the source itself, which stays untouched; choose another output folder")


def relative_path(below: Path, target: Path) -> str:
    """How a layer refers to a file: from its own folder, with forward slashes."""
    source = os.path.abspath(below)
    try:
        relative = os.path.relpath(source, os.path.dirname(os.path.abspath(target))).replace(os.sep, "/")
    except ValueError:
        # Another drive on Windows has no relative path.
        return source.replace(os.sep, "/")
    return relative if relative.startswith("../") else f"./{relative}"
