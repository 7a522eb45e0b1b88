"""What a user corrects beside labels: units, joints, directions, tags, the ground; undo, redo, and the list of all."""

from __future__ import annotations

import getpass
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import WhoOption, WhyOption
from cadgraph.cli.panels import CORRECT
from cadgraph.cli.screen import bars, out, say_json, tell_consequences, tell_lost, tell_state

if TYPE_CHECKING:
    from cadgraph.model.graph import SceneGraph

_SHOWN = 8  # parts that are named when a correction spreads

_Pair = tuple[str, str] | None
_Folder = Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote.")]


def _pair(name: str, metavar: str, text: str) -> Any:
    return typer.Option(name, metavar=metavar, help=text)


@app.command(rich_help_panel=CORRECT)
def correct(
    folder: _Folder,
    label: Annotated[
        list[str] | None,
        typer.Option("--label", metavar="PART=LABEL", help="What a part is, as relabel says it. May be repeated."),
    ] = None,
    forget: Annotated[
        list[str] | None, typer.Option("--forget", metavar="PART", help="Take the label of a part back.")
    ] = None,
    tag: Annotated[
        list[str] | None,
        typer.Option("--tag", metavar="UNIT=TAG", help="What the plant calls a unit: V-001=V-4711. May be repeated."),
    ] = None,
    device: Annotated[
        list[str] | None,
        typer.Option("--device", metavar="UNIT=KIND", help="What a unit is: V-002='check valve'. May be repeated."),
    ] = None,
    keep_tags: Annotated[
        bool, typer.Option("--keep-tags", help="Units keep the tags that they have now, whatever is corrected later.")
    ] = False,
    merge: Annotated[_Pair, _pair("--merge", "A B", "Two units are one; or a part belongs to a unit.")] = None,
    split: Annotated[
        list[str] | None,
        typer.Option("--split", metavar="PART", help="A part is a unit of its own; repeated: these parts are."),
    ] = None,
    join: Annotated[_Pair, _pair("--join", "PART PART", "Two parts join along the pipes, across a gap.")] = None,
    cut: Annotated[_Pair, _pair("--cut", "A B", "Two parts, or a part and a unit, don't join.")] = None,
    flow: Annotated[
        list[str] | None,
        typer.Option(
            "--flow",
            metavar="A -> B",
            help="Which way it flows between two that are connected: 'P-001 -> V-002'; 'P-001 ? V-002' takes it back.",
        ),
    ] = None,
    ground: Annotated[
        list[str] | None, typer.Option("--ground", metavar="PART", help="A part is the ground. May be repeated.")
    ] = None,
    no_ground: Annotated[
        list[str] | None, typer.Option("--no-ground", metavar="PART", help="A part is not the ground.")
    ] = None,
    this_only: Annotated[
        bool, typer.Option("--this-only", help="With --label: leave other parts as they are.")
    ] = False,
    undo: Annotated[bool, typer.Option("--undo", help="Take the last correction back.")] = False,
    redo: Annotated[bool, typer.Option("--redo", help="Do again what was undone last.")] = False,
    who: WhoOption = None,
    why: WhyOption = "",
    scene: Annotated[
        Path | None, typer.Option("--scene", metavar="FILE", help="The scene, if it has been moved.")
    ] = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
) -> None:
    """Correct units, joints, directions of flow, tags and the ground; also several labels at once (relabel: one).

    Parts are named by id or source path, units by tag. All that is given is one correction: it is done as a whole or,
    where something can't be, not at all. It is kept in corrections.json in the folder, which a later 'cadgraph build'
    into it applies again; 'cadgraph corrections' lists all.
    """
    from cadgraph.model.graph import SceneGraph
    from cadgraph.session.correct import apply_edits, step_back_or_forth

    graph = SceneGraph.load(folder)
    edits = [
        *_labels(label or [], forget or [], this_only),
        *_names(graph, folder, tag or [], device or [], keep_tags),
        *_units(graph, merge, split),
        *_joints(graph, join, cut),
        *(_flow(one) for one in flow or []),
        *({"kind": "ground", "part": part, "ground": True} for part in ground or []),
        *({"kind": "ground", "part": part, "ground": False} for part in no_ground or []),
    ]
    if undo + redo + bool(edits) != 1:
        raise ValueError("say what to correct, as --tag V-001=V-4711, or one of --undo and --redo alone")
    name = user_name() if who is None else who
    with bars() as progress:
        more: dict[str, Any] = {"who": name, "why": why, "scene": scene, "report": report, "progress": progress}
        if edits:
            done = apply_edits(folder, edits, **more)
        else:
            done = step_back_or_forth(folder, "undo" if undo else "redo", **more)
    out.print(f"[bold]{escape(done.message)}[/]")
    for part in done.changed[:_SHOWN]:
        said = "without a label" if part.label is None else "/".join(filter(None, part.label.said))
        out.print(f"[dim]{part.id:<12}[/]{escape(said)}")
    if len(done.changed) > _SHOWN:
        out.print(f"{len(done.changed) - _SHOWN:,} more are not shown")
    # The message has all of it but what disagrees, within its sentence; undone and redone it has none of it.
    tell_consequences([one for one in done.consequences if one not in done.message])
    tell_lost(done.lost)
    tell_state(done.outcome.earlier, done.outcome.removed)


