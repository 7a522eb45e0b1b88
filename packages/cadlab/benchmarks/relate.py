"""Functional relations on generated plants: ``python packages/cadlab/benchmarks/relate.py [--seeds 7] [--write]``.

Every preset by every modelling style, with its true labels, with those of the embedded labeler, and with a fifth of the
labels wrong at random. Algorithm 1 of the paper runs on the same labels, contacts and units. ``--write`` puts the table
into ``docs/functional.md``.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import Evaluation, evaluate
from cadlab.markdown import table
from cadplants import PRESETS, STYLES, Defects, Plant, make
from cadplants.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "functional.md"
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"
WRONG = 0.2
SINS = Defects(duplicates=0.02, hidden=0.02, flipped=0.1, soup=0.1, degenerate=0.1)
MODES = {"true": "true", "embedded": "embedded labeler", "wrong": "20 % wrong at random", "sins": "true, spoilt meshes"}


def labels_of(plant: Plant, mode: str, seed: int) -> list[GivenLabel]:
    """The labels that a plant is given; a wrong one is any other name of the vocabulary."""
    if mode == "embedded":
        return []
    names = [(group, name) for group, held in default_vocabulary().groups.items() for name in held.names]
    choose = random.Random(seed)
    given = []
    for path, part in zip(plant.paths(), plant.components, strict=True):
        group, name = part.group, part.name
        if mode == "wrong" and choose.random() < WRONG:
            group, name = choose.choice([other for other in names if other != (group, name)])
        given.append(GivenLabel(path, group, name))
    return given


def tapped_pairs(truth: Truth, evaluation: Evaluation) -> tuple[int, int]:
    """Gauges that follow each other directly, and how many of these pairs have all their neighbours right."""
    kinds = {unit.id: unit.type for unit in truth.units or ()}
    scores = evaluation.total.connected
    faults = (
        {tag for edge in (*scores.missing, *scores.extra) for tag in (edge.source, edge.target)} if scores else set()
    )
    pairs = [
        (one.source, one.target)
        for one in truth.connections or ()
        if kinds.get(one.source) == kinds.get(one.target) == "gauge"
    ]
    return len(pairs), sum(a not in faults and b not in faults for a, b in pairs)


@dataclass
class Sum:
    """What is counted over several plants."""

    edges: list[int] = field(default_factory=lambda: [0, 0, 0])
    paper: list[int] = field(default_factory=lambda: [0, 0, 0])
    ends: list[int] = field(default_factory=lambda: [0, 0, 0])
    taps: list[int] = field(default_factory=lambda: [0, 0])
    flow: list[int] = field(default_factory=lambda: [0, 0, 0])
    plants: int = 0

    def add(self, truth: Truth, evaluation: Evaluation) -> None:
        """Counts one more plant."""
        found, paper = evaluation.total.connected, evaluation.total.related
        if found is None or paper is None or found.direction is None or found.terminals is None:
            return
        for totals, score in ((self.edges, found.edges), (self.paper, paper.edges), (self.ends, found.terminals)):
            for k, count in enumerate((score.n_true, score.n_predicted, score.n_correct)):
                totals[k] += count
        for k, count in enumerate(tapped_pairs(truth, evaluation)):
            self.taps[k] += count
        direction = found.direction
        for k, count in enumerate((direction.n_known, direction.n_decided, direction.n_right)):
            self.flow[k] += count
        self.plants += 1

    def row(self, *heads: object) -> list[object]:
        """One line of the table."""
        known, decided, right = self.flow
        return [
            *heads, self.plants, self.edges[0], f1(self.edges), f1(self.paper),
            f"{self.taps[1]}/{self.taps[0]}", f1(self.ends),
            f"{decided}/{known}" if known else "", decided - right,
        ]  # fmt: skip


def f1(counts: list[int]) -> str:
    """F1 of true, predicted and correct ones."""
    return f"{2 * counts[2] / max(1, counts[0] + counts[1]):.3f}"


def cases(seeds: list[int], presets: list[str], styles: list[str], modes: list[str]) -> Iterator[tuple[str, str, Sum]]:
    """Each mode and style with its sums."""
    for mode in modes:
        for style in styles:
            total = Sum()
            for preset in presets:
                for seed in seeds:
                    plant = make(preset, seed, style, SINS if mode == "sins" else None)
                    graph = build(plant.scene(), labels=labels_of(plant, mode, seed))
                    truth = Truth.from_json(truth_of(plant))
                    total.add(truth, evaluate(graph, truth))
            yield mode, style, total


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    # Lines of an assortment are random: a check valve there may stand against the pump. The station is the demo, which
    # was chosen for being read well.
    usual = [name for name in sorted(PRESETS) if name not in ("assortment", "field", "station")]
    parser.add_argument("--presets", nargs="+", default=usual)
    parser.add_argument("--hands", nargs="+", default=list(STYLES))
    parser.add_argument("--modes", nargs="+", default=list(MODES))
    parser.add_argument("--write", action="store_true", help="put the table into docs/functional.md")
    options = parser.parse_args()
    heads = [
        "labels", "hand", "plants", "true edges", "F1 connected", "F1 Algorithm 1", "taps in order", "F1 open ends",
        "directions decided", "wrong",
    ]  # fmt: skip
    rows = []
    sums: dict[str, Sum] = {}
    for mode, style, found in cases(options.seeds, options.presets, options.styles, options.modes):
        rows.append(found.row(MODES[mode], style))
        whole = sums.setdefault(mode, Sum())
        for totals, more in (
            (whole.edges, found.edges), (whole.paper, found.paper), (whole.ends, found.ends),
            (whole.taps, found.taps), (whole.flow, found.flow),
        ):  # fmt: skip
            totals[:] = [a + b for a, b in zip(totals, more, strict=True)]
        whole.plants += found.plants
    rows = [whole.row(MODES[mode], "**all**") for mode, whole in sums.items()] + rows
    text = "\n".join(table(heads, rows, numbers=True))
    seeds = ", ".join(str(seed) for seed in options.seeds)
    text = f"Presets {', '.join(options.presets)}; seed {seeds}.\n\n{text}"
    print(text)
    if options.write:
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
        _, _, after = rest.partition(END)
        PAGE.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
