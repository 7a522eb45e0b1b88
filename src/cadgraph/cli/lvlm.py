"""Labels by a vision-language model: label, ask-folder, and the vocabulary: grow, show, check, merge."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.asking import AskingOptions, asks
from cadgraph.cli.options import (
    USE_METADATA,
    AssetRootOption,
    ConfigOption,
    MetadataOption,
    ScaleOption,
    SetOption,
    StrictOption,
    UnitOption,
    UpOption,
    settings_of,
    values_of,
)
from cadgraph.cli.panels import LABEL
from cadgraph.cli.screen import bars, err, out, say, tell

vocabularies = typer.Typer(no_args_is_help=True, help="Grow, show, check or merge the tree of labels.")
app.add_typer(vocabularies, name="vocabulary", rich_help_panel=LABEL)

_OutputOption = Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The new tree (YAML).")]
_TreeArgument = Annotated[
    Path | None, typer.Argument(metavar="FILE", help="A tree (YAML); the built-in one if left out.")
]


@app.command(rich_help_panel=LABEL)
@asks()
def label(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote; labelled anew.")],
    asking: AskingOptions,
    from_folder: Annotated[
        Path | None,
        typer.Option("--from-folder", metavar="FOLDER", help="Read answers beside the questions of a dry run."),
    ] = None,
    batch_results: Annotated[
        list[Path] | None,
        typer.Option("--batch-results", metavar="FILE", help="Read results of a batch. May be repeated."),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option("--scene", metavar="FILE", help="The scene, if it has been moved.")
    ] = None,
    use_metadata: MetadataOption = False,
    settings: SetOption = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
) -> None:
    """Ask a labeler again for the labels of all parts: a model, a folder of answers, the results of a batch.

    Corrections and labels from outside stay. To correct single parts use 'cadgraph relabel' or 'cadgraph correct'.
    """
    from cadgraph.labelers.lvlm.setup import settings_of_questions
    from cadgraph.session.reopen import config_of, relabel

    given = values_of(settings or [])
    more: dict[str, object] = {}
    if from_folder is not None:
        more = {"mode": "folder", "answers": from_folder}
        given = settings_of_questions(from_folder) | given
    elif batch_results:
        more = {"mode": "batch", "results": tuple(batch_results)}
    given |= USE_METADATA if use_metadata else {}
    chosen = asking.settings(config_of(folder).replace(given))
    with bars() as progress:
        labeler = asking.labeler(chosen, folder, progress, **more)
        outcome = relabel(folder, chosen, labeler, scene=scene, report=report, progress=progress)
    if labeler is not None and labeler.only_asks:
        asking.tell_written(labeler, folder)
        return
    tell(outcome)
    asking.tell(labeler, outcome.graph)


@app.command("ask-folder", rich_help_panel=LABEL)
def ask_folder(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote.")],
    to: Annotated[
        Path | None,
        typer.Option(
            "--to",
            metavar="FOLDER",
            show_default="lvlm/questions in FOLDER",
            help="Where the questions are, or go.",
        ),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing new: say what is answered, open, malformed or astray.")
    ] = False,
    everything: Annotated[
        bool, typer.Option("--all", help="Ask about all parts, not only where the embedded labeler is unsure.")
    ] = False,
    hints: Annotated[
        bool, typer.Option("--hints", help="Tell what geometry knows: form, repeats, neighbours.")
    ] = False,
    max_questions: Annotated[
        int | None,
        typer.Option(
            "--max-questions",
            min=0,
            show_default="no limit",
            help="At most so many questions, those that help most.",
        ),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option("--scene", metavar="FILE", help="The scene, if it has been moved.")
    ] = None,
    settings: SetOption = None,
) -> None:
    """Write questions about unsure parts as files for a person or a coding agent to answer, or check the answers.

    The folder of the questions holds a SKILL.md that says how to answer in place. Apply the answers with
    'cadgraph label FOLDER --from-folder QUESTIONS'. With --check the exit status is 1 where an answer can't be used or
    is to no question.
    """
    from cadgraph.labelers.lvlm.setup import FOLDER, QUESTIONS
    from cadgraph.labelers.lvlm.skill import check_answers, write_skill
    from cadgraph.session.reopen import config_of, relabel, vocabulary_of

    questions = to or folder / FOLDER / QUESTIONS
    if check:
        found = check_answers(questions, vocabulary_of(folder))
        for line in found.lines():
            out.print(escape(line))
        if not found.sound:
            raise typer.Exit(1)
        return
    asking = AskingOptions(
        labeler_="lvlm" if everything else "embedded+lvlm", hints=hints, max_questions=max_questions, dry_run=True
    )
    chosen = asking.settings(config_of(folder).replace(values_of(settings or [])))
    with bars() as progress:
        labeler = asking.labeler(chosen, folder, progress, questions=questions)
        relabel(folder, chosen, labeler, scene=scene, progress=progress)
    write_skill(questions, folder)
    found = check_answers(questions, vocabulary_of(folder))
    out.print(
        f"wrote {escape(str(questions))}: {found.counts}; {escape(str(questions / 'SKILL.md'))} says how to answer"
    )


@vocabularies.command("grow")
@asks("labeler_", "votes", "hints", "yes", "batch", "paper_views")
def grow_(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A CAD scene whose things need labels.")],
    output: _OutputOption,
    asking: AskingOptions,
    start: Annotated[
        Path | None, typer.Option("--from", metavar="FILE", help="The tree to begin with; the built-in one by default.")
    ] = None,
    empty: Annotated[bool, typer.Option("--empty", help="Begin with an empty tree, as the paper does.")] = False,
    pictures: Annotated[int, typer.Option(min=1, max=64, help="Overview pictures, shown one after the other.")] = 8,
    config: ConfigOption = None,
    settings: SetOption = None,
    unit: UnitOption = None,
    scale: ScaleOption = None,
    up: UpOption = None,
    asset_roots: AssetRootOption = None,
    strict: StrictOption = False,
) -> None:
    """Show a model overview pictures one after the other, and add the labels that it misses."""
    from cadgraph._io.atomic import write_atomically
    from cadgraph.labelers.lvlm.growth import grow
    from cadgraph.labelers.lvlm.merging import to_yaml
    from cadgraph.labelers.lvlm.setup import make_asking
    from cadgraph.load import load
    from cadgraph.model.vocabulary import Vocabulary, default_vocabulary, read_vocabulary

    if empty and start:
        raise ValueError("--empty and --from contradict each other; give one")
    chosen = asking.settings(
        settings_of(config, settings or [], None, unit, up, scale=scale, strict=strict, asset_roots=asset_roots)
    )
    tree = Vocabulary({}) if empty else read_vocabulary(start) if start else default_vocabulary()
    kept = output.parent / f"{output.stem}-lvlm"
    with bars() as progress:
        progress("read", 0)
        plant = load(scene, chosen.load)
        progress("read", 1)
        growth = grow(
            plant, tree, make_asking(chosen.lvlm, kept, asking.run(progress)), count=pictures, progress=progress
        )
    added = [row for row in growth.merged if row.outcome == "added"]
    if not growth.vocabulary.groups:
        err.print("no label was proposed; nothing was written")
        for name, reason in growth.failures:
            err.print(f"[dim]{escape(name)}: {escape(reason)}[/]")
        raise typer.Exit(2)
    comments = [f"grown from {len(growth.merged)} proposals, {len(added)} of them new; see {output.stem}.added.json"]
    write_atomically(output, to_yaml(growth.vocabulary, comments))
    sources = json.dumps([row.to_json() for row in growth.merged], ensure_ascii=False, indent=1) + "\n"
    write_atomically(output.with_name(f"{output.stem}.added.json"), sources)
    for row in added:
        out.print(f"[bold]{escape(row.group or '')}: {escape(row.name or '')}[/] [dim]{escape(row.wish.source)}[/]")
    for name, reason in growth.failures:
        err.print(f"[dim]{escape(name)}: {escape(reason)}[/]")
    out.print(f"wrote {escape(str(output))}: {len(added)} labels added")


@vocabularies.command("show")
def show_(
    tree: _TreeArgument = None,
    as_yaml: Annotated[
        bool, typer.Option("--yaml", help="As a file for --vocabulary, to begin one of your own from.")
    ] = False,
) -> None:
    """Print a tree of labels."""
    from cadgraph.labelers.lvlm.merging import to_yaml
    from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary

    shown_tree = read_vocabulary(tree) if tree else default_vocabulary()
    if as_yaml:
        say(to_yaml(shown_tree), end="")
        return
    for group, content in shown_tree.groups.items():
        marks = [f"unit: {content.unit}"] if content.unit else []
        marks += ["connector"] if content.connector else []
        shown = f" [dim]({', '.join(marks)})[/]" if marks else ""
        out.print(f"[bold]{escape(group)}[/]{shown}")
        out.print(f"  {escape(', '.join(content.names))}")


@vocabularies.command("check")
def check_(tree: _TreeArgument = None) -> None:
    """Say what is wrong or odd in a tree of labels; ends with 1 where something is."""
    from cadgraph.labelers.lvlm.merging import findings
    from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary

    found = findings(read_vocabulary(tree) if tree else default_vocabulary())
    for line in found:
        out.print(escape(line))
    if found:
        raise typer.Exit(1)
    out.print("nothing to complain of")


@vocabularies.command("merge")
def merge_(
    base: Annotated[Path, typer.Argument(metavar="BASE", help="A tree (YAML), or 'builtin'.")],
    others: Annotated[list[Path], typer.Argument(metavar="OTHER...", help="Trees, or proposals.json of runs.")],
    output: _OutputOption,
) -> None:
    """Merge trees and proposals into one tree; other spellings of a label fold into it."""
    from cadgraph._io.atomic import write_atomically
    from cadgraph.labelers.lvlm.merging import Merged, merge, merge_vocabularies, read_wishes, to_yaml
    from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary

    tree = default_vocabulary() if str(base) == "builtin" else read_vocabulary(base)
    results: list[Merged] = []
    for other in others:
        if other.suffix.lower() in (".yaml", ".yml"):
            tree, merged = merge_vocabularies(tree, read_vocabulary(other), str(other))
        else:
            tree, merged = merge(tree, read_wishes(other))
        results += merged
    write_atomically(output, to_yaml(tree))
    for row in results:
        wish = f"{row.wish.group}: {row.wish.name or '-'}"
        now = "" if row.outcome != "folded" else f" into {row.group}: {row.name or '-'}"
        if row.outcome != "folded" or (row.group, row.name) != (row.wish.group, row.wish.name):
            out.print(f"{row.outcome:<8} {escape(wish)}{escape(now)}")
    out.print(f"wrote {escape(str(output))}")
