"""Writes the generated documents under docs/, and the generated tables in pages, anew, or with --check says which are
out of date.

python tools/write_docs.py [--check]
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path

from typer.testing import CliRunner

from cadgraph._io.atomic import write_atomically
from cadgraph.agents.sql.schema import TABLES
from cadgraph.cli import app
from cadgraph.cli.plugins import add_installed
from cadgraph.config import Config, describe
from cadgraph.model.records import document_schema
from cadgraph.stages.relate.evidence import BASE, CURVES, FLAGS, OPEN_END, Curve
from cadgraph.stages.relate.inline import INLINE, THICKER, WAIST
from cadgraph.stages.relate.recover import ARRANGEMENT, LABELLED, SIZE, SLIM
from cadlab.markdown import put, table

DOCS = Path(__file__).resolve().parents[1] / "docs"


def schema() -> str:
    """The JSON schema of ``graph.json``."""
    return json.dumps(document_schema(), ensure_ascii=False, indent=2) + "\n"


def settings() -> str:
    """Every setting with its default, meaning and source."""
    lines = [
        "# Settings",
        "",
        "Defaults, then a TOML file (`--config FILE`), then flags (`--set NAME=VALUE`). `cadgraph config` prints those",
        "in force as such a file. Lengths are metres, volumes cubic metres, angles radians. *Source* says where a",
        "figure comes from; the paper is *Semantic Enrichment of CAD-Based Industrial Environments via Scene Graphs",
        "for Simulation and Reasoning*.",
        "",
        "| setting | default | meaning | source |",
        "|---|---|---|---|",
    ]
    for name, value, meaning, source in describe(Config()):
        plain = list(value) if isinstance(value, tuple) else value
        lines.append(f"| `{name}` | `{json.dumps(plain)}` | {meaning} | {source} |")
    return "\n".join(lines) + "\n"


@cache
def commands() -> str:
    """The help of every command."""
    add_installed(app)
    runner = CliRunner(env={"COLUMNS": "100", "TERMINAL_WIDTH": "100", "NO_COLOR": "1", "TERM": "dumb"})
    names = [str(command.name or command.callback.__name__) for command in app.registered_commands if command.callback]
    blocks = ["# Commands", ""]
    nested = [
        [str(group.name), str(inner.name or inner.callback.__name__)]
        for group in app.registered_groups
        if group.typer_instance
        for inner in group.typer_instance.registered_commands
        if inner.callback
    ]
    for words in ([], *([name] for name in names), *nested):
        text = runner.invoke(app, [*words, "--help"], prog_name="cadgraph").output
        body = "\n".join(line.rstrip() for line in text.strip().splitlines())
        blocks += [f"## {' '.join(['cadgraph', *words])}", "", "```", body, "```", ""]
    return "\n".join(blocks)


def tables() -> str:
    """The tables that SQL can ask, with their columns."""
    blocks = []
    for name, each in TABLES.items():
        columns = [(f"`{column}`", kind.lower(), meaning) for column, (kind, meaning) in each.columns.items()]
        blocks += [f"### {name}", "", f"A row is {each.holds}.", "", *table(("column", "type", "meaning"), columns), ""]
    return "\n".join(blocks[:-1])


_SPEC = re.compile(r"\{[^}]*\}")
_ARRANGED = {
    "one": "one end",
    "aligned": "two on one axis",
    "square": "two square to each other",
    "two": "two otherwise",
    "many": "three or more",
}


def measured() -> str:
    """What is measured of a joint, with its contribution at some values."""
    return _told([(name, curve) for name, curve in CURVES.items()])


def flagged() -> str:
    """What is there or not at a joint, where each kind starts, and what an open end costs."""
    rows = [(words, _odds(odds)) for odds, words in sorted(FLAGS.values(), key=lambda row: -row[0])]
    rows += [(f"the joint is a `{kind}`", _odds(odds)) for kind, odds in BASE.items()]
    rows.append(("an end that joins nothing", _odds(-OPEN_END)))
    return "\n".join(table(("what", "log-odds"), rows, True))


def arrangement() -> str:
    """How ends of lines meet a body, in log-odds for each type."""
    types = list(next(iter(ARRANGEMENT.values())))
    rows = [(_ARRANGED[name], *(_odds(effect[one]) for one in types)) for name, effect in ARRANGEMENT.items()]
    return "\n".join(table(("ends at the body", *types), rows, True))


def sizes() -> str:
    """How long a body is, in log-odds for each type, and what the labeler's probability adds."""
    likely = Curve(LABELLED.at, LABELLED.gives, "labeler's mean probability of the type, as natural logarithm: {:.1f}")
    slim = ("fitting; taken from all others", SLIM)
    return _told([*SIZE.items(), slim, ("any", likely)], "type")


