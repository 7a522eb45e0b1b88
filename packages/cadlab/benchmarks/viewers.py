"""The page of ``cadgraph view`` beside other viewers: ``python packages/cadlab/benchmarks/viewers.py``.

The same plant is opened in a headless Chromium with software rendering (SwiftShader) by each of them: cadgraph, viser,
rerun, Online3DViewer and xeokit. What isn't installed is left out and named: ``pip install playwright viser
rerun-sdk``, ``npm ci --prefix web/bench``, and a Chromium of the system. Printed are the seconds to the first picture
(some pixel of the plant is there) and to the last (the picture has stopped changing), the frames per second while the
mouse turns the plant for some seconds, the time of a pick where the page can be asked for one, and the memory of all
processes of the browser and of the viewer's own server.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import http.server
import importlib.util
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from _timing import machine
from PIL import Image

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests"))

from browsing import MISSING, browsing, find_browser  # noqa: E402

BENCH = ROOT / "web" / "bench"
SIZE = (1280, 720)
MIDDLE = {"x": 390, "y": 130, "width": 500, "height": 400}  # px; where every viewer shows the plant
TURNING = 6.0  # s
PATIENCE = 180.0  # s
PICK_OURS = """(p) => { const start = performance.now(); const hit = cadgraph.view.pick(p.x, p.y);
  return { ms: performance.now() - start, hit: hit !== null }; }"""

# Counts the frames in which anything was drawn, whoever draws it.
COUNTER = """
(() => {
  let drawn = false; window.framesDrawn = 0;
  const note = (proto, names) => { for (const name of names) { const own = proto[name];
    if (own) proto[name] = function (...args) { drawn = true; return own.apply(this, args); }; } };
  const names = ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced", "drawRangeElements"];
  for (const kind of [window.WebGLRenderingContext, window.WebGL2RenderingContext])
    if (kind) note(kind.prototype, names);
  const get = WebGL2RenderingContext.prototype.getExtension;
  WebGL2RenderingContext.prototype.getExtension = function (name) { const found = get.call(this, name);
    if (found && /multi_draw/.test(name) && !found.noted) { found.noted = true;
      note(found, ["multiDrawElementsWEBGL", "multiDrawArraysWEBGL", "multiDrawElementsInstancedWEBGL"]); }
    return found; };
  const tick = () => { if (drawn) { window.framesDrawn++; drawn = false; } requestAnimationFrame(tick); };
  requestAnimationFrame(tick);
})();
"""


@dataclass(frozen=True)
class Open:
    """A viewer that waits to be looked at.

    Args:
        address: of its page.
        servers: processes of its own.
        prepare: what has to be done in the page before anything is drawn.
        pick: a script that picks at a point, or None.
    """

    address: str
    servers: tuple[int, ...] = ()
    prepare: Callable[[Any], None] | None = None
    pick: str | None = None


@contextlib.contextmanager
def cadgraph_view(work: Path) -> Iterator[Open]:
    process = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "view", str(work / "out"), "--no-browser", "--port", "0"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    try:
        address = next(found[0] for line in process.stdout if (found := re.search(r"http://127\S+", line)))
        # As the others, which have read their plant before they are looked at.
        next(line for line in process.stdout if line.startswith("ready"))
        threading.Thread(target=process.stdout.read, daemon=True).start()
        yield Open(
            address,
            (process.pid,),
            pick=PICK_OURS,
        )
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


@contextlib.contextmanager
def viser_view(work: Path) -> Iterator[Open]:
    port = _free_port()
    with _script("_serve_viser.py", work / "plant.glb", port) as process:
        yield Open(f"http://127.0.0.1:{port}", (process.pid,))


@contextlib.contextmanager
def rerun_view(work: Path) -> Iterator[Open]:
    port, data = _free_port(), _free_port()
    with _script("_serve_rerun.py", work / "plant.glb", port, data) as process:
        yield Open(f"http://127.0.0.1:{port}/?url=rerun%2Bhttp://127.0.0.1:{data}/proxy", (process.pid,))


@contextlib.contextmanager
def o3dv_view(work: Path) -> Iterator[Open]:
    page = '<div id="view" style="position:fixed;inset:0"></div>'
    with _static(work, "o3dv", page) as address:
        yield Open(address, pick="(p) => pickAt(p.x, p.y)")


@contextlib.contextmanager
def xeokit_view(work: Path) -> Iterator[Open]:
    if not (work / "plant.xkt").exists():
        convert = BENCH / "node_modules/@xeokit/xeokit-convert/convert2xkt.js"
        subprocess.run(
            ["node", str(convert), "-s", str(work / "plant.glb"), "-o", str(work / "plant.xkt")],
            check=True, capture_output=True,
        )  # fmt: skip
    page = '<canvas id="canvas" style="position:fixed;inset:0;width:100%;height:100%"></canvas>'
    with _static(work, "xeokit", page) as address:
        yield Open(address, pick="(p) => pickAt(p.x, p.y)")


def _has(module: str) -> str | None:
    return None if importlib.util.find_spec(module) else f"pip install {module.replace('rerun', 'rerun-sdk')}"


def _has_npm(package: str) -> str | None:
    return None if (BENCH / "node_modules" / package).is_dir() else "npm ci --prefix web/bench"


VIEWERS: dict[str, tuple[Callable[[Path], Any], Callable[[], str | None]]] = {
    "cadgraph view": (cadgraph_view, lambda: None),
    "viser": (viser_view, lambda: _has("viser")),
    "rerun": (rerun_view, lambda: _has("rerun")),
    "Online3DViewer": (o3dv_view, lambda: _has_npm("online-3d-viewer")),
    "xeokit": (xeokit_view, lambda: _has_npm("@xeokit/xeokit-sdk")),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", default="field", help="which generated plant")
    parser.add_argument("--only", action="append", choices=VIEWERS, help="only this viewer; may be repeated")
    parser.add_argument("--shots", type=Path, help="folder for a screenshot of each")
    given = parser.parse_args()
    if find_browser() is None:
        raise SystemExit(MISSING)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        make_plant(work, given.preset)
        print(f"{machine()}; Chromium, software rendering, {SIZE[0]} x {SIZE[1]}; plant: {given.preset}")
        print("| viewer | first picture [s] | last picture [s] | frames/s | pick [ms] | browser [MB] | server [MB] |")
        print("|---|---|---|---|---|---|---|")
        for name, (start, missing) in VIEWERS.items():
            if given.only and name not in given.only:
                continue
            lacking = missing()
            if lacking:
                print(f"| {name} | not installed: {lacking} | | | | | |")
                continue
            try:
                with start(work) as viewer:
                    print(
                        f"| {name} | {' | '.join(measure(viewer, given.shots and given.shots / f'{name}.png'))} |",
                        flush=True,
                    )
            except (subprocess.CalledProcessError, StopIteration) as error:
                print(f"| {name} | failed: {str(error)[:80]} | | | | | |")


def make_plant(work: Path, preset: str) -> None:
    """The plant as USD with its graph, and as GLB."""
    run = functools.partial(subprocess.run, check=True, capture_output=True)
    for suffix in ("usdc", "glb"):
        run(
            [
                sys.executable,
                "-m",
                "cadgraph",
                "environment",
                "make",
                "--preset",
                preset,
                "-o",
                str(work / f"plant.{suffix}"),
            ]
        )
    run([sys.executable, "-m", "cadgraph", "build", str(work / "plant.usdc"), "-o", str(work / "out"), "--no-report"])


def measure(viewer: Open, shot: Path | None) -> list[str]:
    """The columns of one viewer."""
    with browsing() as browser:
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.set_default_timeout(PATIENCE * 1000)
        page.add_init_script(COUNTER)
        start = time.perf_counter()
        page.goto(viewer.address, wait_until="commit")
        first, last = _pictures(page, start)
        if shot:
            shot.parent.mkdir(parents=True, exist_ok=True)
            page.screenshot(path=shot)
        frames = _turn(page)
        pick = _pick(page, viewer.pick)
        ours = _memory([p for p in _children(os.getpid()) if p not in _below(viewer.servers)])
        servers = _memory(_below(viewer.servers))
    return [
        _seconds(first),
        _seconds(last),
        frames,
        pick,
        f"{ours:.0f}",
        f"{servers:.0f}" if viewer.servers else "none",
    ]


def _pictures(page: Any, start: float) -> tuple[float | None, float | None]:
    """Seconds until something of the plant is there, and until the picture stays as it is."""
    from playwright.sync_api import Error

    first: float | None = None
    before: Any = None
    changed = start
    while time.perf_counter() - start < PATIENCE:
        try:
            shot = page.screenshot(clip=MIDDLE)
        except Error:
            # A page that computes for long answers nobody.
            time.sleep(0.5)
            continue
        now = np.asarray(Image.open(BytesIO(shot)).convert("L"), np.int16)
        at = time.perf_counter()
        if first is None and _shows_plant(now):
            first = at - start
        if before is None or np.mean(np.abs(now - before) > 6) > 0.0005:
            changed = at
        before = now
        if first is not None and at - changed > 6.0:
            return first, changed - start
        time.sleep(0.1)
    return first, None


def _shows_plant(picture: Any) -> bool:
    # A page that waits shows one colour and a few words.
    backdrop = np.bincount(picture.ravel(), minlength=256).argmax()
    return bool(np.mean(np.abs(picture - backdrop) > 12) > 0.04)


def _turn(page: Any) -> str:
    x, y = SIZE[0] / 2, SIZE[1] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    before, start = page.evaluate("framesDrawn"), time.perf_counter()
    k = 0
    while time.perf_counter() - start < TURNING:
        k += 1
        page.mouse.move(x + 120 * np.sin(k / 15), y + 20 * np.sin(k / 40))
    drawn, spent = page.evaluate("framesDrawn") - before, time.perf_counter() - start
    page.mouse.up()
    return f"{drawn / spent:.1f}"


def _pick(page: Any, script: str | None) -> str:
    if script is None:
        return "by mouse only"
    points = [{"x": SIZE[0] / 2 + dx, "y": SIZE[1] / 2 + dy} for dx in (-90, -30, 0, 40, 80) for dy in (-40, 0, 40)]
    found = [page.evaluate(script, point) for point in points]
    return f"{np.median([one['ms'] for one in found]):.1f}"


def _seconds(value: float | None) -> str:
    return f"over {PATIENCE:.0f}" if value is None else f"{value:.1f}"


def _children(process: int) -> list[int]:
    """All processes below one (Linux)."""
    parents: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError, ValueError, IndexError):
                parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
                parents.setdefault(parent, []).append(int(entry.name))
    found, front = [], [process]
    while front:
        below = parents.get(front.pop(), [])
        found += below
        front += below
    return found


def _below(processes: tuple[int, ...]) -> list[int]:
    return [p for root in processes for p in (root, *_children(root))]


def _memory(processes: list[int]) -> float:
    """Megabytes that only these processes hold, what they share divided among them (Linux)."""
    total = 0.0
    for process in processes:
        with contextlib.suppress(OSError):
            found = re.search(r"^Pss:\s+(\d+)", Path(f"/proc/{process}/smaps_rollup").read_text(), re.M)
            total += int(found[1]) / 1000 if found else 0.0
    return total


def _free_port() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])


@contextlib.contextmanager
def _script(name: str, *arguments: object) -> Iterator[subprocess.Popen[str]]:
    words = [sys.executable, str(Path(__file__).with_name(name)), *map(str, arguments)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        next(line for line in process.stdout if line.startswith("ready"))
        yield process
    finally:
        process.kill()
        process.wait()


@contextlib.contextmanager
def _static(work: Path, name: str, body: str) -> Iterator[str]:
    """A server of the folder with one page that runs a bundled script."""
    esbuild = BENCH / "node_modules/.bin/esbuild"
    options = ["--bundle", "--format=esm", "--external:path", "--external:fs", "--log-level=error"]
    words = [str(esbuild), str(BENCH / f"{name}.js"), f"--outfile={work / name}.js", *options]
    subprocess.run(words, check=True, capture_output=True)
    script = f'<script type="module" src="{name}.js"></script>'
    (work / f"{name}.html").write_text(
        f'<!doctype html><meta charset="utf-8"><body style="margin:0">{body}{script}</body>'
    )

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, format: str, *args: Any) -> None:
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(work)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}/{name}.html"
    finally:
        server.shutdown()


if __name__ == "__main__":
    main()
