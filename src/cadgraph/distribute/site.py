"""Who does the work of a run: processes of this machine or a Ray cluster, with the folder that their results lie in."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cadgraph.distribute.crew import TileCrew
    from cadgraph.distribute.hands import Hands

__all__ = ["FOLDER", "crew_for", "hands_for"]

FOLDER = ".cadgraph-tiles"
"""The name of the run folder, within that of the results."""


@contextmanager
def hands_for(folder: Path, workers: int | None = None, ray: str | None = None) -> Iterator[Hands]:
    """Processes of this machine, or a Ray cluster where one is named.

    Args:
        folder: that what they do goes to; it exists, and all nodes of a cluster see it.
        workers: at a time; None: one process, or all processors of the cluster.
        ray: address of a cluster; see ``RayHands``.

    Raises:
        ValueError: ``workers`` is below 1, or ``ray`` is no address.
        MissingExtra: Ray is asked for and not installed.
        CadGraphError: the cluster can't be used.
    """
    if workers is not None and workers < 1:
        raise ValueError(f"workers is {workers}; give at least 1")
    if ray is None:
        from cadgraph.distribute.processes import Processes

        with Processes(workers or 1) as processes:
            yield processes
        return
    from cadgraph.distribute.on_ray import RayHands

    with RayHands(ray, folder, workers) as cluster:
        yield cluster


@contextmanager
def crew_for(
    target: Path, workers: int | None = None, tiles: int | None = None, ray: str | None = None
) -> Iterator[TileCrew | None]:
    """A crew for one run, or None where one process does all at once.

    Where the run ends well, its run folder goes; where it doesn't, the next one goes on from there.

    Args:
        target: the folder of the results; it exists.
        workers: processes; one if None, with ``ray`` all processors.
        tiles: that the site is cut into; by its size and the workers if None.
        ray: address of a Ray cluster that does the work.

    Raises:
        ValueError: ``workers`` or ``tiles`` is below 1, or ``ray`` is no address.
        MissingExtra: Ray is asked for and not installed.
        CadGraphError: the cluster can't be used.
    """
    folder = target / FOLDER
    if workers in (None, 1) and tiles is None and ray is None:
        yield None
    else:
        from cadgraph.distribute.crew import TileCrew

        try:
            with hands_for(target, workers, ray) as hands:
                yield TileCrew(hands, folder, tiles)
        except BaseException as stop:
            if next(folder.glob("*/result-*"), None) is None:
                shutil.rmtree(folder, ignore_errors=True)
            else:
                stop.add_note("what tiles have found so far is kept, the same command goes on from there")
            raise
    shutil.rmtree(folder, ignore_errors=True)
