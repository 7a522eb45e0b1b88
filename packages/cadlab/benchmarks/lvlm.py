"""What asking costs and what it brings: ``python packages/cadlab/benchmarks/lvlm.py [--preset field] [--seeds 8]``.

Asks a simulated model about a generated plant in the ways that the package knows, and prints a table in Markdown:
questions, tokens and the price at gpt-4o's list price, and how many parts get the right name and group.

The simulated model answers from the ground truth and errs as gpt-4o did in the paper (table I, weighted by parts): it
gets 38 % of the names and 80 % of the groups right. Errors are of two kinds. *At random*: each question draws anew, so
asking again helps. *Systematic*: which shapes it gets wrong is a matter of the shape, so that asking about another
copy brings the same mistake; and three of five flanges are called gaskets, as the paper found. Its confidence is what
models say of themselves: higher where it is right, but not by much. The embedded labeler is the package's own, on a
plant that it was not fitted to.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from _timing import machine

from cadgraph.labelers.base import Labeling
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.lvlm.asking import Asking, Budget
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.price import ANSWER_TOKENS, read_price
from cadgraph.labelers.lvlm.reply import Question, Reply
from cadgraph.model.analysis import Analysis
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.pipeline import analyse
from cadlab.markdown import table
from cadplants import make
from cadplants.truth_writer import truth_of

NAMES_RIGHT, GROUPS_RIGHT = 0.38, 0.80
FLANGE_AS_GASKET = 0.6
"""Of the flanges, in the systematic model: the paper says that many flanges were taken for gaskets, and no figure."""

Pair = tuple[str, str]


@dataclass
class Simulated:
    """A model of the paper's accuracy, which answers from the truth."""

    truth: Sequence[Pair]
    shape: Sequence[int]
    vocabulary: Vocabulary
    systematic: bool
    seed: int
    asking: Asking | None = None
    name: str = "gpt-4o"
    looks: bool = False
    keeps: bool = True
    again: bool = True

    def ask(self, question: Question) -> Reply:
        group, name = self.truth[question.part]
        if self.systematic:
            key = f"shape {self.shape[question.part]}"
            noise = f"{question.id}"
        else:
            key = noise = question.id
        draw = self._draw(key)
        told = self._wrong(group, name, draw)
        right = told == (group, name)
        confidence = float(np.clip(self._draw(noise + "confidence").normal(0.78 if right else 0.66, 0.14), 0.05, 0.99))
        answer = {"seen": "a part", "group": told[0], "name": told[1], "confidence": round(confidence, 2)}
        tokens = self.asking.tokens(question) if self.asking else 0
        return Reply(json.dumps(answer), None, tokens, ANSWER_TOKENS)

    def close(self) -> None:
        pass

    def _wrong(self, group: str, name: str, draw: np.random.Generator) -> Pair:
        if self.systematic and name == "flange" and draw.random() < FLANGE_AS_GASKET:
            return "Pipe assembly", "gasket"
        fate = draw.random()
        if fate < NAMES_RIGHT:
            return group, name
        if fate < GROUPS_RIGHT:
            others = [n for n in self.vocabulary.groups[group].names if n != name]
            return (group, others[int(draw.integers(len(others)))]) if others else (group, name)
        groups = [g for g in self.vocabulary.groups if g != group]
        chosen = groups[int(draw.integers(len(groups)))]
        names = self.vocabulary.groups[chosen].names
        return chosen, names[int(draw.integers(len(names)))]

    def _draw(self, key: str) -> np.random.Generator:
        digest = hashlib.sha256(f"{self.seed} {key}".encode()).digest()
        return np.random.default_rng(int.from_bytes(digest[:8], "little"))


class Known:
    """A labeler that says what was said before."""

    def __init__(self, labeling: Labeling) -> None:
        self.labeling = labeling

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        return self.labeling


