import errno
import os
import stat
import sys
from contextlib import nullcontext

import pytest

from cadgraph._io.atomic import ensure_writable, replacing, write_atomically
from cadgraph.errors import OutputError


def test_text_is_written_as_utf8_with_line_feeds(tmp_path):
    write_atomically(tmp_path / "a.txt", "é\n")
    assert (tmp_path / "a.txt").read_bytes() == b"\xc3\xa9\n"


def test_folders_are_made_and_nothing_else_is_left(tmp_path):
    write_atomically(tmp_path / "a" / "b" / "c.bin", b"\x00")
    assert [path.name for path in (tmp_path / "a" / "b").iterdir()] == ["c.bin"]


def test_a_failing_block_leaves_the_old_file_and_nothing_beside_it(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old", encoding="utf-8")

    def fail():
        with replacing(target) as beside:
            beside.write_text("half", encoding="utf-8")
            raise RuntimeError("stop")

    with pytest.raises(RuntimeError, match="stop"):
        fail()
    assert target.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_the_path_beside_keeps_the_suffix(tmp_path):
    with replacing(tmp_path / "scene.usdc") as beside:
        assert beside.suffix == ".usdc"
        assert beside.parent == tmp_path


def test_the_old_file_stays_until_the_block_ends(tmp_path):
    target = tmp_path / "a.txt"
    write_atomically(target, "old")
    with replacing(target) as beside:
        beside.write_text("new", encoding="utf-8")
        assert target.read_text(encoding="utf-8") == "old"
    assert target.read_text(encoding="utf-8") == "new"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such modes")
def test_the_file_gets_the_modes_that_any_new_file_gets(tmp_path):
    (tmp_path / "plain").write_text("", encoding="utf-8")
    write_atomically(tmp_path / "ours", "")
    assert os.stat(tmp_path / "ours").st_mode == os.stat(tmp_path / "plain").st_mode


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such modes")
def test_a_file_that_is_replaced_keeps_its_modes(tmp_path):
    for mode in (0o600, 0o640, 0o664, 0o444):
        target = tmp_path / f"{mode:o}"
        target.write_text("old", encoding="utf-8")
        target.chmod(mode)
        write_atomically(target, "new")
        assert (target.read_text(encoding="utf-8"), os.stat(target).st_mode & 0o777) == ("new", mode)


def test_the_umask_of_the_process_is_never_touched(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "umask", lambda mask: pytest.fail("another thread would write with that mask"))
    write_atomically(tmp_path / "a", "")


def test_a_name_that_is_taken_is_left_alone(tmp_path, monkeypatch):
    taken = iter(["00000000", "11111111"])
    monkeypatch.setattr("cadgraph._io.atomic.secrets.token_hex", lambda n: next(taken))
    (tmp_path / ".a-00000000.txt").write_text("somebody's", encoding="utf-8")
    write_atomically(tmp_path / "a.txt", "ours")
    assert (tmp_path / ".a-00000000.txt").read_text(encoding="utf-8") == "somebody's"
    assert sorted(path.name for path in tmp_path.iterdir()) == [".a-00000000.txt", "a.txt"]


def test_a_file_where_a_folder_should_be_is_an_output_error(tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    for attempt in (lambda: write_atomically(tmp_path / "file" / "a", ""), lambda: ensure_writable(tmp_path / "file")):
        with pytest.raises(OutputError, match="choose another output folder"):
            attempt()


def test_a_folder_where_the_file_should_be_is_an_output_error(tmp_path):
    (tmp_path / "a.txt").mkdir()
    with pytest.raises(OutputError, match=r"a\.txt: can't be written"):
        write_atomically(tmp_path / "a.txt", "text")
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]


def test_a_writable_folder_is_made_and_left_empty(tmp_path):
    assert ensure_writable(tmp_path / "a" / "b") == tmp_path / "a" / "b"
    assert list((tmp_path / "a" / "b").iterdir()) == []


def test_a_full_disk_is_found_before_a_long_run(tmp_path, monkeypatch):
    def full(file):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OutputError, match="No space left on device"):
        ensure_writable(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "O_DIRECTORY"), reason="folders can't be flushed here")
@pytest.mark.parametrize(("number", "refused"), [(errno.EINVAL, False), (errno.EIO, True)])
def test_a_share_that_flushes_no_folders_is_written_and_a_failing_disk_is_said(tmp_path, monkeypatch, number, refused):
    flush = os.fsync

    def only_files(file):
        if stat.S_ISDIR(os.fstat(file).st_mode):
            raise OSError(number, os.strerror(number))
        flush(file)

    monkeypatch.setattr("os.fsync", only_files)
    with pytest.raises(OutputError, match="not sure") if refused else nullcontext():
        write_atomically(tmp_path / "a.txt", "text", durable=True)
    assert (tmp_path / "a.txt").read_text() == "text"
