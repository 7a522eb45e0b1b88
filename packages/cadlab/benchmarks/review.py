"""How soon a plant is right when the review queue is answered: ``python packages/cadlab/benchmarks/review.py``.

Somebody who knows the truth answers question after question: with the option that is right where it is offered, else
by naming it freely; that a label is right as it is counts as a decision, too. The answer is judged by the part that is
shown, and holds for all parts that the question names. Beside it the orders that a user would pick without a queue,
by lowest confidence and at random, one shape with one label at a time, with answers that hold for all its repeats.

Labels are the embedded labeler's with its own mistakes (``own``), or the true ones, 5 % of them wrong on purpose and
stated at 85 to 99 %: whole shapes, wrong as the labeler would err (``shape``), or single parts at random (``single``).

    python packages/cadlab/benchmarks/review.py --plants field:0 field:1:building --orders queue
    python packages/cadlab/benchmarks/review.py --real DIR      also each scene.usdc with scene.truth.json below DIR

The graph is made anew at every tenth decision (``--every``) and wherever a figure is taken; between them labels follow
at once, but units and lines stay, which saves most of the time.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import cast

import numpy as np
from _timing import machine

import cadgraph
from cadgraph._io.progress import Progress, quiet
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.precedence import lay_corrections
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.review.question import Option, Question, label_edits
from cadgraph.session.review.queue import review_queue
from cadlab.evaluate.pairing import Pairing, pair
from cadlab.markdown import table
from cadplants import STYLES, degrade, make
from cadplants.faults.omissions import omitted
from cadplants.presets.authoring_systems import SYSTEMS, draw_system
from cadplants.presets.preset import PRESETS
from cadplants.truth.truth_writer import truth_of

MARKS = (0, 5, 10, 20, 40, 60, 100)
WRONG = 0.05  # share of the parts whose labels are made wrong
Said = tuple[str, str | None]


def plant_of(spec: str) -> tuple[Scene, Truth]:
    """The scene and truth of ``PRESET[:SEED[:HAND]]``; the hand is a modelling style or an authoring system."""
    preset, seed, hand = [*spec.split(":"), "", ""][:3]
    number = int(seed or 0)
    if hand in SYSTEMS and hand not in STYLES:
        drawn = draw_system(np.random.default_rng([number, 26]), hand)
        plant = degrade(omitted(PRESETS[preset](number, drawn.style), drawn.omissions), drawn.defects, number)
    else:
        plant = make(preset, number, hand or None)
    return plant.scene(), Truth.from_json(truth_of(plant))


class QuickSession(cadgraph.Session):
    """A session that makes its units and lines anew only when it is told to; labels follow at once."""

    whole: SceneGraph | None = None

    def make_graph(self, progress: Progress = quiet) -> SceneGraph:
        """The graph with the labels as they are now."""
        if self._graph is None and self.whole is not None and self._known is not None:
            labels = lay_corrections(self._known, self.labeling, self.analysis, self.corrections).labels
            nodes = iter(labels)
            laid = [_with(node, next(nodes)) if isinstance(node, Part) else node for node in self.whole.document.nodes]
            self._graph = SceneGraph(self.whole.document.model_copy(update={"nodes": tuple(laid)}))
        if self._graph is None:
            self.whole = super().make_graph(progress)
        return super().make_graph(progress)

    def renew(self) -> SceneGraph:
        """The whole graph made anew."""
        self.whole = self._graph = None
        return self.graph


def _with(node: Part, label: Label | None) -> Part:
    """A part with its label as corrected, else as it was."""
    return node.model_copy(update={"label": label}) if label is not None and label.source == "human" else node


class WrongLabeler:
    """The true labels, some of them wrong.

    Args:
        truth: of the scene.
        how: ``shape`` or ``single``.
        seed: of what is wrong.
    """

    def __init__(self, truth: Truth, how: str, seed: int) -> None:
        self._true = {row.mesh: (row.group, row.name) for row in truth.meshes if row.group is not None}
        self._how, self._rng = how, np.random.default_rng([seed, 41])

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts; see ``Labeler``."""
        own = EmbeddedLabeler().label(parts, contacts, vocabulary)
        said = [_completed(self._true.get(path), own.answers[k]) for k, path in enumerate(parts.scene.paths)]
        wrong = self._singles(said) if self._how == "single" else self._shapes(parts, own.probabilities, said)
        said = [wrong.get(part, one) for part, one in enumerate(said)]
        sure = np.round(self._rng.uniform(0.85, 0.99, len(said)), 3).tolist()
        return Labeling.judge(
            [None if one is None else Label(*one, sure[part], "somebody") for part, one in enumerate(said)]
        )

    def _singles(self, said: Sequence[Said | None]) -> dict[int, Said]:
        """Parts at random, each with the label of another part."""
        known = [part for part, one in enumerate(said) if one is not None]
        labels = [one for one in said if one is not None]
        found: dict[int, Said] = {}
        for part in self._rng.permutation(known)[: round(WRONG * len(known))].tolist():
            others = [one for one in labels if one != said[part]]
            if others:
                found[part] = others[int(self._rng.integers(len(others)))]
        return found

    def _shapes(self, parts: Parts, probable: Probabilities | None, said: Sequence[Said | None]) -> dict[int, Said]:
        """All repeats of shapes at random, each shape as what the embedded labeler might take it for."""
        known = np.array([one is not None for one in said])
        goal, found = round(WRONG * known.sum()), dict[int, Said]()
        for shape in self._rng.permutation(np.unique(parts.shape)).tolist():
            members = np.flatnonzero((parts.shape == shape) & known).tolist()
            if probable is None or not members or len(found) + len(members) > 1.2 * goal:
                continue
            chance = np.sqrt(probable.values[members[0]])
            chance[[k for k, one in enumerate(probable.classes) if one == said[members[0]]]] = 0.0
            drawn = probable.classes[int(self._rng.choice(len(chance), p=chance / chance.sum()))]
            found.update(dict.fromkeys(members, drawn))
            if len(found) >= goal:
                break
        return found


