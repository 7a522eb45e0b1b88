import json
import os

import pytest

from cadgraph.cli import main
from cadgraph.model.graph import SceneGraph
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
    assert (
        out.splitlines()[-1]
        == "16 lines, 37.47 m, direction unknown (?) in 4, in brackets: valves beside the line, on a tap"
    )
    assert any("T-001:N1" in row and "V-001" in row and "100" in row for row in out.splitlines())


@pytest.fixture
def corrected(folder):
    """A folder to whose graph somebody has made a correction that it doesn't show."""
    (folder / "corrections.json").write_text('{"format": "cadgraph-corrections", "version": 2, "events": []}')
    later = (folder / "graph.json").stat().st_mtime + 10
    os.utime(folder / "corrections.json", (later, later))
    return folder


def test_no_isolation_is_sure_where_the_graph_lacks_corrections(folder, corrected, capsys):
    code, out, err = run(capsys, "isolate", corrected, "P-001", "--strict", "--json")
    told = json.loads(out)
    assert code == 1
    assert told["isolated"] is None
    assert told["doubts"][0]["at"] == "graph"
    assert "corrections were made that this graph lacks" in told["doubts"][0]["text"]
    assert "mind: " in err
    (folder / "corrections.json").unlink()
    code, out, err = run(capsys, "isolate", folder, "P-001", "--json")
    assert not any(doubt["at"] == "graph" for doubt in json.loads(out)["doubts"])
    assert err == ""


@pytest.mark.parametrize(
    "asked",
    [
        ("trace", "V-001"),
        ("trace", "V-001", "--to", "P-001"),
        ("what-if", "V-001"),
        ("find", "--kind", "gate valve"),
        ("overview",),
        ("describe", "V-001"),
    ],
)
def test_every_answer_says_that_the_graph_lacks_corrections(asked, corrected, capsys):
    _, out, err = run(capsys, asked[0], corrected, *asked[1:])
    assert "corrections were made that this graph" in out
    assert "corrections were made that this graph lacks" in err


@pytest.fixture
def outdated(tmp_path):
    """A folder with a graph whose source was replaced after it was built."""
    (tmp_path / "plant.usda").write_text("the plant as it is now")
    graph = pumping()
    document = graph.document
    source = document.source.model_copy(update={"path": "plant.usda", "sha256": "0" * 64})
    SceneGraph(document.model_copy(update={"source": source})).save(tmp_path)
    earlier = (tmp_path / "plant.usda").stat().st_mtime - 10
    os.utime(tmp_path / "graph.json", (earlier, earlier))
    return tmp_path


def test_no_isolation_is_sure_where_the_source_changed_since(outdated, capsys):
    code, out, err = run(capsys, "isolate", outdated, "P-001", "--strict", "--json")
    told = json.loads(out)
    assert code == 1
    assert told["isolated"] is None
    assert told["doubts"][0]["at"] == "graph"
    assert "plant.usda: changed since the graph was built" in told["doubts"][0]["text"]
    assert "mind: " in err
    (outdated / "plant.usda").unlink()
    code, out, err = run(capsys, "isolate", outdated, "P-001", "--json")
    assert not any(doubt["at"] == "graph" for doubt in json.loads(out)["doubts"])
    assert err == ""


@pytest.mark.parametrize(
    "asked", [("what-if", "V-001"), ("find", "--kind", "gate valve"), ("overview",), ("describe", "V-001")]
)
def test_every_tool_says_that_the_source_changed_since(asked, outdated, capsys):
    _, out, err = run(capsys, asked[0], outdated, *asked[1:])
    assert "the file of the scene changed since this graph was built" in out
    assert "plant.usda: changed since the graph was built" in err


def test_line_list_says_it_beside_what_may_be_read_by_others(corrected, capsys):
    _, out, err = run(capsys, "lines", corrected, "--csv")
    assert "corrections" not in out
    assert "mind: " in err


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


def apart(folder):
    """T-001 - V-001 - P-001 and a pump and a gauge without a line."""
    nodes = [unit("V-001", "gate valve"), *(unit(tag) for tag in ("T-001", "P-001", "P-002", "G-001"))]
    network(nodes, chain("T-001 V-001 P-001")).save(folder)
    return folder


@pytest.mark.parametrize(
    "question",
    [
        ("isolate", "P-002"),
        ("isolate", "P-002", "--json"),
        ("trace", "P-002"),
        ("trace", "P-002", "--upstream", "--unknown"),
        ("trace", "P-002", "--to", "T-001"),
        ("trace", "T-001", "--to", "P-002"),
        ("lines", "--of", "P-002"),
    ],
)
def test_a_unit_without_a_line_gets_no_answer_but_one_line_with_the_remedy(tmp_path, capsys, question):
    code, out, err = run(capsys, question[0], apart(tmp_path), *question[1:])
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert err.startswith("error: no line was found at P-002; can't say ")
    assert "'cadgraph explain FOLDER P-002' says what is near it" in err


