"""What the commands show: progress bars, and what was found."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

__all__ = ["bars", "err", "out", "summary_lines", "tell"]

out = Console(highlight=False, soft_wrap=True)
err = Console(stderr=True, highlight=False, soft_wrap=True)


@contextmanager
def bars() -> Iterator[Any]:
    """A progress bar for each stage."""
    columns = (TextColumn("{task.description:<14}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=err) as bars:
        tasks: dict[str, TaskID] = {}

        def told(stage: str, share: float) -> None:
            if stage not in tasks:
                tasks[stage] = bars.add_task(stage, total=1.0)
            bars.update(tasks[stage], completed=share)

        yield told


def tell(outcome: Any) -> None:
    """Says what was found and what to open next."""
    from cadgraph.summary import summarize

    for line in summary_lines(summarize(outcome.graph)):
        out.print(line)
    names = {"report": "look at", "picture": "picture", "graph": "the graph", "labels": "in a simulator"}
    for purpose, words in names.items():
        if purpose in outcome.files:
            out.print(f"[dim]{words:<15}[/][bold]{escape(str(outcome.files[purpose]))}[/]")


def summary_lines(summary: Any) -> list[str]:
    """A summary in about ten lines of console markup."""
    groups = ", ".join(f"{escape(group)} {n}" for group, n in summary.groups.items()) or "none"
    units = ", ".join(f"{len(tags)} {escape(kind)}{'s' * (len(tags) != 1)}" for kind, tags in summary.units.items())
    found = ", ".join(f"{escape(code)} {n}" for code, n in summary.diagnostics.items()) or "none"
    rows = (
        ("source", f"{escape(summary.source)}: {summary.n_meshes:,} meshes, {summary.n_triangles:,} triangles"),
        ("parts", f"{summary.n_parts:,}, {summary.n_labelled:,} of them labelled"),
        ("labels", groups),
        ("structures", f"{summary.n_clusters:,}, {summary.n_pipe_systems:,} of them pipe systems"),
        ("touching", f"{summary.n_adjacent:,} pairs of parts"),
        ("units", units or "none"),
        ("relations", f"{summary.n_related:,} between units"),
        ("diagnostics", found),
    )
    return [f"[dim]{name:<15}[/]{text}" for name, text in rows]
