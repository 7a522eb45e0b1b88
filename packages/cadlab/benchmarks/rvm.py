"""How the RVM reader copes with size and with damage.

    python packages/cadlab/benchmarks/rvm.py [MODEL.rvm] [--primitives N] [--copies N] [--job size|damage]

Size: the bodies of a model, repeated in a grid until there are so many primitives, are read in a process of its own;
its time and its peak memory are printed with the parts of the reading. Damage: copies of the model that are cut, have
40 random bytes or 64 zeros somewhere; how reading each of them ends, and how long the worst one takes. Anything but a
scene or a LoadError of one line is a defect. Without a model a small one is made up.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import platform
import resource
import struct
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.packing import Notes
from cadgraph.load.rvm.chunks import find_chunks, map_words
from cadlab.markdown import head, row

Bytes = npt.NDArray[np.uint8]

SPACING = 300.0  # [m] between the copies of a model
IN_PROCESS = LoadConfig(isolate=False)


def chunk(tag: str, payload: bytes, at: int) -> bytes:
    """One chunk that begins at a byte of the file."""
    return struct.pack(">6I", *tag.encode("ascii"), at + 24 + len(payload), 1) + payload


def text(value: str) -> bytes:
    raw = value.encode()
    n = len(raw) // 4 + 1
    return struct.pack(">I", n) + raw.ljust(4 * n, b"\0")


def made_up(path: Path, branches: int = 20) -> None:
    """Branches of tubes, elbows, flanges and valves."""
    rng = np.random.default_rng(7)
    data = bytearray()

    def add(tag: str, *payload: bytes) -> None:
        data.extend(chunk(tag, b"".join(payload), len(data)))

    def primitive(kind: int, *sizes: float) -> None:
        place = [1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, *rng.uniform(0, 50, 3)]
        add("PRIM", struct.pack(">2I", 1, kind), np.array([*place, *[0] * 6, *sizes], ">f4").tobytes())

    def node(name: str, fill: Callable[[], None]) -> None:
        add("CNTB", struct.pack(">I", 2), text(name), struct.pack(">3fI", 0, 0, 0, 1))
        fill()
        add("CNTE", struct.pack(">I", 2))

    def valve() -> None:
        primitive(8, 60, 200)
        primitive(7, 40, 60, 80, 0, 0, 0, 0, 0, 0)
        primitive(2, 100, 100, 40)

    def branch(number: int) -> None:
        for i in range(8):
            primitive(8, 57.15, float(rng.integers(200, 4000)))
            node(f"ELBOW {i + 1} of BRANCH /B{number}", lambda: primitive(4, 152, 57.15, np.pi / 2))
            node(f"VALVE {i + 1} of BRANCH /B{number}", valve)

    add("HEAD", struct.pack(">I", 2), *map(text, ("made up", "", "", "", "Unicode UTF-8")))
    add("MODL", struct.pack(">I", 1), text("P"), text("/P"))
    for number in range(branches):
        node(f"/B{number}", lambda number=number: branch(number))  # type: ignore[misc]
    add("END:", struct.pack(">I", 1))
    path.write_bytes(bytes(data))


def repeat(model: Path, target: Path, primitives: int) -> int:
    """Writes a model many times over into one file, copies in a grid; returns how many primitives that are."""
    words = np.array(map_words(model))
    chunks = find_chunks(words, model, Notes())
    start, tags = chunks.start - 6, [chunks.of(tag) for tag in ("CNTB", "END:", "PRIM")]
    first, last = start[tags[0][0]], start[tags[1][0]]
    body = words[first:last]
    inner = start[(start >= first) & (start < last)] - first
    places = start[tags[2]] - first + 6 + 2 + 9
    n = -(-primitives // len(places))
    across = int(np.ceil(np.sqrt(n)))
    shift_of = body[places[:, None] + np.arange(2)].view(">f4").astype(np.float32)
    with target.open("wb") as file:
        file.write(words[:first].tobytes())
        for i in range(n):
            copy = body.copy()
            copy[inner + 4] = (body[inner + 4].astype(np.int64) + 4 * i * len(body)).astype(np.uint32)
            moved = shift_of + np.array([i % across, i // across], np.float32) * np.float32(SPACING)
            copy[places[:, None] + np.arange(2)] = moved.astype(">f4").view(">u4")
            file.write(copy.tobytes())
        at = file.tell()
        file.write(chunk("END:", struct.pack(">I", 1), at))
    return n * len(places)


def child(path: Path, metadata: str) -> None:
    """Reads a file and prints its times and peak memory as JSON."""
    packing = importlib.import_module("cadgraph.load.packing")
    read = importlib.import_module("cadgraph.load.rvm").read

    inner = packing.pack_placed
    spent: dict[str, float] = {}
    begun = clock = 0.0

    def timed_pack(*args: object, **kwargs: object) -> object:
        spent["before"] = time.process_time() - begun
        spent["peak before"] = peak()
        spent["shapes"] = len(args[0])  # type: ignore[arg-type]
        return inner(*args, **kwargs)

    setattr(packing, "pack_placed", timed_pack)  # noqa: B010
    config = LoadConfig(isolate=False, metadata=metadata)  # type: ignore[arg-type]
    read_once(read, config)
    begun, clock = time.process_time(), time.perf_counter()
    scene = read(path, config)
    found = {
        "meshes": scene.n_meshes,
        "triangles": scene.n_triangles,
        "facts": len(scene.facts),
        "cpu": time.process_time() - begun,
        "wall": time.perf_counter() - clock,
        "peak": peak(),
        "notes": sorted({note.code for note in scene.diagnostics}),
    }
    print(json.dumps(spent | found))


def read_once(read: Callable[..., object], config: LoadConfig) -> None:
    """Compiles and imports what there is."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "small.rvm"
        made_up(path, 1)
        read(path, config)


