"""What isolation closes on generated plants: ``python packages/cadlab/benchmarks/isolation.py [--write]``.

Every unit with a line is isolated, by the nearest valves and by the fewest, on every preset by every modelling style,
with true labels and with those of the embedded labeler. Counted is what the valves to close are by the truth: a check,
control or relief valve among them is a wrong answer that somebody may open a pipe on, and so is an answer that is said
to be whole although, by the truth, a tank or an open end still feeds the unit with these valves closed. ``--old``
counts valves of unknown kind as shut-off valves, for comparison. ``--write`` puts the table into
``docs/functional.md``.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadgraph.query import Network, find_isolation
from cadlab.evaluate.pairing import pair
from cadlab.evaluate.units import match_units
from cadlab.markdown import put, table
from cadplants import PRESETS, STYLES, Plant, make
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "functional.md"
MODES = {"true": "true", "embedded": "embedded labeler"}
UNSAFE = ("check", "control", "relief", "safety", "reducing", "float", "foot", "flap", "breather", "air")
"""Words of the kinds that never cut anything off."""
HEADS = [
    "labels", "plants", "valves", "kind right", "open", "wrong", "answers", "whole", "doubtful", "with an opening",
    "closed", "unsafe kinds closed", "said whole, but fed",
]  # fmt: skip


class TruePipes:
    """The true network of a plant, for units of the graph that stand for true ones.

    Args:
        truth: of the plant.
        true_of: id of the true unit of each unit of the graph.
    """

    def __init__(self, truth: Truth, true_of: Mapping[str, str]) -> None:
        self.true_of = true_of
        self.next: dict[str, list[str]] = {}
        for one in truth.connections or ():
            self.next.setdefault(one.source, []).append(one.target)
            self.next.setdefault(one.target, []).append(one.source)
        self.sources = {unit.id for unit in truth.units or () if unit.type == "tank"}
        self.sources |= {point.id for point in truth.points if point.kind == "terminal" and point.end == "open"}

    def source(self, place: str, closed: Collection[str]) -> str | None:
        """The first tank or open end that something flows from to a unit with some valves closed, if any."""
        start = self.true_of.get(place)
        if start is None:
            return None
        seen = {start, *(self.true_of[valve] for valve in closed if valve in self.true_of)}
        waiting = [start]
        while waiting:
            for there in self.next.get(waiting.pop(), ()):
                if there in seen:
                    continue
                if there in self.sources:
                    return there
                seen.add(there)
                waiting.append(there)
        return None


@dataclass
class Tally:
    """What is counted over several plants."""

    plants: int = 0
    kinds: Counter[str] = field(default_factory=Counter)
    answers: Counter[bool | None] = field(default_factory=Counter)
    closed: int = 0
    unsafe: Counter[str] = field(default_factory=Counter)
    fed: Counter[str] = field(default_factory=Counter)

    def add(self, name: str, graph: SceneGraph, truth: Truth, assume: bool) -> None:
        """Counts one more plant of this name."""
        self.plants += 1
        matched = match_units(pair(graph, truth))
        true_kind = {unit.id: unit.kind for unit in truth.units or ()}
        kind_of = {place: true_kind[which] for place, which in matched.true_of.items()}
        for unit in matched.true:
            if unit.type == "valve":
                right = "right" if unit.predicted_kind == unit.kind else "wrong" if unit.predicted_kind else "open"
                self.kinds[right] += 1
        self._isolate(name, Network(graph), kind_of, assume, TruePipes(truth, matched.true_of))

    def _isolate(
        self, name: str, network: Network, kind_of: Mapping[str, str | None], assume: bool, pipes: TruePipes
    ) -> None:
        for place, fewest in product(network.places, (False, True)):
            if network.unit_type(place) is None or not network.arcs(place):
                continue
            found = find_isolation(network, place, fewest=fewest, assume_shutoff=assume)
            self.answers[found.isolated] += 1
            self.closed += len(found.valves)
            for valve in found.valves:
                kind = kind_of.get(valve.place) or ""
                if any(word in kind for word in UNSAFE):
                    self.unsafe[f"{name}: {found.name} by {valve.name}, a {kind} taken for a {valve.what}"] += 1
            source = pipes.source(place, {valve.place for valve in found.valves}) if found.isolated else None
            if source is not None:
                names = ", ".join(valve.name for valve in found.valves)
                self.fed[f"{name}: {found.name} by {names or 'nothing'} is fed from {source}"] += 1

    def row(self, mode: str) -> list[object]:
        """One line of the table."""
        kinds, answers = self.kinds, self.answers
        return [
            MODES[mode], self.plants, kinds.total(), kinds["right"], kinds["open"], kinds["wrong"],
            answers.total(), answers[True], answers[None], answers[False], self.closed, self.unsafe.total(),
            self.fed.total(),
        ]  # fmt: skip


def labels_of(plant: Plant, mode: str) -> list[GivenLabel]:
    """The labels that a plant is given."""
    if mode == "embedded":
        return []
    parts = zip(plant.paths(), plant.components, strict=True)
    return [GivenLabel(path, part.group, part.name) for path, part in parts if part.group]


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    parser.add_argument("--presets", nargs="+", default=sorted(PRESETS), choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=list(STYLES), choices=list(STYLES))
    parser.add_argument("--modes", nargs="+", default=list(MODES), choices=list(MODES))
    parser.add_argument("--old", action="store_true", help="count valves of unknown kind as shut-off valves")
    parser.add_argument("--write", action="store_true", help="put the table into docs/functional.md")
    options = parser.parse_args()
    tallies = {mode: Tally() for mode in options.modes}
    for style, preset, seed in product(options.styles, options.presets, options.seeds):
        plant = make(preset, seed, style)
        scene, truth = plant.scene(), Truth.from_json(truth_of(plant))
        for mode, tally in tallies.items():
            graph = build(scene, labels=labels_of(plant, mode))
            tally.add(f"{preset} {seed} {style} {mode}", graph, truth, options.old)
    seeds = ", ".join(str(seed) for seed in options.seeds)
    head = f"Presets {', '.join(options.presets)}; styles {', '.join(options.styles)}; seed {seeds}."
    text = "\n".join([head, "", *table(HEADS, [tally.row(mode) for mode, tally in tallies.items()], True)])
    print(text)
    for tally in tallies.values():
        print(*(f"- {case}" for case in (*tally.unsafe, *tally.fed)), sep="\n")
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "isolation", text), encoding="utf-8")


if __name__ == "__main__":
    main()
