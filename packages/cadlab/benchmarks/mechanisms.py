"""What is found to move on generated plants: ``python packages/cadlab/benchmarks/mechanisms.py [--write]``.

Every preset by three modelling styles (valves in pieces, in a body and an operator, in one mesh), with true labels and
with those of the embedded labeler. A mechanism is right where its kind is the truth's, its axis points the way of the
true one within 0.1 degrees, and its pivot lies within 1 mm of the true axis; the greatest errors are of those of the
right kind. A dial without a needle is right within 1 degree and 3 mm. Units whose true axis was not annotated (some
families of ``assortment``) are counted as not judged. What is missed, wrong or too much is named below the table.

``--real FOLDER ...`` tells what is found in scenes from elsewhere, each a folder with ``scene.usdc`` and
``scene.truth.json``, whose labels count as true ones; folders that aren't there are skipped. ``--write`` puts the table
into ``docs/simulation.md``.
"""

from __future__ import annotations

import argparse
import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import numpy as np

import cadgraph
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Point, Unit
from cadgraph.model.truth import Truth, TruthTurning
from cadgraph.pipeline import build
from cadgraph.query.mechanisms import immovable, say_mechanism
from cadlab.evaluate.labels import true_labels
from cadlab.markdown import put, table
from cadplants import PRESETS, Plant, make
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "simulation.md"
STYLES = ("plant-design", "game", "bim")
MODES = {"true": "true", "embedded": "embedded labeler"}
KINDS = ("handwheel", "gear operator", "lever", "needle", "dial")
HEADS = ["labels", "style", *KINDS, "wrong", "missed", "too much", "not judged", "axis [deg]", "pivot [mm]"]
AXIS, PIVOT = 0.1, 1.0  # degrees, mm
DIAL_AXIS, DIAL_PIVOT = 1.0, 3.0
STILL = ("check", "relief", "safety")
"""Words of the kinds of valves that nobody turns: a mechanism found there is too much."""


@dataclass
class Tally:
    """What is counted over several plants."""

    true: Counter[str] = field(default_factory=Counter)
    right: Counter[str] = field(default_factory=Counter)
    cases: dict[str, list[str]] = field(default_factory=lambda: {"wrong": [], "missed": [], "too much": []})
    not_judged: int = 0
    axis: float = 0.0
    pivot: float = 0.0

    def add(self, name: str, graph: SceneGraph, truth: Truth) -> None:
        """Counts one more plant of this name."""
        matched = dict(_matched(graph, truth))
        for unit in truth.units or ():
            if unit.turns is not None:
                self.true[unit.turns.kind] += 1
                self._judge(f"{name} {unit.tag} ({unit.kind})", matched.get(unit.id), unit.turns)
        known = {matched[unit.id].id: unit for unit in truth.units or () if unit.id in matched}
        for found in graph.units():
            there = known.get(found.id)
            if found.mechanism is None or (there is not None and there.turns is not None):
                continue
            if there is None or there.type != found.unit_type or any(word in (there.kind or "") for word in STILL):
                told = f"{name} {found.tag}: a {found.mechanism.kind} on {there.kind if there else 'no unit'}"
                self.cases["too much"].append(told)
            else:
                self.not_judged += 1

    def _judge(self, name: str, unit: Unit | None, turns: TruthTurning) -> None:
        moves = unit.mechanism if unit is not None else None
        if turns.kind == "dial":
            dial = unit.dial if unit is not None else None
            if dial is None:
                self.cases["missed"].append(f"{name}: dial")
                return
            axis, pivot = _errors(dial.normal, dial.center, turns)
            wrong = axis > DIAL_AXIS or pivot > DIAL_PIVOT or moves is not None
        elif moves is None:
            self.cases["missed"].append(f"{name}: {turns.kind}")
            return
        else:
            axis, pivot = _errors(moves.axis, moves.pivot, turns)
            wrong = axis > AXIS or pivot > PIVOT or moves.kind != turns.kind
        if wrong:
            found = moves.kind if moves is not None else "dial"
            self.cases["wrong"].append(f"{name}: {turns.kind}, found {found}, {axis:.2f} degrees, {pivot:.1f} mm off")
            return
        self.right[turns.kind] += 1
        if turns.kind != "dial":
            self.axis, self.pivot = max(self.axis, axis), max(self.pivot, pivot)

    def row(self, *heads: str) -> list[object]:
        """One line of the table."""
        counts = [f"{self.right[kind]}/{self.true[kind]}" if self.true[kind] else "" for kind in KINDS]
        found = [len(cases) for cases in self.cases.values()]
        return [*heads, *counts, *found, self.not_judged, f"{self.axis:.3f}", f"{self.pivot:.3f}"]


