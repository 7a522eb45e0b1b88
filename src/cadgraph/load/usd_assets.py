"""The files that a USD file refers to, looked at before the USD library composes them.

Only what lies in the folder of the scene or below, or below a folder of ``load.asset_roots``, is opened: a scene from
somewhere may name any file of the machine. What lies elsewhere is noted (``outside-asset``) and composed as empty.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pxr import Ar, Sdf, Tf, Usd

from cadgraph.errors import LoadError
from cadgraph.load.budget import Budget
from cadgraph.load.packing import Notes
from cadgraph.load.sandbox.signature import kind_of
from cadgraph.load.usd_arcs import LayerArcs, arcs_of
from cadgraph.load.usd_census import Census

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["Assets", "file_of", "find_assets", "is_there", "open_layers", "open_stage"]

_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")
_ARGUMENTS = ":SDF_FORMAT_ARGS:"
_NEAR = 4  # so many folders up are named as such; what is farther away is named by its own folder


@dataclass
class Assets:
    """A layer and all that it refers to.

    Args:
        path: of the root layer.
        roots: folders whose files may be opened, the scene's own first.
        layers: what each layer refers to, by identifier, the root first. As long as they are held, the library doesn't
            read them anew.
        below: identifier of the layer that an asset path in a layer names, by both.
        outside: identifiers of what lies elsewhere.
        size: of all files [bytes].
    """

    path: Path
    roots: tuple[Path, ...]
    layers: dict[str, LayerArcs] = field(default_factory=dict)
    below: dict[tuple[str, str], str] = field(default_factory=dict)
    outside: dict[str, None] = field(default_factory=dict)
    size: int = 0

    @property
    def root(self) -> LayerArcs | None:
        """The root layer; None where it can't be opened."""
        return next(iter(self.layers.values()), None)


def file_of(layer: Any) -> str:
    """The file that holds a layer, of a package the package; empty for a layer in memory."""
    return str(layer.realPath).partition("[")[0]


def open_layers(path: Path, asset_roots: Sequence[str] = ()) -> list[Any]:
    """Opens a layer and all that it refers to, so that composing them reads nothing else.

    Args:
        path: of the root layer.
        asset_roots: as in ``LoadConfig``.

    Returns:
        The layers; as long as they are held, the library doesn't read them anew.

    Raises:
        LoadError: a layer is named that is no regular file.
    """
    return [each.layer for each in find_assets(path, asset_roots, Notes()).layers.values()]


def open_stage(path: Path, config: LoadConfig, notes: Notes) -> tuple[Any, Budget]:
    """Composes a scene, as far as it may be, all payloads loaded.

    Args:
        path: of the root layer.
        config: ``asset_roots`` and the limits.
        notes: get ``outside-asset``.

    Returns:
        The stage, for which files that lie outside are muted, and how much its meshes may be.

    Raises:
        LoadError: a layer is no regular file, clips lie outside, or the scene is larger than the settings allow.
        Tf.ErrorException: the library can't open it.
    """
    assets = find_assets(path, config.asset_roots, notes)
    budget = Budget(path, config, assets.size)
    if assets.root is not None:
        _check_growth(assets, budget)
    muted = set(Sdf.Layer.GetMutedLayers())
    known = [each for each in assets.outside if each not in muted]
    if not assets.outside:
        return _checked(Usd.Stage.Open(str(path), Usd.Stage.LoadAll), assets), budget
    for each in known:
        Sdf.Layer.AddToMutedLayers(each)
    try:
        # With no prim: what is muted for this stage alone must be so before any prim is composed.
        nothing = Usd.StagePopulationMask()
        stage = Usd.Stage.OpenMasked(str(path), nothing, Usd.Stage.LoadAll)
        stage.MuteAndUnmuteLayers(list(assets.outside), [])
    finally:
        for each in known:
            Sdf.Layer.RemoveFromMutedLayers(each)
    stage.SetPopulationMask(Usd.StagePopulationMask.All())
    return _checked(stage, assets), budget


def find_assets(path: Path, asset_roots: Sequence[str], notes: Notes) -> Assets:
    """Opens a layer and all that it refers to, as far as that may be opened.

    The library opens whatever a reference names; to open a named pipe or a terminal would wait for ever.

    Args:
        path: of the root layer.
        asset_roots: as in ``LoadConfig``.
        notes: get ``outside-asset``.

    Raises:
        LoadError: a layer is named that is no regular file, or value clips lie outside.
    """
    try:
        os.fspath(path).encode("utf-8")
    except UnicodeEncodeError:
        raise LoadError(f"{path}: its path is not UTF-8, which USD needs; rename it") from None
    folder = Path(os.path.abspath(path)).parent
    found = Assets(path, tuple(_real(folder / each) for each in (".", *asset_roots)))
    try:
        root = Sdf.Layer.FindOrOpen(str(path))
    except Tf.ErrorException:
        # To open the stage meets the same error, and tells it.
        return found
    if root is None:
        return found
    files: set[str] = set()
    waiting = [root]
    while waiting:
        layer = waiting.pop(0)
        if layer.identifier in found.layers:
            continue
        arcs = found.layers[layer.identifier] = arcs_of(layer)
        files.add(file_of(layer))
        waiting += _take_assets(found, layer, arcs, notes)
        for prim, clips in arcs.clips:
            for clip in clips:
                _check_clip(found, layer, prim, clip)
    found.size = sum(os.stat(file).st_size for file in files if file and os.path.isfile(file))
    return found


