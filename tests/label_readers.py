"""Labels of a stage as simulators read them."""

from __future__ import annotations

import numpy as np
from pxr import Usd, UsdGeom, UsdSemantics

_SCHEMA = "SemanticsLabelsAPI:"


def get_labels(prim):
    """All labels applied to a prim by their taxonomies, as ``isaaclab.sim.utils.get_labels`` is documented."""
    found = {}
    for schema in prim.GetAppliedSchemas():
        if schema.startswith(_SCHEMA):
            attribute = UsdSemantics.LabelsAPI(prim, schema.removeprefix(_SCHEMA)).GetLabelsAttr()
            found[schema.removeprefix(_SCHEMA)] = list(attribute.Get() or ()) if attribute else []
    return found


def nearest(prim, taxonomy="class"):
    """The labels of a mesh: its own, else those of the nearest prim above it that has some; None without."""
    while prim and not prim.IsPseudoRoot():
        labels = get_labels(prim)
        if taxonomy in labels:
            return tuple(labels[taxonomy])
        prim = prim.GetParent()
    return None


def drawn_labels(stage, taxonomy="class"):
    """The labels of every mesh that is drawn, by its path; those of an item of a point instancer by ``path[item]``."""
    found = {}
    prims = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            prims.PruneChildren()
            found.update(_items(stage, prim, taxonomy))
        elif prim.IsA(UsdGeom.Gprim):
            found[str(prim.GetPath())] = nearest(prim, taxonomy)
    return found


def _items(stage, prim, taxonomy):
    instancer = UsdGeom.PointInstancer(prim)
    targets = instancer.GetPrototypesRel().GetForwardedTargets()
    if prim.IsInstanceProxy():
        # What is said in a prototype points into it.
        inside = str(prim.GetPrimInPrototype().GetPath())
        targets = [str(target).replace(inside, str(prim.GetPath()), 1) for target in targets]
    for item, number in enumerate(np.array(instancer.GetProtoIndicesAttr().Get()).tolist()):
        root = stage.GetPrimAtPath(targets[number])
        meshes = [p for p in Usd.PrimRange(root, Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Gprim)]
        for mesh in meshes:
            below = str(mesh.GetPath())[len(str(root.GetPath())) :] if len(meshes) > 1 else ""
            yield f"{prim.GetPath()}[{item}]{below}", nearest(mesh, taxonomy)
