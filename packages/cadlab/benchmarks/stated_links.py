"""What a file's own links add to geometry: ``python packages/cadlab/benchmarks/stated_links.py [--seeds 7]``.

Generated plants whose file says what is joined, as the ports of an IFC or the branches of an RVM do: links between the
parts that were made to meet, with the flow of the true connections. All links right, and a tenth of them wrong (half by
one place, half anywhere, a half of these with the flow turned) and another tenth missing. For each the connections and
directions that are found without and with ``relate.use_metadata``, and what ``compare --source`` says of the graph that
was made without. ``--write`` puts the table into ``docs/functional.md``.
"""

from __future__ import annotations

import argparse
import random
from collections import deque
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import Literal

import numpy as np
from relate import f1, labels_of

from cadgraph.config import Config
from cadgraph.model.facts import StatedLink
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import build
from cadgraph.query.compare_source import compare_source
from cadlab.evaluate.evaluation import evaluate
from cadlab.markdown import put, table
from cadplants import PRESETS, STYLES, Defects, Plant, make
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "functional.md"
WRONG, MISSING = 0.1, 0.1
DRAWN = {
    "as meant": Defects(),
    "gaps of 0.5 to 5 mm": Defects(joints=(0.0005, 0.005)),
    "gaps of 15 to 60 mm": Defects(joints=(0.015, 0.06)),
}
FILES = {"right": "all links right", "spoilt": "10 % wrong, 10 % missing"}
LABELS = {"true": "true", "embedded": "embedded labeler", "wrong": "20 % wrong at random"}
HEADS = [
    "labels", "drawn", "links", "plants", "true edges", "F1 without", "F1 with", "precision with",
    "directions without: decided, wrong", "with: decided, wrong", "compare --source: agree, only graph, only source",
]  # fmt: skip
Flow = Literal["forward", "backward", "unknown"]


def links_of(plant: Plant, file: str, seed: int) -> tuple[StatedLink, ...]:
    """What the file of a plant says is joined."""
    paths = plant.paths()
    pairs = sorted(_joined(plant))
    flows = _flows(plant, pairs)
    beside: dict[int, list[int]] = {}
    for a, b in pairs:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    choose = random.Random(seed)
    found = []
    for a, b in pairs:
        flow, second = flows.get((a, b), "unknown"), b
        fate = choose.random() if file == "spoilt" else 1.0
        if fate < MISSING:
            continue
        if fate < MISSING + WRONG:
            near = [c for c in beside[b] if c not in (a, b)]
            second = choose.choice(near if near and choose.random() < 0.5 else sorted(beside))
            turned: dict[str, Flow] = {"forward": "backward", "backward": "forward", "unknown": "unknown"}
            flow = turned[flow] if choose.random() < 0.5 else flow
        found.append(StatedLink(paths[a], paths[second], flow, "IfcRelConnectsPorts"))
    return tuple(found)


def _joined(plant: Plant) -> Iterator[tuple[int, int]]:
    """Pairs of components of lines and devices that were made to meet, but for those within one device."""
    vocabulary = default_vocabulary()
    named = vocabulary.connector_groups.union(vocabulary.unit_of_group)
    for a, b in dict.fromkeys(plant.contacts):
        first, second = plant.components[a], plant.components[b]
        if first.group in named and second.group in named and not (first.unit and first.unit == second.unit):
            yield min(a, b), max(a, b)


def _flows(plant: Plant, pairs: Sequence[tuple[int, int]]) -> dict[tuple[int, int], Flow]:
    """The flow between pairs along the true connections; none where two of these disagree."""
    beside: dict[int, list[int]] = {}
    for a, b in pairs:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    said: dict[tuple[int, int], set[Flow]] = {}
    for one in plant.connections:
        if one.direction == "unknown":
            continue
        start, goal = (_place(plant, name, one.line, beside) for name in (one.source, one.target))
        way = _way(plant, beside, start, goal)
        way = way if one.direction == "forward" else way[::-1]
        for a, b in zip(way, way[1:], strict=False):
            said.setdefault((min(a, b), max(a, b)), set()).add("forward" if a < b else "backward")
    return {pair: next(iter(flows)) for pair, flows in said.items() if len(flows) == 1}


def _place(plant: Plant, name: str, line: str, known: Collection[int]) -> set[int]:
    """The components of a unit, or the one of a line nearest to a point."""
    own = {k for k in known if plant.components[k].unit == name}
    point = next((each.point for each in plant.points if each.id == name), None)
    if own or point is None:
        return own
    near = [k for k in known if plant.components[k].line == line] or list(known)
    boxes = {k: (plant.components[k].vertices.min(axis=0), plant.components[k].vertices.max(axis=0)) for k in near}
    apart = {
        k: float(np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0)))
        for k, (low, high) in boxes.items()
    }
    return {min(near, key=lambda k: (apart[k], k))}