def _completed(true: Said | None, own: Label | None) -> Said | None:
    """A true label; where the truth leaves the name open, the labeler's if its group is right."""
    if true is None or true[1] is not None or own is None or own.group != true[0]:
        return true
    return own.said


@dataclass
class Run:
    """What came of answering questions.

    Args:
        wrong: parts with a wrong group or name after so many decisions.
        n: parts whose truth is known.
        decisions: that were made.
        useful: of these, questions about a part that was wrong.
        offered: of these, with the right answer among the options.
        elsewhere: of the decisions, questions about the network, which were passed over.
        unknown: questions about parts whose truth nobody knows, which were passed over and not counted.
        seconds: that the queue took each time.
        asked_with_options: whether the order offers answers.
    """

    n: int = 0
    decisions: int = 0
    useful: int = 0
    offered: int = 0
    elsewhere: int = 0
    unknown: int = 0
    wrong: dict[int, int] = field(default_factory=dict)
    seconds: list[float] = field(default_factory=list)
    asked_with_options: bool = True

    def cells(self) -> list[str]:
        """Accuracy at each mark, and the rest."""
        shares = [f"{1 - self._at(mark) / max(self.n, 1):.2%}" for mark in MARKS]
        done = next((str(k) for k, wrong in sorted(self.wrong.items()) if wrong == 0), f"{self._at(MARKS[-1])} left")
        right = f"{self.offered} of {self.useful}" if self.asked_with_options else "-"
        return [*shares, done, str(self.useful), right, str(self.elsewhere), f"{np.median(self.seconds or [0]):.2f}"]

    def _at(self, mark: int) -> int:
        return self.wrong[max(k for k in self.wrong if k <= mark)]


def is_right(said: Said | None, true: Said) -> bool:
    """Whether a label is right: the name, too, where it is known."""
    return said is not None and said[0] == true[0] and true[1] in (None, said[1])


def truths_of(pairing: Pairing) -> dict[str, Said]:
    """The true label of each part by its largest mesh's path, as ``cadlab evaluate`` has it."""
    found = {}
    for part, mesh in pairing.head.items():
        row = pairing.rows[mesh]
        if row.group is not None:
            found[pairing.graph.part(part).meshes[0]] = (row.group, row.name)
    return found


def count_wrong(graph: SceneGraph, truth: Truth) -> int:
    """How many parts have a wrong group or name."""
    pairing = pair(graph, truth)
    true = truths_of(pairing)
    return sum(
        not is_right(pairing.label(part.id), true[part.meshes[0]]) for part in graph.parts() if part.meshes[0] in true
    )


