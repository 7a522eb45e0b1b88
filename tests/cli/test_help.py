import re

import pytest
from typer.main import get_command

from cadgraph.agents.sql.schema import TABLES
from cadgraph.cli.application import app
from cadgraph.cli.panels import PANELS
from cadgraph.cli.plugins import add_installed
from command_line import run


@pytest.fixture(scope="module")
def root():
    add_installed(app)
    return get_command(app)


def every(command, name=""):
    """All commands below one that the help shows, by their words."""
    for word, inner in getattr(command, "commands", {}).items():
        if not inner.hidden:
            yield f"{name} {word}".strip(), inner
            yield from every(inner, f"{name} {word}".strip())


def params(command):
    return [param for param in command.params if not getattr(param, "hidden", False)]


def helped(capsys, monkeypatch, *words):
    monkeypatch.setenv("COLUMNS", "200")
    code, out, _ = run(capsys, *words, "--help")
    assert code == 0
    return out


def test_every_command_belongs_to_a_group_of_the_help(root):
    assert [name for name, one in root.commands.items() if not one.hidden and one.rich_help_panel not in PANELS] == []


def test_the_groups_come_in_their_order(capsys, monkeypatch):
    out = helped(capsys, monkeypatch)
    places = [out.index(f"─ {panel} ─") for panel in PANELS if f"─ {panel} ─" in out]
    assert len(places) >= len(PANELS) - 1
    assert places == sorted(places)
    assert "─ Commands ─" not in out


def test_every_text_is_a_sentence(root):
    texts = [
        (name, text)
        for name, command in every(root)
        for text in (command.help, *(param.help for param in params(command)))
    ]
    odd = [(name, text) for name, text in texts if not text or not (text[0].isupper() or text[0] in "'0")]
    assert odd == []
    assert [(name, text) for name, text in texts if text.partition("\n\n- ")[0].rstrip()[-1] not in ".:"] == []


def test_commands_are_told_as_orders(root):
    for name, command in every(root):
        first = command.help.split()[0]
        assert not first.endswith("s"), (name, command.help)


def test_every_argument_is_named_in_capitals(root):
    for name, command in every(root):
        for param in params(command):
            if param.param_type_name == "argument":
                assert re.fullmatch(r"\[?[A-Z_]+(\.\.\.)?\]?", param.metavar or ""), (name, param.name, param.metavar)


def test_flags_show_no_type(capsys, monkeypatch):
    for words in ((), ("build",), ("catalog", "list")):
        out = helped(capsys, monkeypatch, *words)
        assert "--help" in out
        assert "<bool>" not in out


def test_choices_and_defaults_are_said(capsys, monkeypatch):
    told = " ".join(helped(capsys, monkeypatch, "build").replace("│", " ").split())
    assert "--method exact|paper How to decide what touches. [default: (exact)]" in told
    assert "At most so many US dollars. [default: (no limit)]" in told
    assert "pipe|touch" in helped(capsys, monkeypatch, "neighbors")


def test_the_tables_of_a_query_have_a_line_each(capsys, monkeypatch):
    rows = [" ".join(row.split()) for row in helped(capsys, monkeypatch, "query").split("•")]
    for name, table in TABLES.items():
        [row] = [row for row in rows if row.startswith(f"{name}: ")]
        assert row.startswith(f"{name}: {', '.join(table.columns)}")
