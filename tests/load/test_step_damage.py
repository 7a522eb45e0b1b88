"""What of a damaged STEP file is missing is counted and told."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

pytest.importorskip("cascadio")

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.step_damage import Complaints, Counts, damage_of, hear, named_in
from load.solids import StepFile
from load.test_step import VALVES, more

STRICT = LoadConfig(strict=True)


def two_boxes():
    file = StepFile()
    first = file.product("First", [file.box((0, 0, 0), (10, 20, 30))])
    second = file.product("Second", [file.box((0, 0, 0), (5, 5, 5)), file.box((9, 9, 9), (12, 12, 12))])
    top = file.product("Top", (), [(0, 0, 0), (0, 0, 500)])
    for i, child in enumerate((first, second)):
        file.use(top, child, i, f"use{i}")
    return file


def text_of(file, folder):
    file.write(folder / "whole.step")
    return (folder / "whole.step").read_text()


def spoilt(text, every):
    """The text with each so manieth face on a surface that isn't there."""
    count = iter(range(1, 10**6))
    return re.sub(
        r"(ADVANCED_FACE\('[^']*',\([^)]*\),)#\d+",
        lambda found: f"{found[1]}#99999999" if next(count) % every == 0 else found[0],
        text,
    )


def notes_of(scene):
    return [note.message for note in scene.diagnostics if note.code == "damaged-source"]


def test_a_sound_file_is_not_called_damaged(tmp_path):
    text = text_of(two_boxes(), tmp_path)
    assert named_in(text.encode()) == Counts(1, 3, 18)
    (tmp_path / "a.step").write_text(text)
    assert notes_of(load(tmp_path / "a.step", STRICT)) == []


def test_missing_faces_are_told_with_what_is_named_and_what_came(tmp_path):
    (tmp_path / "a.step").write_text(spoilt(text_of(two_boxes(), tmp_path), 5))
    scene = load(tmp_path / "a.step")
    [message] = notes_of(scene)
    assert "3 of 18 faces are missing" in message
    assert "names 1 root, 3 solids, 18 faces" in message
    assert "15 faces" in message
    assert "Unresolved Reference" in message
    assert message.isprintable()


def test_strict_refuses_a_damaged_file_in_one_line(tmp_path):
    (tmp_path / "a.step").write_text(spoilt(text_of(two_boxes(), tmp_path), 5))
    with pytest.raises(LoadError, match=r"a\.step: .*--strict refuses.*3 of 18 faces") as caught:
        load(tmp_path / "a.step", STRICT)
    assert "\n" not in str(caught.value)


def test_an_instance_counts_once(tmp_path):
    file = StepFile()
    bolt = file.product("Bolt", [file.box((0, 0, 0), (10, 20, 30))])
    top = file.product("Top", (), [(0, 0, 0), (0, 0, 500)])
    for i in range(2):
        file.use(top, bolt, i, f"use{i}")
    (tmp_path / "a.step").write_text(text_of(file, tmp_path))
    scene = load(tmp_path / "a.step", STRICT)
    assert scene.n_meshes == 2


def test_nothing_is_said_where_the_file_names_no_faces_and_nobody_complains():
    assert damage_of("IGES", None, Counts(1, 1, 5), Complaints()) is None
    assert damage_of("STEP", Counts(1, 0, 0), Counts(1, 1, 12), Complaints()) is None


def test_many_complaints_are_counted_and_the_first_ones_told():
    lines = [f"ERR entity {n}" for n in range(40)]
    found = damage_of("IGES", None, Counts(1, 1, 5), Complaints(lines))
    assert "objects 40 times: ERR entity 0; ERR entity 1; ERR entity 2" in found.message
    assert "entity 3" not in found.message


def test_what_a_library_writes_to_standard_output_is_heard_and_goes_nowhere():
    code = (
        "import os\n"
        "from cadgraph.load.step_damage import hear\n"
        "print('before')\n"
        "with hear() as told:\n"
        "    os.write(1, b'\\x1b[31mERR one\\x1b[0m\\nall is well\\n')\n"
        "print('after', told.lines)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["before", "after ['ERR one']"]


def test_an_error_within_leaves_standard_output_as_it_was(capfd):
    with pytest.raises(KeyError), hear():
        raise KeyError
    os.write(1, b"there")
    assert "there" in capfd.readouterr().out


@more
@pytest.mark.slow
@pytest.mark.long
def test_no_real_file_is_called_damaged():
    files = sorted(VALVES.parents[1].rglob("*.st*p"))
    assert len(files) > 50
    for file in files:
        assert notes_of(load(file)) == [], file
