"""Functional relations on generated plants: ``python packages/cadlab/benchmarks/relate.py [--seeds 7] [--write]``.

Every preset by every modelling style and every defect of drawing, with its true labels, with those of the embedded
labeler, with the same without its threshold, and with a fifth of the labels wrong at random. Algorithm 1 of the paper
runs on the same labels, contacts and units. A few cases take seconds:

    relate.py --presets skid --styles plant-design --modes true --defects gaps setback

``--defects`` alone takes each defect; ``all`` is the plant that has them together. ``--edges`` lists the wrong edges by
cause. ``--write`` puts tables of the ways of labelling, the styles and the defects into ``docs/functional.md``;
``--cases`` prints a row for every case as well.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import product
from pathlib import Path

from cadgraph.config import Config
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import Evaluation, evaluate
from cadlab.evaluate.relations import EdgeVerdict, RelationScores
from cadlab.markdown import put, table
from cadplants import PRESETS, STYLES, Defects, Plant, make
from cadplants.faults.defects import DEFECTS
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "functional.md"
WRONG = 0.2
ALL_DEFECTS = {
    "none": Defects(),
    "spoilt": Defects(duplicates=0.02, hidden=0.02, flipped=0.1, soup=0.1, degenerate=0.1),
    **DEFECTS,
}
MODES = {
    "true": "true",
    "embedded": "embedded labeler",
    "open": "embedded labeler, no threshold",
    "wrong": "20 % wrong at random",
}
Case = tuple[str, str, str]
"""A way of labelling, a defect, a style."""
UNTHRESHOLDED = Config().replace({"label.min_confidence": 0.0})


def labels_of(plant: Plant, mode: str, seed: int) -> list[GivenLabel]:
    """The labels that a plant is given; a wrong one is any other name of the vocabulary, insulation has none."""
    if mode in ("embedded", "open"):
        return []
    names = [(group, name) for group, held in default_vocabulary().groups.items() for name in held.names]
    choose = random.Random(seed)
    given = []
    for path, part in zip(plant.paths(), plant.components, strict=True):
        group, name = part.group, part.name
        if not group:
            continue
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
    wrong: list[tuple[str, str]] = field(default_factory=list)

    def add(self, name: str, truth: Truth, evaluation: Evaluation) -> None:
        """Counts one more plant of this name."""
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
        self.wrong += [(cause, f"{name}: {edge}") for cause, edge in wrong_edges(found)]
        self.plants += 1

    def __iadd__(self, other: Sum) -> Sum:
        for totals, more in (
            (self.edges, other.edges), (self.paper, other.paper), (self.ends, other.ends),
            (self.taps, other.taps), (self.flow, other.flow),
        ):  # fmt: skip
            totals[:] = [a + b for a, b in zip(totals, more, strict=True)]
        self.plants += other.plants
        self.wrong += other.wrong
        return self

    def row(self, *heads: object) -> list[object]:
        """One line of the table."""
        known, decided, right = self.flow
        return [
            *heads, self.plants, self.edges[0], precision(self.edges),
            f"{self.edges[2] / max(1, self.edges[0]):.3f}", f1(self.edges), f1(self.paper),
            f"{self.taps[1]}/{self.taps[0]}", f1(self.ends),
            f"{decided}/{known}" if known else "", decided - right,
        ]  # fmt: skip


def precision(counts: list[int]) -> str:
    """The share of the predicted ones that are correct."""
    return f"{counts[2] / max(1, counts[1]):.3f}"


def f1(counts: list[int]) -> str:
    """F1 of true, predicted and correct ones."""
    return f"{2 * counts[2] / max(1, counts[0] + counts[1]):.3f}"


HEADS = [
    "plants", "true edges", "precision", "recall", "F1 connected", "F1 Algorithm 1", "taps in order", "F1 ends",
    "directions decided", "wrong",
]  # fmt: skip


def wrong_edges(found: RelationScores) -> Iterator[tuple[str, str]]:
    """The cause and the ends of each edge that only the truth or only the graph has."""
    for edge in found.missing:
        yield cause_of(edge, "missing"), ends_of(edge)
    for edge in found.extra:
        yield cause_of(edge, "extra"), ends_of(edge)


def cause_of(edge: EdgeVerdict, fault: str) -> str:
    """Whether a unit is at fault, or a way that was lost or is too many."""
    if fault == "missing":
        return "missing: a way is cut" if edge.matched else "missing: a unit was not found"
    return "extra: a way leads past a unit or along nothing" if edge.matched else "extra: a unit that is none"


def ends_of(edge: EdgeVerdict) -> str:
    """The true tags of an edge, with those of the graph where there are any."""
    told = []
    for true, predicted in ((edge.source, edge.found_source), (edge.target, edge.found_target)):
        told.append(f"{true or 'nothing'} ({predicted or 'not found'})")
    return " - ".join(told)


@lru_cache(maxsize=8)
def drawn(preset: str, seed: int, style: str, defect: str) -> tuple[Plant, Scene, Truth]:
    """A plant with its scene and truth, the same for each way of labelling it."""
    plant = make(preset, seed, style, ALL_DEFECTS[defect])
    return plant, plant.scene(), Truth.from_json(truth_of(plant))


def case(presets: Sequence[str], seeds: Sequence[int], style: str, defect: str, mode: str) -> Sum:
    """The sums over some plants, drawn in one style with one defect."""
    total = Sum()
    for preset, seed in product(presets, seeds):
        plant, scene, truth = drawn(preset, seed, style, defect)
        config = UNTHRESHOLDED if mode == "open" else None
        graph = build(scene, config, labels=labels_of(plant, mode, seed))
        total.add(f"{preset} {seed} {style} {defect} {mode}", truth, evaluate(graph, truth))
    return total


def told(sums: dict[Case, Sum]) -> list[str]:
    """A table of the ways of labelling with all that is counted, then F1 of each style and of each defect."""
    lines = table(["labels", *HEADS], [found.row(MODES[mode]) for mode, found in summed(sums, 0).items()], True)
    for k, name in ((2, "style"), (1, "defect")):
        if len({key[k] for key in sums}) > 1:
            lines += ["", *compared(sums, k, name)]
    return lines


def compared(sums: dict[Case, Sum], k: int, name: str) -> list[str]:
    """F1 and precision of each style or defect, with a column for each way of labelling."""
    modes = list(dict.fromkeys(mode for mode, _, _ in sums))
    heads = [name, *(f"F1 (precision), {MODES[mode]}" for mode in modes), f"F1 Algorithm 1, {MODES[modes[0]]}"]
    whole = {mode: summed({key: found for key, found in sums.items() if key[0] == mode}, k) for mode in modes}
    rows = []
    for value, first in whole[modes[0]].items():
        edges = [whole[mode][value].edges for mode in modes]
        rows.append([value, *(f"{f1(one)} ({precision(one)})" for one in edges), f1(first.paper)])
    return table(heads, rows, True)


def cases(sums: dict[Case, Sum]) -> list[str]:
    """A table with a row for every case."""
    rows = [found.row(MODES[mode], defect, style) for (mode, defect, style), found in sums.items()]
    return table(["labels", "defect", "style", *HEADS], rows, True)


def summed(sums: dict[Case, Sum], k: int) -> dict[str, Sum]:
    """The sums over all cases with the same way of labelling (0), defect (1) or style (2)."""
    whole: dict[str, Sum] = {}
    for key, found in sums.items():
        total = whole.setdefault(key[k], Sum())
        total += found
    return whole


def causes(sums: dict[Case, Sum], edges: bool) -> list[str]:
    """How many edges are wrong for which cause; with ``edges`` each of them."""
    wrong = [one for found in sums.values() for one in found.wrong]
    lines = []
    for cause, count in Counter(cause for cause, _ in wrong).most_common():
        lines.append(f"- {count} {cause}")
        lines += [f"  - {edge}" for other, edge in wrong if other == cause] if edges else []
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    # Lines of an assortment are random: a check valve there may stand against the pump. The station is the demo, which
    # was chosen for being read well.
    usual = [name for name in sorted(PRESETS) if name not in ("assortment", "field", "station")]
    parser.add_argument("--presets", nargs="+", default=usual, choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=list(STYLES), choices=list(STYLES))
    parser.add_argument("--modes", nargs="+", default=list(MODES), choices=list(MODES))
    parser.add_argument(
        "--defects",
        nargs="*",
        default=["none", "spoilt"],
        choices=list(ALL_DEFECTS),
        help="every one where none is named",
    )
    parser.add_argument("--edges", action="store_true", help="list each wrong edge")
    parser.add_argument("--cases", action="store_true", help="print a row for every case as well")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/functional.md")
    options = parser.parse_args()
    unknown = set(options.defects) - set(ALL_DEFECTS)
    if unknown:
        parser.error(f"unknown defects {', '.join(sorted(unknown))}; there are {', '.join(ALL_DEFECTS)}")
    chosen = product(options.defects or ALL_DEFECTS, options.styles, options.modes)
    sums = {
        (mode, defect, style): case(options.presets, options.seeds, style, defect, mode)
        for defect, style, mode in chosen
    }
    seeds = ", ".join(str(seed) for seed in options.seeds)
    head = f"Presets {', '.join(options.presets)}; styles {', '.join(options.styles)}; seed {seeds}."

    def text(edges: bool) -> str:
        return "\n".join([head, "", *told(sums), "", "Wrong edges by cause:", "", *causes(sums, edges)])

    print(text(options.edges))
    if options.cases:
        print("\n".join(["", *cases(sums)]))
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "figures", text(edges=False)), encoding="utf-8")


if __name__ == "__main__":
    main()