def inline() -> str:
    """What makes a valve of a straight piece in a line."""
    rows = [_row("waist", WAIST), _row("thicker", THICKER)]
    rows += [("base", "any straight piece between two joints", _odds(INLINE["base"]))]
    rows += [("stem", "a thin piece stands on it and leads nowhere", _odds(INLINE["stem"]))]
    rows += [("operator", "a lever, a bonnet or the like sits on it and on no other line", _odds(INLINE["operator"]))]
    return "\n".join(table(("name", "what", "value: log-odds"), rows))


def _told(curves: Sequence[tuple[str, Curve]], head: str = "name") -> str:
    rows = [_row(name, curve) for name, curve in curves]
    return "\n".join(table((head, "what", "value: log-odds"), rows))


def _row(name: str, curve: Curve) -> tuple[str, str, str]:
    """A curve's name, its words without the value, and its contribution at each of its values."""
    spec = _SPEC.findall(curve.says)[0]
    values = [
        f"{spec.format(curve.scale * value)}: {_odds(odds)}" for value, odds in zip(curve.at, curve.gives, strict=True)
    ]
    return name, _SPEC.sub("...", curve.says), ", ".join(values)


def _odds(value: float) -> str:
    return f"{value:+.1f}" if value else "0"


PAGES: dict[str, Callable[[], str]] = {
    "graph.schema.json": schema,
    "settings.md": settings,
    "commands.md": commands,
}
"""What writes each generated document, by its name under docs/."""

PLACES: Mapping[str, Mapping[str, Callable[[], str]]] = {
    "functional.md": {
        "measured": measured,
        "flagged": flagged,
        "arrangement": arrangement,
        "sizes": sizes,
        "inline": inline,
    },
    "query.md": {"tables": tables},
}
"""What writes the tables in pages that are written by hand, by page and by the name of the place."""


def stale(folder: Path) -> list[str]:
    """The names of the documents in a folder that are missing or differ from what would be written now.

    A page written by hand that is not there is none of them: there is nothing to put its tables into.
    """
    names = [name for name, write in PAGES.items() if _read(folder / name) != write()]
    return [
        *names,
        *(name for name in PLACES if (page := _read(folder / name)) is not None and _filled(name, page) != page),
    ]


def main(arguments: Sequence[str] | None = None, folder: Path = DOCS) -> int:
    """Runs the command; the exit code is 1 where ``--check`` finds a stale document."""
    parser = argparse.ArgumentParser(description="Writes the generated documents under docs/ anew.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where one is out of date")
    only_check = parser.parse_args(arguments).check
    names = stale(folder)
    for name in names:
        if not only_check:
            write_atomically(folder / name, _content(folder, name))
        sys.stdout.write(f"{name} {'is out of date: run python tools/write_docs.py' if only_check else 'written'}\n")
    return 1 if only_check and names else 0


def _content(folder: Path, name: str) -> str:
    """What is to stand in a document."""
    return PAGES[name]() if name in PAGES else _filled(name, _read(folder / name) or "")


def _filled(name: str, page: str) -> str:
    """A page written by hand with its tables as they are now."""
    for place, write in PLACES[name].items():
        page = put(page, place, write())
    return page


def _read(path: Path) -> str | None:
    # Git on Windows may have turned the line ends; that is no difference.
    return path.read_text(encoding="utf-8") if path.is_file() else None


if __name__ == "__main__":
    sys.exit(main())