def _take_assets(found: Assets, layer: Any, arcs: LayerArcs, notes: Notes) -> Iterator[Any]:
    """Layers that one layer refers to, opened."""
    seen: dict[str, str] = {}
    for asset, prim in arcs.assets():
        if asset not in seen:
            seen[asset] = _identifier(found, layer, arcs, asset)
            identifier = seen[asset]
            found.below[layer.identifier, asset] = identifier
            if identifier and identifier not in found.outside:
                below = _opened(identifier, asset, found)
                if below is not None:
                    found.below[layer.identifier, asset] = below.identifier
                    yield below
        if seen[asset] in found.outside:
            notes.add("outside-asset", _told(found, layer, asset, seen[asset]), prim or None)


def _identifier(found: Assets, layer: Any, arcs: LayerArcs, asset: str) -> str:
    written = asset
    if asset.startswith("`"):
        root = found.root
        variables = {**arcs.variables, **(root.variables if root else {})}
        value = Sdf.VariableExpression(asset).Evaluate(variables).value
        written = value if isinstance(value, str) else ""
    try:
        return str(Sdf.ComputeAssetPathRelativeToLayer(layer, written)) if written else ""
    except Tf.ErrorException:
        return ""


def _opened(identifier: str, asset: str, found: Assets) -> Any:
    plain = identifier.partition(_ARGUMENTS)[0]
    if _is_address(plain):
        found.outside[identifier] = None
        return None
    resolved = str(Ar.GetResolver().Resolve(plain))
    if not resolved:
        # Missing: for the library to say.
        return None
    file = resolved.partition("[")[0]
    if not any(_real(Path(file)).is_relative_to(root) for root in found.roots):
        found.outside[identifier] = None
        return None
    try:
        mode = os.stat(file).st_mode
    except (OSError, ValueError):
        # No file at all: for the library to say.
        return None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise LoadError(
            f"{found.path}: refers to {asset!r}, which is not a regular file but {kind_of(mode)}; "
            "put a USD file there or remove the reference"
        )
    try:
        return Sdf.Layer.FindOrOpen(identifier)
    except Tf.ErrorException:
        return None


def _check_clip(found: Assets, layer: Any, prim: str, asset: str) -> None:
    """Clips are opened when values are read, by the library itself: those outside can't be left out one by one."""
    try:
        identifier = str(Sdf.ComputeAssetPathRelativeToLayer(layer, asset))
    except Tf.ErrorException:
        return
    file = identifier.partition(_ARGUMENTS)[0].partition("[")[0]
    if _is_address(file):
        raise LoadError(f"{found.path}: value clips of {prim} are at {asset!r}; only files beside the scene are read")
    if not any(_real(Path(file)).is_relative_to(root) for root in found.roots):
        raise LoadError(
            f"{found.path}: value clips of {prim} are in {asset!r}, outside the folder of the scene; "
            f"give --asset-root {_root_for(found, file)} (load.asset_roots) to read them"
        )


def _told(found: Assets, layer: Any, asset: str, identifier: str) -> str:
    is_root = found.root is not None and layer is found.root.layer
    shown = f"{asset!r:.200}" + ("" if is_root else f", which {_relative(found, layer.realPath)!r} refers to,")
    plain = identifier.partition(_ARGUMENTS)[0]
    if _is_address(plain):
        return f"{shown} was not opened: an address; put that file beside the scene"
    root = _root_for(found, str(Ar.GetResolver().Resolve(plain)).partition("[")[0])
    return (
        f"{shown} was not opened: it lies outside the folder of the scene; "
        f"give --asset-root {root} (load.asset_roots) to read it"
    )


def _root_for(found: Assets, file: str) -> str:
    """The folder to name so that a file may be opened, counted from the folder of the scene."""
    folder, own = _real(Path(file)).parent, found.roots[0]
    for up in own.parents[:_NEAR]:
        if folder.is_relative_to(up) and up != Path(up.anchor):
            folder = up
            break
    return _relative(found, str(folder))


def _relative(found: Assets, file: str) -> str:
    try:
        return Path(os.path.relpath(_real(Path(file)), found.roots[0])).as_posix()
    except ValueError:  # another drive
        return file


def _is_address(text: str) -> bool:
    """Whether a path is an address on the net; a single letter before the colon is a drive."""
    return _URL.match(text) is not None


def _real(path: Path) -> Path:
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):
        return path


def _check_growth(assets: Assets, budget: Budget) -> None:
    root = assets.root
    assert root is not None
    prims = Census(assets.layers, assets.below).prims(root.layer.identifier)
    if prims is None:
        raise LoadError(
            f"{assets.path}: its references lead in circles, too many to follow; remove references from a prim to what "
            "holds it"
        )
    budget.check_prims(prims)


def _checked(stage: Any, assets: Assets) -> Any:
    """The stage, if nothing of it lies outside that was not foreseen."""
    for layer in stage.GetUsedLayers():
        file = file_of(layer)
        if file and not any(_real(Path(file)).is_relative_to(root) for root in assets.roots):
            raise LoadError(
                f"{assets.path}: refers to {_relative(assets, file)!r} outside the folder of the scene; "
                f"give --asset-root {_root_for(assets, file)} (load.asset_roots) to read it"
            )
    return stage


def is_there(path: Path) -> bool:
    """Whether a file exists, whatever it is."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False
