import json

import pytest

from cadgraph.cli import main
from networks import chain, network, pumping, unit


@pytest.fixture
def folder(tmp_path):
    pumping().save(tmp_path)
    return tmp_path


def run(capsys, *arguments):
    code = 0
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        code = end.code or 0
    out, err = capsys.readouterr()
    return code, out, err


def test_lines_prints_the_list_with_its_sum(folder, capsys):
    code, out, _ = run(capsys, "lines", folder)
    assert code == 0
    assert out.splitlines()[-1] == "16 lines, 37.47 m, direction unknown (?) in 4"
    assert any("T-001:N1" in row and "V-001" in row and "100" in row for row in out.splitlines())


def test_lines_writes_csv_and_json_files(folder, capsys):
    run(capsys, "lines", folder, "--csv", folder / "lines.csv")
    text = (folder / "lines.csv").read_bytes()
    assert text.startswith(b"\xef\xbb\xbfline,from,from_port,to")
    run(capsys, "lines", folder, "--json", folder / "lines.json")
    assert len(json.loads((folder / "lines.json").read_text(encoding="utf-8"))) == 16


def test_lines_prints_csv_and_json(folder, capsys):
    assert run(capsys, "lines", folder, "--csv")[1].count("\n") == 17
    assert json.loads(run(capsys, "lines", folder, "--json")[1])[0]["dn"] == [80]


def test_trace_and_isolate_answer_as_text_and_json(folder, capsys):
    assert "downstream of V-003 (gate valve):" in run(capsys, "trace", folder, "V-003")[1]
    assert "upstream of V-003" in run(capsys, "trace", folder, "V-003", "--upstream")[1]
    assert "from V-003 to G-007: 7.12 m" in run(capsys, "trace", folder, "V-003", "--to", "G-007")[1]
    assert json.loads(run(capsys, "trace", folder, "V-003", "--json")[1])["steps"][1]["tag"] == "G-002"
    assert "to isolate P-001, close 2 valves:" in run(capsys, "isolate", folder, "P-001")[1]
    answer = json.loads(run(capsys, "isolate", folder, "P-001", "--check-valves", "--json")[1])
    assert answer["isolated"] is True
    assert [valve["tag"] for valve in answer["valves"]] == ["V-004", "V-002"]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("trace", "V-999"), "nothing in the graph is called 'V-999'"),
        (("trace", "V-001", "--upstream", "--downstream"), "give one of them"),
        (("trace", "V-001", "--to", "V-002", "--unknown"), "not with --to"),
        (("isolate", "P-9"), "nothing in the graph is called 'P-9'"),
        (("lines", "--csv", "--json"), "give one of them"),
        (("lines", "out.csv"), "say --csv or --json"),
    ],
)
def test_bad_questions_end_with_one_line(folder, capsys, arguments, says):
    code, _, err = run(capsys, arguments[0], folder, *arguments[1:])
    assert code == 2
    assert says in " ".join(err.split())


def test_tags_are_not_read_as_markup(tmp_path, capsys):
    nodes = [unit("[red]T", unit_type="tank"), unit("P-001")]
    edge = chain("T-001 P-001")[0].model_copy(update={"source": "unit-[red]T"})
    network(nodes, [edge]).save(tmp_path)
    assert "[red]T" in run(capsys, "lines", tmp_path)[1]
