"""Contact search side by side: ours, coal, python-fcl, trimesh, KD-trees on samples, the paper's matrix.

    python packages/cadlab/benchmarks/contacts.py [--quick] [--million] > contacts.md

Every candidate runs in a process of its own, one after the other, so that its peak memory is its own. Times are CPU
seconds of the thread for what runs on one thread, since they stay meaningful on a machine that others use too, and
wall seconds for all threads; the median of the repetitions, kernels warm.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import scenes

from cadgraph.model.scene import Floats, Ints, Scene
from cadlab.markdown import head, row

EPS = 0.01
LIMIT = EPS + 1e-9

SCENES: dict[str, Callable[[float], Scene]] = {
    "plant": lambda scale: scenes.plant(scale),
    "plant, 10 tiles": lambda scale: scenes.plant(scale, tiles=10),
    "diagonal 16 m slivers": lambda scale: scenes.diagonal_tubes(max(50, round(2000 * scale))),
    "trusses of slivers": lambda scale: scenes.trusses(max(3, round(60 * scale))),
    "bolts over a plate": lambda scale: scenes.bolts_on_plate(max(100, round(5000 * scale)), round(1e5 * scale)),
    "concentric spheres": lambda scale: scenes.concentric_spheres(2, max(40, round(220 * scale**0.5))),
    "bin of bolts": lambda scale: scenes.bin_of_bolts(max(100, round(5000 * scale))),
    "plant at 2.4e7 m": lambda scale: scenes.far_away(scenes.plant(scale)),
    "small parts": lambda scale: scenes.small_parts(max(1000, round(1e6 * scale))),
}


def ours(scene: Scene, repeat: int, workers: int | None) -> dict[str, Any]:
    """Trees and contacts by this library."""
    from cadgraph.geometry.contact.pairs import find_contacts, touching
    from cadgraph.geometry.kernels.tree import build_forest

    warm_up = scenes.plant(0.01)
    find_contacts(warm_up, EPS, workers=workers)
    touching(warm_up, EPS, workers=workers)
    clock = time.thread_time if workers == 1 else time.perf_counter
    build, query, yes_no = [], [], []
    for _ in range(repeat):
        start = clock()
        forest = build_forest(scene, workers)
        build.append(clock() - start)
        start = clock()
        found = find_contacts(scene, EPS, forest=forest, workers=workers)
        query.append(clock() - start)
        start = clock()
        touching(scene, EPS, forest=forest, workers=workers)
        yes_no.append(clock() - start)
    tree_bytes = forest.nodes.nbytes + forest.faces.nbytes + forest.centers.nbytes + forest.axes.nbytes
    return {
        "build": float(np.median(build)),
        "query": float(np.median(query)),
        "yes_no": float(np.median(yes_no)),
        "tree": tree_bytes / max(scene.n_triangles, 1),
        "pairs": found.pairs.tolist(),
        "distance": found.distance.tolist(),
    }


def candidates(scene: Scene) -> Ints:
    """Pairs of meshes with near boxes: what every other candidate is given for free."""
    from cadgraph.geometry.contact.broad import near_boxes
    from cadgraph.geometry.kernels.tree import build_forest

    return near_boxes(build_forest(scene).boxes, LIMIT)


def coal(scene: Scene, repeat: int) -> dict[str, Any]:
    """coal's OBBRSS hierarchy on the candidate pairs, on one thread."""
    import coal as library

    pairs = candidates(scene)
    start = time.thread_time()
    models = []
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        model = library.BVHModelOBBRSS()
        model.beginModel(len(faces), len(vertices))
        model.addVertices(vertices)
        model.addTriangles(faces.astype(np.int64))
        model.endModel()
        models.append(model)
    build = time.thread_time() - start
    still, request = library.Transform3s.Identity(), library.DistanceRequest()
    start = time.thread_time()
    distance = [
        library.distance(models[i], still, models[j], still, request, library.DistanceResult())
        for i, j in pairs.tolist()
    ]
    return _near(pairs, np.array(distance), build, time.thread_time() - start)


def fcl(scene: Scene, repeat: int) -> dict[str, Any]:
    """python-fcl on the candidate pairs, on one thread."""
    import fcl as library

    pairs = candidates(scene)
    start = time.thread_time()
    bodies = []
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        model = library.BVHModel()
        model.beginModel(len(vertices), len(faces))
        model.addSubModel(vertices, faces.astype(np.int64))
        model.endModel()
        bodies.append(library.CollisionObject(model, library.Transform()))
    build = time.thread_time() - start
    request = library.DistanceRequest()
    start = time.thread_time()
    distance = [library.distance(bodies[i], bodies[j], request, library.DistanceResult()) for i, j in pairs.tolist()]
    return _near(pairs, np.array(distance), build, time.thread_time() - start)


