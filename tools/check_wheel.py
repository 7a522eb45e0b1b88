"""Builds a wheel of the product alone, installs it into an empty environment, and runs the demo there; then the
generator of plants beside it, which makes a plant and proves it.

python tools/check_wheel.py

Wheels come from the package index that pip is set up with; without one the check says so and ends with code 3.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CONTENT = (
    "cadgraph/py.typed",
    "cadgraph/draw/report/page.html",
    "cadgraph/draw/web/page/index.html",
    "cadgraph/draw/web/page/viewer.css",
    "cadgraph/draw/web/page/viewer.js",
    "cadgraph/labelers/embedded/model.npz",
    "cadgraph/labelers/lvlm/templates/label.txt",
    "cadgraph/model/vocabulary.yaml",
    "cadgraph/session/demo_plant.usdc",
)
"""Files that the product reads at run time, one of each kind."""
UNITS = {"gauge": 7, "pump": 2, "tank": 2, "valve": 13}
"""What the demo must find."""
MISSING = "comes with the package cadplants: in the checkout of cadgraph, pip install ./packages/cadplants"
_UNREACHABLE = 3


class WheelError(Exception):
    """The wheel lacks something, or doesn't work where nothing else is installed."""


def index_is_reachable(folder: Path) -> bool:
    """Whether pip gets what a build needs, without asking twice."""
    asked = _pip("download", "--no-deps", "--retries", "0", "--timeout", "15", "--dest", str(folder), "hatchling")
    return _run(asked, folder).returncode == 0


def build_plants(folder: Path) -> Path:
    """Builds the wheel of the generator of plants into a folder.

    Raises:
        WheelError: it can't be built.
    """
    _must(_run(_pip("wheel", "--no-deps", "--wheel-dir", str(folder), str(ROOT / "packages" / "cadplants")), folder))
    (wheel,) = folder.glob("cadplants-*.whl")
    return wheel


def build_wheel(folder: Path) -> Path:
    """Builds the wheel of the product into a folder.

    Raises:
        WheelError: it can't be built, or lacks a file, or holds one of the other packages.
    """
    _must(_run(_pip("wheel", "--no-deps", "--wheel-dir", str(folder), str(ROOT)), folder))
    (wheel,) = folder.glob("cadgraph-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    missing = [name for name in CONTENT if name not in names]
    strange = sorted({name.split("/")[0] for name in names if not name.startswith("cadgraph")})
    if missing or strange:
        raise WheelError(f"{wheel.name}: lacks {missing}, holds {strange}")
    return wheel


def try_out(wheel: Path, folder: Path) -> None:
    """Installs a wheel with what it needs and no more into an environment of its own, and runs the demo there.

    Raises:
        WheelError: something in that doesn't end as it should.
    """
    environment = folder / "environment"
    _must(_run([sys.executable, "-m", "venv", str(environment)], folder))
    scripts = environment / ("Scripts" if os.name == "nt" else "bin")
    constraints = str(ROOT / "constraints.txt")
    _must(_run(_pip("install", "--constraint", constraints, str(wheel), python=scripts / "python"), folder))
    cadgraph = str(scripts / "cadgraph")
    _must(_run([cadgraph, "demo"], folder))
    graph = json.loads((folder / "demo" / "graph.json").read_text(encoding="utf-8"))
    types = [node["unit_type"] for node in graph["nodes"] if node.get("layer") == "unit"]
    found = {name: types.count(name) for name in sorted(set(types))}
    if found != UNITS:
        raise WheelError(f"the demo finds {found}, not {UNITS}")
    refused = _run([cadgraph, "environment", "make", "-o", "plant.usdc"], folder)
    if refused.returncode != 2 or MISSING not in refused.stderr or len(refused.stderr.splitlines()) != 1:
        raise WheelError(f"'cadgraph environment make' ended with {refused.returncode}: {refused.stderr}")


def try_out_plants(wheel: Path, folder: Path) -> None:
    """Installs the generator beside the product, where ``try_out`` has put it, and makes and checks a plant.

    Raises:
        WheelError: something in that doesn't end as it should.
    """
    scripts = folder / "environment" / ("Scripts" if os.name == "nt" else "bin")
    constraints = str(ROOT / "constraints.txt")
    _must(_run(_pip("install", "--constraint", constraints, str(wheel), python=scripts / "python"), folder))
    cadplants = str(scripts / "cadplants")
    _must(_run([cadplants, "make", "--preset", "tank", "-o", "tank.usdc"], folder))
    _must(_run([cadplants, "check", "tank.usdc"], folder))
    _must(_run([cadplants, "device", "gate valve/os&y", "--params", "tank.truth.json", "-o", "gate.usdc"], folder))


def main() -> int:
    """Runs the check; 0 where all is well, 1 where not, 3 where no package index can be reached."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if not index_is_reachable(folder):
            sys.stderr.write("no package index can be reached: nothing was checked\n")
            return _UNREACHABLE
        try:
            wheel = build_wheel(folder)
            size = wheel.stat().st_size
            try_out(wheel, folder)
            try_out_plants(build_plants(folder), folder)
        except WheelError as error:
            sys.stderr.write(f"{error}\n")
            return 1
    sys.stdout.write(f"{wheel.name}: {size / 1e6:.1f} MB; builds the demo with nothing else installed\n")
    return 0


def _pip(*arguments: str, python: str | Path = sys.executable) -> list[str]:
    return [str(python), "-m", "pip", "--disable-pip-version-check", "--quiet", *arguments]


def _run(command: Sequence[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs a command in a folder where nothing of this repository is on the path."""
    outside = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "COVERAGE"))}
    return subprocess.run(command, cwd=folder, env=outside, capture_output=True, text=True, check=False)


def _must(done: subprocess.CompletedProcess[str]) -> None:
    if done.returncode:
        raise WheelError(f"{' '.join(map(str, done.args))}\nended with {done.returncode}: {done.stderr.strip()}")


if __name__ == "__main__":
    sys.exit(main())
