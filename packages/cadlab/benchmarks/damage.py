"""What becomes of damaged files: ``python benchmarks/damage.py FILE... [--copies N] [--seed N] [--limit SECONDS]``.

Of each file some copies are damaged in turn: cut short at a random place, 40 bytes made random, 64 bytes in a row made
zero. Each copy must end in a scene or in a ``LoadError`` of one line. Copies are read without isolation, in batches by
a process each, so that a crash or an endless reading is found and told and costs the one copy only; STEP is read as by
default, in a process of its own for each, since its library is known to crash. Files without a unit are millimetres.

Prints a table in Markdown: how many copies ended in a scene that says nothing, in one with a note, in an error of one
line, or in anything else, and the longest reading. Ends with 1 where any copy ended in anything else.
"""

from __future__ import annotations

import argparse
import json
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from cadlab.markdown import head, row

OUTCOMES = ("scene", "scene with a note", "error")
TITLES = ("file", "copies", *OUTCOMES, "anything else", "longest [s]")
CRASHING = (".step", ".stp", ".iges", ".igs")  # their library dies of damage, so that it must run by itself
UNITLESS = (".obj", ".stl", ".ply")
BESIDE = (".mtl",)  # what a file names is there, whole
MARK = "outcome: "
BATCH = 25
RANDOM_BYTES, ZEROS = 40, 64


def damaged(data: bytes, number: int, chance: random.Random) -> bytes:
    """One copy of a file, damaged in one of three ways."""
    copy = bytearray(data)
    if number % 3 == 0:
        return bytes(copy[: chance.randrange(1, len(copy))])
    if number % 3 == 1:
        for _ in range(RANDOM_BYTES):
            copy[chance.randrange(len(copy))] = chance.randrange(256)
        return bytes(copy)
    start = chance.randrange(len(copy))
    length = min(ZEROS, len(copy) - start)
    copy[start : start + length] = bytes(length)
    return bytes(copy)


def read_all(paths: Sequence[str]) -> None:
    """Reads files one after the other; a line of JSON for each: how it ended, seconds, what was said."""
    from cadgraph.config import LoadConfig
    from cadgraph.errors import LoadError
    from cadgraph.load import load

    for path in paths:
        begin = time.perf_counter()
        said = ""
        try:
            suffix = Path(path).suffix
            config = LoadConfig(isolate=suffix in CRASHING, unit="mm" if suffix in UNITLESS else None)
            outcome = OUTCOMES[1] if load(path, config).diagnostics else OUTCOMES[0]
        except LoadError as error:
            said = str(error)
            outcome = OUTCOMES[2] if "\n" not in said else "an error of several lines"
        except Exception as error:  # noqa: BLE001 - whatever else comes is what is looked for
            outcome, said = f"{type(error).__name__}", " ".join(str(error).split())[:200]
        # Libraries in C++ write to the same stream, now and then without a line end.
        print(f"\n{MARK}{json.dumps([outcome, time.perf_counter() - begin, said])}", flush=True)


def outcomes_of(paths: Sequence[str], limit: float) -> list[tuple[str, float, str]]:
    """How reading each ended; a process that dies or takes too long costs one file, the rest is read by a new one."""
    found: list[tuple[str, float, str]] = []
    while len(found) < len(paths):
        rest = paths[len(found) :][:BATCH]
        command = [sys.executable, __file__, "--read", *rest]
        try:
            done = subprocess.run(command, capture_output=True, timeout=limit * len(rest), check=False)
            told, ending = done.stdout, f"process ended with {done.returncode}"
        except subprocess.TimeoutExpired as late:
            told, ending = late.stdout or b"", f"longer than {limit:g} s"
        text = told.decode("utf-8", "replace")
        lines = [line.removeprefix(MARK) for line in text.splitlines() if line.startswith(MARK)]
        for line in lines[: len(rest)]:
            outcome, seconds, said = json.loads(line)
            found.append((outcome if seconds <= limit else f"longer than {limit:g} s", seconds, said))
        if len(lines) < len(rest):
            found.append((ending, limit, ""))
    return found


def try_copies(file: Path, copies: int, seed: int = 0, limit: float = 30.0) -> tuple[tuple[object, ...], list[str]]:
    """Reads damaged copies of a file; the cells of its row under ``TITLES``, and a line on each defect.

    Args:
        file: whole.
        copies: how many.
        seed: of the damage.
        limit: seconds that reading one copy may take.
    """
    data, chance = file.read_bytes(), random.Random(f"{seed} {file.name}")
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for number in range(copies):
            path = Path(folder) / f"copy_{number}{file.suffix}"
            path.write_bytes(damaged(data, number, chance))
            for suffix in BESIDE:
                if file.with_suffix(suffix).is_file():
                    shutil.copy(file.with_suffix(suffix), folder)
            paths.append(str(path))
        found = outcomes_of(paths, limit)
    counts = [sum(outcome == known for outcome, _, _ in found) for known in OUTCOMES]
    other = [
        f"{file.name}: copy {number}: {outcome} {said}"
        for number, (outcome, _, said) in enumerate(found)
        if outcome not in OUTCOMES
    ]
    longest = max(seconds for _, seconds, _ in found)
    return (file.name, len(found), *counts, len(other), f"{longest:.2f}"), other


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--copies", type=int, default=300, help="of each file")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--limit", type=float, default=30.0, help="seconds that reading one copy may take")
    parser.add_argument("--read", nargs="+", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.read:
        read_all(options.read)
        return 0
    print(*head(TITLES, numbers=True), sep="\n")
    wrong: list[str] = []
    for file in options.files:
        cells, other = try_copies(file, options.copies, options.seed, options.limit)
        wrong += other
        print(row(cells), flush=True)
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
