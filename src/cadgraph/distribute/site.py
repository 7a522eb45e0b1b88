"""The crew of a run: processes of this machine, whose results lie in the run's folder until it is over."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cadgraph.distribute.crew import TileCrew
from cadgraph.distribute.processes import Processes

__all__ = ["FOLDER", "crew_of_processes"]

FOLDER = ".cadgraph-tiles"
"""The name of the run folder, within that of the results."""


@contextmanager
def crew_of_processes(target: Path, workers: int = 1, tiles: int | None = None) -> Iterator[TileCrew | None]:
    """A crew for one run, or None where one process does all at once.

    Where the run ends well, its run folder goes; where it doesn't, the next one goes on from there.

    Args:
        target: the folder of the results; it exists.
        workers: processes.
        tiles: that the site is cut into; by its size and the workers if None.

    Raises:
        ValueError: ``workers`` or ``tiles`` is below 1.
    """
    if workers < 1:
        raise ValueError(f"workers is {workers}; give at least 1")
    folder = target / FOLDER
    if workers == 1 and tiles is None:
        yield None
    else:
        with Processes(workers) as hands:
            yield TileCrew(hands, folder, tiles)
    shutil.rmtree(folder, ignore_errors=True)
