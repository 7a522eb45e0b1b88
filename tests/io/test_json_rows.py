import json

import pytest

from cadgraph._io.json_rows import write_json_rows


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
