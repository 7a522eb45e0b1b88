"""The trained model as it lies in the package: networks, the names they know, and how sure they must be."""

from __future__ import annotations

import hashlib
import json
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from cadgraph._io.arrays import read_arrays
from cadgraph._io.limits import CHECK_PATH, MODEL, read_bytes_within
from cadgraph.errors import LabelError
from cadgraph.geometry.kernels.parallel import in_turn
from cadgraph.labelers.embedded.alike import find_alike
from cadgraph.labelers.embedded.classifier import Classifier, Inputs
from cadgraph.labelers.embedded.descriptor import FORMS, SIZES
from cadgraph.labelers.embedded.features import Observation
from cadgraph.labelers.embedded.surroundings import PLACE_FEATURES, SIDE_FEATURES
from cadgraph.model.scene import Floats

__all__ = ["STRANGE", "VERSION", "Model", "default_model", "inputs_of", "read_model", "write_model"]

VERSION = 2
STRANGE = "strange/strange"
"""The class of what belongs to no plant; it is never given as a label."""

_FILE = "model.npz"
_INPUTS = (*FORMS, *SIZES, *PLACE_FEATURES)
_REMEDY = "reinstall cadgraph, or train it anew with 'make train'"


@dataclass(frozen=True)
class Model:
    """What the embedded labeler has learnt.

    Args:
        members: networks whose scores are averaged.
        classes: ``group/name``, and ``STRANGE``.
        temperature: the mean scores are divided by it, so that confidence means frequency.
        threshold: least confidence of a label of a part that touches others.
        alone: of one that touches nothing: most things that stand by themselves belong to no plant.
        sure: least confidence of a label that is called sure.
        card: how it was made: seeds, settings, figures.
    """

    members: tuple[Classifier, ...]
    classes: tuple[str, ...]
    temperature: float
    threshold: float
    alone: float
    sure: float
    card: Mapping[str, Any] = field(default_factory=dict)

    def probabilities(self, seen: Observation) -> Floats:
        """The probability of each class for each part, ``(n_parts, n_classes)``."""
        around = seen.surroundings
        rounds = max((member.rounds for member in self.members), default=0)
        alike = find_alike(inputs_of(seen), around.sides, around.here, around.there, rounds)
        total: Floats = np.zeros((alike.n_kinds, len(self.classes)))

        def scores_of(number: int) -> Floats:
            member = self.members[number]
            scores = member.answers(member.hidden(alike.inputs), alike.talks[: member.rounds])
            found: Floats = scores[alike.among_last(member.rounds)]
            return found

        # Threads within a product of these sizes wait for each other longer than they save; whole networks side by side
        # do not.
        with threadpool_limits(1, user_api="blas"):
            for scores in in_turn(scores_of, len(self.members)):
                total += scores
        return self.pooled(total)[alike.kinds[-1]]

    def pooled(self, scores: Floats) -> Floats:
        """Probabilities from the scores of all networks together.

        The networks' probabilities are averaged as logarithms: that mean is as sure as each network is by itself, for
        which the temperature was found; the mean of the probabilities themselves is less sure than it is right.

        Args:
            scores: ``(n, n_classes)`` sum over the networks.
        """
        return softmax(scores / (max(len(self.members), 1) * self.temperature))

    def kinship(self, seen: Observation) -> Floats:
        """A point for each part, ``(n_parts, width)`` of length 1: parts of one kind lie close, known or not.

        It is the direction of what the networks make of a part's shape, size and place before neighbours talk.
        """
        inputs = inputs_of(seen)
        hidden = [member.hidden(inputs) for member in self.members]
        units = [rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-12) for rows in hidden]
        points: Floats = np.hstack(units) / np.sqrt(max(len(units), 1)) if units else np.zeros((len(inputs.shape), 0))
        return points


def softmax(scores: Floats) -> Floats:
    """Scores as probabilities, row by row."""
    powers: Floats = scores - scores.max(axis=1, keepdims=True, initial=-np.inf)
    np.exp(powers, out=powers)
    powers /= powers.sum(axis=1, keepdims=True)
    return powers


def inputs_of(seen: Observation) -> Inputs:
    """What a network sees of each part by itself."""
    return Inputs(np.hstack([seen.shapes.forms, seen.shapes.sizes]), seen.shape_of_part, seen.surroundings.places)


def write_model(model: Model, path: str | Path) -> None:
    """Writes a model: plain arrays and one JSON text, nothing that could run."""
    arrays: dict[str, Any] = {}
    for k, member in enumerate(model.members):
        for name, values in member.weights.items():
            # Half precision halves the file; standardisation needs all digits.
            arrays[f"{k}/{name}"] = values.astype(np.float32 if "mean" in name or "spread" in name else np.float16)
    head = {
        "version": VERSION,
        "classes": list(model.classes),
        "temperature": model.temperature,
        "threshold": model.threshold,
        "alone": model.alone,
        "sure": model.sure,
        "rounds": [member.rounds for member in model.members],
        "inputs": _digest(_INPUTS),
        "sides": _digest(SIDE_FEATURES),
        "card": dict(model.card),
    }
    arrays["head"] = np.frombuffer(json.dumps(head, sort_keys=True).encode(), np.uint8)
    with Path(path).open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **arrays)


def read_model(path: str | Path) -> Model:
    """Reads what ``write_model`` wrote.

    Raises:
        LabelError: the file is missing or damaged, or of another version.
    """
    return _parse(
        read_bytes_within(path, MODEL, LabelError, _REMEDY, f"{CHECK_PATH}, or reinstall cadgraph"), str(path)
    )


def _parse(content: bytes, name: str) -> Model:
    try:
        arrays: dict[str, Any] = dict(read_arrays(content, MODEL))
        head = json.loads(arrays.pop("head").tobytes().decode())
        version = head["version"]
    except (ValueError, KeyError, EOFError, OSError, zipfile.BadZipFile, AttributeError, TypeError) as error:
        raise LabelError(f"{name}: the labeler's model is damaged; {_REMEDY}") from error
    if version != VERSION or head.get("inputs") != _digest(_INPUTS) or head.get("sides") != _digest(SIDE_FEATURES):
        raise LabelError(
            f"{name}: the labeler's model is of version {version!r} or of another cadgraph, this one reads version "
            f"{VERSION}; {_REMEDY}"
        )
    try:
        members = tuple(
            Classifier(
                {
                    key.split("/", 1)[1]: values.astype(np.float64)
                    for key, values in arrays.items()
                    if key.startswith(f"{k}/")
                },
                int(rounds),
            )
            for k, rounds in enumerate(head["rounds"])
        )
        return Model(
            members, tuple(map(str, head["classes"])), float(head["temperature"]), float(head["threshold"]),
            float(head["alone"]), float(head["sure"]), head["card"],
        )  # fmt: skip
    except (KeyError, ValueError, TypeError) as error:
        raise LabelError(f"{name}: the labeler's model is damaged; {_REMEDY}") from error


@lru_cache(maxsize=1)
def default_model() -> Model:
    """The model in the package.

    Raises:
        LabelError: it is missing or damaged.
    """
    file = resources.files("cadgraph.labelers.embedded").joinpath(_FILE)
    try:
        content = file.read_bytes()
    except OSError as error:
        raise LabelError(f"{_FILE}: the labeler's model is missing from the package; {_REMEDY}") from error
    return _parse(content, _FILE)


def _digest(names: Sequence[str]) -> str:
    return hashlib.sha256("\n".join(names).encode()).hexdigest()[:16]
