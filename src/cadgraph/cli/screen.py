"""What the commands show: progress bars, and what was found."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import typer
from rich.console import Console, ConsoleOptions, ConsoleRenderable, RenderHook, RenderResult
from rich.control import Control
from rich.markup import escape
from rich.progress import BarColumn, Progress, ProgressColumn, Task, TaskID, TextColumn, TimeElapsedColumn
from rich.segment import Segment
from rich.text import Text

from cadgraph._io.progress import quiet
from cadgraph._io.text import harmless, printable
from cadgraph.cli.remaining import Remaining, told

__all__ = [
    "REMEDY", "bars", "counts", "err", "named", "note_line", "out", "say", "say_json", "state_lines", "summary_lines",
    "tell", "tell_built", "tell_lost", "tell_next", "tell_state", "tell_warnings",
]  # fmt: skip

REMEDY = "'cadgraph build' makes it anew"
_REMEDIES = {
    "report.html": "'cadgraph build' or 'relabel' draws it anew",
    "picture.png": "'cadgraph build' or 'relabel' draws it anew",
    "simulation.usda": "'cadgraph simulate' makes it anew",
    "devices.json": "'cadgraph simulate' makes it anew",
}
_MOST_NAMES = 12  # units or files that are named on one line
_MOST_PATHS = 3  # meshes that a note names

_CONTROL = re.compile("[\x7f-\x9f\u2028-\u202e\u2066-\u2069]")  # what JSON leaves as it is and a terminal obeys


class _Harmless:
    """Something to print without what moves the cursor, recolours or renames the terminal.

    Names, tags and messages come from files and models; the styles are our own and stay.
    """

    def __init__(self, printed: ConsoleRenderable) -> None:
        self._printed = printed

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for segment in console.render(self._printed, options):
            yield segment if segment.control else Segment(harmless(segment.text), segment.style)


class _Wary(RenderHook):
    def process_renderables(self, renderables: list[ConsoleRenderable]) -> list[ConsoleRenderable]:
        return [one if isinstance(one, Control) else _Harmless(one) for one in renderables]


def _console(to_errors: bool = False) -> Console:
    console = Console(stderr=to_errors, highlight=False, soft_wrap=True)
    console.push_render_hook(_Wary())
    return console


out = _console()
err = _console(to_errors=True)


def say(text: str, end: str = "\n") -> None:
    """Prints a text as it is, without styles; what a terminal would obey is replaced."""
    typer.echo(f"{harmless(text)}{end}", nl=False)


def say_json(values: Any) -> None:
    """Prints values as JSON; what a terminal would obey stands there escaped, so that nothing is lost."""
    text = json.dumps(values, ensure_ascii=False, indent=1)
    # Half a character, as a model or a file may have it, can't be printed.
    told = _CONTROL.sub(lambda found: f"\\u{ord(found[0]):04x}", text)
    typer.echo(told.encode("utf-8", "replace").decode("utf-8"))


@contextmanager
def bars(without: Collection[str] = ()) -> Iterator[Any]:
    """A progress bar for each stage, and how long the whole still takes; nothing where nobody looks at a terminal.

    Args:
        without: stages that don't come in this run.
    """
    if not err.is_terminal:
        yield quiet
        return
    remaining = Remaining(without)
    columns = (TextColumn("{task.description:<14}"), BarColumn(), TimeElapsedColumn(), _Left(remaining))
    with Progress(*columns, console=err) as bars:
        yield _Told(bars, remaining)


class _Left(ProgressColumn):
    """What is left of the whole, beside the stage at work."""

    def __init__(self, remaining: Remaining) -> None:
        super().__init__()
        self._remaining = remaining

    def render(self, task: Task) -> Text:
        """The words for one bar."""
        if task.finished:
            return Text("")
        share = self._remaining.share
        whole = f"{share:.0%} of all, {told(self._remaining.seconds)}" if self._remaining.seconds is not None else ""
        return Text(whole, style="dim")


class _Told:
    """Moves the bars, and takes them away for a while where something has to be asked."""

    def __init__(self, bars: Progress, remaining: Remaining) -> None:
        self._bars, self._remaining = bars, remaining
        self._tasks: dict[str, TaskID] = {}

    def __call__(self, stage: str, share: float) -> None:
        if stage not in self._tasks:
            self._tasks[stage] = self._bars.add_task(stage, total=1.0)
        self._remaining(stage, share)
        self._bars.update(self._tasks[stage], completed=share)

    @contextmanager
    def paused(self) -> Iterator[None]:
        """No bars within the block."""
        self._bars.stop()
        try:
            yield
        finally:
            self._bars.start()


def tell(outcome: Any) -> None:
    """Says what was found and what to open next."""
    from cadgraph.query.summary import summarize

    for line in summary_lines(summarize(outcome.graph)):
        out.print(line)
    if not outcome.files:
        out.print("[dim]as it was      [/]nothing was asked that could be answered in this run; no result was changed")
    names = {"report": "look at", "picture": "picture", "graph": "the graph", "labels": "in a simulator"}
    for purpose, words in names.items():
        if purpose in outcome.files:
            out.print(f"[dim]{words:<15}[/][bold]{escape(str(outcome.files[purpose]))}[/]")
    tell_state(outcome.earlier, outcome.removed)
    for remark in outcome.remarks:
        out.print(f"[yellow]{escape(remark)}[/]")


def tell_built(one: Any, width: int) -> None:
    """Says on one line what became of one of many scenes.

    Args:
        one: the scene, as ``cadgraph.session.many`` has it.
        width: of the longest name.
    """
    found = counts(one.parts, one.units, one.connections)
    said = {
        "built": f"built in {one.seconds:.1f} s: {found}",
        "kept": f"kept as it was built before this run was stopped: {found}",
        "failed": f"[bold red]failed[/]: {escape(printable(one.reason))}",
    }
    out.print(f"{named(one.name, width)}  {said[one.state]}")


def counts(parts: int, units: int, connections: int) -> str:
    """What a graph holds, in a few words."""
    return f"{_count(parts, 'part')}, {_count(units, 'unit')}, {_count(connections, 'connection')}"


def named(name: str, width: int) -> str:
    """The name of a scene at the start of its line; one that breaks lines can't pass for the line of another."""
    return f"[dim]{escape(f'{printable(name):<{width}}')}[/]"


