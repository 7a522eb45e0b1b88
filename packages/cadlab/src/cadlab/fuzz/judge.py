"""Says what came of reading a spoilt file: read whole, refused in one line, or a fault of the reader."""

from __future__ import annotations

import traceback
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from cadgraph.errors import CadGraphError
from cadlab.fuzz.kinds import Kind

__all__ = ["FAULTS", "Verdict", "fault_of_message", "judge"]

FAULTS = {
    "traceback": "another error than those that are told in one line",
    "unprintable": "a message of several lines, or with control characters",
    "unnamed": "a message that doesn't name the file",
    "endless": "a message of more than 2,000 characters",
    "noise": "something printed, or a warning of Python",
    "lost": "a mesh that is neither in the scene nor in a diagnostic",
    "unsound": "a scene whose numbers can't be",
    "memory": "more memory than 2 GB",
    "crash": "the end of the process",
    "hang": "more than ten seconds",
}
"""What must not happen."""

_MOST_MESSAGE = 2000


@dataclass(frozen=True)
class Verdict:
    """What came of a case.

    Args:
        outcome: ``read``, ``refused`` or a key of ``FAULTS``; ``stopped-crash``, ``stopped-hang``, ``stopped-memory``
            where that happened to the process that a scene is read in, and the caller was told in one line.
        detail: the message, or where it failed.
    """

    outcome: str
    detail: str = ""

    @property
    def is_fault(self) -> bool:
        """Whether something is to be mended."""
        return self.outcome in FAULTS


def judge(kind: Kind, file: Path, seeds: Path) -> Verdict:
    """Reads a file in this process.

    Args:
        kind: of file.
        file: what is read.
        seeds: folder of the sound files.
    """
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            found = kind.read(file, seeds)
            fault = _fault_of_scene(kind, file, found) if kind.scene else None
        except MemoryError:
            return Verdict("memory", "MemoryError")
        except Exception as error:  # noqa: BLE001 - which ones may come is the question
            if isinstance(error, CadGraphError) or (kind.values and type(error) is ValueError):
                return fault_of_message(kind, file, str(error)) or Verdict("refused", str(error))
            return Verdict("traceback", _place(error))
    # What a reader of scenes prints or warns of, its own process keeps to itself.
    if warned and not kind.scene:
        return Verdict("noise", f"{warned[0].category.__name__}: {warned[0].message}")
    return fault or Verdict("read")


def fault_of_message(kind: Kind, file: Path, message: str) -> Verdict | None:
    """What is wrong with the text of a refusal, if anything."""
    if not message.isprintable():
        return Verdict("unprintable", repr(message)[:300])
    if len(message) > _MOST_MESSAGE:
        return Verdict("endless", message[:300])
    if kind.named and str(file.parent) not in message:
        return Verdict("unnamed", message[:300])
    return None


def _place(error: Exception) -> str:
    """Type and text of an error, and the last line of ours that it went through."""
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if "/cadgraph/" in frame.filename.replace("\\", "/")] or list(frames)
    at = f"{Path(ours[-1].filename).name}:{ours[-1].lineno} {ours[-1].name}" if ours else "?"
    return f"{at}: {type(error).__name__}: {error!s:.200}"


def _fault_of_scene(kind: Kind, file: Path, scene: Any) -> Verdict | None:
    if not np.isfinite(scene.vertices).all() or not np.isfinite(scene.origin).all():
        return Verdict("unsound", "a vertex is not finite")
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
            return Verdict("unsound", "a mesh without faces, or a face with a corner that is not there")
    lost = _lost_of_usd(file, scene) if kind.name.startswith("usd") else ()
    if lost:
        return Verdict("lost", ", ".join(lost)[:300])
    texts = [*(note.message for note in scene.diagnostics), *(note.code for note in scene.diagnostics)]
    wrong = [text for text in texts if "\n" in text or "\x1b" in text]
    return Verdict("unprintable", repr(wrong[0])[:300]) if wrong else None


def _lost_of_usd(file: Path, scene: Any) -> list[str]:
    """Surfaces of a stage, by a walk of its own, that no path of the scene and no note tells of."""
    from pxr import Tf, Usd, UsdGeom

    try:
        stage = Usd.Stage.Open(str(file), Usd.Stage.LoadAll)
    except Tf.ErrorException:
        # Damage in the middle of a binary file is noticed or not, as memory happens to be.
        return []
    told = {*scene.paths, *scene.anchors, *(mesh for note in scene.diagnostics for mesh in note.meshes)}
    steps = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))
    walk, lost = iter(steps), []
    for prim in walk:
        if str(prim.GetPath()) in told or prim.IsA(UsdGeom.PointInstancer):
            walk.PruneChildren()  # of an instancer the paths tell items, not prims
        elif prim.IsA(UsdGeom.Gprim) and _counts(prim, told):
            lost.append(str(prim.GetPath()))
    return lost


def _counts(prim: Any, told: set[str]) -> bool:
    path = str(prim.GetPath())
    return not any(other.startswith(f"{path}/") for other in told)
