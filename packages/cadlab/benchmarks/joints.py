"""How sure joints are against how often they are right: ``python packages/cadlab/benchmarks/joints.py [--write]``.

Plants of every modelling style and defect with their true labels. A joint is right where the plant was made so that its
two parts meet; of those that were not made the score should be low where they don't. ``--write`` puts the table into
``docs/functional.md``.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

import numpy as np

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.pipeline import build
from cadlab.markdown import put, table
from cadplants import PRESETS, STYLES, Plant, make
from cadplants.faults.defects import DEFECTS

PAGE = Path(__file__).parents[3] / "docs" / "functional.md"
BINS = (0.0, 0.1, 0.5, 0.7, 0.9, 0.97, 0.99, 1.0 + 1e-9)


def verdicts(plant: Plant, graph: SceneGraph) -> Iterator[tuple[bool, float, bool]]:
    """Of each joint whether it was made, its score, and whether its parts meet in truth."""
    number = {path: k for k, path in enumerate(plant.paths())}
    meant = {frozenset(pair) for pair in plant.contacts}
    for joint in graph.joints():
        first, second = ([number[mesh] for mesh in graph.part(part).meshes] for part in (joint.first, joint.second))
        right = any(frozenset((a, b)) in meant for a in first for b in second)
        yield joint.made, joint.score, right


def measure(
    presets: Sequence[str], seeds: Sequence[int], styles: Sequence[str], defects: Sequence[str]
) -> list[tuple[bool, float, bool]]:
    """The verdicts of all joints of some plants, true labels given."""
    found: list[tuple[bool, float, bool]] = []
    for preset, seed, style, defect in product(presets, seeds, styles, defects):
        plant = make(preset, seed, style, DEFECTS[defect])
        named = zip(plant.paths(), plant.components, strict=True)
        labels = [GivenLabel(path, part.group, part.name) for path, part in named if part.group]
        found += verdicts(plant, build(plant.scene(), labels=labels))
    return found


def rows(found: Sequence[tuple[bool, float, bool]]) -> list[list[object]]:
    """One row for each bin of scores: how many joints, their mean score and the share that is right."""
    lines: list[list[object]] = []
    for made in (True, False):
        scores = np.array([score for here, score, _ in found if here == made])
        right = np.array([right for here, _, right in found if here == made])
        for low, high in zip(BINS, BINS[1:], strict=False):
            inside = (scores >= low) & (scores < high)
            if inside.any():
                share = f"{right[inside].mean():.3f}"
                told = f"{low:.2f}-{min(high, 1.0):.2f}"
                lines.append(
                    ["made" if made else "not made", told, int(inside.sum()), f"{scores[inside].mean():.3f}", share]
                )
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    usual = [name for name in sorted(PRESETS) if name not in ("assortment", "field", "station")]
    parser.add_argument("--presets", nargs="+", default=usual, choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=["plant-design", "bim"], choices=list(STYLES))
    parser.add_argument("--defects", nargs="+", default=list(DEFECTS), choices=list(DEFECTS))
    parser.add_argument("--write", action="store_true", help="put the table into docs/functional.md")
    options = parser.parse_args()
    found = measure(options.presets, options.seeds, options.styles, options.defects)
    heads = ["joint", "score", "joints", "mean score", "meet in truth"]
    seeds = ", ".join(str(seed) for seed in options.seeds)
    head = f"Presets {', '.join(options.presets)}; styles {', '.join(options.styles)}; seed {seeds}."
    drawn = f"Drawn with {', '.join(options.defects)}."
    text = "\n".join([head, drawn, "", *table(heads, rows(found), True)])
    print(text)
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "joints", text), encoding="utf-8")


if __name__ == "__main__":
    main()
