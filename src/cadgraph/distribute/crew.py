"""A crew that deals the costly steps out as tasks on files, and puts together what comes back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import cadgraph
from cadgraph._io.atomic import write_atomically
from cadgraph._io.progress import Progress, quiet
from cadgraph.distribute.cut import cut_rows, cut_tiles, default_tiles, own_pairs
from cadgraph.distribute.hands import Call, Failure, Hands
from cadgraph.distribute.packing import unpack_facts
from cadgraph.distribute.store import digest_of, read_result, save_arrays, scene_arrays, write_result
from cadgraph.distribute.tasks import find_contacts_of_tile, measure_range, result_of
from cadgraph.errors import CadGraphError, FormatError
from cadgraph.geometry.shape.analysis import CHUNK
from cadgraph.model.parts import Contacts, Properties
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.shapes import Facts

__all__ = ["TileCrew"]

Found = dict[str, npt.NDArray[Any]]

_UNLIKE = 4  # times as many, or as few, that work on a run as did before it was stopped: it is cut anew


class TileCrew:
    """Does the costly steps of an analysis as tasks, each of which reads and writes files of a run folder.

    Results that an earlier run left in the folder for the same input and settings are taken as they are; so a run that
    was stopped goes on where it was.

    Args:
        hands: that run the tasks.
        folder: the run folder, which all of them see.
        tiles: how many tiles; None: by the number of meshes and of hands.
        cut: cuts boxes ``(n, 2, 3)`` into a number of tiles, ``(n,)``; by medians if None. Whatever it says, the result
            is the same.
    """

    def __init__(
        self,
        hands: Hands,
        folder: str | Path,
        tiles: int | None = None,
        cut: Callable[[Floats, int], Ints] = cut_tiles,
    ) -> None:
        if tiles is not None and tiles < 1:
            raise ValueError(f"tiles is {tiles}; give at least 1")
        self._hands, self._folder, self._tiles, self._cut = hands, Path(folder).absolute(), tiles, cut

    @property
    def remarks(self) -> tuple[str, ...]:
        """What went wrong on the way and was made good again, in words."""
        n = self._hands.ended
        times = "once" if n == 1 else f"{n} times"
        told = f"{times} a process ended before its work was done, and that was done again"
        return (f"{told}; where memory is short, give fewer --workers",) if n else ()

    def contacts(self, scene: Scene, properties: Properties, limit: float, progress: Progress = quiet) -> Contacts:
        """All pairs of meshes whose surfaces are at most ``limit`` apart [m]."""
        tile = self._cut(properties.aabb, self._count(scene.n_meshes))
        dealt = [pairs for pairs in own_pairs(properties.aabb, tile, limit) if len(pairs)]
        arrays = scene_arrays(scene)
        home, step = self._place("contacts", arrays, limit, digest_of({str(i): p for i, p in enumerate(dealt)}))
        for number, pairs in enumerate(dealt):
            if not result_of(step, number).exists():
                write_result(step / f"pairs-{number:06d}.npz", {"pairs": pairs})
        calls = [(str(home), str(step), number, limit) for number in range(len(dealt))]
        found = self._all(find_contacts_of_tile, step, calls, _contacts_in, partial(progress, "contacts"))
        pairs = np.concatenate([np.zeros((0, 2), np.int64), *(one["pairs"] for one in found)])
        distance = np.concatenate([np.zeros(0), *(one["distance"] for one in found)])
        points = np.concatenate([np.zeros((0, 2, 3)), *(one["points"] for one in found)])
        order = np.lexsort((pairs[:, 1], pairs[:, 0]))
        return Contacts(np.ascontiguousarray(pairs[order]), distance[order], points[order])

    def facts(self, scene: Scene, properties: Properties) -> Sequence[Facts]:
        """What is measured of each mesh of a scene that holds one for each shape."""
        ranges = cut_rows(np.diff(scene.face_offsets), self._count(scene.n_meshes), CHUNK)
        home, step = self._place("shapes", scene_arrays(scene, properties), tuple(ranges))
        calls = [(str(home), str(step), number, *ends) for number, ends in enumerate(ranges)]
        found = self._all(measure_range, step, calls, unpack_facts, None)
        for (first, last), one in zip(ranges, found, strict=True):
            if len(one) != last - first:
                raise FormatError(f"{step}: a result of another length; remove the folder, then build again")
        return [facts for some in found for facts in some]

    def _count(self, n_meshes: int) -> int:
        return self._tiles or default_tiles(n_meshes, self._shares)

    @cached_property
    def _shares(self) -> int:
        """How many share the work: where a run was stopped, as many as then, so that its results still fit.

        Unless many more work now, for whom those tiles would be too few; or there are so many tiles for nothing.
        """
        file, now = self._folder / "shares.txt", self._hands.count
        try:
            before = int(file.read_text(encoding="ascii")[:9])
        except (OSError, ValueError):
            before = 0
        if now / _UNLIKE <= before <= now * _UNLIKE:
            return before
        write_atomically(file, f"{now}\n")
        return now

    def _place(self, name: str, arrays: Found, *settings: object) -> tuple[Path, Path]:
        """Where what the tasks of a step read lies, and where their results go: named by what these depend on."""
        write_atomically(self._folder / "README.txt", _README)
        input_digest = digest_of(arrays)
        home = self._folder / f"scene-{input_digest}"
        save_arrays(home, arrays, input_digest)
        return home, self._folder / f"{name}-{digest_of({}, cadgraph.__version__, name, input_digest, settings)}"

    def _all(
        self,
        task: Callable[..., None],
        step: Path,
        calls: Sequence[Call],
        read: Callable[[Found], Any],
        told: Callable[[float], None] | None,
    ) -> list[Any]:
        """The results of all tasks of a step, those that are there already without running them again."""
        found = [_read(result_of(step, number), read) for number in range(len(calls))]
        missing = [number for number, one in enumerate(found) if one is None]
        outcomes = self._hands.run(task, [calls[number] for number in missing], told) if missing else []
        for number, outcome in zip(missing, outcomes, strict=True):
            if isinstance(outcome, Failure):
                if isinstance(outcome.error, CadGraphError | MemoryError):
                    raise outcome.error
                raise CadGraphError(f"{step}: tile {number} failed: {outcome.reason}")
            found[number] = _read(result_of(step, number), read)
            if found[number] is None:
                raise FormatError(f"{result_of(step, number)}: missing or damaged; all workers must see this folder")
        return found


def _read(file: Path, read: Callable[[Found], Any]) -> Any:
    """A result as its step wants it; None where it isn't there, or not as it should be."""
    arrays = read_result(file)
    try:
        return None if arrays is None else read(arrays)
    except (KeyError, ValueError, IndexError, TypeError):
        return None


def _contacts_in(arrays: Found) -> Found:
    n = len(arrays["pairs"])
    for name, shape in (("pairs", (n, 2)), ("distance", (n,)), ("points", (n, 2, 3))):
        if arrays[name].shape != shape:
            raise ValueError(name)
    return arrays


_README = """What a cadgraph run with tiles keeps while it works: inputs and results of its tasks.
A run that was stopped goes on from here; without it, it begins anew. It may be removed at any time.
"""
