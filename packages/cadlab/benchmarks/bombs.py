"""Small files that grow: ``python packages/cadlab/benchmarks/bombs.py [NAME...] [--write]``.

Each file is made in a folder of its own and given to the command that reads it. All must end with a graph or one line
within ten seconds and one gigabyte, both processes together. Prints a table in Markdown: the bomb, its size, the
seconds, the CPU time, the greatest memory, the exit code and what was said; ends with 1 where a bomb took more, or
ended with a traceback. ``--write`` puts the table into ``docs/reliability.md``. Memory is only known on Linux.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from _bomb_files import BOMBS, plain_scene

from cadgraph._io.limits import size_text
from cadlab.markdown import head, put, row

PAGE = Path(__file__).parents[3] / "docs" / "reliability.md"
TITLES = ("bomb", "size", "seconds", "CPU [s]", "memory [MB]", "exit", "said")
SECONDS, BYTES = 10.0, 1_000_000_000
GIVE_UP = 120.0  # seconds
STEP = 0.02  # seconds from one look at the memory to the next


def family(process: int) -> Iterator[int]:
    """A process and all below it."""
    yield process
    with suppress(OSError, ValueError):
        for thread in os.listdir(f"/proc/{process}/task"):
            text = Path(f"/proc/{process}/task/{thread}/children").read_text(encoding="ascii")
            for child in map(int, text.split()):
                yield from family(child)


def memory_of(process: int) -> int:
    """Bytes that a process and all below it hold in memory."""
    total = 0
    for each in family(process):
        with suppress(OSError, ValueError, IndexError, AttributeError):
            pages = int(Path(f"/proc/{each}/statm").read_text(encoding="ascii").split()[1])
            total += pages * os.sysconf("SC_PAGE_SIZE")
    return total


def cpu_seconds() -> float:
    """CPU time of all processes that were started here and ended; 0 where the system doesn't tell."""
    times = os.times()
    return times.children_user + times.children_system


def run(arguments: list[str], scratch: Path) -> tuple[float, float, int, int, str]:
    """Seconds, CPU seconds, greatest memory [bytes], exit code and output of a command of cadgraph."""
    begin, before = time.perf_counter(), cpu_seconds()
    with (scratch / "said.txt").open("wb") as said:
        process = subprocess.Popen([sys.executable, "-m", "cadgraph", *arguments], stdout=said, stderr=said)
        late = threading.Timer(GIVE_UP, process.kill)
        late.start()
        peak = 0
        while process.poll() is None:
            peak = max(peak, memory_of(process.pid))
            time.sleep(STEP)
        late.cancel()
    seconds = time.perf_counter() - begin
    said_text = (scratch / "said.txt").read_text(encoding="utf-8", errors="replace")
    return seconds, cpu_seconds() - before, peak, process.returncode, said_text


def try_bomb(name: str, built: Path) -> tuple[tuple[object, ...], bool]:
    """The cells of the row of a bomb, and whether it ended as it must."""
    make, command = BOMBS[name]
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        bomb = make(scratch)
        paths = {"bomb": bomb, "out": scratch / "out", "plain": plain_scene(scratch), "built": built}
        size = sum(path.stat().st_size for path in scratch.rglob("*") if path.is_file() and path.name != "plain.usda")
        seconds, cpu, peak, code, text = run([part.format(**paths) for part in command], scratch)
        said = " ".join(text.replace(f"{scratch}{os.sep}", "").split())
    # What is left out with a note is no error; what else the machine does is not the bomb's doing.
    busy = min(seconds, cpu or seconds)
    fine = code in (0, 2) and busy <= SECONDS and peak <= BYTES and "Traceback" not in said
    return (name, size_text(size), f"{seconds:.1f}", f"{cpu:.1f}", f"{peak / 1e6:.0f}", code, said[:240]), fine


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help=f"of {', '.join(BOMBS)}; all by default")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    lines, wrong = head(TITLES), []
    print(*lines, sep="\n")
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder) / "built"
        # Kernels are compiled at the first run, which is none of the bombs' doing.
        run(["build", str(plain_scene(Path(folder))), "-o", str(built), "--no-report"], Path(folder))
        for name in options.names or BOMBS:
            cells, fine = try_bomb(name, built)
            lines.append(row(cells))
            print(lines[-1], flush=True)
            if not fine:
                wrong.append(name)
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "bombs", "\n".join(lines)), encoding="utf-8")
    if wrong:
        print(f"not stopped within {SECONDS:g} s and {BYTES / 1e9:g} GB: {', '.join(wrong)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
