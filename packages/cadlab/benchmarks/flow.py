"""Flow directions and kinds of valves on generated plants: ``python packages/cadlab/benchmarks/flow.py [--seeds 7]``.

For every modelling style, with true labels and with those of the embedded labeler: how many of the directions that are
certain are found and how many of these are wrong, and how many kinds of valves are stated and how many of these are
right. Valves in one mesh, and a plant that has all defects of drawing:

    flow.py --defects one all --styles plant-design bim

``--reasons`` lists what fixes the directions that are not found. ``--write`` puts a table of each way of labelling and
each way of drawing, over all styles, into ``docs/flow.md``.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

from _timing import machine

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import Evaluation, evaluate
from cadlab.markdown import put, table
from cadplants import PRESETS, STYLES, Defects, Plant, make
from cadplants.faults.defects import DEFECTS
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "flow.md"
LABELS = {"true": "true", "embedded": "embedded labeler"}
HEADS = [
    "labels", "drawn", "style", "meshes", "directions certain", "found", "share", "wrong", "said of others", "valves",
    "kinds stated", "right", "precision", "recall", "among two guesses",
]  # fmt: skip


@dataclass
class Sum:
    """What is counted over several plants.

    Args:
        meshes: of the plants.
        known: directions that the truth knows, of edges that are found.
        found: of which the graph says one.
        right: of which both agree.
        beyond: directions that the truth leaves open.
        valves: that are found.
        stated: of which the graph says a kind.
        named: of which it is the right one.
        guessed: left open, with the right kind among the guesses.
        missed: what fixes directions that were not found.
    """

    meshes: int = 0
    known: int = 0
    found: int = 0
    right: int = 0
    beyond: int = 0
    valves: int = 0
    stated: int = 0
    named: int = 0
    guessed: int = 0
    missed: Counter[str] = field(default_factory=Counter)

    def add(self, plant: Plant, graph: SceneGraph, truth: Truth, evaluation: Evaluation) -> None:
        """Counts one more plant."""
        self.meshes += plant.n_meshes
        relations = evaluation.total.connected
        if relations is not None and relations.direction is not None:
            direction = relations.direction
            self.known += direction.n_known
            self.found += direction.n_decided
            self.right += direction.n_right
            self.beyond += direction.n_invented
            self.missed.update({one.reason: one.n_known - one.n_decided for one in relations.reasons})
        for kind, unit in matched_valves(graph, truth):
            self.valves += 1
            self.stated += unit.kind is not None
            self.named += unit.kind == kind
            self.guessed += unit.kind is None and kind in [guess for guess, _ in unit.kind_guesses]

    def __iadd__(self, other: Sum) -> Sum:
        for name in ("meshes", "known", "found", "right", "beyond", "valves", "stated", "named", "guessed"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        self.missed.update(other.missed)
        return self

    def row(self, *heads: object) -> list[object]:
        """One line of the table."""
        return [
            *heads, self.meshes, self.known, self.found, share(self.found, self.known), self.found - self.right,
            self.beyond, self.valves, self.stated, self.named, share(self.named, self.stated),
            share(self.named, self.valves), share(self.guessed, self.valves - self.stated),
        ]  # fmt: skip


SHORT_HEADS = [
    "labels", "drawn", "directions certain", "found", "wrong", "valves", "kinds stated", "right", "precision", "recall",
]  # fmt: skip


def short_rows(sums: dict[tuple[str, str, str], Sum]) -> list[list[object]]:
    """A row for each way of labelling and each defect, over all styles."""
    whole: dict[tuple[str, str], Sum] = {}
    for (mode, defect, style), found in sums.items():
        if style != "**all**":
            total = whole.setdefault((mode, defect), Sum())
            total += found
    return [
        [
            LABELS[mode], defect, one.known, one.found, one.found - one.right, one.valves, one.stated, one.named,
            share(one.named, one.stated), share(one.named, one.valves),
        ]
        for (mode, defect), one in whole.items()
    ]  # fmt: skip


def share(some: int, of: int) -> str:
    """A share in per cent, empty where there is nothing to share."""
    return f"{100 * some / of:.0f} %" if of else ""


def matched_valves(graph: SceneGraph, truth: Truth) -> Iterable[tuple[str | None, Unit]]:
    """The true kind of each valve with the unit of the graph that holds most of its meshes."""
    owner = owners(graph)
    for true in truth.units or ():
        held = Counter(owner[mesh].tag for mesh in true.meshes if mesh in owner)
        for tag, _ in held.most_common(1):
            if true.type == graph.unit(tag).unit_type == "valve":
                yield true.kind, graph.unit(tag)


def owners(graph: SceneGraph) -> dict[str, Unit]:
    """The unit that each mesh is part of."""
    meshes = {part.id: part.meshes for part in graph.parts()}
    return {mesh: unit for unit in graph.units() for part in unit.parts for mesh in meshes[part]}


def labels_of(plant: Plant, mode: str) -> list[GivenLabel]:
    """The labels that a plant is given."""
    if mode == "embedded":
        return []
    named = zip(plant.paths(), plant.components, strict=True)
    return [GivenLabel(path, part.group, part.name) for path, part in named if part.group]


def case(preset: str, seed: int, style: str, defect: str, mode: str) -> Sum:
    """The sums over one plant."""
    plant = make(preset, seed, style, DEFECTS[defect] if defect != "none" else Defects())
    graph = build(plant.scene(), labels=labels_of(plant, mode))
    truth = Truth.from_json(truth_of(plant))
    found = Sum()
    found.add(plant, graph, truth, evaluate(graph, truth))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    parser.add_argument("--presets", nargs="+", default=["loop", "tank"], choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=list(STYLES), choices=list(STYLES))
    parser.add_argument("--labels", nargs="+", default=list(LABELS), choices=list(LABELS))
    parser.add_argument("--defects", nargs="+", default=["none"], choices=["none", *DEFECTS])
    parser.add_argument("--reasons", action="store_true", help="list what fixes the directions that are not found")
    parser.add_argument("--write", action="store_true", help="put a table over all styles into docs/flow.md")
    options = parser.parse_args()
    began = time.perf_counter()
    sums: dict[tuple[str, str, str], Sum] = {}
    for mode, defect, style in product(options.labels, options.defects, options.styles):
        for preset, seed in product(options.presets, options.seeds):
            found = case(preset, seed, style, defect, mode)
            for key in ((mode, "**all**", "**all**"), (mode, defect, style)):
                total = sums.setdefault(key, Sum())
                total += found
    seeds = ", ".join(str(seed) for seed in options.seeds)
    print(f"{machine()}\n\nPresets {', '.join(options.presets)}; seed {seeds}; {time.perf_counter() - began:.0f} s.\n")
    rows = [found.row(LABELS[mode], defect, style) for (mode, defect, style), found in sums.items()]
    print("\n".join(table(HEADS, rows, True)))
    if options.write:
        head = f"Presets {', '.join(options.presets)}; styles {', '.join(options.styles)}; seed {seeds}."
        text = "\n".join([head, "", *table(SHORT_HEADS, short_rows(sums), True)])
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "figures", text), encoding="utf-8")
    if options.reasons:
        print("\n".join(line for mode in options.labels for line in told_reasons(mode, sums)))


def told_reasons(mode: str, sums: dict[tuple[str, str, str], Sum]) -> list[str]:
    """What fixes the directions that are certain, and how many of them are not found."""
    missed = sums[mode, "**all**", "**all**"].missed.most_common()
    return [f"- {LABELS[mode]}: {f'{n} not found, ' if n else 'all of '}{reason}" for reason, n in missed]


if __name__ == "__main__":
    main()
