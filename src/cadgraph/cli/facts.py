"""What a file says of its parts, and what that is taken for: facts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.markup import escape

from cadgraph._io.text import printable
from cadgraph.cli.application import app
from cadgraph.cli.options import (
    AssetRootOption,
    ConfigOption,
    ScaleOption,
    SetOption,
    UnitOption,
    UpOption,
    settings_of,
)
from cadgraph.cli.panels import BUILD
from cadgraph.cli.screen import out

if TYPE_CHECKING:
    from cadgraph.facts.listing import FactRow

_WIDEST = 60  # characters of a value that are shown


@app.command(rich_help_panel=BUILD)
def facts(
    scene: Annotated[Path, typer.Argument(metavar="FILE", help="A CAD scene, of any format that is read.")],
    words: Annotated[
        Path | None,
        typer.Option("--words", metavar="FILE", help="Words of your own and their labels (YAML), beside the built-in."),
    ] = None,
    vocabulary: Annotated[
        Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree, as YAML.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
    config: ConfigOption = None,
    settings: SetOption = None,
    unit: UnitOption = None,
    scale: ScaleOption = None,
    up: UpOption = None,
    asset_roots: AssetRootOption = None,
) -> None:
    """List what a file says of its parts: each value, how often, the label that it speaks for and by what rule.

    What matched nothing comes last, the most frequent first: put its words into a file of your own (--words) and try
    again. 'cadgraph build --use-metadata' lets it count.
    """
    from cadgraph.facts.listing import list_facts
    from cadgraph.facts.words import read_words
    from cadgraph.load import load
    from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary

    chosen = settings_of(config, settings or [], None, unit, up, scale=scale, asset_roots=asset_roots)
    known = read_words(words or chosen.label.words)
    tree = read_vocabulary(vocabulary) if vocabulary else default_vocabulary()
    loaded = load(scene, chosen.load)
    rows = list_facts(loaded.paths, loaded.facts, known, tree)
    if as_json:
        print(json.dumps([row.to_json() for row in rows], ensure_ascii=True, indent=1))  # noqa: T201
        return
    matched = [row for row in rows if row.matched]
    for row in matched:
        out.print(_line(row))
    unmatched = rows[len(matched) :]
    if unmatched:
        out.print("[bold]matched nothing[/]")
    for row in unmatched:
        out.print(_line(row))
    speaking = sum(row.count for row in matched if row.label)
    silent = sum(row.count for row in unmatched)
    out.print(f"{speaking:,} facts speak for a label, {silent:,} match nothing; {known.n_phrases:,} phrases are known")


def _line(row: FactRow) -> str:
    value = printable(row.value[:_WIDEST], "\N{REPLACEMENT CHARACTER}") + ("..." if len(row.value) > _WIDEST else "")
    start = f"{row.count:>6,}  [dim]{row.key:<11}[/] {escape(value)}"
    if row.label is None:
        return start if not row.matched else f"{start} [dim]({escape(row.rule)})[/]"
    kind = f", {escape(row.kind)}" if row.kind else ""
    trust = f"{row.trust:.0%}" if row.trust is not None else ""
    return f"{start} -> [bold]{escape(row.label)}[/]{kind} {trust} [dim]{escape(row.rule)}[/]"
