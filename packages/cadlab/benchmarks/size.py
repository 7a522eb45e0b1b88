"""Time and memory of whole builds over the number of meshes: ``python packages/cadlab/benchmarks/size.py``.

Every scene is built by the command line in a process of its own, and the time of each stage is taken from the file
that the build writes. Scenes are lines of pipes, flanges, elbows and supports (instances of few shapes; ``--points``
writes them as point instancers) of 1,000, 10,000 and 100,000 meshes, with ``--million`` of a million; the generated
plant ``field`` (``--field``), the same in triangles two and a half times as many (``--fine``), and 1,000 teapots of
which no two are alike (``--teapots``); any other file by ``--scene``. Under the table stands the exponent of each
stage's time over the meshes of the lines: 1 is proportional, 2 is quadratic.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from _size_scenes import write_lines, write_teapots
from _timing import machine

from cadlab.markdown import table

_COUNTS = """
import sys
from cadgraph.model.graph import SceneGraph
source = SceneGraph.load(sys.argv[1]).source
print(source.n_meshes, source.n_triangles)
"""
_FINE = """
import sys
from dataclasses import replace
from cadplants.presets.field import make_field
from cadplants.styles.modeling_style import STYLES
from cadplants.writers import write_plant
write_plant(make_field(0, replace(STYLES["plant-design"], sag=0.000015, sides=(44, 176))), sys.argv[1])
"""
_SHORT = 0.05  # stages that take less in every scene have no exponent [s]


@dataclass(frozen=True)
class Built:
    """One build.

    Args:
        name: of the scene.
        meshes: in the graph.
        triangles: of them.
        wall: of the process from start to end [s].
        spent: of the processor, its children included [s]; NaN where the system doesn't tell.
        peak: most memory that one of the processes held [MiB]; NaN where the system doesn't tell.
        stages: wall time of each stage [s].
    """

    name: str
    meshes: int
    triangles: int
    wall: float
    spent: float
    peak: float
    stages: dict[str, float]


def measured(command: list[str]) -> tuple[float, float, float]:
    """Wall and processor seconds of a command, and the most memory that one of its processes held [MiB].

    Raises:
        SystemExit: it ended with an error.
    """
    clock = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    spent = peak = float("nan")
    if sys.platform == "win32":
        code = child.wait()
    else:
        _, status, used = os.wait4(child.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        child.returncode = code
        spent = used.ru_utime + used.ru_stime
        peak = used.ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    if code:
        raise SystemExit(f"{' '.join(command)} ended with {code}")
    return time.perf_counter() - clock, spent, peak


def built(name: str, scene: Path, folder: Path, report: bool) -> Built:
    """Builds one scene in a process of its own."""
    out = folder / f"out_{name}"
    command = [sys.executable, "-m", "cadgraph", "build", str(scene), "-o", str(out)]
    wall, spent, peak = measured([*command, "--report" if report else "--no-report"])
    stages = json.loads((out / "timings.json").read_text(encoding="utf-8"))
    # Not here: what this process once held would count as the peak of the next one that it starts.
    counts = subprocess.run([sys.executable, "-c", _COUNTS, str(out)], check=True, capture_output=True, text=True)
    meshes, triangles = map(int, counts.stdout.split())
    return Built(name, meshes, triangles, wall, spent, peak, stages)


def exponents(runs: list[Built]) -> list[float]:
    """Of wall time and of each stage over the number of meshes, by least squares of the logarithms."""
    size = np.log([run.meshes for run in runs])
    columns = [[run.wall for run in runs], *([run.stages.get(s, 0.0) for run in runs] for s in stages_of(runs))]
    return [
        float(np.polyfit(size, np.log(np.maximum(seconds, 1e-3)), 1)[0]) if max(seconds) > _SHORT else float("nan")
        for seconds in columns
    ]


def stages_of(runs: list[Built]) -> list[str]:
    """All stages in their order."""
    return list(dict.fromkeys(stage for run in runs for stage in run.stages))


def cell(value: float) -> str:
    """A number with as many digits as are of use."""
    return "–" if np.isnan(value) else f"{value:.0f}" if value >= 100 else f"{value:.2f}"


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lines", type=int, nargs="*", default=[1_000, 10_000, 100_000], help="sizes of the scenes")
    parser.add_argument("--million", action="store_true", help="also a million meshes, as point instances")
    parser.add_argument("--points", action="store_true", help="write the lines as point instancers")
    parser.add_argument("--field", action="store_true", help="also the generated plant")
    parser.add_argument("--fine", action="store_true", help="also that plant in fine triangles")
    parser.add_argument("--teapots", type=int, nargs="?", const=1000, default=0)
    parser.add_argument("--scene", type=Path, nargs="+", default=[], help="also these files")
    parser.add_argument("--no-report", action="store_true")
    parser.add_argument("--keep", type=Path, help="a folder that keeps scenes and results")
    options = parser.parse_args()
    print(machine(), flush=True)
    with tempfile.TemporaryDirectory() as away:
        folder = options.keep or Path(away)
        folder.mkdir(parents=True, exist_ok=True)
        runs = [built(name, path, folder, not options.no_report) for name, path in scenes(options, folder)]
    stages = stages_of(runs)
    head = ["scene", "meshes", "triangles", "wall s", "processor s", "peak MiB", *stages]
    rows: list[list[object]] = []
    for run in runs:
        figures = [cell(run.wall), cell(run.spent), cell(run.peak), *(cell(run.stages.get(s, np.nan)) for s in stages)]
        rows.append([run.name, f"{run.meshes:,}", f"{run.triangles:,}", *figures])
    in_lines = [run for run in runs if run.name.startswith("lines")]
    if len(in_lines) > 1:
        total, *each = (cell(value) for value in exponents(in_lines))
        by_stage = dict(zip(stages_of(in_lines), each, strict=True))
        rows.append(["exponent", "", "", total, "", "", *(by_stage.get(stage, "–") for stage in stages)])
    print(*table(head, rows, numbers=True), sep="\n")


def scenes(options: argparse.Namespace, folder: Path) -> list[tuple[str, Path]]:
    """Name and file of each scene; those that are not there yet are written."""
    found = []
    sizes = [*options.lines, *([1_000_000] if options.million else [])]
    for n in sizes:
        points = options.points or n >= 1_000_000
        path = folder / f"lines_{n}{'_points' if points else ''}.usdc"
        if not path.exists():
            write_lines(path, n, points)
        found.append((f"lines_{n}", path))
    if options.field:
        path = folder / "field.usdc"
        if not path.exists():
            making = [sys.executable, "-m", "cadgraph", "environment", "make", "--preset", "field", "-o", str(path)]
            subprocess.run(making, check=True, stdout=subprocess.DEVNULL)
        found.append(("field", path))
    if options.fine:
        path = folder / "fine.usdc"
        if not path.exists():
            subprocess.run([sys.executable, "-c", _FINE, str(path)], check=True, stdout=subprocess.DEVNULL)
        found.append(("fine", path))
    if options.teapots:
        path = folder / f"teapots_{options.teapots}.usdc"
        if not path.exists():
            write_teapots(path, options.teapots)
        found.append((f"teapots_{options.teapots}", path))
    return [*found, *((path.stem, path) for path in options.scene)]


if __name__ == "__main__":
    main()
