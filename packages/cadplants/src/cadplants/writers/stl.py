"""Plants as binary STL: one bag of triangles, as meshes are printed."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Plant
from cadplants.writers.placing import Frame, place
from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["write"]

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as STL, component after component; nothing in the file says where one ends.

    Args:
        plant: what to write.
        style: millimetres and Z up by default; the file tells neither.
        stem: said in the header.
    """
    frame = Frame(style.meters_per_unit or 0.001, style.up_axis or "Z")
    corners = []
    for one in place(plant):
        pose = frame.pose(one.pose)
        points = frame.points(one.solid) @ pose[:3, :3].T + pose[:3, 3]
        # Rounded before normals are taken, so that these belong to the triangles in the file.
        corners.append(points.astype("<f4")[one.solid.faces])
    triangles = np.concatenate(corners) if corners else np.zeros((0, 3, 3), "<f4")
    wide = triangles.astype(np.float64)
    normals = np.cross(wide[:, 1] - wide[:, 0], wide[:, 2] - wide[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(triangles), _RECORD)
    records["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    records["corners"] = triangles
    # It must not begin with "solid", as text files do.
    header = f"cadplants: {stem}".encode("ascii", "replace")[:80].ljust(80, b"\0")
    data = header + np.array([len(records)], "<u4").tobytes() + records.tobytes()
    paths = tuple(f"/region_{index}" for index in range(plant.n_meshes))
    return Written({".stl": data}, paths, frame.meters_per_unit, frame.up_axis, painted=False)
