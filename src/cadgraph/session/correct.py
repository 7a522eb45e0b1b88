"""Correcting a finished graph in its folder: labels, units, joints, directions, tags; the results are written anew."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from cadgraph._io.progress import Progress, quiet
from cadgraph._io.results import new_results
from cadgraph._io.run_folder import results_folder
from cadgraph.model.corrections import read_history
from cadgraph.model.edits import Correction, Tag
from cadgraph.model.given_labels import split_label
from cadgraph.model.graph import SceneGraph, shards_in
from cadgraph.model.records import Part
from cadgraph.model.source_file import find_source
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.reopen import config_of, reopen
from cadgraph.session.requests import EditRequest
from cadgraph.session.run import Clock, Outcome, stage_graph, write_rest
from cadgraph.session.session import Change, Session, changed_parts
from cadgraph.session.told import tell_flow, tell_lines, tell_renamed, tell_units

__all__ = ["Amendment", "amend", "apply_edits", "edits_to_keep_tags", "step_back_or_forth"]


_DISAGREE = ("flow-contradiction", "flow-disagrees")


@dataclass(frozen=True)
class Amendment:
    """What a correction changed.

    Args:
        outcome: of writing the folder anew.
        part: that was corrected, as it is now; None where it was no label of a single part.
        changed: all parts with another label than before, itself included, as they are now.
        message: what was done, in words.
        lost: the corrections in force that don't fit the graph, in words.
        renamed: units of the same parts that have another tag than before, in words.
        consequences: types of unit of which there are more or fewer than before, flow that turned or isn't known any
            more, and reasons for it that newly disagree, in words.
    """

    outcome: Outcome
    part: Part | None
    changed: tuple[Part, ...]
    message: str = ""
    lost: tuple[str, ...] = ()
    renamed: str = ""
    consequences: tuple[str, ...] = ()


def amend(
    folder: str | Path,
    part: str,
    label: str | None,
    *,
    this_only: bool = False,
    who: str = "",
    why: str = "",
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
        who: name of the user.
        why: the reason.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        ValueError: the graph has no such part (``UnknownNode``), or there is no correction of it to take back.
        LabelError: the label is not in the graph's vocabulary.
        LoadError: the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    before, target = _opened(folder)
    node = before.part(part)
    tree = Vocabulary.from_json(before.vocabulary, f"{folder}: vocabulary of the graph")
    if label is not None:
        split_label(label, tree)
    corrected = {edit.mesh for edit in read_history(target, tree).in_force if isinstance(edit, Correction)}
    if label is None and corrected.isdisjoint(node.meshes):
        raise ValueError(f"{part}: nobody corrected this part itself; 'cadgraph explain' names the one that was")
    mesh = node.meshes[0]

    def change(session: Session) -> Change:
        if label is None:
            return session.forget(mesh, who=who, why=why)
        return session.correct(mesh, label, this_only=this_only, who=who, why=why)

    return _changed(before, target, change, scene, report, progress)


def apply_edits(
    folder: str | Path,
    edits: Sequence[Mapping[str, Any] | EditRequest],
    *,
    who: str = "",
    why: str = "",
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Amendment:
    """Corrects one or several things at once, all or nothing; the folder's results are written anew.

    Args:
        folder: what ``cadgraph build`` wrote.
        edits: as :meth:`~cadgraph.session.session.Session.apply` takes them.
        who: name of the user.
        why: the reason.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        ValueError: the graph has no such part, unit or place (``UnknownNode``), or a correction can't be carried out.
        LabelError: a label is not in the graph's vocabulary.
        LoadError: the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    before, target = _opened(folder)
    return _changed(before, target, lambda session: session.apply(edits, who=who, why=why), scene, report, progress)


def edits_to_keep_tags(graph: SceneGraph, folder: str | Path) -> list[Mapping[str, Any]]:
    """The edits by which units keep the tags that they have, whatever is corrected later; see ``apply_edits``.

    Tags that no plant gave are numbers in the order of the parts: where a correction takes one unit away, those after
    it move up.

    Args:
        graph: finished.
        folder: that it lies in.

    Raises:
        ValueError: all units keep their tags already, or there is none.
    """
    given = {edit.tag for edit in read_history(_home(folder)).in_force if isinstance(edit, Tag)}
    edits: list[Mapping[str, Any]] = [
        {"kind": "tag", "unit": unit.id, "tag": unit.tag} for unit in graph.units() if unit.tag not in given
    ]
    if not edits:
        raise ValueError(f"{folder}: no unit whose tag could change: each that there is keeps it by a correction")
    return edits


def step_back_or_forth(
    folder: str | Path,
    step: Literal["undo", "redo"],
    *,
    who: str = "",
    why: str = "",
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Amendment:
    """Undoes the last correction of a folder, or does the one undone last again; the results are written anew.

    Args:
        folder: what ``cadgraph build`` wrote.
        step: which of both.
        who: name of the user.
        why: the reason.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        ValueError: there is nothing to undo, or to do again.
        LoadError: the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    before, target = _opened(folder)
    history = read_history(target)
    if not (history.can_undo if step == "undo" else history.can_redo):
        raise ValueError(f"{target}: nothing to {step}")
    return _changed(before, target, lambda session: getattr(session, step)(who=who, why=why), scene, report, progress)


def _opened(folder: str | Path) -> tuple[SceneGraph, Path]:
    return SceneGraph.load(folder), _home(folder)


def _home(folder: str | Path) -> Path:
    """The folder of a graph, which may be named by its file."""
    return Path(folder) if Path(folder).is_dir() else Path(folder).parent


def _changed(
    before: SceneGraph,
    folder: Path,
    change: Callable[[Session], Change],
    scene: str | Path | None,
    report: bool,
    progress: Progress,
) -> Amendment:
    """Takes the scene of a graph up again, changes something, and writes everything anew."""
    clock = Clock(progress)
    with results_folder(folder) as target:
        config = config_of(folder)
        source = find_source(before.source, target, scene, "--scene")
        # A correction that the graph does not show must not wait for a later build: both come together.
        with new_results(target) as new:
            session = reopen(before, target, source, config, clock, keep=True)
            done = change(session)
            seen, graph = session.analysis.scene, session.make_graph(clock)
            clock("write graph", 0)
            stage_graph(seen, graph, source, target, shard_above=shards_in(target))
            outcome = write_rest(seen, graph, target, new, config.report if report else None, clock)
    return Amendment(
        outcome,
        done.part,
        changed_parts(before, outcome.graph),
        done.message,
        session.lost,
        tell_renamed(before, outcome.graph),
        _consequences(before, outcome.graph),
    )


def _consequences(before: SceneGraph, now: SceneGraph) -> tuple[str, ...]:
    known = {note.message for note in before.diagnostics}
    against = [note.message for note in now.diagnostics if note.code in _DISAGREE and note.message not in known]
    came = tell_units(before, now), tell_flow(before, now), tell_lines(before, now)
    return tuple(filter(None, (*came, *against)))
