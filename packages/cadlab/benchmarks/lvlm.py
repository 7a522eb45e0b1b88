"""What asking costs and what it brings: ``python packages/cadlab/benchmarks/lvlm.py [--plants field riser/vendor]``.

Asks a simulated model about generated plants in the ways that the package knows, and prints a table in Markdown for
each plant: questions, the price at gpt-4o's list price, how many parts get the right name and group, and F1 of the
functional relations that follow.

The simulated models answer from the truth and are right as often as their column says. Errors are *systematic*: which
shapes a model gets wrong, and what it takes them for, is a matter of the shape, so that asking about another copy
brings the same mistake; half of them fall on names that are often confused (gasket and flange, plate and bracket...),
a third of the rest into other groups. Confidence is what models say of themselves: higher where they are right, but
not by much. The labeler joins their answers by an accuracy that was measured on another plant (``lvlm_accuracy.py``).
The embedded labeler is the package's own; it has not seen these styles.
"""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from _timing import machine

from cadgraph.config import Config
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.lvlm.asking import Asking, Budget
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.joining import Accuracy, read_accuracy
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.price import ANSWER_TOKENS, read_price
from cadgraph.labelers.lvlm.question_groups import find_question_groups
from cadgraph.labelers.lvlm.reply import Question, Reply
from cadgraph.model.analysis import Analysis
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.pipeline import analyse, contradicted
from cadgraph.session.session import Session
from cadlab.evaluate.evaluation import evaluate
from cadlab.markdown import put, table
from cadplants import make
from cadplants.truth.truth_writer import truth_of

PAGE = Path(__file__).parents[3] / "docs" / "lvlm.md"
Pair = tuple[str, str]
ACCURACIES = (1.0, 0.98, 0.9, 0.8)
CONFUSED, ELSEWHERE = 0.5, 1 / 3
PAIRS = read_accuracy("").confused


@dataclass
class Simulated:
    """A model that is right about a share of the shapes, and answers from the truth."""

    truth: Sequence[Pair]
    shape: Sequence[int]
    vocabulary: Vocabulary
    accuracy: float
    seed: int
    asking: Asking | None = None
    name: str = "gpt-4o"
    looks: bool = False
    keeps: bool = True
    again: bool = True

    def ask(self, question: Question) -> Reply:
        group, name = self.truth[question.part]
        draw = self._draw(f"shape {self.shape[question.part]} {group} {name}")
        right = draw.random() < self.accuracy
        told = (group, name) if right else self._wrong(group, name, draw)
        own = self._draw(question.id).normal(0.88 if right else 0.72, 0.12)
        answer = {
            "seen": "a part",
            "group": told[0],
            "name": told[1],
            "confidence": round(float(np.clip(own, 0, 1)), 2),
        }
        tokens = self.asking.tokens(question) if self.asking else 0
        return Reply(json.dumps(answer), None, tokens, ANSWER_TOKENS)

    def close(self) -> None:
        pass

    def _wrong(self, group: str, name: str, draw: np.random.Generator) -> Pair:
        rivals = {b for a, b in PAIRS if a == name} | {a for a, b in PAIRS if b == name}
        places = [(g, n) for g, held in self.vocabulary.groups.items() for n in held.names if n in rivals]
        if places and draw.random() < CONFUSED:
            return places[int(draw.integers(len(places)))]
        others = [n for n in self.vocabulary.groups[group].names if n != name]
        if others and draw.random() > ELSEWHERE:
            return group, others[int(draw.integers(len(others)))]
        groups = [g for g in self.vocabulary.groups if g != group]
        chosen = groups[int(draw.integers(len(groups)))]
        names = self.vocabulary.groups[chosen].names
        return chosen, names[int(draw.integers(len(names)))]

    def _draw(self, key: str) -> np.random.Generator:
        digest = hashlib.sha256(f"{self.seed} {key}".encode()).digest()
        return np.random.default_rng(int.from_bytes(digest[:8], "little"))


@dataclass(frozen=True)
class Known:
    """A labeler that says what was said before."""

    labeling: Labeling

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        return self.labeling


@dataclass(frozen=True)
class Case:
    """A plant, what geometry says of it, and what is true."""

    analysis: Analysis
    labeling: Labeling
    truth: Truth
    pairs: Sequence[Pair]

    def scores(self, labeling: Labeling) -> tuple[float, float, float]:
        """Shares of right names and groups among all parts, and F1 of the relations."""
        said = [label.said if label is not None else None for label in labeling.labels]
        names = float(np.mean([one == true for one, true in zip(said, self.pairs, strict=True)]))
        groups = float(
            np.mean([one is not None and one[0] == true[0] for one, true in zip(said, self.pairs, strict=True)])
        )
        found = evaluate(Session(self.analysis, labeling).graph, self.truth).total.connected
        return names, groups, (found.edges.f1 or 0.0) if found is not None else float("nan")


