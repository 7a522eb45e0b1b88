"""Trains the embedded labeler's network: ``python -m cadlab.training``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.labelers import embedded
from cadgraph.labelers.embedded.model import write_model
from cadlab.training.course import Course, run_course
from cadlab.training.page import write_page
from cadlab.training.real import read_real_parts
from cadplants.assortment import FAMILIES

_MODEL = Path(embedded.__file__).with_name("model.npz")
"""The model that the labeler reads; ``make train`` writes it anew in place."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command."""
    usual = Course()
    parser = argparse.ArgumentParser(prog="python -m cadlab.training", description="Trains the embedded labeler.")
    parser.add_argument("--model", type=Path, default=_MODEL, help="what to write")
    parser.add_argument("--page", type=Path, default=Path("docs/labeler.md"), help="where the figures go")
    parser.add_argument("--plants-in", type=Path, default=Path(".training"), help="folder that keeps generated plants")
    parser.add_argument("--real", type=Path, help="folder with real STEP parts to try the model on")
    parser.add_argument("--plants", type=int, default=usual.plants)
    parser.add_argument("--strangers", type=int, default=usual.distractors)
    parser.add_argument("--members", type=int, default=usual.members)
    parser.add_argument("--folds", type=int, default=usual.folds)
    parser.add_argument("--seeds", type=int, default=usual.seeds)
    parser.add_argument("--epochs", type=int, default=usual.recipe.epochs)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args(arguments)
    course = replace(
        usual, plants=given.plants, distractors=given.distractors,
        members=given.members, folds=given.folds, seeds=given.seeds,
        recipe=replace(usual.recipe, epochs=given.epochs),
    )  # fmt: skip
    trials = run_course(course, given.plants_in, given.workers, _tell)
    beside = given.model.with_suffix(".part")
    write_model(trials.model, beside)
    beside.replace(given.model)
    real = read_real_parts(given.real) if given.real else []
    page = write_page(trials, real, given.model.stat().st_size, len(FAMILIES))
    write_atomically(given.page, page)
    sys.stdout.write(f"wrote {given.model} and {given.page}\n")


def _tell(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
