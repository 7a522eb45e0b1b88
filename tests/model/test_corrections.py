"""corrections.json: what is in force, what was ever done, and what is refused."""

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time

import pytest

from cadgraph.errors import LabelError, OutputError
from cadgraph.model.anchors import Anchor
from cadgraph.model.corrections import (
    Correction,
    CorrectionsFile,
    Fingerprint,
    History,
    read_corrections,
    read_history,
    with_correction,
    write_corrections,
    write_history,
)
from cadgraph.model.edits import Cut, Direction, Forget, Ground, Join, Merge, Split, Tag, check_tag, describe, fold
from cadgraph.model.vocabulary import default_vocabulary

PRINT = Fingerprint(12, (1.0, 0.5, 0.4, 0.3))
ONE = Correction("/a", "Tank", "tank", PRINT, (1.0, 2.0, 3.0))
TWO = Correction("/b \ud800 ü", "Valve assembly", None, PRINT, (0.0, 0.0, 0.0), this_only=True)
A, B, C = (Anchor(path, PRINT, (1.0, 2.0, 3.0)) for path in ("/a", "/b", "/c"))
EVERY = (
    ONE,
    Merge((A, B)),
    Split((A,)),
    Join(A, B),
    Cut(B, C),
    Direction((A,), (B,), (C,), ((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)), "backward"),
    Tag((A, B), "V-4711 <b> ü"),
    Ground(A, True),
)


def test_corrections_come_back_as_they_were(tmp_path):
    file = write_corrections([ONE, TWO], tmp_path / "corrections.json")
    assert read_corrections(file, default_vocabulary()) == (ONE, TWO)
    assert read_corrections(tmp_path) == (ONE, TWO)
    first = file.read_bytes()
    assert write_corrections([ONE, TWO], file).read_bytes() == first


def test_every_kind_comes_back_with_who_when_and_why(tmp_path):
    history = History().do(EVERY, "all at once", when="2026-01-02T03:04:05Z", who="Ann\nB", why="x" * 3000)
    history = history.do((Forget(A),), "forgotten").undo(who="Bob").redo().undo()
    file = write_history(history, tmp_path / "corrections.json")
    again = read_history(tmp_path)
    assert again == history
    assert again.in_force == EVERY
    assert (again.events[0].who, len(again.events[0].why)) == ("Ann B", 2000)
    assert write_history(again, file).read_bytes() == file.read_bytes()
    assert all(describe(edit) for edit in EVERY)


def test_the_first_version_is_still_read(tmp_path):
    file = tmp_path / "corrections.json"
    rows = [ROW, {**ROW, "mesh": "/b", "this_only": True}]
    file.write_text(json.dumps({"format": "cadgraph-corrections", "version": 1, "corrections": rows}))
    history = read_history(file, default_vocabulary())
    assert [(edit.mesh, edit.this_only) for edit in history.in_force] == [("/a", False), ("/b", True)]
    assert [edit.mesh for edit in history.undo().in_force] == ["/a"]
    write_history(history, file)
    assert json.loads(file.read_text())["version"] == 2
    assert read_history(file) == history


def test_no_file_is_no_correction(tmp_path):
    assert read_corrections(tmp_path) == ()
    assert read_history(tmp_path) == History()


def test_a_new_correction_replaces_that_of_the_same_mesh():
    again = Correction("/a", "Tank", "shell", PRINT, (0.0, 0.0, 0.0))
    assert with_correction([ONE, TWO], again) == (TWO, again)
    assert fold([ONE, TWO, again]) == (TWO, again)


def test_of_two_edits_about_the_same_the_later_one_counts():
    assert fold([ONE, Forget(A)]) == ()
    assert fold([Join(A, B), Cut(B, A)]) == (Cut(B, A),)
    assert fold([Tag((A, B), "x"), Tag((B, A), "y")]) == (Tag((B, A), "y"),)
    assert fold([Ground(A, True), Ground(B, True), Ground(A, False)]) == (Ground(B, True), Ground(A, False))
    assert fold([Merge((A, B)), Split((A,)), Merge((A, B))]) == (Merge((A, B)), Split((A,)), Merge((A, B)))


def test_undo_and_redo_have_no_limit_and_nothing_is_ever_taken_out():
    history = History()
    for k in range(300):
        history = history.do((Tag((A,), f"V-{k}"),), f"tag {k}")
    for _ in range(300):
        history = history.undo()
    assert (history.in_force, history.can_undo, history.can_redo) == ((), False, True)
    with pytest.raises(ValueError, match="nothing to undo"):
        history.undo()
    for _ in range(299):
        history = history.redo()
    assert history.in_force == (Tag((A,), "V-298"),)
    history = history.do((ONE,), "another way")
    assert not history.can_redo
    with pytest.raises(ValueError, match="nothing to redo"):
        history.redo()
    assert len(history.events) == 900
    rows = history.audit()
    assert [row["id"] for row in rows] == list(range(900, 0, -1))
    assert (rows[0]["what"], rows[1]["what"]) == ("another way", "done again: tag 298")
    assert [row["what"] for row in rows if row["undone"]] == ["tag 299"]