def trimesh(scene: Scene, repeat: int) -> dict[str, Any]:
    """trimesh's collision manager (fcl below), one for each pair, on a sample of the pairs."""
    import trimesh as library

    pairs = candidates(scene)
    random = np.random.default_rng(0)
    some = pairs[np.sort(random.choice(len(pairs), min(100, len(pairs)), replace=False))]
    start = time.thread_time()
    distance = []
    for i, j in some.tolist():
        manager = library.collision.CollisionManager()
        for k in (i, j):
            manager.add_object(str(k), library.Trimesh(*scene.mesh(k), process=False))
        distance.append(manager.min_distance_internal())
    spent = time.thread_time() - start
    result = _near(some, np.array(distance), 0.0, spent * len(pairs) / len(some))
    result["sample"] = some.tolist()
    result["note"] = f"{len(some)} of {len(pairs):,} pairs, extrapolated"
    return result


def kd_trees(scene: Scene, repeat: int) -> dict[str, Any]:
    """KD-trees on surface samples every centimetre."""
    from scipy.spatial import cKDTree

    pairs = candidates(scene)
    start = time.thread_time()
    samples = [_samples(*scene.mesh(i)) for i in range(scene.n_meshes)]
    trees = [cKDTree(points, balanced_tree=False, compact_nodes=False) for points in samples]
    build = time.thread_time() - start
    start = time.thread_time()
    distance = []
    for i, j in pairs.tolist():
        few, many = (i, j) if len(samples[i]) <= len(samples[j]) else (j, i)
        low, high = samples[many].min(0) - 2 * EPS, samples[many].max(0) + 2 * EPS
        near = samples[few][((samples[few] >= low) & (samples[few] <= high)).all(axis=1)]
        found = trees[many].query(near, distance_upper_bound=2 * EPS)[0] if len(near) else np.array([np.inf])
        distance.append(float(found.min()))
    result = _near(pairs, np.array(distance), build, time.thread_time() - start)
    result["note"] = f"{sum(map(len, samples)):,} points"
    return result


def matrix(scene: Scene, repeat: int) -> dict[str, Any]:
    """The paper's full matrix of distances between points, extrapolated from one block."""
    from scipy.spatial.distance import cdist

    n = sum(len(_samples(*scene.mesh(i))) for i in range(scene.n_meshes))
    block = np.random.default_rng(0).uniform(size=(4000, 3))
    cdist(block[:100], block[:100])
    start = time.thread_time()
    cdist(block, block).min()
    spent = time.thread_time() - start
    return {
        "build": 0.0,
        "query": spent * (n / len(block)) ** 2 / 2,
        "pairs": None,
        "note": f"extrapolated from a block of {len(block):,} points to {n:,}; {8 * n * n / 2**40:,.1f} TiB if kept",
    }


def limits(scene: Scene, repeat: int) -> dict[str, Any]:
    """What the machine can do at best: reading all once, sorting one key for each triangle."""
    block = np.ones(1 << 25)
    block.sum()
    start = time.perf_counter()
    for _ in range(3):
        block.sum()
    bandwidth = 3 * block.nbytes / (time.perf_counter() - start)
    keys = np.random.default_rng(0).integers(0, 1 << 62, scene.n_triangles, np.uint64)
    start = time.perf_counter()
    keys.sort()
    sort = time.perf_counter() - start
    read = (scene.vertices.nbytes + scene.faces.nbytes) / bandwidth
    return {"bandwidth": bandwidth, "read": read, "sort": sort, "pairs": None}


def _near(pairs: Ints, distance: Floats, build: float, query: float) -> dict[str, Any]:
    near = distance <= LIMIT
    return {
        "build": build,
        "query": query,
        "pairs": pairs[near].tolist(),
        "distance": np.maximum(distance[near], 0).tolist(),
    }