def test_isolate_says_what_makes_the_answer_doubtful_and_is_strict_when_asked(tmp_path, capsys):
    apart(tmp_path)
    code, out, _ = run(capsys, "isolate", tmp_path, "P-001")
    assert code == 0
    assert out.startswith("these valves may not isolate P-001 wholly:\n  P-001: only one of its two nozzles has a line")
    code, out, _ = run(capsys, "isolate", tmp_path, "P-001", "--strict", "--json")
    assert (code, json.loads(out)["isolated"]) == (1, None)
    assert json.loads(out)["doubts"][0]["at"] == "P-001"


def test_isolate_ends_well_when_strict_only_where_it_is_sure(folder, tmp_path_factory, capsys):
    assert run(capsys, "isolate", folder, "P-001", "--strict")[0] == 0
    other = tmp_path_factory.mktemp("other")
    network([unit("T-001"), unit("P-001"), unit("T-002")], chain("T-001 P-001 T-002")).save(other)
    assert run(capsys, "isolate", other, "P-001", "--strict")[0] == 1


def test_isolate_takes_valves_of_unknown_kind_for_shut_off_only_when_asked(tmp_path, capsys):
    nodes = [unit("T-001"), unit("V-001"), unit("P-001"), unit("V-002"), unit("V-003", "gate valve"), unit("T-002")]
    network(nodes, chain("T-001 V-001 P-001 V-002 V-003 T-002")).save(tmp_path)
    strict = json.loads(run(capsys, "isolate", tmp_path, "P-001", "--json")[1])
    assert [v["tag"] for v in strict["valves"]] == ["V-003"]
    assert [v["tag"] for v in strict["passed"]] == ["V-001", "V-002"]
    assert (strict["isolated"], strict["openings"][0]["to"]) == (False, "T-001")
    assumed = json.loads(run(capsys, "isolate", tmp_path, "P-001", "--assume-shutoff", "--json")[1])
    assert [v["tag"] for v in assumed["valves"]] == ["V-001", "V-002"]
    assert assumed["isolated"] is None
    assert "likely a check valve" in assumed["doubts"][1]["text"]


def test_the_line_list_names_what_it_lacks(tmp_path, capsys):
    code, out, _ = run(capsys, "lines", apart(tmp_path))
    assert code == 0
    assert out.splitlines()[-3:] == [
        "note: no line was found at P-002, G-001",
        "note: fewer lines than its kind needs has P-001 (1 of 2)",
        "note: 'cadgraph explain FOLDER TAG' says what is near a unit or an end",
    ]
    _, out, err = run(capsys, "lines", tmp_path, "--json")
    assert len(json.loads(out)) == 1
    assert "no line was found at P-002" in err


def test_a_plant_of_units_without_any_line_is_no_success(tmp_path, capsys):
    network([unit("P-001")], []).save(tmp_path)
    code, out, _ = run(capsys, "lines", tmp_path)
    assert code == 1
    assert "note: no line was found at P-001" in out
    network([], []).save(tmp_path)
    assert run(capsys, "lines", tmp_path)[0] == 0


def test_the_lines_at_a_unit_are_those_that_end_there_or_run_through(folder, capsys):
    rows = json.loads(run(capsys, "lines", folder, "--of", "P-001", "--json")[1])
    assert [(row["from"], row["to"]) for row in rows] == [("junction-001", "P-001"), ("P-001", "junction-003")]
    rows = json.loads(run(capsys, "lines", folder, "--of", "v2", "--json")[1])
    assert [row["through"] for row in rows] == [["V-002", "G-001"]]
    # A gauge on a tap beside a line, behind its root valve.
    rows = json.loads(run(capsys, "lines", folder, "--of", "G-007", "--json")[1])
    assert [row["through"] for row in rows] == [["V-009", "G-005", "V-014", "G-007"]]


def test_explain_tells_of_units_and_of_what_connects_two(folder, capsys):
    assert "V-003, gate valve (valve)" in run(capsys, "explain", folder, "v3")[1]
    assert "P-001 - V-005" in run(capsys, "explain", folder, "P-001", "V-005")[1]
    assert json.loads(run(capsys, "explain", folder, "P-001", "--json")[1])["least"] == 2
    code, _, err = run(capsys, "explain", folder, "P-001", "P-001")
    assert code == 2
    assert "give two different ones" in err


def test_tags_are_not_read_as_markup(tmp_path, capsys):
    nodes = [unit("[red]T", unit_type="tank"), unit("P-001")]
    edge = chain("T-001 P-001")[0].model_copy(update={"source": "unit-[red]T"})
    network(nodes, [edge]).save(tmp_path)
    assert "[red]T" in run(capsys, "lines", tmp_path)[1]
