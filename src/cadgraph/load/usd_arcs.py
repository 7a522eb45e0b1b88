"""What one layer of USD refers to, found without composing anything."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from pxr import Sdf

__all__ = ["Arc", "LayerArcs", "Site", "arcs_of"]

_LISTS = {"references": "reference", "payload": "payload", "inheritPaths": "inherit", "specializes": "specialize"}
_SITE = {*_LISTS, "instanceable", "clips"}
_Known = dict[tuple[str, Any], tuple["Arc", ...]]


class Arc(NamedTuple):
    """One thing that a prim is composed of besides its own opinions.

    Args:
        kind: ``"reference"``, ``"payload"``, ``"inherit"`` or ``"specialize"``.
        asset: the file as it is written there; empty: the layers that the prim stands in.
        prim: path of the target; empty: the default prim of the file.
    """

    kind: str
    asset: str
    prim: str


class Site(NamedTuple):
    """A prim of a layer that composes more than what stands below it.

    Args:
        arcs: all of them, of whatever strength.
        variants: for each variant set the paths of its variants, of which one is chosen.
        instanceable: as authored, or None.
    """

    arcs: tuple[Arc, ...]
    variants: tuple[tuple[str, ...], ...]
    instanceable: bool | None


@dataclass
class LayerArcs:
    """What a layer refers to.

    Args:
        layer: the open layer.
        sublayers: as they are written there.
        default: path of its default prim, or empty.
        sites: by path.
        inner: how many prims stand at and below each prim that has others below; what is not here has none. Those of
            variants count in their variant alone.
        clips: prims with value clips, and the files that these name.
        variables: of expressions in paths of assets.
    """

    layer: Any
    sublayers: tuple[str, ...]
    default: str
    sites: dict[str, Site] = field(default_factory=dict)
    inner: dict[str, int] = field(default_factory=dict)
    clips: list[tuple[str, tuple[str, ...]]] = field(default_factory=list)
    variables: dict[str, Any] = field(default_factory=dict)

    def size(self, path: str) -> int:
        """How many prims the layer has at and below a path."""
        found = self.inner.get(path)
        if found is not None:
            return found
        if path in self.sites:
            return 1
        return 1 if Sdf.Path.IsValidPathString(path)[0] and self.layer.GetObjectAtPath(path) else 0

    def assets(self) -> Iterator[tuple[str, str]]:
        """All files that it is composed with, as written there, and the prim that names each; empty for sublayers."""
        for asset in self.sublayers:
            yield asset, ""
        for path, site in self.sites.items():
            for arc in site.arcs:
                if arc.asset:
                    yield arc.asset, path


def arcs_of(layer: Any) -> LayerArcs:
    """Goes over all prims of a layer once."""
    root = layer.pseudoRoot
    default = root.GetInfo("defaultPrim") if root.HasInfo("defaultPrim") else ""
    variables = root.GetInfo("expressionVariables") if root.HasInfo("expressionVariables") else {}
    found = LayerArcs(
        layer,
        tuple(layer.subLayerPaths),
        default if default.startswith("/") else f"/{default}" * bool(default),
        variables=dict(variables),
    )
    above: list[int] = []
    sizes: list[int] = []
    inner: list[tuple[str, int]] = []
    stack: list[tuple[Any, int]] = [(root, -1)]
    known: _Known = {}
    while stack:
        prim, parent = stack.pop()
        number = len(above)
        above.append(parent)
        sizes.append(1)
        # The library takes ten times as long to list the children of a prim that has none as to say so.
        if prim.HasInfo("primChildren"):
            # A damaged file may name children that it doesn't hold.
            children = [child for child in prim.nameChildren.values() if child]
            inner.append((str(prim.path), number))
            stack.extend([(child, number) for child in children])
        sets = prim.variantSets
        of_sets = _variants(sets) if len(sets) else ()
        for each in of_sets:
            # No parent: a variant is a tree of its own.
            stack.extend((variant, -1) for variant in each)
        keys = _SITE.intersection(prim.ListInfoKeys())
        if keys or of_sets:
            _take_site(found, prim, keys, of_sets, known)
    for number in range(len(above) - 1, -1, -1):
        if above[number] >= 0:
            sizes[above[number]] += sizes[number]
    found.inner = {path: sizes[number] for path, number in inner}
    return found


def _variants(sets: Any) -> tuple[tuple[Any, ...], ...]:
    # A damaged file may name sets and variants that it doesn't hold.
    return tuple(
        tuple(variant.primSpec for variant in one.variants.values() if variant and variant.primSpec)
        for one in sets.values()
        if one
    )


def _take_site(
    found: LayerArcs, prim: Any, keys: set[str], of_sets: tuple[tuple[Any, ...], ...], known: _Known
) -> None:
    path = str(prim.path)
    arcs: tuple[Arc, ...] = ()
    for key in sorted(keys & _LISTS.keys()):
        arcs += _arcs(key, prim.GetInfo(key), path, known)
    instanceable = bool(prim.GetInfo("instanceable")) if "instanceable" in keys else None
    variants = tuple(tuple(str(variant.path) for variant in each) for each in of_sets)
    found.sites[path] = Site(arcs, variants, instanceable)
    if "clips" in keys:
        found.clips.append((path, tuple(_clip_files(prim.GetInfo("clips")))))


def _arcs(key: str, listed: Any, path: str, known: _Known) -> tuple[Arc, ...]:
    # Instances by the thousand refer to the same few things.
    found = known.get((key, listed))
    if found is not None:
        return found
    kind, items = _LISTS[key], listed.GetAppliedItems()
    if any(isinstance(item, Sdf.Path) for item in items):
        # Relative to where it stands.
        here = Sdf.Path(path).GetPrimOrPrimVariantSelectionPath()
        return tuple(Arc(kind, "", str(item.MakeAbsolutePath(here))) for item in items)
    arcs = tuple(Arc(kind, item.assetPath, str(item.primPath) if item.primPath else "") for item in items)
    known[key, listed] = arcs
    return arcs


def _clip_files(sets: Any) -> Iterator[str]:
    for values in sets.values() if isinstance(sets, dict) else ():
        if not isinstance(values, dict):
            continue
        for key in ("assetPaths", "manifestAssetPath", "templateAssetPath"):
            value = values.get(key)
            for one in value if key == "assetPaths" and value is not None else [value]:
                text = getattr(one, "path", one)
                if isinstance(text, str) and text:
                    yield text
