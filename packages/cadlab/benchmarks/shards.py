"""A graph in shards against one whole file: size, time to write, to open and to ask for one part, and memory.

    python packages/cadlab/benchmarks/shards.py            # 10,000 and 100,000 parts
    python packages/cadlab/benchmarks/shards.py --million  # 1,000,000 as well: some minutes, 16 GB

The graphs are made up: boxes in a row, each touching the two beside it. Each question is asked in a process of its own.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from _timing import machine

from cadgraph._io.json_rows import json_rows
from cadgraph._io.shard_files import FOLDER
from cadgraph.model.shards import ABOVE, cut
from cadlab.markdown import head, row

_ASK = """
import json, re, sys, time
def peak():
    # Of this program alone; getrusage tells that of the process that started it as well.
    return int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1]) / (1 << 20)
from cadgraph.model.graph import SceneGraph
start = time.perf_counter()
graph = SceneGraph.load(sys.argv[1])
opened, n = time.perf_counter() - start, graph.count("part")
times = []
for k in range(20):
    start = time.perf_counter()
    part = graph.part(f"/World/Site/Line_{k * n // 20 // 100:05d}/Geo_{k * n // 20:07d}")
    graph.neighbors(part)
    times.append(time.perf_counter() - start)
light = peak()
start = time.perf_counter()
from cadgraph.query.summary import summarize
summarize(graph)
print(json.dumps([opened, sorted(times)[10], max(times), light, time.perf_counter() - start]))
"""


def main() -> None:
    """Prints the table."""
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--million", action="store_true", help="a million parts as well")
    sizes = [10_000, 100_000, *([1_000_000] if asked.parse_args().million else [])]
    titles = (
        *("parts", "written as", "size [MB]", "write [s]", "open [s]", "a part by its mesh, and its neighbours [ms]"),
        *("the longest [ms]", "peak memory until then [GB]", "summary [s]"),
    )
    sys.stdout.write("\n".join(head(titles)) + "\n")
    for n in sizes:
        with tempfile.TemporaryDirectory() as place:
            for way in ("one file", "shards"):
                folder = Path(place, way.replace(" ", "-"))
                folder.mkdir()
                seconds = _write(_document(n), folder, shards=way == "shards")
                size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6
                done = subprocess.run(
                    [sys.executable, "-c", _ASK, str(folder)], capture_output=True, text=True, check=True
                )
                opened, usual, longest, memory, summary = json.loads(done.stdout)
                cells = (
                    *(f"{n:,}", way, f"{size:,.0f}", f"{seconds:.1f}", f"{opened:.2f}", f"{1000 * usual:.1f}"),
                    *(f"{1000 * longest:.0f}", f"{memory:.2f}", f"{summary:.2f}"),
                )
                sys.stdout.write(f"{row(cells)}\n")
                sys.stdout.flush()
    sys.stdout.write(f"\n{machine()}. By default, kinds of more than {ABOVE:,} rows go into shards.\n")


def _write(document: dict[str, Any], folder: Path, shards: bool) -> float:
    start = time.perf_counter()
    parted = cut(document, above=1) if shards else None
    content = document
    if parted is not None:
        content, packed = parted
        (folder / FOLDER).mkdir()
        for name, some in packed:
            (folder / FOLDER / name).write_bytes(some)
    (folder / "graph.json").write_bytes(json_rows(content, ("nodes", "edges", "diagnostics")))
    return time.perf_counter() - start


def _document(n: int) -> dict[str, Any]:
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    label = {"group": "Pipe assembly", "name": "pipe", "confidence": 0.973211, "source": "geometry", "evidence": {}}
    parts = [
        {
            "layer": "part", "id": f"part-{i:05d}", "meshes": [f"/World/Site/Line_{i // 100:05d}/Geo_{i:07d}"],
            "label": label, "guesses": [], "centroid": [i * 0.1 + 0.05, 1.234567, 2.345678],
            "aabb": [[i * 0.1, 1.2, 2.3], [i * 0.1 + 0.1, 1.3, 2.4]],
            "obb": {"center": [i * 0.1 + 0.05, 1.25, 2.35], "axes": axes, "extents": [0.1, 0.1, 0.1]},
            "area": 0.06, "volume": 0.001, "n_triangles": 12, "shape": f"shape-{i % 2000:05d}", "ground": False,
            "inside": None,
        }
        for i in range(n)
    ]  # fmt: skip
    nodes = [{"layer": "site", "id": "site"}, {"layer": "cluster", "id": "cluster-0", "kind": None, "n_parts": n,
              "centroid": [0.0, 0.0, 0.0], "aabb": [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]}, *parts]  # fmt: skip
    edges: list[dict[str, Any]] = [{"kind": "contains", "source": "site", "target": "cluster-0"}]
    edges += [{"kind": "contains", "source": "cluster-0", "target": part["id"]} for part in parts]
    edges += [
        {"kind": "adjacent", "source": f"part-{i:05d}", "target": f"part-{i + 1:05d}", "distance": 0.0,
         "point": [i * 0.1 + 0.1, 1.25, 2.35]}
        for i in range(n - 1)
    ]  # fmt: skip
    source = {"path": "made-up.usdc", "n_meshes": n, "n_triangles": 12 * n}
    frame = {"format": "cadgraph", "version": 1, "directed": True, "multigraph": True, "graph": {}, "source": source}
    return {**frame, "vocabulary": {}, "config": {}, "nodes": nodes, "edges": edges, "diagnostics": []}


if __name__ == "__main__":
    main()