def peak() -> float:
    """Most memory so far [GB]; Linux counts it in kilobytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


def size(model: Path, primitives: int) -> None:
    columns = ["metadata", "file MB", "meshes", "shapes", "triangles", "facts", "CPU s", "of it before packing"]
    print(*head([*columns, "wall s", "peak GB", "before packing"], numbers=True), sep="\n")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.rvm"
        n = repeat(model, path, primitives)
        noted: set[str] = set()
        for metadata in ("off", "keep"):
            command = [sys.executable, __file__, "--child", str(path), "--metadata", metadata]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode:
                print(row([metadata, f"ended with {done.returncode}: {done.stderr.strip()[-200:]}"]))
                continue
            got = json.loads(done.stdout)
            noted |= set(got["notes"])
            cells = [metadata, f"{path.stat().st_size / 1e6:.0f}"]
            cells += [f"{got[name]:,}" for name in ("meshes", "shapes", "triangles", "facts")]
            cells += [f"{got[name]:.1f}" for name in ("cpu", "before", "wall", "peak", "peak before")]
            print(row(cells), flush=True)
    print(f"\n{n:,} primitives; notes: {', '.join(sorted(noted)) or 'none'}")


def damaged(data: Bytes, number: int) -> Bytes:
    """Copy ``number``: cut, with 40 random bytes, or with 64 zeros."""
    rng = np.random.default_rng(number)
    copy = data.copy()
    at = int(rng.integers(64, len(data) - 64))
    if number % 3 == 0:
        return copy[:at]
    if number % 3 == 1:
        copy[rng.integers(0, len(data), 40)] = rng.integers(0, 256, 40)
    else:
        copy[at : at + 64] = 0
    return copy


def outcome(path: Path) -> str:
    try:
        scene = load(path, IN_PROCESS)
    except LoadError as error:
        return "LoadError" if "\n" not in str(error) else "DEFECT: an error of several lines"
    except (ArithmeticError, LookupError, TypeError, ValueError, AttributeError, RuntimeError, OSError) as error:
        return f"DEFECT: {type(error).__name__}: {error}"[:150]
    if not np.isfinite(scene.vertices).all():
        return "DEFECT: a point is not finite"
    usual = {"flat-primitive", "left-out-lines", "left-out-type", "encoding-guessed"}
    return "scene with a note" if {note.code for note in scene.diagnostics} - usual else "scene"


def damage(model: Path, copies: int) -> None:
    data = np.fromfile(model, np.uint8)
    ends: dict[str, Counter[str]] = {}
    worst = (0.0, -1)
    kinds = ("cut", "40 random bytes", "64 zeros")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.rvm"
        for number in range(copies):
            damaged(data, number).tofile(path)
            clock = time.perf_counter()
            end = outcome(path)
            worst = max(worst, (time.perf_counter() - clock, number))
            ends.setdefault(end, Counter())[kinds[number % 3]] += 1
    print(*head(["ends in", *kinds], numbers=True), sep="\n")
    for end, counts in sorted(ends.items()):
        print(row([end, *(str(counts[kind]) for kind in kinds)]))
    print(f"\nThe worst takes {worst[0]:.2f} s (copy {worst[1]}).")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("model", nargs="?", type=Path)
    parser.add_argument("--primitives", type=int, default=1_000_000)
    parser.add_argument("--copies", type=int, default=300)
    parser.add_argument("--job", choices=("size", "damage"), help="only this one")
    parser.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--metadata", default="keep", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        child(options.child, options.metadata)
        return
    print(
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}, "
        f"numpy {np.__version__}\n"
    )
    with tempfile.TemporaryDirectory() as folder:
        model = options.model
        if model is None:
            model = Path(folder) / "made_up.rvm"
            made_up(model)
        if options.job != "damage":
            size(model, options.primitives)
            print()
        if options.job != "size":
            damage(model, options.copies)


if __name__ == "__main__":
    main()