def test_what_another_program_wrote_is_not_written_over(tmp_path):
    mine, theirs = CorrectionsFile(tmp_path), CorrectionsFile(tmp_path)
    history = mine.read()
    theirs.read()
    mine.write(history := history.do((ONE,), "mine"))
    mine.write(history := history.do((TWO,), "mine, too"))
    with pytest.raises(OutputError, match="another program"):
        theirs.write(History().do((ONE,), "theirs"))
    assert read_history(tmp_path) == history
    theirs.write(theirs.read().undo())
    with pytest.raises(OutputError, match="another program"):
        mine.write(history.undo())


def test_what_could_not_be_read_again_is_not_written(tmp_path):
    deep = dataclasses.replace(ONE, mesh="/" + "assembly/" * 1000)
    file = CorrectionsFile(tmp_path)
    file.write(History().do((deep,), describe(deep)))
    assert read_corrections(tmp_path) == (deep,)
    document = json.loads((tmp_path / "corrections.json").read_text())
    document["events"][0]["id"] = 999_999_999_999
    (tmp_path / "corrections.json").write_text(json.dumps(document))
    before = (tmp_path / "corrections.json").read_bytes()
    with pytest.raises(OutputError, match="'id' must be a whole number, so it can't be kept"):
        file.write(file.read().undo())
    assert (tmp_path / "corrections.json").read_bytes() == before


def test_nothing_is_written_where_the_folder_was(tmp_path):
    (tmp_path / "out").mkdir()
    file = CorrectionsFile(tmp_path / "out")
    file.write(history := file.read().do((ONE,), "one"))
    (tmp_path / "out").rename(tmp_path / "elsewhere")
    for _ in range(2):
        with pytest.raises(LabelError, match="the folder is gone"):
            file.write(history.do((TWO,), "two"))
        assert not (tmp_path / "out" / "corrections.json").exists()
        (tmp_path / "out").mkdir(exist_ok=True)
    (tmp_path / "out").rmdir()
    (tmp_path / "elsewhere").rename(tmp_path / "out")
    file.write(history.do((TWO,), "two"))
    assert len(read_corrections(tmp_path / "out")) == 2


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_does_not_make_anybody_wait(tmp_path):
    os.mkfifo(tmp_path / "corrections.json")
    with pytest.raises(LabelError, match="a pipe"):
        read_history(tmp_path)


WRITER = """
import sys
from cadgraph.model.corrections import CorrectionsFile, Correction, Fingerprint
file = CorrectionsFile(sys.argv[1])
history = file.read()
for k in range(100_000):
    edit = Correction(f"/{k}", "Tank", None, Fingerprint(1, (1.0, 1.0, 1.0, 1.0)), (0.0, 0.0, 0.0))
    history = history.do((edit,), f"edit {k}")
    file.write(history)
    print(len(history.events), flush=True)
"""


def test_a_kill_loses_nothing_that_was_confirmed(tmp_path):
    for wait in (0.03, 0.11):
        with subprocess.Popen(
            [sys.executable, "-c", WRITER, str(tmp_path)], stdout=subprocess.PIPE, text=True
        ) as writer:
            confirmed = int(writer.stdout.readline())
            time.sleep(wait)
            os.kill(writer.pid, signal.SIGKILL)
            confirmed = max([confirmed, *map(int, writer.stdout.read().split("\n")[:-1])])
        held = read_history(tmp_path)
        assert confirmed <= len(held.events) <= confirmed + 1
        assert len(held.in_force) >= 1


@pytest.mark.parametrize(
    ("tag", "words"),
    [("", "at least"), ("  ", "at least"), ("x" * 65, "at most 64"), ("a\tb", "printed"), ("\u202e", "printed")],
)
def test_a_tag_is_printable_and_short(tag, words):
    with pytest.raises(ValueError, match=words):
        check_tag(tag)
    assert check_tag(" V-4711 / ä ") == "V-4711 / ä"


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
        {"group": "x" * 5000}, {"name": "no such name"}, {"group": "Spaceship"},
    ],
    ids=lambda change: str(change)[:30],
)  # fmt: skip
def test_a_damaged_row_is_refused_in_one_line_that_names_it(tmp_path, change):
    file = tmp_path / "corrections.json"
    rows = [ROW, {**ROW, **change}]
    file.write_text(json.dumps({"format": "cadgraph-corrections", "version": 1, "corrections": rows}))
    with pytest.raises(LabelError, match="correction 2") as caught:
        read_corrections(file, default_vocabulary())
    assert "\n" not in str(caught.value)
    assert str(file) in str(caught.value)


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "[" * 100_000, '{"format": "x"}', '{"format": "cadgraph-corrections", "version": 3}',
     '{"format": "cadgraph-corrections", "version": true}',
     '{"format": "cadgraph-corrections", "version": 1, "corrections": {}}',
     '{"format": "cadgraph-corrections", "version": 2, "corrections": []}', "\udcff"],
    ids=lambda text: text[:20],
)  # fmt: skip
def test_a_damaged_file_is_refused_in_one_line(tmp_path, text):
    file = tmp_path / "corrections.json"
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(LabelError) as caught:
        read_corrections(file)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


