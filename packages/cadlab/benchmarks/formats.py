"""One plant through every format: ``python packages/cadlab/benchmarks/formats.py [--presets station] [--write]``.

A generated plant is written as each system would export it, read, and its graph compared with the truth: by geometry
alone, and with what the file says of its parts (``--use-metadata``), of which in RVM and IFC a tenth is wrong and a
tenth missing. Names in the other formats say nothing. ``--write`` puts the table into ``docs/formats.md``.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from _timing import machine

from cadgraph.config import Config
from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import StructureScores, evaluate
from cadlab.markdown import put, table
from cadplants import make
from cadplants.writers import write_plant
from cadplants.writers.matching import truth_for
from cadplants.writers.metadata import Metadata
from cadplants.writers.plant_file import FileStyle

PAGE = Path(__file__).parents[3] / "docs" / "formats.md"
SPOILT = FileStyle(metadata=Metadata(wrong_classes=0.1, missing_names=0.1))
FILES: tuple[tuple[str, str, FileStyle | None], ...] = (
    ("USD", "plant.usdc", None),
    ("STEP", "plant.step", None),
    ("RVM + .att", "plant.rvm", SPOILT),
    ("IFC", "plant.ifc", SPOILT),
    ("GLB, a node for each part", "nodes.glb", None),
    ("GLB, a mesh for each material", "merged.glb", FileStyle(layout="merged")),
    ("OBJ", "plant.obj", None),
    ("STL, one bag", "plant.stl", None),
)
KNOWN: dict[str, dict[str, str]] = {
    ".obj": {"load.unit": "mm", "load.up": "Y"},
    ".stl": {"load.unit": "mm", "load.up": "Z"},
}
TITLES = (
    "format", "meshes", "read [s]", "group", "name", "connected F1", "with metadata: group", "name", "connected F1",
)  # fmt: skip


def rows(preset: str, seed: int, folder: Path) -> Iterator[tuple[str, ...]]:
    """The table's row of each format."""
    plant = make(preset, seed)
    for title, name, style in FILES:
        truth = Truth.load(write_plant(plant, folder / name, style))
        # Files without a unit are read as a user would who knows it.
        config = Config().replace(KNOWN.get(Path(name).suffix, {}))
        start = time.perf_counter()
        scene = load(folder / name, config.load)
        seconds = time.perf_counter() - start
        fitting = truth if style is None and name.endswith(".usdc") else truth_for(scene, truth)
        told = config.replace({"label.use_metadata": True, "relate.use_metadata": True})
        plain, with_metadata = (evaluate(build(scene, each), fitting).total for each in (config, told))
        yield title, f"{scene.n_meshes:,}", f"{seconds:.1f}", *scored(plain), *scored(with_metadata)


def scored(scores: StructureScores) -> tuple[str, str, str]:
    """Groups and names of meshes right, and F1 of connections."""
    f1 = scores.connected.edges.f1 if scores.connected else None
    return percent(scores.meshes.group.accuracy), percent(scores.meshes.name.accuracy), number(f1)


def percent(share: float | None) -> str:
    return "-" if share is None else f"{100 * share:.1f} %"


def number(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--presets", nargs="+", default=["station"])
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--write", action="store_true", help=f"put the table into {PAGE.name}")
    options = parser.parse_args()
    print(machine())
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for preset in options.presets:
            print(f"{preset}, seed {options.seed}", flush=True)
            found = list(rows(preset, options.seed, Path(folder)))
            print("\n".join(table(TITLES, found, numbers=True)), flush=True)
    if options.write:
        PAGE.write_text(put(PAGE.read_text("utf-8"), "formats", "\n".join(table(TITLES, found, numbers=True))), "utf-8")


if __name__ == "__main__":
    main()
