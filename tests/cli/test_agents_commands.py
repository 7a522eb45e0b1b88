import json

import pytest

from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import TOOLS, tool_named
from cadgraph.cli.agents import straight
from cadgraph.cli.application import app
from command_line import refused, run
from networks import pumping


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return pumping().save(tmp_path_factory.mktemp("pumping")).parent


def test_each_tool_is_a_command():
    commands = {command.name or command.callback.__name__ for command in app.registered_commands}
    assert {tool.name.replace("_", "-") for tool in TOOLS} <= commands


@pytest.mark.parametrize(
    ("words", "name", "arguments"),
    [
        (["overview"], "overview", {}),
        (["find", "--type", "valve", "--near", "P-001", "--within", "2"], "find",
         {"type": "valve", "near": "P-001", "within": 2.0}),
        (["describe", "V-004"], "describe", {"id": "V-004"}),
        (["neighbors", "P-001"], "neighbors", {"id": "P-001"}),
        (["route", "T-001", "V-010"], "route", {"start": "T-001", "end": "V-010"}),
        (["what-if", "V-005", "V-007", "--sources", "T-001"], "what_if",
         {"close": ["V-005", "V-007"], "sources": ["T-001"]}),
        (["measure", "P-001", "P-002"], "measure", {"a": "P-001", "b": "P-002"}),
    ],
)  # fmt: skip
def test_a_command_says_what_the_tool_says(folder, capsys, words, name, arguments):
    answer = tool_named(name).ask(Plant.open(folder), arguments)
    command = [words[0], folder, *words[1:]]
    code, out, _ = run(capsys, *command)
    assert (code, out) == (0, straight(answer.text) + "\n")
    code, out, _ = run(capsys, *command, "--json")
    assert json.loads(out) == json.loads(json.dumps(answer.values))


def test_wrong_words_end_in_one_line(folder, capsys):
    assert "did you mean P-001, P-002?" in refused(capsys, "describe", folder, "P-9")
    assert "did you mean valve?" in refused(capsys, "find", folder, "--type", "vlave")
    assert "Input should be 'pipe' or 'touch'" in refused(capsys, "neighbors", folder, "P-001", "--by", "air")
    assert "there is no page 7" in refused(capsys, "find", folder, "--page", "7")
    assert "no line was found" not in refused(capsys, "what-if", folder, "P-001")


def test_columns_are_straight_and_the_last_of_a_row_makes_none_wider():
    text = "head\na\tbb\tc\na long reason\tthat goes on and on\nccc\tb\tdd\nfoot"
    assert straight(text).split("\n") == [
        "head", "a              bb  c", "a long reason  that goes on and on", "ccc            b   dd", "foot"
    ]  # fmt: skip
