"""Writes the generated documents under docs/ anew, or with --check says which are out of date.

python tools/write_docs.py [--check]
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from typer.testing import CliRunner

from cadgraph._io.atomic import write_atomically
from cadgraph.cli import app
from cadgraph.config import Config, describe
from cadgraph.model.records import document_schema

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


def commands() -> str:
    """The help of every command."""
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


PAGES: dict[str, Callable[[], str]] = {
    "graph.schema.json": schema,
    "settings.md": settings,
    "commands.md": commands,
}
"""What writes each generated document, by its name under docs/."""


def stale(folder: Path) -> list[str]:
    """The names of the documents in a folder that are missing or differ from what would be written now."""
    return [name for name, write in PAGES.items() if _read(folder / name) != write()]


def main(arguments: Sequence[str] | None = None, folder: Path = DOCS) -> int:
    """Runs the command; the exit code is 1 where ``--check`` finds a stale document."""
    parser = argparse.ArgumentParser(description="Writes the generated documents under docs/ anew.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where one is out of date")
    only_check = parser.parse_args(arguments).check
    names = stale(folder)
    for name in names:
        if not only_check:
            write_atomically(folder / name, PAGES[name]())
        sys.stdout.write(f"{name} {'is out of date: run python tools/write_docs.py' if only_check else 'written'}\n")
    return 1 if only_check and names else 0


def _read(path: Path) -> str | None:
    # Git on Windows may have turned the line ends; that is no difference.
    return path.read_text(encoding="utf-8") if path.is_file() else None


if __name__ == "__main__":
    sys.exit(main())