def read_case(preset: str, style: str, seed: int) -> Case:
    plant = make(preset, seed, style) if style else make(preset, seed)
    analysis = analyse(plant.scene())
    labeling = EmbeddedLabeler().label(analysis.parts, analysis.contacts, default_vocabulary())
    known = truth_of(plant)
    named = {mesh["mesh"]: (str(mesh["group"]), str(mesh["name"])) for mesh in known["meshes"]}
    return Case(analysis, labeling, Truth.from_json(known), [named[path] for path in analysis.parts.scene.paths])


def ways(kinds: int) -> Mapping[str, tuple[Way, Budget]]:
    return {
        "per part (paper)": (Way(per="part", again_below=0, repair=False, staged=False), Budget()),
        "per shape": (Way(), Budget()),
        "embedded+lvlm": (Way(ask="unsure"), Budget()),
        f"embedded+lvlm, at most {kinds // 4}": (Way(ask="unsure"), Budget(questions=kinds // 4)),
        "embedded+lvlm, at most 20": (Way(ask="unsure"), Budget(questions=20)),
    }


def asked(case: Case, way: Way, budget: Budget, accuracy: float, seed: int) -> tuple[Labeling, Asking]:
    parts, vocabulary = case.analysis.parts, default_vocabulary()
    model = Simulated(case.pairs, parts.shape.tolist(), vocabulary, accuracy, seed)
    asking = Asking(model, Cache(":memory:"), read_price("gpt-4o"), budget, concurrency=1)
    model.asking = asking
    measured = Accuracy(min(accuracy, 0.99), min((2 + accuracy) / 3, 0.995), confused=PAIRS)
    embedded = Known(case.labeling) if way.ask == "unsure" else None
    labeler = LvlmLabeler(asking, way, embedded=embedded, accuracy=measured)
    labeler.contradictions = partial(contradicted, case.analysis, vocabulary, Config())
    return labeler.label(parts, case.analysis.contacts, vocabulary), asking


def rows_of(case: Case, seeds: int) -> list[str]:
    """The table of a plant."""
    kinds = len(find_question_groups(case.analysis.parts))
    titles = ["way", "questions", "US$"]
    for accuracy in ACCURACIES:
        titles += [f"{accuracy:.0%}: names", "groups", "F1"]
    names, groups, f1 = case.scores(case.labeling)
    rows = [["embedded", "0", "0", *[f"{names:.1%}", f"{groups:.1%}", f"{f1:.3f}"] * len(ACCURACIES)]]
    for title, (way, budget) in ways(kinds).items():
        cells, first = [], None
        for accuracy in ACCURACIES:
            found = []
            for seed in range(1 if accuracy == 1 else seeds):
                labeling, asking = asked(case, way, budget, accuracy, seed)
                found.append(case.scores(labeling))
                first = first or asking.tally
            names, groups, f1 = np.mean(found, axis=0).tolist()
            cells += [f"{names:.1%}", f"{groups:.1%}", f"{f1:.3f}"]
        if first is not None:
            rows.append([title, f"{first.asked:,}", f"{first.cost:.2f}", *cells])
    return table(titles, rows, numbers=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plants", nargs="+", default=["field", "riser/vendor", "tank/bim"], metavar="PRESET[/STYLE]")
    parser.add_argument("--seed", type=int, default=5, help="of the plants")
    parser.add_argument("--seeds", type=int, default=2, help="of the simulated models, averaged")
    parser.add_argument("--write", action="store_true", help=f"put the tables into {PAGE.name}")
    options = parser.parse_args()
    lines = []
    for which in options.plants:
        preset, _, style = which.partition("/")
        case = read_case(preset, style, options.seed)
        drawn = f" in the style `{style}`" if style else ""
        found = [f"`{preset}`{drawn}, {case.analysis.parts.n_parts:,} parts:", "", *rows_of(case, options.seeds), ""]
        print(*found, sep="\n", flush=True)
        lines += found
    if options.write:
        text = "\n".join([*lines, f"({machine()}.)"])
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "simulated", text), encoding="utf-8")


if __name__ == "__main__":
    main()
