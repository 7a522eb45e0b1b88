"""PLY to a scene, through ``trimesh``: one mesh. Neither unit nor up axis belongs to the format.

Notes in ``Scene.diagnostics``: ``invalid-indices``, ``invalid-points``, ``cut-short``, and those of ``pack``.
"""

from __future__ import annotations

import logging
import re
import struct
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import trimesh

from cadgraph.errors import LoadError
from cadgraph.load.naming import path_step
from cadgraph.load.packing import Notes, Piece, pack
from cadgraph.load.triangles import clean_triangles, linear
from cadgraph.model.scene import Floats, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_HEADER = 1 << 16  # bytes in which a header says how many faces there are; ours
# What the library ends in on damaged files; it has no errors of its own.
_DAMAGE = (
    *(ArithmeticError, AssertionError, AttributeError, EOFError, LookupError, MemoryError, NameError, OSError),
    *(RuntimeError, StopIteration, SyntaxError, TypeError, ValueError, struct.error, DeprecationWarning),
)


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a PLY file.

    Args:
        path: of the file; pictures that it names are not opened.
        config: not asked, as the format says nothing of its parts.

    Returns:
        The scene in the file's own unit and axes; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, or is a point cloud.
    """
    notes = Notes()
    mesh = _loaded(path)
    faces = np.asarray(getattr(mesh, "faces", np.zeros((0, 3))))
    promised = _promised_faces(path)
    if promised and not len(faces):
        raise LoadError(f"{path}: none of its {promised:,} faces is there; copy or export it again")
    if not len(faces):
        raise LoadError(f"{path}: a point cloud, without any face; model its surfaces first")
    at = f"/{path_step(path.stem, 'part')}"
    points, faces, _ = clean_triangles(np.asarray(mesh.vertices, np.float64), faces, at, notes)
    if len(mesh.faces) < promised:
        message = f"{len(mesh.faces):,} of {promised:,} faces are there: the file is likely cut short"
        notes.add("cut-short", message + "; compare it with its source")
    pieces = [Piece(at, points, faces, np.eye(4), _color(mesh))] if len(faces) else []
    source = Source(meters_per_unit=1.0, up_axis="Z", format="ply", unit_stated=False, up_stated=False)
    scene = pack(pieces, source, np.eye(4), notes)
    if not scene.n_meshes:
        raise LoadError(f"{path}: none of its faces can be used; export it again")
    return scene


def _promised_faces(path: Path) -> int:
    with path.open("rb") as file:
        found = re.search(rb"^element face (\d{1,12})\s*$", file.read(_HEADER), re.MULTILINE)
    return int(found[1]) if found else 0


def _loaded(path: Path) -> Any:
    try:
        with path.open("rb") as file, _quiet():
            scene = trimesh.load_scene(
                file, file_type="ply", process=False, skip_materials=True, fix_texture=False, validate=False
            )
            return next(iter(scene.geometry.values()), None)
    except _DAMAGE as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise LoadError(f"{path}: not readable as PLY ({reason}); copy or export it again") from None


@contextmanager
def _quiet() -> Iterator[None]:
    """Without messages of the library on the terminal; what it can't read ends in an error."""
    log = logging.getLogger("trimesh")
    before = log.disabled
    log.disabled = True
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # Where numpy stops at what is no number, points would be missing.
            warnings.filterwarnings("error", message="string or file could not be read", category=DeprecationWarning)
            yield
    finally:
        log.disabled = before


def _color(mesh: Any) -> Floats | None:
    """The mean of its vertices' or faces' colours, which are those of a screen (sRGB)."""
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind not in ("vertex", "face"):
        return None
    colors = np.asarray(visual.vertex_colors if kind == "vertex" else visual.face_colors)
    return linear(colors[:, :3] / 255).mean(axis=0) if len(colors) else None
