import json
from pathlib import Path

import pytest

from cadgraph.config import read_config
from cadgraph.errors import LabelError
from cadgraph.model.given_labels import GivenLabel, read_labels, split_label
from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary

VOCABULARY = default_vocabulary()
ROW = {"mesh": "/a", "group": "Pipe assembly", "name": "pipe"}


def read(tmp_path, content, name="labels.json"):
    path = tmp_path / name
    path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
    return read_labels(path, VOCABULARY)


def test_a_json_list_is_read(tmp_path):
    assert read(tmp_path, [ROW]) == (GivenLabel("/a", "Pipe assembly", "pipe"),)


def test_a_truth_file_is_read(tmp_path):
    assert read(tmp_path, {"format": "cadgraph-truth", "meshes": [ROW]}) == (GivenLabel("/a", "Pipe assembly", "pipe"),)


def test_a_csv_is_read_with_or_without_names(tmp_path):
    text = "mesh,group,name\n/a,Pipe assembly,pipe\n/b,Tank,\n"
    assert read(tmp_path, text, "labels.csv") == (
        GivenLabel("/a", "Pipe assembly", "pipe"),
        GivenLabel("/b", "Tank", None),
    )


def test_a_csv_as_a_spreadsheet_writes_it_is_read(tmp_path):
    text = '\ufeffmesh,group,name\r\n"/a,b",Tank,shell\r\n'
    assert read(tmp_path, text, "labels.csv") == (GivenLabel("/a,b", "Tank", "shell"),)


@pytest.mark.parametrize(
    ("content", "word"),
    [
        ("{", "JSON"),
        ("3", "list"),
        ({"labels": []}, "list"),
        ([3], "entry 0"),
        ([{"mesh": "/a"}], "'group'"),
        ([{"mesh": 3, "group": "Tank"}], "'mesh'"),
        ([ROW, ROW], "twice"),
        ([{"mesh": "/a", "group": "Nonsense"}], "--vocabulary"),
        ([{"mesh": "/a", "group": "Tank", "name": "pipe"}], "'pipe' is no name of group 'Tank'"),
        ([{"mesh": "/a" * 9999, "group": "Tank"}], "'mesh'"),
    ],
)
def test_what_is_malformed_is_named(tmp_path, content, word):
    with pytest.raises(LabelError, match=word) as caught:
        read(tmp_path, content)
    assert "labels.json" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_csv_without_its_columns_is_named(tmp_path):
    with pytest.raises(LabelError, match="'group'"):
        read(tmp_path, "mesh,name\n/a,pipe\n", "labels.csv")


def test_our_own_table_of_parts_is_told_from_one_of_labels(tmp_path):
    with pytest.raises(LabelError, match=r"a table of parts.*--to labels-csv"):
        read(tmp_path, "part,group,name,largest_mesh\npart-00000,Tank,,/a\n", "parts.csv")


@pytest.mark.parametrize("text", ["pipe assembly/PIPE", "Pipe Assembly/pipe"])
def test_a_label_in_other_letters_is_suggested(text):
    with pytest.raises(LabelError, match="did you mean 'Pipe assembly/pipe'"):
        split_label(text, VOCABULARY)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(LabelError, match=r"nothing\.json"):
        read_labels(tmp_path / "nothing.json", VOCABULARY)


def test_bytes_that_are_no_text_are_named(tmp_path):
    (tmp_path / "labels.json").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(LabelError, match="UTF-8"):
        read_labels(tmp_path / "labels.json", VOCABULARY)


def test_a_quote_left_open_is_named(tmp_path):
    with pytest.raises(LabelError, match="quote"):
        read(tmp_path, 'mesh,group,name\n"' + "x" * 200_000, "labels.csv")


def test_a_row_of_too_few_or_too_many_values_is_named(tmp_path):
    path = tmp_path / "labels.csv"
    for text, says in (
        ("mesh,group,name\n/a,Tank,shell,more\n", "line 2: more values than columns"),
        ("mesh,group,name\n/a\n", "line 2: 'group' is missing"),
    ):
        path.write_text(text)
        with pytest.raises(LabelError, match=says):
            read_labels(path, default_vocabulary())


@pytest.mark.skipif(not Path("/dev/zero").is_char_device(), reason="needs devices")
def test_an_endless_device_is_refused():
    with pytest.raises(LabelError, match="a device"):
        read_labels("/dev/zero", default_vocabulary())
    with pytest.raises(LabelError, match="a device"):
        read_vocabulary("/dev/zero")
    with pytest.raises(ValueError, match="a device"):
        read_config("/dev/zero")
