"""What dealing the work out costs and gains: ``python packages/cadlab/benchmarks/distribute.py [--scene FILE...]``.

Each scene is built whole in one process, by ``--workers 2``, and by ``--ray local --workers 2`` where Ray is installed,
each in a process of its own; then the steps that are dealt out alone, with the tasks that they become, what these read
and write, and what a task costs that does nothing. Scenes are lines of pipes and the generated plant ``field``.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from _timing import machine
from size import cell, measured, scenes

import cadgraph
from cadgraph.distribute.crew import TileCrew
from cadgraph.distribute.hands import Hands
from cadgraph.distribute.site import hands_for
from cadgraph.pipeline import analyse
from cadlab.markdown import table

STAGES = ("read", "measure", "contacts", "group", "label", "relate", "places", "mechanisms", "assemble", "write labels")
EMPTY = 200  # tasks that do nothing


def ways(workers: int) -> list[tuple[str, list[str]]]:
    """Names and options of the ways to build."""
    with_ray = importlib.util.find_spec("ray") is not None
    given = [("whole", []), (f"{workers} processes", ["--workers", str(workers)])]
    return [*given, *([(f"Ray, {workers} CPUs", ["--ray", "local", "--workers", str(workers)])] if with_ray else [])]


def builds(name: str, scene: Path, folder: Path, workers: int) -> list[list[object]]:
    """A row for each way to build a scene; all must write the same graph."""
    rows: list[list[object]] = []
    graphs, base = set(), 0.0
    for way, options in ways(workers):
        out = folder / f"{name}-{way.split(',')[0].replace(' ', '-')}"
        command = [sys.executable, "-m", "cadgraph", "build", str(scene), "-o", str(out), "--no-report", *options]
        wall, spent, peak = measured(command)
        base = base or wall
        stages = json.loads((out / "timings.json").read_text(encoding="utf-8"))
        graphs.add((out / "graph.json").read_bytes())
        each = (cell(stages.get(stage, float("nan"))) for stage in STAGES)
        rows.append([name, way, cell(wall), f"{base / wall:.2f}x", cell(spent), cell(peak), *each])
    if len(graphs) != 1:
        raise SystemExit(f"{name}: the graphs differ")
    return rows


class Counted:
    """Hands that note what each step came to."""

    def __init__(self, hands: Hands) -> None:
        self._hands = hands
        self.steps: list[tuple[str, int, float]] = []

    @property
    def count(self) -> int:
        return self._hands.count

    def run(
        self,
        function: Callable[..., Any],
        calls: Sequence[Any],
        told: Callable[[float], None] | None = None,
        each: Callable[[int, Any], None] | None = None,
    ) -> list[Any]:
        start = time.perf_counter()
        done = self._hands.run(function, calls, told, each)
        self.steps.append((function.__name__, len(calls), time.perf_counter() - start))
        return done


def do_nothing(number: int) -> int:
    """A task that costs nothing but being one."""
    return number


@contextmanager
def started(folder: Path, workers: int, ray: str | None) -> Iterator[tuple[Hands, float]]:
    """Hands, and how long they took to be there [s]."""
    start = time.perf_counter()
    with hands_for(folder, workers, ray) as hands:
        hands.run(do_nothing, [(number,) for number in range(workers)])
        yield hands, time.perf_counter() - start


def steps(name: str, path: Path, folder: Path, workers: int) -> list[list[object]]:
    """A row for each way and step: its tasks, their time, the bytes that they are given and give back."""
    rows: list[list[object]] = []
    scene = cadgraph.load(path)
    for way, ray in (("processes", None), ("Ray", "local"))[: len(ways(workers)) - 1]:
        run_folder = folder / f"steps-{name}-{way}"
        run_folder.mkdir()
        with started(run_folder, workers, ray) as (hands, until_there):
            start = time.perf_counter()
            hands.run(do_nothing, [(number,) for number in range(EMPTY)])
            each = (time.perf_counter() - start) / EMPTY
            counted = Counted(hands)
            analyse(scene, crew=TileCrew(counted, run_folder))
        shared = sum(file.stat().st_size for file in run_folder.glob("scene-*/*.npy"))
        for task, n, seconds in counted.steps:
            step = {"find_contacts_of_tile": "contacts", "look_at_meshes": "visible", "measure_range": "shapes"}[task]
            given = [file.stat().st_size for file in run_folder.glob(f"{step}-*/pairs-*.npz")]
            back = [file.stat().st_size for file in run_folder.glob(f"{step}-*/result-*.npz")]
            traffic = f"{sum(given) / n / 1e3:.1f}", f"{sum(back) / n / 1e3:.1f}", f"{shared / 1e6:.0f}"
            rows.append([name, way, step, n, f"{seconds:.2f}", *traffic, f"{1e3 * each:.1f}", f"{until_there:.1f}"])
    return rows


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lines", type=int, nargs="*", default=[10_000], help="sizes of the scenes of lines")
    parser.add_argument("--scene", type=Path, nargs="+", default=[], help="also these files")
    parser.add_argument("--no-field", action="store_true", help="without the generated plant")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--keep", type=Path, help="a folder that keeps scenes and results")
    options = parser.parse_args()
    options.million = options.points = options.teapots = False
    options.field = not options.no_field
    print(machine(), flush=True)
    with tempfile.TemporaryDirectory() as away:
        made = options.keep or Path(away)
        made.mkdir(parents=True, exist_ok=True)
        there = scenes(options, made)
        with tempfile.TemporaryDirectory(dir=made) as scratch:
            rows = [row for name, path in there for row in builds(name, path, Path(scratch), options.workers)]
            head = ["scene", "way", "wall s", "speed-up", "processor s", "peak MiB", *STAGES]
            print(*table(head, rows, numbers=True), sep="\n", flush=True)
            print()
            rows = [row for name, path in there for row in steps(name, path, Path(scratch), options.workers)]
            head = ["scene", "way", "step", "tasks", "wall s", "given kB/task", "back kB/task"]
            print(*table([*head, "scene MB", "empty task ms", "start s"], rows, numbers=True), sep="\n")


if __name__ == "__main__":
    main()
