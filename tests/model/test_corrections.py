import json

import pytest

from cadgraph.errors import LabelError
from cadgraph.model.corrections import Correction, Fingerprint, read_corrections, with_correction, write_corrections
from cadgraph.model.vocabulary import default_vocabulary

PRINT = Fingerprint(12, (1.0, 0.5, 0.4, 0.3))
ONE = Correction("/a", "Tank", "tank", PRINT, (1.0, 2.0, 3.0))
TWO = Correction("/b \ud800 ü", "Valve assembly", None, PRINT, (0.0, 0.0, 0.0), this_only=True)


def test_corrections_come_back_as_they_were(tmp_path):
    file = write_corrections([ONE, TWO], tmp_path / "corrections.json")
    assert read_corrections(file, default_vocabulary()) == (ONE, TWO)
    assert read_corrections(tmp_path) == (ONE, TWO)
    first = file.read_bytes()
    assert write_corrections([ONE, TWO], file).read_bytes() == first


def test_no_file_is_no_correction(tmp_path):
    assert read_corrections(tmp_path) == ()


def test_a_new_correction_replaces_that_of_the_same_mesh():
    again = Correction("/a", "Tank", "shell", PRINT, (0.0, 0.0, 0.0))
    assert with_correction([ONE, TWO], again) == (TWO, again)


@pytest.mark.parametrize(
    ("n", "long", "agrees"), [(12, 1.0, True), (13, 1.0, False), (12, 1.0009, True), (12, 1.002, False)]
)
def test_fingerprints_agree_within_rounding(n, long, agrees):
    assert PRINT.agrees(Fingerprint(n, (long, 0.5, 0.4, 0.3))) is agrees


ROW = {
    "mesh": "/a", "group": "Tank", "name": "tank", "n_triangles": 12, "lengths": [1, 1, 1, 1], "centroid": [0, 0, 0],
}  # fmt: skip


@pytest.mark.parametrize(
    "change",
    [
        {"mesh": 3}, {"mesh": ""}, {"group": None}, {"name": ["x"]}, {"this_only": "yes"}, {"n_triangles": -1},
        {"n_triangles": True}, {"n_triangles": 1.5}, {"lengths": [1, 1, 1]}, {"lengths": "abcd"},
        {"lengths": [1, 1, 1, 1e400]}, {"centroid": [0, 0, float("nan")]}, {"centroid": [0, 0, 10**400]},
        {"mesh": "x" * 5000}, {"name": "no such name"}, {"group": "Spaceship"},
    ],
    ids=lambda change: str(change)[:30],
)  # fmt: skip
def test_a_damaged_row_is_refused_in_one_line_that_names_it(tmp_path, change):
    file = tmp_path / "corrections.json"
    rows = [ROW, {**ROW, **change}]
    file.write_text(json.dumps({"format": "cadgraph-corrections", "version": 1, "corrections": rows}))
    with pytest.raises(LabelError, match="correction 1") as caught:
        read_corrections(file, default_vocabulary())
    assert "\n" not in str(caught.value)
    assert str(file) in str(caught.value)


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "[" * 100_000, '{"format": "x"}', '{"format": "cadgraph-corrections", "version": 2}',
     '{"format": "cadgraph-corrections", "version": 1, "corrections": {}}', "\udcff"],
    ids=lambda text: text[:20],
)  # fmt: skip
def test_a_damaged_file_is_refused_in_one_line(tmp_path, text):
    file = tmp_path / "corrections.json"
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(LabelError) as caught:
        read_corrections(file)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)