@app.command(rich_help_panel=CORRECT)
def corrections(
    folder: _Folder, as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False
) -> None:
    """List all corrections of a folder, the latest first: when, who, what, why; and those that no longer fit."""
    from cadgraph.model.corrections import read_history
    from cadgraph.model.edits import LOST
    from cadgraph.model.graph import SceneGraph

    rows = read_history(folder).audit()
    lost = [one.message for one in SceneGraph.load(folder).diagnostics if one.code == LOST]
    if as_json:
        say_json({"corrections": rows, "lost": lost})
        return
    for row in rows:
        told = f"{row['what']}: {row['why']}" if row["why"] else row["what"]
        state = " [yellow](undone)[/]" if row["undone"] else ""
        when, who = row["when"] or "-", row["who"] or "-"
        out.print(f"[dim]{row['id']:>4} {escape(when):<20} {escape(who)}[/] {escape(told)}{state}")
    out.print(f"{len(rows):,} in all" if rows else "nothing was corrected")
    tell_lost(lost)


def user_name() -> str:
    """The name that somebody is logged in by; empty where there is none."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def _labels(labels: list[str], forget: list[str], this_only: bool) -> list[dict[str, Any]]:
    sides = [_sides("label", one) for one in labels]
    said = [{"kind": "label", "part": part, "group": label, "this_only": this_only} for part, label in sides]
    return [*said, *({"kind": "forget", "part": part} for part in forget)]


def _names(graph: SceneGraph, folder: Path, tags: list[str], devices: list[str], keep: bool) -> list[Mapping[str, Any]]:
    """What units are called, and what they are."""
    from cadgraph.session.correct import edits_to_keep_tags

    called: list[Mapping[str, Any]] = [
        dict(zip(("kind", "unit", kind), (kind, *_sides(kind, one)), strict=True))
        for kind, texts in (("tag", tags), ("device", devices))
        for one in texts
    ]
    return [*called, *(edits_to_keep_tags(graph, folder) if keep else [])]


def _units(graph: SceneGraph, merge: _Pair, split: list[str] | None) -> list[dict[str, Any]]:
    merged = [{"kind": "merge", "parts": [part for one in merge for part in _parts(graph, one)]}] if merge else []
    return [*merged, *([{"kind": "split", "parts": split}] if split else [])]


def _joints(graph: SceneGraph, join: _Pair, cut: _Pair) -> list[dict[str, Any]]:
    joined = [{"kind": "join", "first": join[0], "second": join[1]}] if join else []
    return [*joined, *(_cuts(graph, *cut) if cut else [])]


def _sides(kind: str, text: str) -> tuple[str, str]:
    first, equals, second = text.partition("=")
    if not (first.strip() and equals and second.strip()):
        examples = {"label": "part-00012=Valve assembly/handwheel", "device": "V-002='check valve'"}
        example = examples.get(kind, "V-001=V-4711")
        raise ValueError(f"--{kind} {text}: write it as {example}")
    return first.strip(), second.strip()


def _flow(text: str) -> dict[str, Any]:
    """A direction of flow: from one to the other, or taken back."""
    mark = "->" if "->" in text else "?"
    source, _, target = (side.strip() for side in text.partition(mark))
    if not source or not target:
        raise ValueError(f"--flow {text!r} is no flow; write 'P-001 -> V-002', or 'P-001 ? V-002' to take one back")
    flow = "forward" if mark == "->" else "unknown"
    return {"kind": "direction", "source": source, "target": target, "flow": flow}


def _parts(graph: SceneGraph, which: str) -> list[str]:
    """The ids of the parts of a unit, or of a part alone."""
    from cadgraph.model.records import Part, Unit

    found = graph.find(which, Part, Unit)
    return list(found.parts) if isinstance(found, Unit) else [found.id]


def _cuts(graph: SceneGraph, first: str, second: str) -> list[dict[str, Any]]:
    """All joints between two parts, or units."""
    ones, others = set(_parts(graph, first)), set(_parts(graph, second))
    pairs = [(joint.first, joint.second) for joint in graph.joints(made=True)]
    found = [(a, b) for a, b in pairs if (a in ones and b in others) or (a in others and b in ones)]
    if not found:
        raise ValueError(f"{first} and {second} are not joined; 'cadgraph explain' lists what joins what")
    return [{"kind": "cut", "first": a, "second": b} for a, b in dict.fromkeys(found)]