def questions(session: QuickSession, order: str, skipped: set[str], rng: np.random.Generator) -> Iterator[Question]:
    """What is asked next."""
    if order == "queue":
        yield from review_queue(session, 50, skipped)
        return
    asked: dict[tuple[str, Said | None], list[Part]] = {}
    for part in session.graph.parts():
        if not part.ground and not (part.label is not None and part.label.source == "human"):
            asked.setdefault((part.shape, part.label.said if part.label is not None else None), []).append(part)
    groups = list(asked.values())
    if order == "random":
        groups = [groups[k] for k in rng.permutation(len(groups)).tolist()]
    else:
        groups.sort(key=lambda group: group[0].label.confidence if group[0].label is not None else 0.0)
    for first, *others in groups:
        question = Question(
            f"label:{first.meshes[0]}", "label", "", "", (first.id,), tuple(other.id for other in others), 0.0, ()
        )
        if question.id not in skipped:
            yield question


def answer(question: Question, true: Said, said: Said | None) -> tuple[Option, bool]:
    """The option that is right, and whether it was offered."""
    for option in question.options:
        edit = option.edits[0]
        if edit["kind"] == "label" and is_right((edit["group"], edit["name"]), true):
            return option, True
    chosen = said if said is not None and is_right(said, true) else true
    return Option("", None, label_edits((*question.parts, *question.alike), *chosen)), False


def review(session: QuickSession, truth: Truth, order: str, most: int, every: int, verbose: bool = False) -> Run:
    """Answers questions until so many decisions are made or nothing is wrong."""
    graph = session.renew()
    true = truths_of(pair(graph, truth))
    run, skipped, rng = Run(n=len(true), asked_with_options=order == "queue"), set[str](), np.random.default_rng(7)
    run.wrong[0] = count_wrong(graph, truth)
    while run.decisions < most and run.wrong[max(run.wrong)]:
        start = time.perf_counter()
        question = next(iter(questions(session, order, skipped, rng)), None)
        run.seconds.append(time.perf_counter() - start)
        if question is None:
            break
        about_label = question.id.startswith("label:")
        run.decisions += not about_label or _shown(session, question) in true
        if not about_label:
            run.elsewhere += 1
            skipped.add(question.id)
        elif _shown(session, question) not in true:
            run.unknown += 1
            skipped.add(question.id)
            continue
        else:
            _decide(session, question, true[_shown(session, question)], run, verbose)
        whole = run.decisions in MARKS or run.decisions % every == 0
        run.wrong[run.decisions] = count_wrong(session.renew() if whole else session.graph, truth)
    run.wrong[run.decisions] = count_wrong(session.renew(), truth)
    return run


def _shown(session: QuickSession, question: Question) -> str:
    return session.graph.part(question.parts[0]).meshes[0]


def _decide(session: QuickSession, question: Question, true: Said, run: Run, verbose: bool) -> None:
    """Answers one question."""
    label = session.graph.part(question.parts[0]).label
    said = label.said if label is not None else None
    option, offered = answer(question, true, said)
    useful = not is_right(said, true)
    run.useful += useful
    run.offered += useful and offered
    session.apply(option.edits)
    if verbose:
        how = "" if useful else " (right as it is)"
        told = f"{question.title} -> {true[1]}{how}, {1 + len(question.alike)} parts: {question.why}"
        print(f"{run.decisions:3d} {question.kind} {told}", flush=True)


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plants", nargs="*", default=["field:0"])
    parser.add_argument("--real", type=Path)
    parser.add_argument("--wrong", nargs="*", default=["own", "shape", "single"])
    parser.add_argument("--orders", nargs="*", default=["queue", "confidence", "random"])
    parser.add_argument("--most", type=int, default=MARKS[-1])
    parser.add_argument("--every", type=int, default=10)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    print(machine() + "\n")
    sources = [(spec, plant_of(spec)) for spec in options.plants]
    for file in sorted(options.real.glob("*/scene.truth.json")) if options.real else ():
        sources.append((file.parent.name, (cadgraph.load(file.with_name("scene.usdc")), Truth.load(file))))
    rows = []
    for name, (scene, truth) in sources:
        for how in options.wrong:
            for order in options.orders:
                labeler = None if how == "own" else WrongLabeler(truth, how, 0)
                session = cast("QuickSession", QuickSession.start(scene, labeler=labeler))
                run = review(session, truth, order, options.most, options.every, options.verbose)
                rows.append([name, how, order, str(run.n), *run.cells()])
                print(" | ".join(rows[-1]), flush=True)
    done = ("all right after", "about wrong labels", "right answer offered", "about the network", "queue [s]")
    titles = ["plant", "wrong labels", "order", "parts", *map(str, MARKS), *done]
    print("\n" + "\n".join(table(titles, rows)))


if __name__ == "__main__":
    main()
