"""From the name of a generated plant to questions with answers."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import cadgraph
from cadgraph._io.progress import Progress, quiet
from cadgraph.agents.plant import Plant
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.agentbench import solvers
from cadlab.agentbench.facts import Facts, facts_of_truth
from cadlab.agentbench.oracle import Oracle
from cadlab.agentbench.question_file import PlantRow, QuestionSet, write_questions, write_set
from cadlab.agentbench.questions import Question, draw, rounded
from cadplants.presets.preset import PRESETS, make
from cadplants.truth.truth_writer import truth_of

__all__ = ["DEFAULT_PRESETS", "LABELS", "Labels", "isolations_of", "make_set", "questions_about"]

Labels = Literal["true", "embedded"]
LABELS: tuple[Labels, ...] = ("true", "embedded")
DEFAULT_PRESETS = tuple(sorted(PRESETS.keys() - {"assortment"}))
"""An assortment has lines of random devices, in which a check valve may stand against a pump."""


def make_set(
    folder: Path,
    seed: int = 0,
    presets: Sequence[str] = DEFAULT_PRESETS,
    labels: Sequence[Labels] = LABELS,
    each: int = 3,
    progress: Progress = quiet,
) -> QuestionSet:
    """Generates plants, builds their graphs, and writes questions with the answers.

    Args:
        folder: gets ``set.jsonl`` with the answers, ``questions.jsonl`` without them, and ``plants`` with a folder for
            each graph.
        seed: of plants and questions.
        presets: of the generator.
        labels: which labels the graphs are built with.
        each: most questions of a type about a plant.
        progress: called with the name of a plant and the share of all that is done.

    Returns:
        What was written.

    Raises:
        ValueError: an unknown preset, or nothing to make.
        OutputError: the folder can't be written.
    """
    unknown = sorted(set(presets) - PRESETS.keys())
    if unknown or not presets or not labels or each < 1:
        what = f"unknown preset {unknown[0]!r}; there are" if unknown else "give one of the presets"
        raise ValueError(f"{what} {', '.join(PRESETS)}; labels of {', '.join(LABELS)}; at least one question each")
    rows: list[PlantRow] = []
    questions: list[Question] = []
    for number, preset in enumerate(dict.fromkeys(presets)):
        progress(preset, number / len(presets))
        for row, graph, found in _about_preset(preset, seed, dict.fromkeys(labels), each):
            graph.save(folder / "plants" / row.name)
            rows.append(row)
            questions += found
    made = QuestionSet(seed, each, cadgraph.__version__, tuple(rows), tuple(questions))
    write_set(folder / "set.jsonl", made)
    write_questions(folder / "questions.jsonl", made)
    progress("done", 1.0)
    return made


def _about_preset(
    preset: str, seed: int, labels: Sequence[Labels] | dict[Labels, None], each: int
) -> Iterator[tuple[PlantRow, SceneGraph, list[Question]]]:
    plant = make(preset, seed)
    scene, truth = plant.scene(), Truth.from_json(truth_of(plant))
    named = zip(plant.paths(), plant.components, strict=True)
    given = [GivenLabel(path, part.group, part.name) for path, part in named if part.group]
    for mode in labels:
        graph = build(scene, labels=given if mode == "true" else ())
        facts = facts_of_truth(truth, scene, graph)
        name = f"{preset}-{mode}"
        yield _plant_row(name, preset, seed, mode, facts, graph), graph, questions_about(graph, facts, name, seed, each)


def questions_about(graph: SceneGraph, facts: Facts, name: str, seed: int, each: int) -> list[Question]:
    """Draws questions about a graph, with what is true and what the tools say.

    Args:
        graph: that is asked about.
        facts: of its truth.
        name: of the plant.
        seed: of the choice.
        each: most questions of a type.
    """
    oracle = Oracle(Plant(graph))
    found = []
    for question in draw(facts, name, seed, each):
        said = rounded(oracle.answer(question))
        leaks = None
        if question.type == "isolate" and isinstance(said, list):
            leaks = tuple(solvers.leaks(facts, question.about["unit"], said))
        found.append(replace(question, graph=said, leaks=leaks))
    return found


def isolations_of(graph: SceneGraph, facts: Facts) -> dict[str, list[str]]:
    """For each unit of which the tools say what isolates it, what these valves leave open in truth.

    Args:
        graph: whose units are asked about.
        facts: of its truth.
    """
    oracle = Oracle(Plant(graph))
    piped = [unit.name for unit in facts.units if facts.links[unit.id] and not unit.name.startswith("(")]
    said = {name: oracle.isolate(name) for name in piped}
    return {name: solvers.leaks(facts, name, valves) for name, valves in said.items() if valves is not None}


def _plant_row(name: str, preset: str, seed: int, mode: Labels, facts: Facts, graph: SceneGraph) -> PlantRow:
    text = json.dumps(graph.to_json(), sort_keys=True, ensure_ascii=False).encode("utf-8", "backslashreplace")
    never = [unit.name for unit in facts.units if unit.type == "valve" and not unit.shuts]
    leaks = isolations_of(graph, facts)
    return PlantRow(
        name=name,
        preset=preset,
        seed=seed,
        labels=mode,
        tags={unit.name: unit.id for unit in facts.units if not unit.name.startswith("(")},
        lost=tuple(unit.id for unit in facts.units if unit.name.startswith("(")),
        never=tuple(name for name in never if not name.startswith("(")),
        isolations=len(leaks),
        safe=sum(not each for each in leaks.values()),
        digest=hashlib.sha256(text).hexdigest(),
    )