def _samples(vertices: Floats, faces: Any) -> Floats:
    """Corners and a lattice of at most 1 cm on every face, each point once."""
    corners = vertices[faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    steps = np.maximum(np.ceil(longest / 0.01).astype(np.int64), 1)
    found = [vertices]
    for n in np.unique(steps[steps > 1]):
        i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
        keep = i + j <= n
        shares = np.column_stack([n - i[keep] - j[keep], i[keep], j[keep]]) / n
        # long slivers need no lattice across
        some = corners[steps == n]
        height = 2 * _areas(some).max() / (0.01 * n)
        if height < 0.01:
            shares = shares[(shares == 0).any(axis=1)]
        found.append(np.einsum("sk,fkd->fsd", shares, some).reshape(-1, 3))
    return np.unique(np.round(np.concatenate(found), 6), axis=0)


def _areas(corners: Floats) -> Floats:
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas: Floats = 0.5 * np.linalg.norm(normal, axis=1)
    return areas


METHODS: dict[str, Callable[[Scene, int], dict[str, Any]]] = {
    "ours, 1 thread": lambda scene, repeat: ours(scene, repeat, 1),
    "ours, all threads": lambda scene, repeat: ours(scene, repeat, None),
    "coal": coal,
    "python-fcl": fcl,
    "trimesh manager": trimesh,
    "KD-trees on 1 cm samples": kd_trees,
    "the paper's matrix": matrix,
    "limits": limits,
}


def run_one(method: str, scene_name: str, scale: float, repeat: int) -> None:
    """The work of a child process: prints its result as JSON."""
    scene = SCENES[scene_name](scale)
    result = METHODS[method](scene, repeat)
    result["meshes"], result["triangles"] = scene.n_meshes, scene.n_triangles
    result["scene"] = (scene.vertices.nbytes + scene.faces.nbytes) / 2**20
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    result["peak"] = peak / (2**20 if sys.platform == "darwin" else 2**10)
    print(json.dumps(result))


def measure(method: str, scene: str, scale: float, repeat: int) -> dict[str, Any] | None:
    """Runs one candidate in a process of its own; None if it fails or takes too long."""
    command = [sys.executable, str(Path(__file__)), "--one", method, scene, str(scale), str(repeat)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=3600, check=True)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
        print(f"<!-- {method} on {scene}: {type(error).__name__} -->", flush=True)
        return None
    result: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return result


def machine() -> str:
    """One line that describes the machine without naming it."""
    model = platform.processor() or platform.machine()
    cpu = Path("/proc/cpuinfo")
    if cpu.exists():
        names = [line.split(":")[1].strip() for line in cpu.read_text().splitlines() if line.startswith("model name")]
        model = names[0] if names else model
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    return f"{model}, {os.cpu_count()} processors{load}, {platform.system()}, Python {platform.python_version()}"


def wrong(result: dict[str, Any], truth: set[tuple[int, int]]) -> tuple[str, str]:
    """False and missed pairs against the exact ones, among those that a method looked at."""
    if result["pairs"] is None:
        return "", ""
    found = {tuple(pair) for pair in result["pairs"]}
    there = truth & {tuple(pair) for pair in result["sample"]} if "sample" in result else truth
    return str(len(found - truth)), str(len(there - found))


def side_by_side(scale: float, repeat: int) -> Iterator[str]:
    """The table of all candidates on the plant."""
    titles = (
        "candidate",
        "meshes",
        "triangles",
        "build s",
        "query s",
        "total s",
        "peak MiB",
        "false",
        "missed",
        "note",
    )
    yield from head(titles)
    results: dict[str, dict[str, Any]] = {}
    for method in METHODS:
        # what samples surfaces would drown in the plate and the long tubes of the whole scene
        part = scale if "sample" not in method and "matrix" not in method else min(scale, 0.02)
        result = measure(method, "plant", part, repeat)
        if result is None or method == "limits":
            results[method] = result or {}
            continue
        results[method] = result
        if part != scale:
            exact = measure("ours, all threads", "plant", part, 1) or {"pairs": []}
            truth = {tuple(pair) for pair in exact["pairs"]}
        else:
            truth = {tuple(pair) for pair in (results.get("coal") or results["ours, 1 thread"])["pairs"]}
        false, missed = wrong(result, truth)
        note = result.get("note", "")
        if "yes_no" in result:
            note = f"yes/no only: query {result['yes_no']:.3f} s; tree {result['tree']:.0f} bytes a triangle"
        build, query = result["build"], result["query"]
        times = f"{build:.3f}", f"{query:.3f}", f"{build + query:.3f}"
        counts = f"{result['meshes']:,}", f"{result['triangles']:,}"
        yield row((method, *counts, *times, f"{result['peak']:,.0f}", false, missed, note))
    yield ""
    mine, peer = results.get("ours, 1 thread"), results.get("coal")
    if mine and peer:
        ratio = (peer["build"] + peer["query"]) / (mine["build"] + mine["query"])
        apart = (
            np.abs(np.array(mine["distance"]) - np.array(peer["distance"])).max()
            if mine["pairs"] == peer["pairs"]
            else np.nan
        )
        yield (
            f"coal takes **{ratio:.1f} times** as long as ours on one thread; {len(mine['pairs']):,} pairs, the same: "
            f"{mine['pairs'] == peer['pairs']}; greatest difference of a distance {apart:.1e} m."
        )
        yield ""
    if results.get("limits"):
        limit = results["limits"]
        yield (
            f"Physical limit: reading the scene once {1e3 * limit['read']:.1f} ms "
            f"(at {limit['bandwidth'] / 1e9:.1f} GB/s), sorting one key a triangle {1e3 * limit['sort']:.0f} ms."
        )
    yield ""


def growth(scales: list[float], tiles: bool, repeat: int) -> Iterator[str]:
    """Time over size, and its exponent."""
    yield from head(("scene", "meshes", "triangles", "pairs", "total s (1 thread)", "ns a triangle", "peak MiB"))
    sizes, times = [], []
    for scale, name in [(s, "plant") for s in scales] + ([(scales[-1], "plant, 10 tiles")] if tiles else []):
        result = measure("ours, 1 thread", name, scale, repeat)
        if result is None:
            continue
        total = result["build"] + result["query"]
        sizes.append(result["triangles"])
        times.append(total)
        yield row(_cells(name, result, total))
    yield ""
    exponent = np.polyfit(np.log(sizes), np.log(times), 1)[0]
    yield f"Exponent: {exponent:.2f}"
    yield ""


def hostile(scale: float, repeat: int) -> Iterator[str]:
    """Scenes that broke other designs, against the plain one."""
    titles = ("scene", "meshes", "triangles", "pairs", "s, 1 thread", "ns a triangle", "MiB")
    yield from head((*titles, "to the plant", "same as coal"))
    plain = measure("ours, 1 thread", "plant", scale, repeat)
    if plain is None:
        return
    base = (plain["build"] + plain["query"]) / plain["triangles"]
    for name in list(SCENES)[2:8]:
        result = measure("ours, 1 thread", name, scale, repeat)
        peer = measure("coal", name, scale, 1)
        if result is None:
            continue
        total = result["build"] + result["query"]
        same = "" if peer is None else str(peer["pairs"] == result["pairs"])
        yield row((*_cells(name, result, total), f"{total / result['triangles'] / base:.1f}x", same))
    yield ""


def _cells(name: str, result: dict[str, Any], total: float) -> tuple[str, ...]:
    counts = f"{result['meshes']:,}", f"{result['triangles']:,}", f"{len(result['pairs']):,}"
    return name, *counts, f"{total:.3f}", f"{1e9 * total / result['triangles']:.0f}", f"{result['peak']:,.0f}"


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="scenes a tenth of the size")
    parser.add_argument("--scale", type=float, default=None, help="size of the scenes; 1 by default, 0.1 if quick")
    parser.add_argument("--million", action="store_true", help="also a million small parts (needs about 8 GiB)")
    parser.add_argument("--one", nargs=4, metavar=("METHOD", "SCENE", "SCALE", "REPEAT"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        method, scene, scale, repeat = arguments.one
        run_one(method, scene, float(scale), int(repeat))
        return
    scale = arguments.scale or (0.1 if arguments.quick else 1.0)
    repeat = 3
    print(f"# Contacts\n\n{machine()}\n", flush=True)
    sections = [
        ("Side by side", side_by_side(scale, repeat)),
        ("Growth", growth([scale * f for f in (0.1, 0.3, 1.0)], not arguments.quick, repeat)),
        ("Hostile scenes", hostile(scale, repeat)),
    ]
    for title, lines in sections:
        print(f"## {title}\n", flush=True)
        for line in lines:
            print(line, flush=True)
    if arguments.million:
        result = measure("ours, all threads", "small parts", 1.0, 1)
        if result:
            print("## A million small parts\n")
            print(row(_cells("small parts", result, result["build"] + result["query"])))
    print(f"\n{machine()}")


if __name__ == "__main__":
    main()