ANCHOR = {"mesh": "/a", "n_triangles": 12, "lengths": [1, 1, 1, 1], "centroid": [0, 0, 0]}
EDITS = {
    "label": {"kind": "label", "part": ANCHOR, "group": "Tank", "name": "tank", "this_only": False},
    "forget": {"kind": "forget", "part": ANCHOR},
    "merge": {"kind": "merge", "parts": [ANCHOR, ANCHOR]},
    "split": {"kind": "split", "parts": [ANCHOR]},
    "join": {"kind": "join", "first": ANCHOR, "second": ANCHOR},
    "cut": {"kind": "cut", "first": ANCHOR, "second": ANCHOR},
    "direction": {"kind": "direction", "source": [ANCHOR], "target": [], "via": [], "ends": [[0, 0, 0], [1, 1, 1]],
                  "flow": "forward"},
    "tag": {"kind": "tag", "parts": [ANCHOR], "tag": "V-4711"},
    "ground": {"kind": "ground", "mesh": ANCHOR, "ground": True},
}  # fmt: skip
EVENT = {"event": "do", "id": 7, "when": "", "who": "", "why": "", "what": "x", "edits": list(EDITS.values())}
BAD_ANCHORS = [{**ANCHOR, key: value} for key in ANCHOR for value in (None, "", [1], {}, True, 1e400, -1)]


def written(tmp_path, *events):
    file = tmp_path / "corrections.json"
    file.write_text(json.dumps({"format": "cadgraph-corrections", "version": 2, "events": events}))
    return file


def test_the_sound_rows_are_read(tmp_path):
    assert len(read_history(written(tmp_path, EVENT), default_vocabulary()).events[0].edits) == len(EDITS)


def bad_edits():
    for kind, row in EDITS.items():
        yield {**row, "kind": "paint"}
        for key in set(row) - {"kind", "name", "this_only"}:
            without = {k: v for k, v in row.items() if k != key}
            yield without
            for value in (None, 3, "", "x" * 5000, {"mesh": 1}, [{}], [[0], [0]], ["a"]):
                is_text = isinstance(value, str) and value and len(value) < 5000
                if not is_text and not (kind == "direction" and value == []):
                    yield {**row, key: value}
        for key in ("part", "first", "second", "mesh"):
            if key in row:
                yield from ({**row, key: bad} for bad in BAD_ANCHORS)


def test_every_bad_field_of_every_edit_ends_in_one_line(tmp_path):
    refused = 0
    for edit in bad_edits():
        file = written(tmp_path, EVENT, {**EVENT, "id": 8, "edits": [EDITS["cut"], edit]})
        with pytest.raises(LabelError, match="correction 2: edit 2") as caught:
            read_history(file)
        assert "\n" not in str(caught.value)
        assert len(str(caught.value)) < 500
        refused += 1
    assert refused > 200


@pytest.mark.parametrize(
    "change",
    [
        {"event": "erase"}, {"event": None}, {"id": "8"}, {"id": True}, {"id": 7}, {"id": 3}, {"id": -1}, {"when": 3},
        {"who": None}, {"why": ["x"]}, {"what": "x" * 5000}, {"edits": []}, {"edits": {}}, {"edits": [3]},
        {"event": "undo"}, {"event": "undo", "of": "7"}, {"event": "undo", "of": 6}, {"event": "redo", "of": 7},
    ],
    ids=lambda change: str(change)[:30],
)  # fmt: skip
def test_every_bad_field_of_an_event_ends_in_one_line(tmp_path, change):
    for row in ({**EVENT, "id": 8, **change}, [change]):
        file = written(tmp_path, EVENT, row)
        with pytest.raises(LabelError) as caught:
            read_history(file)
        assert "\n" not in str(caught.value)
        assert str(file) in str(caught.value)


def test_labels_that_are_undone_for_good_need_no_vocabulary(tmp_path):
    odd = Correction("/a", "Spaceship", None, PRINT, (0.0, 0.0, 0.0))
    history = History().do((odd,), "odd")
    write_history(history, tmp_path / "corrections.json")
    with pytest.raises(LabelError, match="Spaceship"):
        read_history(tmp_path, default_vocabulary())
    write_history(history.undo().do((ONE,), "sound"), tmp_path / "corrections.json")
    assert read_history(tmp_path, default_vocabulary()).in_force == (ONE,)
