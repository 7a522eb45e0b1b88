"""Files come into a folder together: a process that is ended at any step leaves the folder as before or as after."""

import hashlib
import json
import os
import shutil

import pytest

from cadgraph._io import results
from cadgraph._io.atomic import write_atomically
from cadgraph._io.folder_lock import holding
from cadgraph._io.limits import GRAPH
from cadgraph._io.manifest import (
    MANIFEST,
    behind,
    changed_by_others,
    manifest_in,
    of_an_earlier_graph,
    read_checked,
)
from cadgraph._io.results import new_results, settle, settle_if_free
from cadgraph._io.run_folder import at_work_in, one_of_results
from cadgraph._io.staging import NEXT, READY, redirecting, result_path, staged_path
from cadgraph.errors import FormatError, OutputError

OLD = {"graph.json": "old graph", "semantics.usda": "old labels", "report.html": "old report", "devices.json": "old"}
NEW = {"graph.json": "new graph", "semantics.usda": "new labels", "timings.json": "{}", "corrections.json": "new edits"}
AFTER = {**OLD, **NEW}
del AFTER["devices.json"]  # dropped


class Killed(BaseException):
    """Stands for the end of the process: nothing that would tidy up runs after it."""


def write(folder, contents, **more):
    with new_results(folder, **more):
        for name, content in contents.items():
            write_atomically(folder / name, content)


@pytest.fixture
def folder(tmp_path):
    target = tmp_path / "plant"
    target.mkdir()
    write(target, OLD)
    (target / "mine.txt").write_text("somebody's")
    return target


def contents(folder):
    """What a reader finds without moving anything."""
    names = {path.name for place in (folder, folder / READY) if place.is_dir() for path in place.iterdir()}
    names -= {NEXT, READY, MANIFEST, "mine.txt"}
    return {name: result_path(folder / name).read_text() for name in names}


def holds(folder, expected):
    for path in folder.iterdir():
        assert not path.name.startswith("."), path.name
    found = {path.name: path.read_text() for path in folder.iterdir() if path.name not in (MANIFEST, "mine.txt")}
    assert (folder / "mine.txt").read_text() == "somebody's"
    assert changed_by_others(folder) == ()
    return found == expected


def test_all_come_together_and_the_manifest_names_them(folder):
    write(folder, NEW, dropped=("devices.json", "timings.json"))
    assert holds(folder, AFTER)
    manifest = manifest_in(folder)
    assert manifest.graph == hashlib.sha256(b"new graph").hexdigest()
    assert manifest.corrections == hashlib.sha256(b"new edits").hexdigest()
    assert sorted(manifest.files) == ["graph.json", "report.html", "semantics.usda", "timings.json"]
    assert of_an_earlier_graph(folder) == ("report.html",)
    assert not behind(folder)


def test_nothing_is_in_its_place_before_the_block_ends(folder):
    with new_results(folder):
        path = folder / "graph.json"
        write_atomically(path, "new graph")
        assert path.read_text() == "old graph"
        assert result_path(path).read_text() == "new graph", "the writer itself sees what it wrote"
    assert path.read_text() == "new graph"


