"""Trains the embedded labeler's network: ``python -m cadlab.training``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import cadlab
from cadgraph._io.atomic import write_atomically
from cadgraph.labelers import embedded
from cadgraph.labelers.embedded.model import write_model
from cadlab.training.course import Course, run_course, source_digest
from cadlab.training.page import write_page
from cadlab.training.real import read_modelled_plants, read_real_parts, read_real_plants
from cadlab.training.sheet import draw_mistakes
from cadplants.presets.taste import ALL_FAMILIES, LAID

_MODEL = Path(embedded.__file__).with_name("model.npz")
"""The model that the labeler reads; ``make train`` writes it anew in place."""
_MODELLED = Path(cadlab.__file__).parents[2] / "training_plants"


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command."""
    usual = Course()
    parser = argparse.ArgumentParser(prog="python -m cadlab.training", description="Trains the embedded labeler.")
    parser.add_argument("--model", type=Path, default=_MODEL, help="what to write")
    parser.add_argument("--page", type=Path, default=Path("docs/labeler.md"), help="where the figures go")
    parser.add_argument("--plants-in", type=Path, default=Path(".training"), help="folder that keeps generated plants")
    parser.add_argument("--sheet", type=Path, default=Path("docs/labeler_mistakes.jpg"), help="where the pictures go")
    parser.add_argument(
        "--real", type=Path,
        help="folder with real plants (NAME/scene.usdc, NAME/scene.truth.json) to try the model on, and with single "
        "parts (parts/labels.csv), of which those of open licences are learnt from",
    )  # fmt: skip
    parser.add_argument(
        "--modelled", type=Path, default=_MODELLED,
        help="folder with plants of other modellers to learn from (MODELLER/NAME/scene.usdc, scene.truth.json)",
    )  # fmt: skip
    parser.add_argument("--plants", type=int, default=usual.plants)
    parser.add_argument("--drawn", type=int, default=usual.drawn)
    parser.add_argument("--others", type=int, default=usual.others)
    parser.add_argument("--members", type=int, default=usual.members)
    parser.add_argument("--draws", type=int, default=usual.draws)
    parser.add_argument("--folds", type=int, default=usual.folds)
    parser.add_argument("--seeds", type=int, default=usual.seeds)
    parser.add_argument("--epochs", type=int, default=usual.recipe.epochs)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--no-ablations", action="store_true", help="train no networks that lack something")
    given = parser.parse_args(arguments)
    course = replace(
        usual, plants=given.plants, drawn=given.drawn, others=given.others,
        members=given.members, draws=given.draws, folds=given.folds, seeds=given.seeds,
        ablations=not given.no_ablations, recipe=replace(usual.recipe, epochs=given.epochs),
    )  # fmt: skip
    plants = read_real_plants(given.real) if given.real else []
    kept = given.plants_in / source_digest()
    parts = read_real_parts(given.real / "parts", kept) if given.real else []
    modelled = read_modelled_plants(given.modelled, kept, given.workers)
    trials = run_course(course, given.plants_in, plants, parts, modelled, given.workers, _tell)
    beside = given.model.with_suffix(".part")
    write_model(trials.model, beside)
    beside.replace(given.model)
    if plants:
        draw_mistakes(plants, trials.real, given.sheet)
    drawn, sheet = len(ALL_FAMILIES) - len(LAID), given.sheet.name if plants else ""
    page = write_page(trials, parts, given.model.stat().st_size, drawn, sheet)
    write_atomically(given.page, page)
    sys.stdout.write(f"wrote {given.model} and {given.page}\n")


def _tell(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
