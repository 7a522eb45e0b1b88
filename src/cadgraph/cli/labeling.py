"""A user's own parts and corrections: explain, relabel, and the catalogue: add, list."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.correcting import user_name
from cadgraph.cli.options import (
    AssetRootOption,
    ConfigOption,
    GraphArgument,
    ScaleOption,
    SetOption,
    StrictOption,
    UnitOption,
    UpOption,
    WhoOption,
    WhyOption,
    settings_of,
)
from cadgraph.cli.panels import CORRECT, LABEL, LOOK
from cadgraph.cli.screen import bars, err, out, say_json, tell_consequences, tell_lost, tell_state

catalogs = typer.Typer(no_args_is_help=True, help="Add your own parts to a catalogue, or list one.")
app.add_typer(catalogs, name="catalog", rich_help_panel=LABEL)

if TYPE_CHECKING:
    from cadgraph.model.records import Part

_DEFAULT = Path("parts.cadgraph-catalog")
_SHOWN = 8  # parts that are named when a correction spreads

_PartArgument = Annotated[
    str, typer.Argument(metavar="PART", help="Id of a part (part-00012), or source path of one of its meshes.")
]
_LabelOption = Annotated[
    str | None, typer.Option("--as", metavar="LABEL", help="'group/name', as 'Valve assembly/valve'.")
]
_SceneOption = Annotated[Path | None, typer.Option("--scene", metavar="FILE", help="The scene, if it has been moved.")]
_JsonOption = Annotated[bool, typer.Option("--json", help="Print as JSON.")]


@app.command(rich_help_panel=LOOK)
def explain(
    graph: GraphArgument,
    which: Annotated[
        str,
        typer.Argument(
            metavar="WHICH", help="Id of a part (part-00012) or path of one of its meshes; or tag of a unit (V-003)."
        ),
    ],
    other: Annotated[
        str | None, typer.Argument(metavar="[OTHER]", help="Another unit: say why the two are connected, or not.")
    ] = None,
    as_json: _JsonOption = False,
) -> None:
    """Say why a part has its label, what a unit is joined to, or why two units are connected or not.

    Of a part: evidence, best guesses, neighbours, repeats, unit. Of a unit (or a junction or end of a line): its ports,
    what each is joined to, how sure that is and why, what it lacks for its kind, and the likeliest joints that were not
    made. Of two: the joints on the way between them in order and the weakest of these, or what is missing for a way.
    """
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query.explain import explain_any

    told = explain_any(SceneGraph.load(graph), which, other)
    if as_json:
        say_json(told.to_json())
        return
    for heading, text in told.lines():
        out.print(f"[dim]{heading:<12}[/]{escape(text)}")


@app.command(rich_help_panel=CORRECT)
def relabel(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote.")],
    part: _PartArgument,
    label: _LabelOption = None,
    forget: Annotated[bool, typer.Option("--forget", help="Take the correction of this part back.")] = False,
    this_only: Annotated[bool, typer.Option("--this-only", help="Leave all other parts as they are.")] = False,
    who: WhoOption = None,
    why: WhyOption = "",
    scene: _SceneOption = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
) -> None:
    """Correct the label of one part; its repeats follow, and softly what is much like it.

    For several labels at once, and for all else that can be wrong, there is 'cadgraph correct'. The correction is kept
    in corrections.json in the folder: a later 'cadgraph build' into it applies it again.
    """
    from cadgraph.session.correct import amend

    if (label is None) != forget:
        raise ValueError("say what the part is with --as 'group/name', or take a correction back with --forget")
    with bars() as progress:
        done = amend(
            folder,
            part,
            label,
            this_only=this_only,
            who=user_name() if who is None else who,
            why=why,
            scene=scene,
            report=report,
            progress=progress,
        )
    corrected = done.part or done.outcome.graph.part(part)
    out.print(f"[bold]{corrected.id}[/] is {escape(_said(corrected))} now")
    others = [p for p in done.changed if p.id != corrected.id]
    for p in others[:_SHOWN]:
        why = "" if p.label is None else p.label.evidence.why or p.label.source
        out.print(f"[dim]{p.id:<12}[/]{escape(_said(p))}{escape(f': {why}') if why else ''}")
    more = f", {len(others) - _SHOWN} of them not shown" if len(others) > _SHOWN else ""
    out.print(f"{len(others):,} other parts changed{more}")
    tell_consequences(done.consequences, done.renamed)
    if others and done.consequences and not this_only and not forget:
        out.print("[dim]with --this-only all other parts keep their labels[/]")
    tell_lost(done.lost)
    tell_state(done.outcome.earlier, done.outcome.removed)


def _said(part: Part) -> str:
    from cadgraph.model.vocabulary import spell_label

    return "without a label" if part.label is None else spell_label(part.label.group, part.label.name)


@catalogs.command("add")
def add_(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="CAD files, or folders that 'cadgraph build' wrote.")
    ],
    label: Annotated[
        str | None, typer.Option("--as", metavar="LABEL", help="'group/name'. Graphs bring their own labels.")
    ] = None,
    catalog: Annotated[Path, typer.Option("--catalog", metavar="FILE", help="To add to; made if missing.")] = _DEFAULT,
    merge: Annotated[bool, typer.Option("--merge", help="One entry of a whole file instead of one per part.")] = False,
    only: Annotated[
        str | None, typer.Option("--only", metavar="LABEL", help="Of graphs: parts with this label, whoever gave it.")
    ] = None,
    vocabulary: Annotated[
        Path | None, typer.Option("--vocabulary", metavar="FILE", help="The label tree that must hold --as.")
    ] = None,
    scene: _SceneOption = None,
    config: ConfigOption = None,
    settings: SetOption = None,
    unit: UnitOption = None,
    scale: ScaleOption = None,
    up: UpOption = None,
    asset_roots: AssetRootOption = None,
    strict: StrictOption = False,
) -> None:
    """Add parts to a catalogue, from CAD files under one label or from graphs with theirs.

    A file of several parts gives an entry for each distinct shape, all with the same label; --merge makes one entry of
    the whole file, for devices that plants hold as one mesh. Of a graph the parts that were labelled by hand or from
    outside are taken, or with --only those of one label.
    """
    from cadgraph._io.folder_lock import holding
    from cadgraph.model.catalog import read_catalog, write_catalog
    from cadgraph.model.given_labels import split_label
    from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary
    from cadgraph.session.catalog_builder import EMPTY, take_file, take_graph

    tree = read_vocabulary(vocabulary) if vocabulary else None
    meant = split_label(label, tree) if label is not None else None
    if meant is not None and tree is None and not default_vocabulary().holds(*meant):
        err.print(
            f"[dim]{escape(str(label))} is not in the built-in vocabulary; build with the --vocabulary that has it[/]"
        )
    chosen = settings_of(config, settings or [], None, unit, up, scale=scale, strict=strict, asset_roots=asset_roots)
    wanted = split_label(only, None) if only is not None else None
    # What two add at once must both be in it.
    with holding(catalog.parent):
        whole = read_catalog(catalog) if catalog.exists() else EMPTY
        for file in files:
            if file.is_dir() or file.name == "graph.json":
                if merge:
                    raise ValueError(f"{file}: --merge is for CAD files; a graph has its parts")
                if unit is not None or up is not None or scale is not None:
                    raise ValueError(
                        f"{file}: --unit, --scale and --up are for CAD files; a graph knows how its scene was read"
                    )
                taken = take_graph(whole, file, wanted, meant, scene)
            else:
                if meant is None:
                    raise ValueError(f"{file}: say what it is with --as 'group/name'")
                if only is not None:
                    raise ValueError(f"{file}: --only is for graphs; a CAD file has no labels")
                taken = take_file(whole, file, *meant, merge=merge, config=chosen)
            whole = taken.catalog
            _tell(file, taken, merge)
        write_catalog(whole, catalog)
    out.print(f"wrote {escape(str(catalog))}: {_entries(len(whole.entries))}")


@catalogs.command("list")
def list_(
    catalog: Annotated[Path, typer.Argument(metavar="[FILE]", help="A catalogue.")] = _DEFAULT,
    as_json: _JsonOption = False,
) -> None:
    """Print the entries of a catalogue."""
    from cadgraph.model.catalog import read_catalog, rows_of

    rows = rows_of(read_catalog(catalog))
    if as_json:
        say_json(rows)
        return
    for row in rows:
        size = " x ".join(f"{1000 * x:.0f}" for x in row["size"])
        label = f"{row['group']}/{row['name']}" if row["name"] else row["group"]
        origin = f"{row['file']} {row['mesh']}".strip()
        told = f"{size} mm, {row['n_triangles']:,} triangles, {escape(origin)}"
        out.print(f"[dim]{row['id']}[/] {escape(label)} [dim]{told}[/]")
    out.print(_entries(len(rows)))


def _tell(file: Path, taken: Any, merge: bool) -> None:
    told = [f"{taken.n_parts:,} part{'s' * (taken.n_parts != 1)}", f"{_entries(len(taken.added))} added"]
    told += [f"{taken.known:,} known or repeated"] if taken.known else []
    told += [f"{len(taken.replaced):,} replaced, which had another label"] if taken.replaced else []
    told += [f"{taken.torn:,} shapes left out, which have several labels"] if taken.torn else []
    several = len(taken.added) > 1 and not file.is_dir() and not merge
    hint = " [dim](all with the same label; --merge makes one entry of a file)[/]" if several else ""
    out.print(f"{escape(str(file))}: {', '.join(told)}{hint}")


def _entries(n: int) -> str:
    return f"{n:,} entr{'y' if n == 1 else 'ies'}"
