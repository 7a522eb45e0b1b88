"""The page that ships in the package is what its sources give, byte for byte."""

import shutil
import subprocess
from pathlib import Path

import pytest

import cadgraph

ROOT = Path(__file__).parents[3]
SHIPPED = Path(cadgraph.__file__).parent / "draw" / "web" / "page"


def test_the_shipped_page_is_what_the_sources_give(tmp_path):
    node = shutil.which("node")
    if node is None:
        pytest.skip("needs Node 20 or newer: https://nodejs.org")
    if not (ROOT / "web" / "node_modules").is_dir():
        pytest.skip("needs what the page is built with: make web-tools")
    done = subprocess.run([node, ROOT / "web" / "build.mjs", tmp_path], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    built = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    shipped = {path.name: path.read_bytes() for path in SHIPPED.iterdir()}
    assert built.keys() == shipped.keys()
    old = [name for name in built if built[name] != shipped[name]]
    assert old == [], "make web builds them anew"
