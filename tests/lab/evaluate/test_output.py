import json
import re
from xml.etree import ElementTree

import pytest

import graphs
from cadgraph.errors import OutputError
from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate, figures, to_json, to_markdown
from lab.evaluate.plants import PIPE, VALVE, agreeing, line, relabelled

EMPTY = {"format": "cadgraph-truth", "version": 1}


@pytest.fixture(scope="module")
def evaluation():
    wrong = {"/v1": (PIPE, "flange", 0.7), "/v2w": None, "/p0": (VALVE, "lever", 0.4)}
    return evaluate(relabelled(agreeing(line(), 0.9), wrong), line())


def test_json_holds_counts_and_shares(evaluation):
    data = to_json(evaluation)
    assert (data["format"], data["version"]) == ("cadgraph-evaluation", 1)
    assert json.loads(json.dumps(data, allow_nan=False)) == data
    total = data["total"]
    assert total["parts"]["group"]["accuracy"] == round(8 / 11, 9)
    assert total["units"]["total"]["strict"]["f1"] == 1.0
    assert total["connected"]["edges"] == {
        "n_true": 3, "n_predicted": 3, "n_correct": 3, "precision": 1.0, "recall": 1.0, "f1": 1.0,
    }  # fmt: skip
    assert [s["id"] for s in data["structures"]] == ["A", "structure-2"]


def test_the_page_says_what_was_measured(evaluation):
    page = to_markdown(evaluation, ["a-b.svg"])
    assert "| group, per part | 11 | 72.7 % |" in page
    assert "| Valve assembly | *unlabelled* | 1 |" in page
    assert "| all | all | 4 | 2 | 2 | 0 | 4 | 4 | 0 | 0 | 0 | 3 of 3 |" in page
    assert page.endswith("![a b](a-b.svg)\n")
    for name in ("Labels", "Units", "Order and relations", "Clusters", "Contacts", "Calibration of confidence"):
        assert f"\n## {name}\n" in page


def test_every_table_is_even(evaluation):
    for table in re.findall(r"(?:^\|.*\|\n)+", to_markdown(evaluation), re.M):
        widths = {len(re.findall(r"(?<!\\)\|", row)) for row in table.splitlines()}
        assert len(widths) == 1, table


def test_a_page_of_nothing():
    page = to_markdown(evaluate(graphs.graph(), Truth.from_json(EMPTY)))
    assert "0 meshes in the truth" in page
    assert "## Units" not in page


def test_long_lists_are_cut():
    data = {**EMPTY, "meshes": [{"mesh": f"/{i}", "group": f"g{i:02}", "name": "n"} for i in range(50)]}
    truth = Truth.from_json(data)
    graph = relabelled(agreeing(truth), {f"/{i}": (f"h{i}", "n", 1) for i in range(50)})
    assert "And 60 more" in to_markdown(evaluate(graph, truth))


NASTY = "<script>|`x`|[a](b)\n& $y$"


def nasty():
    data = line().to_json()
    data["preset"] = NASTY
    data["clusters"][0]["id"] = NASTY
    data["units"][0].update(tag=NASTY, kind=NASTY)
    data["meshes"][0].update(group=NASTY, name=NASTY + "\x00\ud800")
    truth = Truth.from_json(data)
    return evaluate(relabelled(agreeing(truth), {"/v1": (NASTY, NASTY, 1.0)}), truth)


def test_nothing_from_a_file_is_markup():
    page = to_markdown(nasty())
    assert "<script" not in page
    assert "[a](b)" not in page
    assert "&lt;script&gt;" in page
    assert len({len(re.findall(r"(?<!\\)\|", row)) for row in page.splitlines() if row.startswith("| ")} - {0}) < 10


def test_figures_are_well_formed_and_escaped(tmp_path):
    written = figures(nasty(), tmp_path / "new")
    assert [path.name for path in written] == [
        "reliability.svg", "confusion-groups.svg", "confusion-names.svg", "scores-groups.svg", "scores-names.svg",
    ]  # fmt: skip
    for path in written:
        root = ElementTree.fromstring(path.read_bytes())
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        assert {child.tag.split("}")[1] for child in root.iter()} <= {"svg", "title", "rect", "text", "g", "line",
                                                                      "circle"}  # fmt: skip


def test_confusion_shows_every_case(evaluation, tmp_path):
    figures(evaluation, tmp_path)
    text = (tmp_path / "confusion-groups.svg").read_text(encoding="utf-8")
    assert "<title>Valve assembly taken for Pipe assembly: 1 of 5</title>" in text
    assert "<title>Valve assembly taken for unlabelled: 1 of 5</title>" in text


def test_figures_without_content_are_left_out(tmp_path):
    assert figures(evaluate(graphs.graph(), Truth.from_json(EMPTY)), tmp_path) == ()


@pytest.mark.parametrize(("n", "drawn"), [(60, True), (61, False)])
def test_a_matrix_too_large_to_read_is_left_out(tmp_path, n, drawn):
    truth = Truth.from_json({**EMPTY, "meshes": [{"mesh": f"/{i}", "group": "g", "name": f"{i}"} for i in range(n)]})
    names = [path.name for path in figures(evaluate(agreeing(truth), truth), tmp_path)]
    assert ("confusion-names.svg" in names) == drawn


def test_a_folder_that_is_a_file_is_an_output_error(evaluation, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        figures(evaluation, tmp_path / "file")
