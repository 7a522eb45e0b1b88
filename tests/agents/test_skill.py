"""The page for agents without the protocol names only commands and options that there are."""

import re
from pathlib import Path

import typer

from cadgraph.cli import app

SKILL = (Path(__file__).parents[2] / "examples" / "SKILL.md").read_text(encoding="utf-8")


def commands():
    """Each command that the page names, with the options that it gives it."""
    for span in re.findall(r"`(cadgraph [^`]+)`|^\$ (cadgraph .+)$", SKILL, re.MULTILINE):
        words = "".join(span).split()
        yield words[1], {word for word in words[2:] if word.startswith("--")}


def test_each_command_and_option_of_the_skill_is_there():
    known = typer.main.get_command(app)
    named = list(commands())
    assert len(named) > 15
    for verb, options in named:
        if verb == "VERB":
            continue
        assert verb in known.commands, verb
        there = {option for parameter in known.commands[verb].params for option in parameter.opts}
        assert options <= there, (verb, options - there)


def test_the_skill_has_a_name_and_says_when_it_is_used():
    head = SKILL.split("---")[1]
    assert re.search(r"^name: [a-z-]{1,64}$", head, re.MULTILINE)
    described = re.search(r"^description: (.+)$", head, re.MULTILINE)
    assert described is not None
    assert len(described[1]) <= 1024
    assert "<" not in described[1]
