"""The whole reproduction: every experiment, every picture, one page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

from cadgraph._io.atomic import ensure_writable, write_atomically
from cadgraph._io.progress import Progress, quiet
from cadgraph.config import ReportConfig
from cadgraph.model.records import Connected
from cadlab.reproduce.experiment import LABELINGS, METHODS, Labeling, Subject, Trial, subject_of, try_out
from cadlab.reproduce.page import Findings, Pictures, to_markdown
from cadlab.reproduce.paper import STRUCTURES
from cadlab.reproduce.pictures import draw_trial, save_picture, side_by_side
from cadlab.reproduce.pie import distribution, draw_pies
from cadplants import make
from cadplants.presets.trap import make_bent_pipe, make_platform_and_tanks

__all__ = ["reproduce"]

_PAGE = "reproduction.md"
_FOLDER = "reproduction"
_FULL = ReportConfig(width=1280, height=800)
_HALF = ReportConfig(width=760, height=520)
_SMALL = ReportConfig(width=200, height=140, samples=1)


@dataclass(frozen=True)
class _Scope:
    """How much is done: what stands for the whole plant, which of Table I's structures, sizes of pictures."""

    preset: str
    structures: tuple[str, ...]
    full: ReportConfig
    half: ReportConfig


def reproduce(
    folder: str | Path,
    *,
    preset: str = "field",
    seed: int = 0,
    quick: bool = False,
    labelings: Sequence[Labeling] = LABELINGS,
    progress: Progress = quiet,
) -> Path:
    """Runs the paper's experiments on generated plants and writes their figures beside the paper's.

    The same seed gives the same page and pictures to the byte on one machine; the page holds no times.

    Args:
        folder: gets ``reproduction.md``, and its pictures in ``reproduction/``.
        preset: of the whole plant.
        seed: of all plants.
        quick: only the riser, as whole plant and as the one structure of Table I, with small pictures; for tests.
        labelings: where labels come from; the first must be the true ones.
        progress: called with the name of a stage and the share of it that is done.

    Returns:
        The page.

    Raises:
        OutputError: the folder can't be written.
        ValueError: an unknown preset.
    """
    target = ensure_writable(folder)
    scope = _Scope(preset, tuple(s.id for s in STRUCTURES), _FULL, _HALF)
    if quick:
        scope = _Scope("riser", ("S2",), _SMALL, _SMALL)
    findings = _measure(scope, seed, labelings, progress)
    pictures = _draw(findings, scope, target / _FOLDER, progress)
    write_atomically(target / _PAGE, to_markdown(findings, pictures))
    return target / _PAGE


def _measure(scope: _Scope, seed: int, labelings: Sequence[Labeling], progress: Progress) -> Findings:
    # A preset that is both the whole plant and a structure of Table I is built once.
    subjects: dict[str, Subject] = {}
    presets = [scope.preset, *(s.preset for s in STRUCTURES if s.id in scope.structures)]
    trials: dict[str, tuple[Trial, ...]] = {}
    steps = [
        (name, method, labeling) for name in dict.fromkeys(presets) for method in METHODS for labeling in labelings
    ]
    for done, (name, method, labeling) in enumerate(steps):
        progress("experiments", done / (len(steps) + 1))
        if name not in subjects:
            subjects[name] = subject_of(make(name, seed))
        trials[name] = (*trials.get(name, ()), try_out(subjects[name], method, labeling))
    progress("experiments", len(steps) / (len(steps) + 1))
    traps = {
        name: tuple(try_out(subject_of(plant), method, labelings[0]) for method in METHODS)
        for name, plant in (
            ("split", make_bent_pipe()),
            ("whole", make_bent_pipe(0.005)),
            ("joined", make_platform_and_tanks()),
        )
    }
    progress("experiments", 1)
    return Findings(
        whole=trials[scope.preset],
        structures={s.id: trials[s.preset] for s in STRUCTURES if s.id in scope.structures},
        traps=traps,
        seed=seed,
    )


def _draw(findings: Findings, scope: _Scope, folder: Path, progress: Progress) -> Pictures:
    """Draws and writes all pictures; returns their paths relative to the page, by what they show."""
    images: list[tuple[str, str, Image.Image]] = []
    progress("pictures", 0)
    truly = findings.trial(findings.whole, "exact", true=True)
    images.append(("clusters", "clusters.jpg", draw_trial(truly, scope.full, "clusters")))
    images.append(("pie", "labels.png", _pies(findings)))
    progress("pictures", 0.3)
    for name in ("split", "joined"):
        drawn = [(f"{t.method} mode", draw_trial(t, scope.half, "clusters")) for t in findings.traps[name]]
        images.append((name, f"{name}.jpg", side_by_side(drawn)))
    for done, (name, trials) in enumerate(findings.structures.items()):
        progress("pictures", 0.5 + 0.5 * done / len(findings.structures))
        for trial in trials:
            # Algorithm 1 as the paper draws it; ours where it knows more than Algorithm 1.
            if trial.method == "paper" or trial.graph.of_kind(Connected):
                key = f"{name}-{trial.method}-{trial.labeling.name}"
                image = draw_trial(trial, scope.full, "groups", paper_only=trial.method == "paper")
                images.append((key, f"{key}.jpg", image))
    for _, file, image in images:
        save_picture(image, folder / file)
    progress("pictures", 1)
    return {key: f"{folder.name}/{file}" for key, file, _ in images}


def _pies(findings: Findings) -> Image.Image:
    chosen = [trial for trial in findings.whole if trial.method == "exact"]
    return draw_pies([(trial.labeling.title, distribution(trial.graph)) for trial in chosen])
