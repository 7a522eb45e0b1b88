"""Pictures per second: ``python benchmarks/render.py [--size WIDTHxHEIGHT] [--pairs] [--report PRESET]``.

Draws a generated plant of pipes, flanges, bolts and tanks, from a few hundred meshes up to millions of triangles, and
prints a table in Markdown with a description of the machine.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import platform
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.annotation import Mark, Segment, Tag, annotate
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.color import distinct_colors
from cadgraph.draw.render.pair import Pair, PairRenderer
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.draw.render.surroundings import Surroundings
from cadgraph.draw.render.views import Target, View, choose_views, three_quarter_view
from cadgraph.draw.report import write_report
from cadgraph.model.scene import Scene
from cadgraph.pipeline import build
from cadplants import make

Mesh = tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]


def turned(profile: list[tuple[float, float]], sides: int) -> Mesh:
    """A surface of revolution about Z through (radius, height) points."""
    angle = np.arange(sides) * 2 * np.pi / sides
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(sides, h)], axis=1) for r, h in profile]
    i = np.arange(sides)
    j = (i + 1) % sides
    faces = []
    for ring in range(len(profile) - 1):
        low, high = ring * sides, (ring + 1) * sides
        faces += [np.stack([low + i, low + j, high + j], axis=1), np.stack([low + i, high + j, high + i], axis=1)]
    return np.concatenate(rings), np.concatenate(faces)


def plant(lines: int, sides: int) -> Scene:
    """Parallel pipe lines on a rack, each with flanges and bolts, and a tank for every few lines."""
    meshes: list[Mesh] = []
    along = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])

    def add(mesh: Mesh, at: tuple[float, float, float], rotation: npt.NDArray[np.float64] | None = None) -> None:
        vertices, faces = mesh
        meshes.append((vertices @ (np.eye(3) if rotation is None else rotation.T) + np.array(at), faces))

    pipe = turned([(0, -1), (0.05, -1), (0.05, 1), (0, 1)], sides)
    flange = turned([(0.05, -0.01), (0.1, -0.01), (0.1, 0.01), (0.05, 0.01)], sides)
    bolt = turned([(0, -0.04), (0.008, -0.04), (0.008, 0.04), (0, 0.04)], 6)
    tank = turned([(0.8 * float(np.sin(t)), -1.2 * float(np.cos(t))) for t in np.linspace(0, np.pi, 48)], 96)
    across = max(1, int(np.sqrt(lines)))
    for line in range(lines):
        y, z = 0.4 * (line % across), 0.5 + 0.4 * (line // across)
        for piece in range(4):
            x = 2.05 * piece
            add(pipe, (x, y, z), along)
            for side in (-0.012, 0.012):
                add(flange, (x + 1.025 + side, y, z), along)
            for k in range(8):
                a = k * np.pi / 4
                add(bolt, (x + 1.025, y + 0.08 * float(np.cos(a)), z + 0.08 * float(np.sin(a))), along)
        if line % 8 == 0:
            add(tank, (-2.5, 0.4 * across * (line / lines), 1.2 + (line % 3)))
    return Scene.from_meshes(meshes)


def timed(act: Callable[[], object], repeats: int) -> str:
    """Median wall and processor time [s]: on a machine that others use, the first says little."""
    walls, works = [], []
    for _ in range(repeats):
        wall, work = time.perf_counter(), time.process_time()
        act()
        walls.append(time.perf_counter() - wall)
        works.append(time.process_time() - work)
    return f"{statistics.median(walls):.2f} / {statistics.median(works):.2f}"


def peak_memory() -> float:
    """Of this process so far [GB]; not known on Windows."""
    if sys.platform == "win32":
        return float("nan")
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak * (1 if sys.platform == "darwin" else 1024) / 1e9


def measure(lines: int, sides: int, size: tuple[int, int], repeats: int) -> str:
    scene = plant(lines, sides)
    renderer = Renderer(scene)
    built = timed(renderer.caster, 1)
    chosen = timed(lambda: three_quarter_view(renderer), 1)
    camera = frame(renderer.points(), three_quarter_view(renderer), size)
    paint = Paint(distinct_colors(scene.n_meshes))
    first = timed(lambda: renderer.picture(camera, paint), 1)
    full = timed(lambda: renderer.picture(camera, paint), repeats)
    three = timed(lambda: renderer.pictures(camera, [paint] * 3), repeats)
    plain = timed(lambda: renderer.picture(camera, paint, Look(sky_rays=0, floor=False)), repeats)
    square = frame(renderer.points(), -camera.forward, (512, 512))
    small = timed(lambda: renderer.picture(square, paint, Look(sky_rays=0, floor=False, samples=2)), repeats)
    image = renderer.picture(camera, paint)
    spots = [(float(x), float(x) / 3, 1.0) for x in range(8)]
    notes = timed(
        lambda: annotate(
            image,
            camera,
            segments=[Segment(a, b) for a, b in zip(spots[:-1], spots[1:], strict=True)],
            marks=[Mark(spot) for spot in spots],
            tags=[Tag(spot, f"V-{i:03d}") for i, spot in enumerate(spots)],
        ),
        repeats,
    )
    cells = [f"{scene.n_meshes:,}", f"{scene.n_triangles:,}"]
    return (
        "| "
        + " | ".join([*cells, built, chosen, first, full, three, plain, notes, small, f"{peak_memory():.2f}"])
        + " |"
    )


def spent(act: Callable[[], object]) -> str:
    """Wall and processor time of one run [s]."""
    wall, work = time.perf_counter(), time.process_time()
    act()
    return f"{time.perf_counter() - wall:.2f} / {time.process_time() - work:.2f}"


def measure_pairs(lines: int, sides: int, threads: int) -> str:
    """Views of 2,000 meshes, and 25 pairs of pictures as a vision-language model is shown them."""
    scene = plant(lines, sides)
    about = Surroundings(scene)
    chosen = np.linspace(0, scene.n_meshes - 1, 2000).round().astype(int).tolist()

    def views_of(mesh: int) -> list[tuple[int, View]]:
        cutout = about.cutout(mesh)
        return [(mesh, view) for view in choose_views(cutout, Target.of(cutout, 0))]

    def pair_of(look: tuple[int, View]) -> Pair:
        return PairRenderer(about.cutout(look[0])).pair(0, look[1].camera, look[1].hidden)

    with ThreadPoolExecutor(threads) as pool:
        looks: list[tuple[int, View]] = []
        chosen_in = spent(lambda: looks.extend(look for found in pool.map(views_of, chosen) for look in found))
        some = looks[:: len(looks) // 25][:25]

        def draw() -> None:
            for _ in pool.map(pair_of, some):
                pass

        draw()
        pairs = spent(draw)
        some *= 4
        sustained = spent(draw)

    cells = [f"{scene.n_meshes:,}", f"{scene.n_triangles:,}", chosen_in, pairs, sustained, beside(scene, some)]
    return "| " + " | ".join([*cells, f"{peak_memory():.2f}"]) + " |"


def measure_report(preset: str, repeats: int) -> str:
    """The report of a generated plant: all pictures and the page."""
    scene = make(preset).scene()
    graph = build(scene)
    with tempfile.TemporaryDirectory() as folder:
        write_report(scene, graph, folder)
        report = timed(lambda: write_report(scene, graph, folder), repeats)
    return f"| {preset} | {scene.n_meshes:,} | {scene.n_triangles:,} | {report} | {peak_memory():.2f} |"


def beside(scene: Scene, looks: list[tuple[int, View]]) -> str:
    """The same 50 pictures by pyvista, where it is installed and finds a driver that draws off screen."""
    try:
        pyvista: Any = importlib.import_module("pyvista")
    except ImportError:
        return "not here"
    plotter = pyvista.Plotter(off_screen=True, window_size=[512, 512])
    faces = np.concatenate([np.full((scene.n_triangles, 1), 3), scene.global_faces()], axis=1)
    plotter.add_mesh(pyvista.PolyData(scene.vertices, faces.reshape(-1)))
    plotter.enable_anti_aliasing("ssaa")

    def draw() -> None:
        for mesh, view in looks:
            # Cameras are relative to the lowest corner of their mesh.
            eye = view.camera.eye + scene.mesh(mesh)[0].min(axis=0)
            ahead = eye + view.camera.forward
            plotter.camera_position = [tuple(eye), tuple(ahead), tuple(view.camera.up)]
            plotter.screenshot(return_img=True)
            plotter.screenshot(return_img=True)

    draw()
    return spent(draw)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", default="1280x800", help="of the large pictures, WIDTHxHEIGHT")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--huge", action="store_true", help="also a scene of about 7 million triangles")
    parser.add_argument("--pairs", action="store_true", help="only the pictures for a vision-language model")
    parser.add_argument("--report", default="", metavar="PRESET", help="only the report of a generated plant")
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1, help="that draw pairs")
    options = parser.parse_args()
    width, height = (int(side) for side in options.size.split("x"))
    print(f"{platform.platform()}, {os.cpu_count()} processors, Python {platform.python_version()}")
    if options.report:
        print("\n| plant | meshes | triangles | report, wall / processor s | peak GB |\n|---|---:|---:|---:|---:|")
        print(measure_report(options.report, options.repeats))
        return
    print(f"\nWall / processor seconds, median of {options.repeats}; {width}x{height}, 3x3 samples, 3 sky rays.\n")
    titles = ["meshes", "triangles", "tree", "view", "first", "picture", "3 colourings", "no light", "notes"]
    titles.append("512x512 plain")
    print("| " + " | ".join([*titles, "peak GB"]) + " |")
    print("|" + "---:|" * (len(titles) + 1))
    for lines, sides in ((8, 24), (64, 24), (180, 48), *(((180, 540),) if options.huge else ())):
        if not options.pairs:
            print(measure(lines, sides, (width, height), options.repeats), flush=True)
            gc.collect()
    print("\nFor a vision-language model, wall / processor seconds, pictures of 512x512 with anti-aliasing:\n")
    titles = [
        "meshes",
        "triangles",
        "views of 2,000",
        "25 pairs",
        "100 pairs",
        "pyvista, 50 pictures",
    ]
    print("| " + " | ".join([*titles, "peak GB"]) + " |")
    print("|" + "---:|" * (len(titles) + 1))
    for lines, sides in ((180, 48), (190, 380)):
        print(measure_pairs(lines, sides, options.threads), flush=True)
        gc.collect()


if __name__ == "__main__":
    main()
