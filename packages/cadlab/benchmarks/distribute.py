"""What dealing the work out costs and gains: ``python packages/cadlab/benchmarks/distribute.py [--scene FILE...]``.

Each scene is built whole in one process, by ``--workers 2``, and by ``--ray local --workers 2`` where Ray is installed,
each in a process of its own (the processor time of Ray's own daemons is not in it); then the steps that are dealt out
alone, with the tasks that they become, what these read and write, and what a task costs that does nothing. There the
speed-up is told by the processor time of the process that worked longest, which other programs on the machine don't
change much. Scenes are lines of pipes and the generated plant ``field``.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

sys.path.insert(0, str(Path(__file__).parent))

from _timing import machine
from size import cell, measured, scenes

import cadgraph
from cadgraph.distribute.crew import TileCrew
from cadgraph.distribute.hands import Call, Hands
from cadgraph.distribute.site import hands_for
from cadgraph.geometry.kernels.parallel import use_threads
from cadgraph.model.parts import Contacts
from cadgraph.model.shapes import Facts
from cadgraph.pipeline import analyse
from cadgraph.session.demo import DEMO_SCENE
from cadlab.markdown import table

STAGES = ("read", "measure", "contacts", "group", "label", "relate", "places", "mechanisms", "assemble", "write labels")
_T = TypeVar("_T")

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


@dataclass
class Step:
    """What one step came to.

    Args:
        tasks: that it became.
        wall: of all of it [s].
        dealing: processor time of this process: files of the scene, cutting, putting together [s].
        worked: processor time of the tasks in each process [s].
    """

    tasks: int = 0
    wall: float = 0.0
    dealing: float = 0.0
    worked: dict[int, float] = field(default_factory=dict)


class Alone:
    """Hands that are this process itself."""

    count = 1
    ended = 0

    def run(self, function: Callable[..., Any], calls: Sequence[Call], *_: object) -> list[Any]:
        return [function(*call) for call in calls]


class Timed:
    """A crew whose steps are timed; other programs on the machine change the wall time, and little else.

    Args:
        hands: that do the work.
        folder: of the run.
        tiles: as for ``TileCrew``.
    """

    def __init__(self, hands: Any, folder: Path, tiles: int | None = None) -> None:
        self.steps: dict[str, Step] = {}
        self._hands, self._crew = hands, TileCrew(self, folder, tiles)
        self._step = Step()

    @property
    def count(self) -> int:
        return int(self._hands.count)

    @property
    def ended(self) -> int:
        """How often a process ended amid its calls."""
        return int(self._hands.ended)

    def run(self, function: Callable[..., Any], calls: Sequence[Call], *_: object) -> list[Any]:
        done = self._hands.run(timed_call, [(function, call) for call in calls])
        for pid, spent in done:
            self._step.worked[pid] = self._step.worked.get(pid, 0.0) + spent
        self._step.tasks = len(calls)
        return [None] * len(calls)

    def contacts(self, *given: Any) -> Contacts:
        return self._timed("contacts", lambda: self._crew.contacts(*given))

    def facts(self, *given: Any) -> Sequence[Facts]:
        return self._timed("shapes", lambda: self._crew.facts(*given))

    def _timed(self, name: str, act: Callable[[], _T]) -> _T:
        self._step = self.steps[name] = Step()
        wall, spent = time.perf_counter(), time.process_time()
        found = act()
        self._step.wall = time.perf_counter() - wall
        self._step.dealing = time.process_time() - spent - self._step.worked.get(os.getpid(), 0.0)
        return found


def timed_call(function: Callable[..., Any], call: Call) -> tuple[int, float]:
    """Does a task, and says in which process and how long its processor worked."""
    start = time.process_time()
    function(*call)
    return os.getpid(), time.process_time() - start


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
    use_threads(1)
    small = cadgraph.load(DEMO_SCENE)
    analyse(small, crew=Timed(Alone(), folder / f"steps-{name}-warm", 1))
    whole = Timed(Alone(), folder / f"steps-{name}-whole", 1)
    analyse(scene, crew=whole)
    base = {step: max(one.worked.values()) for step, one in whole.steps.items()}
    rows += [row(name, "one process", step, one, base, []) for step, one in whole.steps.items()]
    for way, ray in (("processes", None), ("Ray", "local"))[: len(ways(workers)) - 1]:
        run_folder = folder / f"steps-{name}-{way}"
        run_folder.mkdir()
        with started(run_folder, workers, ray) as (hands, until_there):
            start = time.perf_counter()
            hands.run(do_nothing, [(number,) for number in range(EMPTY)])
            each = (time.perf_counter() - start) / EMPTY
            # Once for nothing, as each process reads the kernels that it uses.
            analyse(small, crew=Timed(hands, run_folder / "warm"))
            crew = Timed(hands, run_folder)
            analyse(scene, crew=crew)
        shared = sum(file.stat().st_size for file in run_folder.glob("scene-*/*.npy"))
        for step, one in crew.steps.items():
            given = sum(file.stat().st_size for file in run_folder.glob(f"{step}-*/pairs-*.npz"))
            back = sum(file.stat().st_size for file in run_folder.glob(f"{step}-*/result-*.npz"))
            more = [given / one.tasks / 1e3, back / one.tasks / 1e3, shared / 1e6, 1e3 * each, until_there]
            rows.append(row(name, way, step, one, base, more))
    return rows


def row(name: str, way: str, step: str, one: Step, base: dict[str, float], more: Sequence[float]) -> list[object]:
    """The figures of one step; the speed-up is that of processor time along the longest way through the step."""
    longest, total = max(one.worked.values()), sum(one.worked.values())
    told = [f"{value:.2f}" for value in (one.wall, longest, total, one.dealing)]
    rest = [f"{value:.1f}" for value in more] or ["–"] * 5
    return [name, way, step, one.tasks, *told, f"{base[step] / longest:.2f}x", *rest]


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lines", type=int, nargs="*", default=[10_000], help="sizes of the scenes of lines")
    parser.add_argument("--scene", type=Path, nargs="+", default=[], help="also these files")
    parser.add_argument("--no-field", action="store_true", help="without the generated plant")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--steps-only", action="store_true", help="without the whole builds")
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
            if not options.steps_only:
                rows = [one for name, path in there for one in builds(name, path, Path(scratch), options.workers)]
                head = ["scene", "way", "wall s", "speed-up", "processor s", "peak MiB", *STAGES]
                print(*table(head, rows, numbers=True), sep="\n", flush=True)
                print()
            rows = [one for name, path in there for one in steps(name, path, Path(scratch), options.workers)]
            head = ["scene", "way", "step", "tasks", "wall s", "longest process, processor s", "all processes"]
            head += ["dealing", "speed-up", "given kB/task", "back kB/task", "scene MB", "empty task ms", "start s"]
            print(*table(head, rows, numbers=True), sep="\n")


if __name__ == "__main__":
    main()
