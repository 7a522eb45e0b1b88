import json

import pytest

from cadgraph._io.json_rows import json_row, read_json, write_json_rows
from cadgraph.model.labels import Guess


def test_each_key_and_each_row_has_a_line(tmp_path):
    write_json_rows(tmp_path / "a.json", {"a": [1, 2], "rows": [{"x": 1}, {"x": "é"}], "none": []}, ("rows", "none"))
    lines = ["{", ' "a": [1, 2],', ' "rows": [', '  {"x": 1},', '  {"x": "é"}', " ],", ' "none": []', "}", ""]
    assert (tmp_path / "a.json").read_text(encoding="utf-8") == "\n".join(lines)


def test_a_lone_surrogate_reads_back(tmp_path):
    write_json_rows(tmp_path / "a.json", {"name": "\ud800"}, ())
    assert json.loads((tmp_path / "a.json").read_text(encoding="utf-8")) == {"name": "\ud800"}


def test_a_number_that_json_lacks_is_refused_and_nothing_is_written(tmp_path):
    with pytest.raises(ValueError, match="JSON"):
        write_json_rows(tmp_path / "a.json", {"rows": [float("nan")]}, ("rows",))
    assert list(tmp_path.iterdir()) == []


def row(**others):
    return Guess("Pipe assembly", "pipe", 0.5, **others)


def test_a_record_stands_as_its_plain_values_do(tmp_path):
    write_json_rows(tmp_path / "a.json", {"rows": (row(note="é"), row())}, ("rows",))
    text = (tmp_path / "a.json").read_text(encoding="utf-8")
    assert json.loads(text) == {"rows": [row(note="é").model_dump(mode="json"), row().model_dump(mode="json")]}
    assert text.count("\n  {") == 2


@pytest.mark.parametrize("value", [float("nan"), [float("inf")], {"deep": -float("inf")}])
def test_a_number_that_json_lacks_in_a_record_is_refused_and_nothing_is_written(tmp_path, value):
    with pytest.raises(ValueError, match="JSON"):
        write_json_rows(tmp_path / "a.json", {"rows": (row(other=value),)}, ("rows",))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("text", ["NaN", "to Infinity and beyond", "\ud800", 'quotes " and \\'])
def test_texts_of_a_record_read_back(text):
    assert json.loads(json_row(row(other=text)))["other"] == text


@pytest.mark.parametrize(
    "text", ['{"a": [1, 2.5, "\\u00e9", null, true]}', '"\\ud800"', "[1e400, 123456789012345678901234567890]"]
)
def test_json_is_read_as_the_standard_library_reads_it(text):
    assert read_json(text) == json.loads(text)


@pytest.mark.parametrize("text", ["", "{", "[1,]", "[" * 5000])
def test_what_is_no_json_is_refused(text):
    with pytest.raises((ValueError, RecursionError)):
        read_json(text)
