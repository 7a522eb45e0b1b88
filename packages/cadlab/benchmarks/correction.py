"""What a correction costs beside a full build: ``python packages/cadlab/benchmarks/correction.py [--field]``.

Prints a Markdown table of processor seconds until the new graph is there, files and report apart: of a build, and in a
session of single corrections of parts with different labels (median and greatest), and of taking them back.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

from _timing import machine, once

import cadgraph
from cadgraph.model.scene import Scene
from cadgraph.session.session import Change
from cadlab.markdown import table
from cadplants import make, write_usd

# One part of each, and what it is said to be.
CORRECTIONS = {
    "elbow": "Pipe assembly/tee",
    "gasket": "Pipe assembly/flange",
    "valve body": "Pipe assembly/coupling",
    "handwheel": "Gauge assembly/gauge face",
    "pipe": "Structural element/column",
    "bolt": "Pipe assembly/gasket",
    "post": "Pipe assembly/pipe",
}


def scene_of(preset: str) -> Scene:
    """The scene of a preset, as it comes from a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plant.usdc"
        write_usd(make(preset), path)
        return cadgraph.load(path)


def row(preset: str) -> list[str]:
    """One line of the table."""
    scene = scene_of(preset)
    cadgraph.build(scene)
    build = once(lambda: cadgraph.build(scene))
    session = cadgraph.Session.start(scene)
    graph = session.graph
    prepare = once(session.prepare)
    corrections, undos, changed = [], [], []
    for name, label in CORRECTIONS.items():
        part = next((p for p in graph.parts() if p.label is not None and p.label.name == name), None)
        if part is None:
            continue
        changes: list[Change] = []
        corrections.append(once(lambda: changes.append(session.correct(part.id, label))))  # noqa: B023
        changed.append(len(changes[0].changed))
        undos.append(once(session.undo))
    if session.graph.to_json() != graph.to_json():
        raise ValueError("taking corrections back did not lead back to the graph")
    middle = statistics.median(corrections)
    return [
        preset, f"{scene.n_meshes:,}", f"{len(graph.parts()):,}", f"{build:.2f}", f"{prepare:.2f}", f"{middle:.2f}",
        f"{max(corrections):.2f}", f"{statistics.median(undos):.2f}", f"{build / middle:.0f}", f"{max(changed)}",
    ]  # fmt: skip


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--field", action="store_true", help="also the whole field plant")
    presets = ("skid", "pumps", *(("field",) if parser.parse_args().field else ()))
    print(machine() + "\n")
    titles = [
        "plant",
        "meshes",
        "parts",
        "build [s]",
        "prepared [s]",
        "correction [s]",
        "slowest [s]",
        "undo [s]",
        "ratio",
        "most changed",
    ]
    print(*table(titles, [row(preset) for preset in presets], numbers=True), sep="\n")


if __name__ == "__main__":
    main()
