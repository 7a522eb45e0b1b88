"""Corrections by an agent: a plant opened for them, each tried out first, kept with who made it and why."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Iterable, Mapping
from contextlib import ExitStack, nullcontext
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import ensure_writable
from cadgraph._io.folder_lock import holding
from cadgraph._io.run_folder import refuse_foreign, tidy
from cadgraph.agents.answer import Answer, AskError, cell, page_of
from cadgraph.agents.plant import Plant
from cadgraph.errors import CadGraphError, OutputError
from cadgraph.model.given_labels import split_label
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import CorrectedEvidence
from cadgraph.model.records import Connected, Part, Unit
from cadgraph.model.scene import Scene
from cadgraph.model.source_file import find_source
from cadgraph.model.vocabulary import spell_label
from cadgraph.serve.saving import Saver
from cadgraph.session.reopen import config_of, reopen
from cadgraph.session.run import write_graph
from cadgraph.session.session import Change, Session
from cadgraph.session.told import tell_renamed

__all__ = ["Desk"]

_MOST_NAMED = 12  # parts or units that an answer names
_PATIENCE = 40.0  # s that a correction waits for the plant to be opened: less than clients have patience
_DELAY = 0.5  # s after a correction that the graph is written: a client that ends may kill the server soon after


class _Stopping(Exception):
    """The work is ended, as the server is."""


class Desk:
    """A folder opened for corrections: no other cadgraph changes it until it is closed. Safe for threads.

    Opening goes on beside: the scene is read, measured and labelled as ``cadgraph view`` does it. Each correction is in
    ``corrections.json`` when it is answered; ``graph.json`` and ``semantics.usda`` follow a moment later.

    Args:
        folder: what ``cadgraph build`` wrote.
        graph: in the folder.
        who: name under which corrections are kept.

    Attributes:
        graph: as corrections have made it; None while the plant is still being opened.
        scene: that it is of; likewise.

    Raises:
        OutputError: another process is at work in the folder, or it can't be written.
    """

    def __init__(self, folder: Path, graph: SceneGraph, who: str) -> None:
        self._folder, self._who = folder, who
        self._source: Path | None = None
        self._session: Session | None = None
        # Of their own, as the session's are others while a correction is tried out.
        self.graph: SceneGraph | None = None
        self.scene: Scene | None = None
        self._failure: CadGraphError | ValueError | OSError | None = None
        self._unsaved: str | None = None
        self._differs = False  # whether the graph is another one than the folder held, and nobody was told
        self._told = "it has just begun"
        self._stopping, self._opened = threading.Event(), threading.Event()
        self._lock = threading.Lock()
        self._held = ExitStack()
        ensure_writable(folder)
        self._held.enter_context(holding(folder))
        try:
            tidy(folder)
            refuse_foreign(folder)
        except OutputError:
            self._held.close()
            raise
        self._saver = Saver(self._save, self._saved, _DELAY)
        self._opener = threading.Thread(target=self._open, args=(graph,), name="cadgraph-opener", daemon=True)
        self._opener.start()

    @property
    def stage(self) -> str:
        """What opening is at, in words."""
        return "ready" if self._session is not None else self._told

    def correct(self, target: str, label: str, why: str, this_only: bool = False, dry_run: bool = True) -> Answer:
        """Says what a part or a unit is, or tries that out.

        Args:
            target: tag or id of a unit, id of a part, or the path of one of its meshes.
            label: ``group/name``, a group, or a name that only one group has; ``""`` takes a correction back.
            why: the reason, kept with the correction.
            this_only: whether parts that look the same keep their labels.
            dry_run: whether nothing is kept; no file changes then.

        Returns:
            What changed, or would.

        Raises:
            AskError: the plant is not opened yet, or has changed in another way meanwhile.
            CadGraphError: there is no such part or label; or it can't be kept.
            ValueError: the correction can't be carried out.
        """
        if not why.strip():
            raise AskError("say why: the reason is kept with the correction, for the people who look at it later")
        session = self._ready()
        with self._lock:
            if session.overtaken:
                session.take_up()
                self._publish(session.graph)
                raise AskError("the corrections were changed by another program meanwhile; ask again what is there now")
            before = session.graph
            if self._differs:
                self._differs = False
                raise AskError(
                    "the graph that was in the folder lacks corrections, or another version made it, and is made anew: "
                    "ids may mean other parts now; ask again what is there, then repeat"
                )
            edits, what = _edits(Plant(before, self._folder), session, target, label, this_only)
            with session.trial() if dry_run else nullcontext():
                change = session.apply(edits, who=self._who, why=why)
                now = session.graph
            if not dry_run:
                self._publish(now)
        return _told(what, change, before, now, dry_run)

    def close(self) -> str | None:
        """Writes what is left to be written and lets the folder go; why that failed, if it did."""
        self._stopping.set()
        self._saver.close()
        self._held.close()
        return self._unsaved

    def _publish(self, graph: SceneGraph) -> None:
        self.graph = graph
        self._saver.give((graph, None if self._session is None else self._session.kept))

    def _ready(self) -> Session:
        if not self._opened.wait(_PATIENCE):
            raise AskError(
                f"the plant is still being opened for corrections ({self._told}); nothing was changed; "
                "repeat this call in half a minute"
            )
        if self._session is None:
            raise AskError(f"nothing can be corrected here: {cell(self._failure, 400)}")
        return self._session

    def _open(self, graph: SceneGraph) -> None:
        try:
            config = config_of(self._folder)
            self._source = find_source(graph.source, self._folder)
            session = reopen(graph, self._folder, self._source, config, self._progress, keep=True)
            now = session.make_graph(self._progress)
            session.prepare()
            # Where the source lies now is no difference.
            self._differs = now.document.model_copy(update={"source": graph.source}) != graph.document
            self.graph, self.scene = now, session.analysis.scene
            self._session = session
        except _Stopping:
            return
        except (CadGraphError, ValueError, OSError) as error:
            self._failure = error
        except MemoryError:
            self._failure = ValueError("there is not enough memory for this scene")
        finally:
            self._opened.set()

    def _progress(self, stage: str, share: float) -> None:
        if self._stopping.is_set():
            raise _Stopping
        if stage:
            self._told = f"{stage}, {share:.0%}"

    def _save(self, content: tuple[SceneGraph, str | None]) -> None:
        if self.scene is not None and self._source is not None:
            graph, corrections = content
            write_graph(self.scene, graph, self._source, self._folder, corrections)

    def _saved(self, failed: str | None) -> None:
        self._unsaved = failed


def _edits(
    plant: Plant, session: Session, target: str, label: str, this_only: bool
) -> tuple[list[Mapping[str, Any]], str]:
    """The corrections that are asked for, and what they say."""
    node = plant.find(target)
    if not isinstance(node, Part | Unit):
        raise AskError(f"{cell(node.id)} is a {node.layer}, which has no label; give a part or a unit")
    parts = (node.id,) if isinstance(node, Part) else node.parts
    group, name = split_label(label, session.vocabulary) if label.strip() else (None, None)
    if len(parts) > 1 and (group is None or name is not None):
        listed = [f"{part} {_said(plant.graph.part(part))}" for part in parts[:_MOST_NAMED]]
        more = f" and {len(parts) - _MOST_NAMED} more" if len(parts) > _MOST_NAMED else ""
        raise AskError(
            f"{plant.called(node.id)} has {len(parts)} parts, and only a group fits them all; name the part: "
            f"{'; '.join(listed)}{more}"
        )
    if group is None:
        return [{"kind": "forget", "part": parts[0]}], f"{parts[0]}: its correction is taken back"
    alone = this_only or len(parts) > 1
    edits = [{"kind": "label", "part": part, "group": group, "name": name, "this_only": alone} for part in parts]
    subject = parts[0] if len(parts) == 1 else f"all {len(parts)} parts of {plant.called(node.id)}"
    return list(edits), f"{subject}: {spell_label(group, name)}"


def _said(part: Part) -> str:
    return "without a label" if part.label is None else cell(spell_label(*part.label.said))


def _told(what: str, change: Change, before: SceneGraph, now: SceneGraph, dry_run: bool) -> Answer:
    """What a correction changed, or would change."""
    gone, new = _difference(_units(before), _units(now))
    renamed = tell_renamed(before, now)
    lines = {graph: len(graph.of_kind(Connected)) for graph in (before, now)}
    changed = [{"part": part.id, "label": _said(part), "corrected": _is_own(part)} for part in change.changed]
    values = {
        "dry_run": dry_run,
        "kept": not dry_run,
        "what": change.message,
        "changed": changed,
        "units_gone": gone,
        "units_new": new,
        "renamed": renamed,
        "connections_before": lines[before],
        "connections_after": lines[now],
        "regrouped": change.regrouped,
    }
    would = "would change" if dry_run else "changed"
    rows = [f"{what}: {len(changed)} label{'s' * (len(changed) != 1)} {would}"]
    rows += [f"  {row['part']}\t{row['label']}" for row in changed[:_MOST_NAMED]]
    rows += [f"  and {len(changed) - _MOST_NAMED} more"] * (len(changed) > _MOST_NAMED)
    rows += [f"units gone: {_named(gone)}"] * bool(gone) + [f"units new: {_named(new)}"] * bool(new)
    if renamed:
        rows.append(f"tags mean other units than before: {renamed}")
    if lines[before] != lines[now]:
        rows.append(f"connections: {lines[before]} before, {lines[now]} after")
    if change.regrouped:
        rows.append("parts and structures were made anew: ids may mean other parts than before")
    head = "dry run, nothing was changed" if dry_run else "kept in corrections.json"
    foot = ["to keep it, repeat with dry_run=false"] if dry_run else ["look again before you rely on earlier answers"]
    return Answer(page_of([head], rows, foot, 1), values)


def _is_own(part: Part) -> bool:
    """Whether somebody corrected this very part."""
    evidence = part.label.evidence if part.label is not None else None
    return isinstance(evidence, CorrectedEvidence) and evidence.mesh is not None


def _units(graph: SceneGraph) -> Counter[str]:
    return Counter(cell(f"{unit.tag} ({unit.kind or unit.unit_type})") for unit in graph.units())


def _difference(before: Counter[str], now: Counter[str]) -> tuple[list[str], list[str]]:
    return sorted((before - now).elements()), sorted((now - before).elements())


def _named(names: Iterable[str]) -> str:
    listed = list(names)
    more = f" and {len(listed) - _MOST_NAMED} more" if len(listed) > _MOST_NAMED else ""
    return ", ".join(listed[:_MOST_NAMED]) + more