@pytest.mark.parametrize("reason", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_a_failing_block_changes_nothing(folder, reason):
    def fail():
        with new_results(folder):
            write_atomically(folder / "graph.json", "new graph")
            raise reason

    with pytest.raises(reason):
        fail()
    assert holds(folder, OLD)


def test_files_are_on_the_disk_before_they_count(folder, monkeypatch):
    seen, fsync, replace = [], os.fsync, os.replace

    def flushed(number):
        seen.append(os.fstat(number).st_ino)
        return fsync(number)

    def renamed(source, target):
        if str(target).endswith(READY):
            seen.append({path.name: path.stat().st_ino for path in (*source.rglob("*"), source)})
        return replace(source, target)

    monkeypatch.setattr(os, "fsync", flushed)
    monkeypatch.setattr(os, "replace", renamed)
    write(folder, {**NEW, "graph-shards/nodes-00000.gz": "rows"})
    at = next(i for i, one in enumerate(seen) if isinstance(one, dict))
    files = seen[at] if hasattr(os, "O_DIRECTORY") else {name: n for name, n in seen[at].items() if "." in name[1:]}
    assert {*NEW, MANIFEST} < set(files)
    assert set(files.values()) <= set(seen[:at])
    if hasattr(os, "O_DIRECTORY"):
        assert folder.stat().st_ino in seen[at + 1 :]
        assert (folder / "graph-shards").stat().st_ino in seen[at + 1 :]


def steps_of(monkeypatch, act):
    """How often the system is asked to rename or remove something while a commit goes on."""
    count = [0]
    end_at(monkeypatch, None, count)
    act()
    monkeypatch.undo()
    return count[0]


def end_at(monkeypatch, number, count, after=False):
    """Ends the process at the n-th rename or removal of a file or a folder: before it, or right after it."""

    def ending(real):
        def step(*args, **more):
            here = count[0] = count[0] + 1
            if number is not None and here > number:
                raise Killed  # what would tidy up does not run either
            if here == number and not after:
                raise Killed
            done = real(*args, **more)
            if here == number:
                raise Killed
            return done

        return step

    for owner, name in ((os, "replace"), (os, "rename"), (os, "unlink"), (shutil, "rmtree")):
        monkeypatch.setattr(owner, name, ending(getattr(owner, name)))


def commit(folder):
    new = results.NewResults(folder, ("devices.json", "timings.json"))
    with redirecting(folder):
        for name, content in NEW.items():
            place = staged_path(folder / name)
            place.parent.mkdir(exist_ok=True)
            place.write_text(content)
    new.commit()


@pytest.mark.parametrize("after", [False, True])
def test_wherever_it_ends_the_folder_is_as_before_or_as_after(folder, tmp_path, monkeypatch, after):
    trial = tmp_path / "trial"
    shutil.copytree(folder, trial)
    n = steps_of(monkeypatch, lambda: commit(trial))
    assert n >= len(NEW) + 3, "a rename for each, the one that counts, the manifest, the folder"
    states = []
    for number in range(1, n + 1):
        here = tmp_path / f"ended-{number}"
        shutil.copytree(folder, here)
        end_at(monkeypatch, number, [0], after)
        with pytest.raises(Killed):
            commit(here)
        monkeypatch.undo()
        # A reader that may not move anything finds one of both, by the digests, too.
        read = contents(here)
        content = read_checked(here / "graph.json", GRAPH, FormatError, "").decode()
        assert read["graph.json"] == content
        states.append(content)
        expected = AFTER if content == "new graph" else OLD
        assert {name: read.get(name) for name in expected} == expected
        assert changed_by_others(here) == ()
        with at_work_in(here):
            pass
        assert holds(here, expected)
        # And the same may be done again.
        write(here, NEW, dropped=("devices.json", "timings.json"))
        assert holds(here, AFTER)
    assert states == sorted(states, reverse=True), "once it counts, it counts"
    assert {"old graph", "new graph"} == set(states) if not after else "new graph" in states


def test_a_move_that_was_interrupted_is_ended_by_the_next_reader(folder, monkeypatch):
    end_at(monkeypatch, 2, [0])
    with pytest.raises(Killed):
        commit(folder)
    monkeypatch.undo()
    assert (folder / READY).is_dir()
    with holding(folder):
        settle_if_free(folder)
        assert (folder / READY).is_dir(), "somebody is at work, who does it himself"
    settle_if_free(folder)
    assert holds(folder, AFTER)


def test_what_was_begun_and_not_complete_goes_with_the_next_writer(folder):
    (folder / NEXT).mkdir()
    (folder / NEXT / "graph.json").write_text("half")
    assert contents(folder) == OLD
    with at_work_in(folder):
        pass
    assert holds(folder, OLD)


def test_files_below_the_folder_come_too(folder):
    with new_results(folder):
        write_atomically(folder / "mjcf" / "meshes" / "a.obj", "v")
        assert not (folder / "mjcf").exists()
    assert (folder / "mjcf" / "meshes" / "a.obj").read_text() == "v"
    assert not (folder / NEXT).exists()


def test_what_lies_elsewhere_is_written_at_once(folder, tmp_path):
    with new_results(folder):
        write_atomically(tmp_path / "other.txt", "x")
        assert (tmp_path / "other.txt").exists()


def test_a_folder_by_another_name_is_the_same_folder(folder, tmp_path):
    (tmp_path / "link").symlink_to(folder, target_is_directory=True)
    with new_results(tmp_path / "link"):
        write_atomically(folder / "graph.json", "new graph")
        assert (folder / "graph.json").read_text() == "old graph"
    assert (folder / "graph.json").read_text() == "new graph"


def test_a_place_that_is_taken_is_known_before_anything_counts(folder):
    (folder / "picture.png").mkdir()

    def fail():
        write(folder, {"graph.json": "new graph", "picture.png": "x"})

    with pytest.raises(OutputError, match=r"picture\.png: a folder stands where a result goes"):
        fail()
    assert (folder / "graph.json").read_text() == "old graph"
    assert not (folder / NEXT).exists()


def test_a_folder_without_a_graph_gets_no_manifest(tmp_path):
    write(tmp_path, {"parts.csv": "x", "devices.json": "{}"})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["devices.json", "parts.csv"]


def test_other_exports_leave_the_manifest_as_it_is(folder):
    before = (folder / MANIFEST).read_bytes()
    write(folder, {"parts.csv": "x"})
    assert (folder / MANIFEST).read_bytes() == before


def test_a_file_that_is_not_what_was_written_is_said_in_one_line(folder):
    (folder / "graph.json").write_text("of another build")
    with pytest.raises(FormatError, match=r"graph\.json: not what cadgraph wrote .* build the graph anew"):
        read_checked(folder / "graph.json", GRAPH, FormatError, "")
    assert changed_by_others(folder) == ("graph.json",)
    (folder / MANIFEST).unlink()
    assert read_checked(folder / "graph.json", GRAPH, FormatError, "") == b"of another build"


def test_a_reader_between_two_states_looks_again(folder, monkeypatch):
    """The graph is read, then replaced with its manifest: no false alarm."""
    real = manifest_in
    looks = []

    def later(place):
        if not looks:
            write(place, NEW)
        looks.append(place)
        return real(place)

    monkeypatch.setattr("cadgraph._io.manifest.manifest_in", later)
    assert read_checked(folder / "graph.json", GRAPH, FormatError, "") == b"new graph"
    assert len(looks) == 2


def test_changing_one_file_on_purpose_renews_the_manifest(folder):
    with one_of_results(folder / "graph.json"):
        write_atomically(folder / "graph.json", "by hand")
    assert read_checked(folder / "graph.json", GRAPH, FormatError, "") == b"by hand"
    assert of_an_earlier_graph(folder) == ("devices.json", "report.html", "semantics.usda")


def test_a_report_that_says_it_is_of_an_earlier_graph_is_still_of_that(folder):
    with new_results(folder) as new:
        assert not new.is_earlier("report.html")
        write_atomically(folder / "graph.json", "new graph")
        assert new.is_earlier("report.html")
        new.keep("report.html")
        write_atomically(folder / "report.html", "old report, with a note")
    assert "report.html" in of_an_earlier_graph(folder)
    with new_results(folder) as new:
        write_atomically(folder / "graph.json", "old graph")
        assert not new.is_earlier("report.html"), "the graph is the same again"
    assert of_an_earlier_graph(folder) == ()


def test_corrections_that_the_graph_lacks_are_known(folder):
    (folder / "corrections.json").write_text("[]")
    assert behind(folder)
    write(folder, {"graph.json": "with them"})
    assert not behind(folder)
    write(folder, {"graph.json": "others came meanwhile"}, corrections=hashlib.sha256(b"earlier").hexdigest())
    assert behind(folder)


@pytest.mark.parametrize(
    "content",
    [
        '{"format": "cadgraph-manifest"',
        '{"format": "cadgraph-manifest", "version": "x"}',
        '{"format": "cadgraph-manifest", "version": 1, "graph": 3, "corrections": "", "files": []}',
        '{"format": "cadgraph-manifest", "version": 1, "graph": "", "corrections": "", "files": [{}]}',
        '["cadgraph-manifest"]',
    ],
)
def test_a_damaged_manifest_is_said_in_one_line_and_written_anew(folder, content):
    (folder / MANIFEST).write_text(content)
    with pytest.raises(FormatError, match=r"manifest\.json: damaged .* build the graph anew, or remove it"):
        read_checked(folder / "graph.json", GRAPH, FormatError, "")
    write(folder, {"graph.json": "new graph"})
    assert read_checked(folder / "graph.json", GRAPH, FormatError, "") == b"new graph"


def test_a_newer_manifest_and_one_of_another_program(folder):
    (folder / MANIFEST).write_text(json.dumps({"format": "cadgraph-manifest", "version": 2}))
    with pytest.raises(FormatError, match="newer cadgraph"):
        manifest_in(folder)
    (folder / MANIFEST).write_text(json.dumps({"name": "web", "files": "x" * 2_000_000}))
    assert manifest_in(folder) is None


def test_a_link_in_the_place_of_what_is_ready_is_not_followed(folder, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    (other / "graph.json").write_text("of others")
    (folder / READY).symlink_to(other, target_is_directory=True)
    settle(folder)
    assert result_path(folder / "graph.json").read_text() == "old graph"
    assert (other / "graph.json").read_text() == "of others"
    assert (folder / "graph.json").read_text() == "old graph"
