"""A mesh with some of its faces only, as opinions over the whole one."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import Sdf, UsdGeom, Vt
from scipy.spatial import cKDTree

from cadgraph.export.usd_specs import set_attribute
from cadgraph.model.scene import Faces, Floats, Ints
from cadgraph.simulate.stage.specs import over

__all__ = ["faces_of_pieces", "faces_of_subset", "keep_faces"]

Bools = npt.NDArray[np.bool_]


def faces_of_subset(prim: Any, name: str) -> Bools:
    """``(n_polygons,)`` which polygons of a mesh belong to one of its subsets."""
    kept = np.zeros(len(_counts(prim)), bool)
    indices = np.asarray(UsdGeom.Subset(prim.GetChild(name)).GetIndicesAttr().Get(), np.int64)
    kept[indices[(indices >= 0) & (indices < len(kept))]] = True
    return kept


def faces_of_pieces(prim: Any, matrix: Floats, vertices: Floats, faces: Faces, moving: Bools) -> Bools:
    """``(n_polygons,)`` which polygons of a mesh are what moves of it in the scene.

    The loader makes triangles of polygons and drops what is broken, so that its triangles are no polygons of the
    source; but no position of a piece belongs to another piece.

    Args:
        prim: the mesh of the source.
        matrix: ``(4, 4)`` for row vectors, from the mesh to the scene.
        vertices: ``(n, 3)`` of the mesh in the scene [m].
        faces: ``(m, 3)`` its triangles.
        moving: ``(m,)`` which of them move.
    """
    counts = _counts(prim)
    corners = np.asarray(UsdGeom.Mesh(prim).GetFaceVertexIndicesAttr().Get(), np.int64)
    points = np.asarray(UsdGeom.Mesh(prim).GetPointsAttr().Get(), np.float64)
    moves = np.zeros(len(vertices), bool)
    moves[faces[moving]] = True
    used = np.unique(faces)
    nearest = used[cKDTree(vertices[used]).query(points @ matrix[:3, :3] + matrix[3, :3])[1]]
    votes = np.bincount(np.repeat(np.arange(len(counts)), counts), moves[nearest][corners], len(counts))
    kept: Bools = 2 * votes > counts
    return kept


def keep_faces(layer: Any, path: Any, prim: Any, kept: Bools) -> None:
    """Authors a mesh with these polygons only, and the points, normals, primvars and subsets that belong to them.

    Args:
        layer: gets the opinions.
        path: of the mesh in the layer, where all of it is composed.
        prim: the whole mesh.
        kept: ``(n_polygons,)`` which to keep.
    """
    counts, mesh = _counts(prim), UsdGeom.Mesh(prim)
    corner_kept = np.repeat(kept, counts)
    corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(), np.int64)[corner_kept]
    used, renumbered = np.unique(corners, return_inverse=True)
    spec = over(layer, path)
    points = np.asarray(mesh.GetPointsAttr().Get(), np.float32)[used]
    set_attribute(spec, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points)))
    set_attribute(spec, "faceVertexCounts", "IntArray", _ints(counts[kept]))
    set_attribute(spec, "faceVertexIndices", "IntArray", _ints(renumbered.reshape(-1)))
    extent = np.array([points.min(axis=0), points.max(axis=0)])
    set_attribute(spec, "extent", "Float3Array", Vt.Vec3fArray.FromNumpy(extent))
    # In the order of the points, of the polygons, of the corners: which values stay.
    stay = {
        "vertex": used,
        "varying": used,
        "uniform": np.flatnonzero(kept),
        "faceVarying": np.flatnonzero(corner_kept),
    }
    normals = mesh.GetNormalsAttr()
    if normals.HasAuthoredValue() and mesh.GetNormalsInterpolation() in stay:
        _slice(spec, normals, stay[mesh.GetNormalsInterpolation()])
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithAuthoredValues():
        if primvar.GetInterpolation() in stay:
            indexed = primvar.GetIndicesAttr() if primvar.IsIndexed() else primvar.GetAttr()
            _slice(spec, indexed, stay[primvar.GetInterpolation()])
    number = np.cumsum(kept) - 1
    for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim)):
        indices = np.asarray(subset.GetIndicesAttr().Get(), np.int64)
        indices = indices[(indices >= 0) & (indices < len(kept))]
        child = over(layer, spec.path.AppendChild(subset.GetPrim().GetName()))
        set_attribute(child, "indices", "IntArray", _ints(number[indices[kept[indices]]]))
    # Of subdivision surfaces, which are loaded as their cages; they number points and faces that are gone.
    for name in ("holeIndices", "cornerIndices", "creaseIndices", "creaseLengths"):
        if prim.GetAttribute(name).HasAuthoredValue():
            set_attribute(spec, name, "IntArray", Vt.IntArray())
    for name in ("cornerSharpnesses", "creaseSharpnesses"):
        if prim.GetAttribute(name).HasAuthoredValue():
            set_attribute(spec, name, "FloatArray", Vt.FloatArray())


def _slice(spec: Any, whole: Any, stay: Ints) -> None:
    values = whole.Get()
    if values is None or len(values) <= (int(stay.max()) if len(stay) else 0):
        return
    part = Sdf.AttributeSpec(spec, whole.GetName(), whole.GetTypeName())
    part.default = type(values)([values[i] for i in stay.tolist()])


def _counts(prim: Any) -> Ints:
    return np.asarray(UsdGeom.Mesh(prim).GetFaceVertexCountsAttr().Get(), np.int64)


def _ints(values: Ints) -> Any:
    return Vt.IntArray.FromNumpy(np.ascontiguousarray(values, np.int32))