WAYS: Mapping[str, tuple[Way, Budget]] = {
    "per part (paper)": (Way(per="part", again_below=0, repair=False, paper=True), Budget()),
    "per shape": (Way(again_below=0, repair=False), Budget()),
    "per shape, sizes": (Way(again_below=0), Budget()),
    "per shape, 3 votes, sizes": (Way(votes=3, again_below=0), Budget()),
    "per shape, 5 votes, sizes": (Way(votes=5, again_below=0), Budget()),
    "embedded + unsure, 3 votes, sizes": (Way(ask="unsure", votes=3), Budget()),
    "embedded + at most 100 questions": (Way(ask="unsure", votes=3), Budget(questions=100)),
}


def accuracy(labels: Sequence[Label | None], truth: Sequence[Pair]) -> tuple[float, float, float]:
    """Share of the parts with the right name, of the names that are given, and of the parts with the right group."""
    given = [label is not None and label.name is not None for label in labels]
    names = [label is not None and (label.group, label.name) == true for label, true in zip(labels, truth, strict=True)]
    groups = [label is not None and label.group == true[0] for label, true in zip(labels, truth, strict=True)]
    return float(np.mean(names)), float(np.sum(names)) / max(sum(given), 1), float(np.mean(groups))


def shown(shares: Sequence[float]) -> list[str]:
    names, of_given, groups = shares
    return [f"{names:.1%} ({of_given:.0%})", f"{groups:.1%}"]


def row(title: str, analysis: Analysis, labeling: Labeling, truth: Sequence[Pair], seeds: int) -> list[str]:
    parts, contacts = analysis.parts, analysis.contacts
    way, budget = WAYS[title]
    vocabulary = default_vocabulary()
    cells: list[str] = []
    estimate = None
    for systematic in (False, True):
        found = []
        for seed in range(seeds):
            model = Simulated(truth, parts.shape.tolist(), vocabulary, systematic, seed)
            asking = Asking(model, Cache(":memory:"), read_price("gpt-4o"), budget, concurrency=1)
            model.asking = asking
            embedded = Known(labeling) if way.ask == "unsure" else None
            labeler = LvlmLabeler(asking, way, embedded=embedded)
            found.append(accuracy(labeler.label(parts, contacts, vocabulary).answers, truth))
            if estimate is None:
                estimate = asking.tally
        cells += shown(np.mean(found, axis=0).tolist())
    if estimate is None:
        raise ValueError("at least one seed is needed")
    tokens = estimate.prompt_tokens + estimate.answer_tokens
    return [title, f"{estimate.asked:,}", f"{tokens / 1e6:.2f}", f"{estimate.cost:.2f}", *cells]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", default="field")
    parser.add_argument("--seed", type=int, default=0, help="of the plant")
    parser.add_argument("--seeds", type=int, default=8, help="of the simulated model, averaged")
    options = parser.parse_args()
    plant = make(options.preset, options.seed)
    start = time.perf_counter()
    analysis = analyse(plant.scene())
    labeling = EmbeddedLabeler().label(analysis.parts, analysis.contacts, default_vocabulary())
    named = {mesh["mesh"]: (mesh["group"], mesh["name"]) for mesh in truth_of(plant)["meshes"]}
    truth = [(str(g), str(n)) for g, n in (named[path] for path in analysis.parts.scene.paths)]
    print(machine())
    print(f"\n{options.preset}: {analysis.parts.n_parts:,} parts; labelled in {time.perf_counter() - start:.0f} s.\n")
    titles = ["way", "questions", "M tokens", "US$", "names, random", "groups", "names, systematic", "groups "]
    rows = []
    embedded = accuracy(labeling.answers, truth)
    rows.append(["embedded alone", "0", "0", "0", *shown(embedded) * 2])
    rows += [row(title, analysis, labeling, truth, options.seeds) for title in WAYS]
    print(*table(titles, rows, numbers=True), sep="\n")
    print("\nIn brackets: of the names that are given; where votes agree on the group only, the name is left open.")


if __name__ == "__main__":
    main()
