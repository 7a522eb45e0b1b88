"""What is said of STEP files that are damaged, and of sound ones.

    python packages/cadlab/benchmarks/step_damage.py FOLDER [--copies 10]

Reads every STEP file below a folder, which are taken for sound; then damages the largest of them in each of several
ways, a few copies of each, and says for how many that was told.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from _timing import machine

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.step_damage import named_in
from cadlab.markdown import head, row

_FACE = re.compile(rb"(ADVANCED_FACE\s*\(\s*'[^']*'\s*,\s*\([^)]*\)\s*,\s*)#\d+")
_OUTCOMES = ("told", "refused", "stopped", "silent")
_PATIENCE = 60.0  # s; users have load.timeout, ten minutes by default
_SHARE = 0.2  # of the places of a kind that are spoilt


def main() -> None:
    """Prints both tables."""
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("folder", type=Path)
    asked.add_argument("--copies", type=int, default=10, help="of each way to damage a file")
    given = asked.parse_args()
    files = sorted(path for path in given.folder.rglob("*") if path.suffix.lower() in (".step", ".stp"))
    faces = told = refused = 0
    for file in files:
        faces += named_in(file.read_bytes()).faces
        said = _said(file)
        told += said[0] == "told"
        refused += said[0] == "refused"
    sys.stdout.write(f"{len(files)} sound files, {faces:,} faces: called damaged {told}, refused {refused}\n\n")
    largest = max(files, key=lambda file: file.stat().st_size)
    sys.stdout.write(
        "\n".join(
            head(
                (
                    "damage",
                    "copies",
                    "told",
                    "refused",
                    f"stopped after {_PATIENCE:.0f} s",
                    "silent",
                    "faces missing, in all",
                )
            )
        )
        + "\n"
    )
    for name, spoil in _WAYS.items():
        counts = dict.fromkeys(_OUTCOMES, 0)
        missing = 0
        for seed in range(given.copies):
            with tempfile.TemporaryDirectory() as place:
                copy = Path(place, f"copy{largest.suffix}")
                copy.write_bytes(spoil(largest.read_bytes(), random.Random(seed)))
                outcome, lost = _said(copy)
            counts[outcome] += 1
            missing += lost
        sys.stdout.write(f"{row((name, given.copies, *counts.values(), missing))}\n")
        sys.stdout.flush()
    sys.stdout.write(f"\n{machine()}.\n")


def _said(file: Path) -> tuple[str, int]:
    """What is said of a file: told (with how many faces are missing), refused, stopped, or silent."""
    try:
        scene = load(file, LoadConfig(timeout=_PATIENCE))
    except LoadError as error:
        return "stopped" if "took longer" in str(error) else "refused", 0
    notes = [note.message for note in scene.diagnostics if note.code == "damaged-source"]
    if not notes:
        return "silent", 0
    found = re.search(r"([\d,]+) of [\d,]+ faces are missing", notes[0])
    return "told", int(found[1].replace(",", "")) if found else 0


def _some(pattern: bytes, instead: bytes) -> Callable[[bytes, random.Random], bytes]:
    wanted = re.compile(pattern)

    def spoil(data: bytes, rng: random.Random) -> bytes:
        return wanted.sub(lambda found: found.expand(instead) if rng.random() < _SHARE else found[0], data)

    return spoil


def _cut(data: bytes, rng: random.Random) -> bytes:
    return data[: int(len(data) * rng.uniform(0.3, 0.95))]


def _digits(data: bytes, rng: random.Random) -> bytes:
    spoilt = bytearray(data)
    start = data.index(b"DATA;")
    places = [at for at in range(start, len(data)) if chr(data[at]).isdigit()]
    for at in rng.sample(places, 20):
        spoilt[at] = ord(str(rng.randrange(10)))
    return bytes(spoilt)


_WAYS: dict[str, Callable[[bytes, random.Random], bytes]] = {
    "faces on surfaces that aren't there": _some(_FACE.pattern, rb"\g<1>#99999999"),
    "faces without a surface": _some(_FACE.pattern, rb"\g<1>$"),
    "faces without bounds": _some(rb"(ADVANCED_FACE\s*\(\s*'[^']*'\s*,\s*)\([^)]*\)", rb"\g<1>()"),
    "faces that are gone": _some(rb"#\d+\s*=\s*ADVANCED_FACE[^;]*;", rb""),
    "loops that are gone": _some(rb"#\d+\s*=\s*EDGE_LOOP[^;]*;", rb""),
    "planes without a place": _some(rb"(PLANE\s*\(\s*'[^']*'\s*,\s*)#\d+", rb"\g<1>#99999999"),
    "radii below zero": _some(rb"(CYLINDRICAL_SURFACE\s*\(\s*'[^']*'\s*,\s*#\d+\s*,\s*)[\d.E+-]+", rb"\g<1>-5."),
    "words for numbers": _some(rb"(CARTESIAN_POINT\s*\(\s*'[^']*'\s*,\s*)\([^)]*\)", rb"\g<1>(1.,'x',3.)"),
    "20 other digits": _digits,
    "cut short": _cut,
}


if __name__ == "__main__":
    main()