def tell_state(earlier: Sequence[str], removed: Sequence[str] = ()) -> None:
    """Says which files of a folder don't belong to its graph, and how they come to.

    Args:
        earlier: names of those that show an earlier graph.
        removed: names of those that went with it.
    """
    tell_warnings(state_lines(earlier, removed))


def tell_warnings(warnings: Sequence[str]) -> None:
    """Says what somebody should mind, a line each."""
    for warning in warnings:
        out.print(f"[dim]{'mind':<15}[/]{escape(warning)}")


def state_lines(earlier: Sequence[str], removed: Sequence[str] = (), changed: Sequence[str] = ()) -> list[str]:
    """Which files of a folder don't belong to its graph, and how they come to, in words.

    Args:
        earlier: names of those that show an earlier graph.
        removed: names of those that went with it.
        changed: names of those that are gone, or not what was written.
    """
    told = []
    for names, what in (
        (earlier, "of an earlier graph"),
        (removed, "of the earlier graph, removed"),
        (changed, "changed or taken away since it was written"),
    ):
        remedies = dict.fromkeys(_REMEDIES.get(name, REMEDY) for name in names)
        if names:
            more = f" and {len(names) - _MOST_NAMES:,} more" if len(names) > _MOST_NAMES else ""
            told.append(f"{', '.join(names[:_MOST_NAMES])}{more}: {what}; {', '.join(remedies)}")
    return told


def tell_consequences(consequences: Sequence[str], renamed: str = "") -> None:
    """Says what a correction did to units and flow, which nobody may have meant."""
    for message in filter(None, (*consequences, renamed)):
        out.print(f"[yellow]{escape(message)}[/]")


def tell_lost(lost: Sequence[str]) -> None:
    """Names the corrections in force that don't fit the graph any more."""
    for message in lost:
        out.print(f"[yellow]no longer fits:[/] {escape(message)}")


def tell_next(commands: Sequence[str]) -> None:
    """Names commands to go on with, one a line."""
    for number, command in enumerate(commands):
        out.print(f"[dim]{'' if number else 'try next':<15}[/]{escape(command)}")


def note_line(note: Any) -> str:
    """A diagnostic on one line, with the first of the paths that it concerns."""
    first = ", ".join(note.meshes[:_MOST_PATHS])
    more = f" and {len(note.meshes) - _MOST_PATHS} more" if len(note.meshes) > _MOST_PATHS else ""
    return f"{note.code}: {note.message}" + (f": {first}{more}" if first else "")


def summary_lines(summary: Any) -> list[str]:
    """A summary in about a dozen lines of console markup."""
    from cadgraph.query.doubt import mounted_words
    from cadgraph.query.summary import connection_words, end_words

    groups = ", ".join(f"{escape(group)} {n}" for group, n in summary.groups.items()) or "none"
    units = ", ".join(f"{len(tags)} {escape(kind)}{'s' * (len(tags) != 1)}" for kind, tags in summary.units.items())
    found = ", ".join(f"{escape(code)} {n}" for code, n in summary.diagnostics.items()) or "none"
    rows = (
        (
            "source",
            f"{escape(printable(summary.source))}: {_count(summary.n_meshes, 'mesh', 'es')}, "
            f"{_count(summary.n_triangles, 'triangle')}",
        ),
        ("parts", _of_them(summary.n_parts, summary.n_labelled, "labelled", "labelled", "not labelled")),
        ("labels", groups),
        (
            "structures",
            _of_them(summary.n_clusters, summary.n_with_pipes, "with pipes", "with pipes", "without pipes"),
        ),
        ("touching", f"{_count(summary.n_adjacent, 'pair')} of parts"),
        ("units", units or "none"),
        *((("no line at", _some(mounted_words(summary.without_line))),) if summary.without_line else ()),
        ("connections", connection_words(summary)),
        ("ends", end_words(summary)),
        ("systems", f"{_count(summary.n_systems, 'connected network')} of pipes"),
        *(
            (("related", f"{_count(summary.n_related, 'pair')} of units (Algorithm 1 of the paper)"),)
            if summary.n_related
            else ()
        ),
        ("diagnostics", found),
        *(("ground", escape(words)) for words in summary.ground),
        *(("mind", escape(warning)) for warning in summary.warnings),
    )
    return [f"[dim]{name:<15}[/]{text}" for name, text in rows]


def _some(names: Sequence[str]) -> str:
    more = len(names) - _MOST_NAMES
    return escape(", ".join(names[:_MOST_NAMES])) + (f" and {more} more" if more > 0 else "")


def _count(n: int, noun: str, plural: str = "s") -> str:
    return f"{n:,} {noun}{'' if n == 1 else plural}"


def _of_them(n: int, some: int, are: str, is_one: str, is_none: str) -> str:
    if n == 1:
        return f"1, {is_one if some else is_none}"
    return f"{n:,}, {some:,} of them {is_one if some == 1 else are}"
