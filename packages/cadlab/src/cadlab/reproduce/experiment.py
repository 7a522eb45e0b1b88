"""One plant, built by one method with the labels of one labeler, and measured against its truth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from cadgraph.config import Config
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate import Evaluation, evaluate
from cadlab.evaluate.labels import true_labels
from cadplants import Plant
from cadplants.truth.truth_writer import truth_of

__all__ = ["LABELINGS", "METHODS", "Labeling", "Subject", "Trial", "subject_of", "try_out"]

METHODS = ("paper", "exact")


@dataclass(frozen=True)
class Labeling:
    """A way to get labels.

    Args:
        name: short, for file names.
        title: for people.
        settings: dotted names and values, laid over the defaults.
        true: whether the truth gives the labels.
    """

    name: str
    title: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    true: bool = False


LABELINGS = (
    Labeling("true", "true labels", {"label.labeler": "none"}, true=True),
    Labeling("embedded", "embedded labeler", {"label.labeler": "embedded"}),
)
"""Every labeler that runs without a network; a later one needs a row here."""


@dataclass(frozen=True)
class Subject:
    """What is experimented on.

    Args:
        plant: as generated.
        scene: its meshes.
        truth: with its clusters named.
    """

    plant: Plant
    scene: Scene
    truth: Truth


@dataclass(frozen=True)
class Trial:
    """One experiment and its outcome.

    Args:
        subject: the plant.
        method: ``"paper"`` or ``"exact"``.
        labeling: where its labels come from.
        graph: that was built.
        evaluation: of the graph.
    """

    subject: Subject
    method: str
    labeling: Labeling
    graph: SceneGraph
    evaluation: Evaluation


def subject_of(plant: Plant) -> Subject:
    """Makes a plant ready: its scene and its truth."""
    return Subject(plant, plant.scene(), Truth.from_json(truth_of(plant), plant.name))


def try_out(subject: Subject, method: str, labeling: Labeling) -> Trial:
    """Builds the graph of a plant and measures it."""
    config = Config().replace({**labeling.settings, "method": method})
    graph = build(subject.scene, config, labels=true_labels(subject.truth) if labeling.true else ())
    return Trial(subject, method, labeling, graph, evaluate(graph, subject.truth))
