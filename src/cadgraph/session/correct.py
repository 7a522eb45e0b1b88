"""Correcting a finished graph: one part gets another label, others like it follow, and the folder is written anew."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.progress import Progress, quiet
from cadgraph._io.run_folder import results_folder
from cadgraph.model.corrections import CORRECTIONS, read_corrections, write_corrections
from cadgraph.model.given_labels import split_label
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.reopen import FormerLabeler, config_of, find_source, reopen
from cadgraph.session.run import Clock, Outcome, write_results
from cadgraph.session.session import Session, changed_parts

__all__ = ["Amendment", "amend"]


@dataclass(frozen=True)
class Amendment:
    """What a correction changed.

    Args:
        outcome: of writing the folder anew.
        part: that was corrected, as it is now.
        changed: all parts with another label than before, itself included, as they are now.
    """

    outcome: Outcome
    part: Part
    changed: tuple[Part, ...]


def amend(
    folder: str | Path,
    part: str,
    label: str | None,
    *,
    this_only: bool = False,
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Amendment:
    """Corrects the label of one part of a graph, and of others like it; the folder's results are written anew.

    The correction is kept in ``corrections.json`` beside the graph; a later build into the folder applies it again.
    Several corrections of one scene are quicker in a :class:`~cadgraph.session.session.Session`.

    Args:
        folder: what ``cadgraph build`` wrote.
        part: id of the part, or source path of one of its meshes.
        label: ``group/name``, a group, or a name that only one group has; None takes an earlier correction back.
        this_only: whether others keep their labels.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        ValueError: the graph has no such part (``UnknownNode``), or there is no correction of it to take back.
        LabelError: the label is not in the graph's vocabulary; the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    before = SceneGraph.load(folder)
    node = before.part(part)
    tree = Vocabulary.from_json(before.document.vocabulary, f"{folder}: vocabulary of the graph")
    if label is not None:
        split_label(label, tree)
    clock = Clock(progress)
    with results_folder(Path(folder) if Path(folder).is_dir() else Path(folder).parent) as target:
        if label is None and not any(one.mesh in node.meshes for one in read_corrections(target, tree)):
            raise ValueError(f"{part}: nobody corrected this part itself; 'cadgraph explain' names the one that was")
        config = config_of(folder)
        source = find_source(before, target, scene)
        former = FormerLabeler(before) if config.lvlm.ask != "never" else None
        session = reopen(before, target, source, config, former, clock)
        mesh = node.meshes[0]
        change = session.forget(mesh) if label is None else session.correct(mesh, label, this_only=this_only)
        outcome = _write(session, source, target, report, clock)
    now = outcome.graph
    return Amendment(outcome, change.part or now.part(mesh), changed_parts(before, now))


def _write(session: Session, source: Path, target: Path, report: bool, clock: Clock) -> Outcome:
    """The results with the corrections beside them, or neither."""
    file = target / CORRECTIONS
    old = file.read_bytes() if file.exists() else None
    write_corrections(session.corrections, file)
    try:
        return write_results(session, source, target, report, clock)
    except BaseException:
        # A correction that the graph does not show must not wait for a later build.
        if old is None:
            file.unlink(missing_ok=True)
        else:
            write_atomically(file, old)
        raise
