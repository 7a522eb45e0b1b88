"""Writes the plant as a stage that simulators open, for the command that simulates it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rich.markup import escape

from cadgraph.cli.screen import err, out
from cadgraph.errors import LoadError

_TOLD = 5  # of what has no joint, by name; the table has them all


def write_stage_beside(graph: Path, source: Path | None, needles: bool) -> dict[str, Any]:
    """Writes ``simulation.usda`` and ``devices.json`` beside a graph; where its source is gone, says so instead.

    Args:
        graph: the folder of a run, or its graph.json.
        source: where the file is that the graph was made from; None: where it was.
        needles: whether gauges without a needle get one.

    Returns:
        What was written, as plain values for JSON and for :func:`say_stage`.

    Raises:
        LoadError: the source that was given is not the graph's; or it can't be read any more.
        OutputError: a file can't be written.
    """
    from cadgraph.model.graph import SceneGraph
    from cadgraph.model.source_file import find_source
    from cadgraph.simulate.stage.writing import write_stage

    folder = graph if graph.is_dir() else graph.parent
    plant = SceneGraph.load(graph)
    try:
        origin = find_source(plant.source, folder, source)
    except LoadError as error:
        if source is not None:
            raise
        return {"stage": None, "why": str(error)}
    written = write_stage(plant, origin, folder, needles)
    return {
        "stage": str(written.files[0]),
        "devices": str(written.files[1]),
        "joints": [device.joint for device in written.devices],
        "immovable": [{"tag": each.tag, "reason": each.reason} for each in written.immovable],
        "colliders": written.n_colliders,
    }


def say_stage(stage: dict[str, Any]) -> None:
    """Prints what was written, and what nobody can turn."""
    if stage["stage"] is None:
        err.print(f"simulation.usda was not written: {escape(stage['why'])}")
        return
    joints, left = len(stage["joints"]), stage["immovable"]
    out.print()
    out.print(f"wrote {escape(stage['stage'])}: {joints} joints, {stage['colliders']:,} colliders")
    out.print(f"wrote {escape(stage['devices'])}")
    for each in left[:_TOLD]:
        out.print(f"[dim]no joint[/]  {escape(each['tag'])}: {escape(each['reason'])}")
    if len(left) > _TOLD:
        out.print(f"[dim]no joint[/]  {len(left) - _TOLD} more, in devices.json")
