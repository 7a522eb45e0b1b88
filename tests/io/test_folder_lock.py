"""A folder is held by one process at a time; who comes second is told by whom; what a killed one left is taken over."""

import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from cadgraph._io import folder_lock
from cadgraph._io.folder_lock import LOCK, holding
from cadgraph.errors import OutputError

HOLD = """
import sys
from cadgraph._io.folder_lock import holding
sys.argv = ["/usr/bin/cadgraph", "build", "secret-plant.usd"]
with holding(FOLDER):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(tmp_path):
    """Another process that holds the folder until it is ended."""
    folder = tmp_path / "plant"
    folder.mkdir()
    code = HOLD.replace("FOLDER", repr(str(folder)))
    process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout.readline().strip() == b"held"
    yield folder, process
    process.kill()
    process.communicate()


def refused(folder):
    with pytest.raises(OutputError) as told, holding(folder):
        pass
    return str(told.value)


def test_who_comes_second_is_told_by_which_process(holder):
    folder, process = holder
    said = refused(folder)
    assert said == (
        f"{folder}: another cadgraph is at work in it (process {process.pid}, cadgraph build); end that one first"
    )
    assert "secret" not in (folder / LOCK).read_text(), "what it is at work on is nobody's business"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_what_a_killed_process_left_is_taken_over(holder):
    folder, process = holder
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert (folder / LOCK).exists()
    with holding(folder):
        assert json.loads((folder / LOCK).read_text())["pid"] == os.getpid()
    assert list(folder.iterdir()) == []


@pytest.mark.skipif(not Path("/proc/locks").exists(), reason="only Linux tells who holds a lock")
def test_the_system_knows_better_than_a_note_that_was_left(holder):
    folder, process = holder
    for left in ({"pid": 1, "command": "cadgraph view", "host": socket.gethostname()}, {"pid": "x"}, []):
        (folder / LOCK).write_text(json.dumps(left))
        assert f"process {process.pid}" in refused(folder)
        assert "cadgraph view" not in refused(folder)


def test_without_the_systems_word_a_note_counts_while_its_process_runs(holder, monkeypatch):
    folder, process = holder
    monkeypatch.setattr(folder_lock, "_PROC_LOCKS", folder / "nothing")
    assert f"process {process.pid}, cadgraph build" in refused(folder)
    if sys.platform == "win32":
        return
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    (folder / LOCK).write_text(json.dumps({"pid": gone.pid, "command": "x", "host": socket.gethostname()}))
    assert "(a build, or cadgraph view)" in refused(folder)
    (folder / LOCK).write_text(json.dumps({"pid": 12, "command": "cadgraph\x1b[2J view", "host": "another"}))
    assert "process 12 on another, cadgraph" in refused(folder)
    assert "\x1b" not in refused(folder)


def test_a_second_block_of_the_same_process_is_told_so(tmp_path):
    with holding(tmp_path):
        assert "this very process" in refused(tmp_path)


@pytest.mark.skipif(sys.platform == "win32", reason="there the note is the lock")
def test_a_note_is_never_written_through_a_link(tmp_path):
    mine = tmp_path / "mine.txt"
    mine.write_text("mine")
    folder = tmp_path / "plant"
    folder.mkdir()
    (folder / LOCK).symlink_to(mine)
    with holding(folder):
        pass
    assert mine.read_text() == "mine"