def _errors(axis: Point, point: Point, turns: TruthTurning) -> tuple[float, float]:
    """Between two axes [deg], and of a point from the true one [mm]."""
    true, apart = np.array(turns.axis), np.array(point) - turns.point
    angle = math.degrees(math.acos(float(np.clip(np.dot(axis, true) / np.linalg.norm(true), -1.0, 1.0))))
    return angle, 1000 * float(np.linalg.norm(apart - (apart @ true) * true))


def _matched(graph: SceneGraph, truth: Truth) -> Iterator[tuple[str, Unit]]:
    """Of each true unit the unit of the graph that holds what turns of it, else most of its meshes."""
    owner = {mesh: unit for unit in graph.units() for part in unit.parts for mesh in graph.part(part).meshes}
    for unit in truth.units or ():
        meshes = (unit.turns.mesh,) if unit.turns is not None and unit.turns.mesh in owner else unit.meshes
        held = Counter(owner[mesh].id for mesh in meshes if mesh in owner)
        if held:
            best = min(held, key=lambda one: (-held[one], one))
            yield unit.id, next(one for one in graph.units() if one.id == best)


def labels_of(plant: Plant, mode: str) -> list[GivenLabel]:
    """The labels that a plant is given."""
    if mode == "embedded":
        return []
    parts = zip(plant.paths(), plant.components, strict=True)
    return [GivenLabel(path, part.group, part.name) for path, part in parts if part.group]


def tell_real(folder: Path) -> None:
    """Prints what is found in a scene from elsewhere."""
    file, known = folder / "scene.usdc", folder / "scene.truth.json"
    if not file.is_file() or not known.is_file():
        print(f"{folder}: not there")
        return
    scene, truth = cadgraph.load(file), Truth.load(known)
    given = [one for one in true_labels(truth) if one.mesh in scene.paths]
    for mode, labels in (("true", given), ("embedded", [])):
        graph = build(scene, labels=labels)
        units = [unit for unit in graph.units() if unit.unit_type in ("valve", "gauge")]
        print(f"{folder.name}, labels {mode}: {len(units)} valves and gauges")
        reasons = {one.unit: one.reason for one in immovable(graph)}
        for unit in units:
            pieces = f", {len(unit.mechanism.pieces)} pieces of its mesh" if unit.mechanism else ""
            print(f"- {unit.tag}: {say_mechanism(unit) or reasons.get(unit.id, 'nothing')}{pieces}")


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    parser.add_argument("--presets", nargs="+", default=sorted(PRESETS), choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=list(STYLES))
    parser.add_argument("--modes", nargs="+", default=list(MODES), choices=list(MODES))
    parser.add_argument("--real", type=Path, nargs="+", default=[], help="folders with scenes from elsewhere")
    parser.add_argument("--write", action="store_true", help="put the table into docs/simulation.md")
    options = parser.parse_args()
    for folder in options.real:
        tell_real(folder)
    if options.real:
        return
    tallies = {(mode, style): Tally() for mode in options.modes for style in options.styles}
    for style, preset, seed in product(options.styles, options.presets, options.seeds):
        plant = make(preset, seed, style)
        scene, truth = plant.scene(), Truth.from_json(truth_of(plant))
        for mode in options.modes:
            graph = build(scene, labels=labels_of(plant, mode))
            tallies[mode, style].add(f"{preset} {seed} {style}, {mode} labels,", graph, truth)
    seeds = ", ".join(str(seed) for seed in options.seeds)
    rows = [tally.row(MODES[mode], style) for (mode, style), tally in tallies.items()]
    text = "\n".join([f"Presets {', '.join(options.presets)}; seed {seeds}.", "", *table(HEADS, rows)])
    print(text)
    for tally in tallies.values():
        for what, cases in tally.cases.items():
            if cases:
                print(*(f"- {what}: {case}" for case in cases), sep="\n")
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "mechanisms", text), encoding="utf-8")


if __name__ == "__main__":
    main()
