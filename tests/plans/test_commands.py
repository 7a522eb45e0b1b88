import json

import pytest

from cadgraph.agents.answer import BUDGET, tokens
from cadgraph.agents.planning import plan
from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import tool_named
from cadgraph.cli import main
from cadgraph.errors import AskError
from gallery import gallery, standing

GOALS = "read G-001; close V-002, V-003"


@pytest.fixture
def folder(tmp_path):
    gallery().save(tmp_path)
    return tmp_path


def run(capsys, *arguments):
    code = 0
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        code = end.code or 0
    out, err = capsys.readouterr()
    return code, out, " ".join(err.split())


def test_a_round_is_told_what_is_not_plain_first(folder, capsys):
    code, out, _ = run(capsys, "plan", folder, GOALS, "--start", "v1")
    lines = out.splitlines()
    assert code == 0
    assert lines[0].startswith("round of 3 goals from V-001 and back: ")
    assert lines[0].endswith("no order is shorter (walks estimated as straight lines)")
    assert lines[1].startswith("! V-003 takes a ladder, lift or other access")
    assert any("close V-002 (ball valve): its middle is 1.2 m above the platform" in line for line in lines)


def test_a_round_as_json_keeps_the_rules_when_it_is_checked(folder, capsys):
    _, out, _ = run(capsys, "plan", folder, GOALS, "--json")
    written = json.loads(out)
    assert written["needs_ladder_or_lift"] == ["V-003"]
    assert written["faults"] == []
    file = folder / "round.json"
    file.write_text(out, encoding="utf-8")
    assert run(capsys, "plan", folder, "--check", file)[:2] == (
        0, f"the round of {len(written['steps'])} steps keeps all rules\n"
        f"the best round that is known takes {written['length_m']:.1f} m\n",
    )  # fmt: skip


def test_a_round_of_somebody_else_that_breaks_rules_ends_with_1(folder, capsys):
    file = folder / "theirs.json"
    steps = [{"do": "walk", "at": "G-001"}, {"do": "read", "at": "g1"}, {"do": "close", "at": "V-002"}]
    file.write_text(json.dumps({"goals": "read G-001; close V-002", "steps": steps}), encoding="utf-8")
    code, out, _ = run(capsys, "plan", folder, "--check", file)
    assert code == 1
    assert "the round of 3 steps breaks 2 rules" in out
    assert "step 3: one does not stand at V-002: walk there before" in out
    # Goals of one's own count in place of those in the file; they go before the options that take values.
    code, out, _ = run(capsys, "plan", folder, "read G-001", "--check", file, "--json")
    assert code == 1
    assert "step 3: V-002: to close it is not asked" in json.loads(out)["faults"]


@pytest.mark.parametrize(
    ("text", "says"),
    [("{", "no round"), ('{"steps": [{"do": "fly", "at": "V-001"}]}', "steps.0.do"), ('{"steps": []}', "no goals")],
)
def test_a_file_that_is_no_round_is_refused_in_one_line(folder, capsys, text, says):
    file = folder / "bad.json"
    file.write_text(text, encoding="utf-8")
    code, _, err = run(capsys, "plan", folder, "--check", file)
    assert code == 2
    assert says in err


def test_files_for_planners_are_written(folder, capsys):
    code, _, err = run(capsys, "plan", folder, GOALS, "--pddl", folder / "pddl")
    assert code == 0
    assert "domain.pddl, problem.pddl, plan.pddl" in err
    assert "(:domain cadgraph-round)" in (folder / "pddl" / "problem.pddl").read_text(encoding="utf-8")


def test_the_tool_says_what_the_command_says(folder):
    answer = tool_named("plan").ask(Plant.open(folder), {"goals": GOALS})
    assert answer.text.splitlines()[0].startswith("round of 3 goals from and back to the ground: ")
    assert [step["name"] for step in answer.values["steps"] if step["do"] == "close"] != []
    with pytest.raises(AskError, match="did you mean"):
        tool_named("plan").ask(Plant.open(folder), {"goals": "read G-01x"})
    with pytest.raises(AskError, match="begins at a unit"):
        plan(Plant.open(folder), GOALS, "place-001")


def test_a_long_round_comes_in_pages_that_lose_nothing():
    many = [standing(f"G-{100 + n}", (float(n % 20), 0.3 * n, 1.0)) for n in range(30)]
    plant = Plant(gallery(many))
    goals = "read " + ", ".join(one.tag for one in many)
    pages, page = [], 1
    while True:
        answer = plan(plant, goals, page=page)
        assert tokens(answer.text) <= BUDGET
        pages += answer.text.splitlines()
        if f"next: page={page + 1}" not in answer.text:
            break
        page += 1
    numbers = [int(line.split(".")[0]) for line in pages if line[0].isdigit()]
    assert page > 1
    assert numbers == list(range(1, len(answer.values["steps"]) + 1))


def test_a_round_whose_step_names_another_unit_than_it_is_at_is_wrong(folder, capsys):
    written = json.loads(run(capsys, "plan", folder, "close V-001", "--json")[1])
    step = next(step for step in written["steps"] if step["do"] == "close")
    step["name"] = "V-002"
    file = folder / "renamed.json"
    file.write_text(json.dumps(written), encoding="utf-8")
    code, out, _ = run(capsys, "plan", folder, "--check", file)
    assert code == 1
    assert "it names V-002, but is at V-001" in out