def _way(plant: Plant, beside: Mapping[int, Sequence[int]], start: set[int], goal: set[int]) -> list[int]:
    """The fewest steps over components of no unit from one place to another."""
    came: dict[int, int] = dict.fromkeys(start, -1)
    waiting = deque(sorted(start))
    while waiting:
        here = waiting.popleft()
        if here in goal:
            way = [here]
            while came[way[-1]] >= 0:
                way.append(came[way[-1]])
            return way[::-1]
        for there in beside.get(here, ()):
            if there not in came and (there in goal or not plant.components[there].unit):
                came[there] = here
                waiting.append(there)
    return []


@dataclass
class Sum:
    """What is counted over several plants; pairs are without and with the file's links."""

    plants: int = 0
    edges: tuple[list[int], list[int]] = field(default_factory=lambda: ([0, 0, 0], [0, 0, 0]))
    flow: tuple[list[int], list[int]] = field(default_factory=lambda: ([0, 0, 0], [0, 0, 0]))
    compared: list[int] = field(default_factory=lambda: [0, 0, 0])

    def row(self, *heads: object) -> list[object]:
        """One line of the table."""
        (known, decided, right), (known_with, decided_with, right_with) = self.flow
        true, predicted, correct = self.edges[1]
        return [
            *heads, self.plants, true, f1(self.edges[0]), f1(self.edges[1]), f"{correct / max(1, predicted):.3f}",
            f"{decided}/{known}, {decided - right}", f"{decided_with}/{known_with}, {decided_with - right_with}",
            ", ".join(str(count) for count in self.compared),
        ]  # fmt: skip


@lru_cache(maxsize=4)
def drawn(preset: str, seed: int, style: str, how: str) -> tuple[Plant, Scene, Truth]:
    """A plant with its scene and truth."""
    plant = make(preset, seed, style, DRAWN[how])
    return plant, plant.scene(), Truth.from_json(truth_of(plant))


def measure(plants: Sequence[tuple[str, int, str]], how: str, mode: str, file: str) -> Sum:
    """The sums over some plants: presets, seeds, styles."""
    total = Sum()
    for preset, seed, style in plants:
        plant, bare, truth = drawn(preset, seed, style, how)
        scene = replace(bare, links=links_of(plant, file, seed))
        for k, use in enumerate((False, True)):
            config = Config().replace({"relate.use_metadata": use})
            graph = build(scene, config, labels=labels_of(plant, mode, seed))
            found = evaluate(graph, truth).total.connected
            if found is None or found.direction is None:
                continue
            edges, ways = found.edges, found.direction
            counted = edges.n_true, edges.n_predicted, edges.n_correct
            total.edges[k][:] = [a + b for a, b in zip(total.edges[k], counted, strict=True)]
            counted = ways.n_known, ways.n_decided, ways.n_right
            total.flow[k][:] = [a + b for a, b in zip(total.flow[k], counted, strict=True)]
            if not use:
                said = compare_source(graph)
                more = (len(said.agreeing), len(said.only_ours), len(said.only_theirs))
                total.compared = [a + b for a, b in zip(total.compared, more, strict=True)]
        total.plants += 1
    return total


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7])
    parser.add_argument("--presets", nargs="+", default=["skid", "loop"], choices=sorted(PRESETS))
    parser.add_argument("--styles", nargs="+", default=["plant-design"], choices=list(STYLES))
    parser.add_argument("--labels", nargs="+", default=["true", "wrong"], choices=list(LABELS))
    parser.add_argument("--drawn", nargs="+", default=list(DRAWN), choices=list(DRAWN))
    parser.add_argument("--write", action="store_true", help="put the table into docs/functional.md")
    options = parser.parse_args()
    plants = list(product(options.presets, options.seeds, options.styles))
    rows = [
        measure(plants, how, mode, file).row(LABELS[mode], how, FILES[file])
        for mode, how, file in product(options.labels, options.drawn, FILES)
    ]
    seeds = ", ".join(str(seed) for seed in options.seeds)
    head = f"Presets {', '.join(options.presets)}; styles {', '.join(options.styles)}; seed {seeds}."
    text = "\n".join([head, "", *table(HEADS, rows, True)])
    print(text)
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "stated", text), encoding="utf-8")


if __name__ == "__main__":
    main()
