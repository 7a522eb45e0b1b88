"""The fuzzer itself: the same case is the same file, a small run finds nothing, and what it once found stays mended."""

import json
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.errors import FormatError, LoadError
from cadlab.fuzz.__main__ import main
from cadlab.fuzz.child import put_down, seeds_of
from cadlab.fuzz.judge import FAULTS, fault_of_message, judge
from cadlab.fuzz.kinds import KINDS, Kind
from cadlab.fuzz.mutate import spoilt
from cadlab.fuzz.seeds import write_seeds
from cadlab.fuzz.workers import judge_all

CORPUS = Path(__file__).parent / "corpus"
FOUND = sorted(CORPUS.iterdir())


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seeds")
    write_seeds(folder)
    return folder


def test_every_kind_has_a_sound_file_that_is_read(seeds, tmp_path):
    for kind in KINDS.values():
        for content in seeds_of(kind, seeds):
            found = judge(kind, put_down(kind, content, seeds, tmp_path / "scratch"), seeds)
            assert found.outcome == "read", (kind.name, found)


@given(st.sampled_from(sorted(KINDS)), st.integers(0, 2**40))
def test_a_case_is_the_same_file_each_time(seeds, name, number):
    kind = KINDS[name]
    files = [spoilt(name, kind.layout, seeds_of(kind, seeds), number) for _ in range(2)]
    assert files[0] == files[1]


def test_most_cases_are_spoilt(seeds):
    kind = KINDS["obj"]
    sound = seeds_of(kind, seeds)
    assert sum(spoilt("obj", kind.layout, sound, number) not in sound for number in range(50)) > 45


def test_a_small_run_over_all_kinds_finds_no_fault(capsys):
    assert main(["--mutations", "170", "--seed", "0", "--workers", "2"]) == 0, capsys.readouterr().out
    told = capsys.readouterr().out
    assert re.search(r"\| all \| 170 \|", told)
    assert "no faults" in told


@pytest.mark.parametrize("file", FOUND, ids=lambda file: file.name)
def test_what_it_once_found_stays_mended(file, seeds, tmp_path):
    name = next(kind for kind in sorted(KINDS, key=len, reverse=True) if file.name.startswith(f"{kind}-"))
    kind = KINDS[name]
    found = judge(kind, put_down(kind, file.read_bytes(), seeds, tmp_path / "scratch"), seeds)
    assert not found.is_fault, found


def reading(read, **more):
    return Kind("truth", ".json", "json", read, **more)


def raising(error):
    def read(file, seeds):
        raise error

    return reading(read)


@pytest.mark.parametrize(
    ("read", "outcome"),
    [
        (raising(KeyError("a")), "traceback"),
        (raising(ValueError("a")), "traceback"),
        (raising(MemoryError()), "memory"),
        (raising(FormatError("nothing that helps")), "unnamed"),
        (reading(lambda file, seeds: __import__("warnings").warn("a", stacklevel=1)), "noise"),
    ],
)
def test_the_judge_sees_every_fault(read, outcome, tmp_path):
    found = judge(read, tmp_path / "a.json", tmp_path)
    assert found.outcome == outcome
    assert found.is_fault
    assert outcome in FAULTS


@pytest.mark.parametrize(
    ("message", "outcome"), [("a\nb", "unprintable"), ("\x1b[31m", "unprintable"), ("a" * 5000, "endless")]
)
def test_the_judge_sees_what_is_wrong_with_a_message(message, outcome, tmp_path):
    assert fault_of_message(KINDS["truth"], tmp_path / "a.json", message).outcome == outcome


def test_the_judge_takes_a_line_that_names_the_file(tmp_path):
    file = tmp_path / "a.json"
    assert judge(raising(LoadError(f"{file}: damaged; export it again")), file, tmp_path).outcome == "refused"
    assert fault_of_message(KINDS["truth"], file, f"{file}: damaged") is None


def test_the_judge_misses_a_mesh_that_nobody_tells_of(seeds, tmp_path, monkeypatch):
    from cadgraph.load import load
    from cadgraph.model.scene import Scene

    kind = KINDS["usdc"]
    file = put_down(kind, seeds_of(kind, seeds)[2], seeds, tmp_path / "scratch")
    assert judge(kind, file, seeds).outcome == "read"

    def one_less(path, config):
        scene = load(path, config)
        return Scene.select(scene, range(1, scene.n_meshes))

    monkeypatch.setattr("cadgraph.load", one_less)
    assert judge(kind, file, seeds).outcome == "lost"


def test_a_child_that_ends_is_told_and_followed_by_another(seeds, tmp_path):
    unreadable = tmp_path / "gone"
    found = {one.case: one.verdict for one in judge_all([("truth", unreadable), ("truth", 1)], seeds, workers=1)}
    assert found["truth", unreadable].outcome == "crash"
    assert found["truth", 1].outcome in ("read", "refused")


def test_a_case_is_read_again_by_its_name(capsys, tmp_path):
    file = tmp_path / "a.json"
    file.write_text(json.dumps({"format": "other"}))
    assert main(["--case", f"truth:{file}", "--case", "obj:3"]) == 0
    told = capsys.readouterr().out
    assert "not a truth file" in told
    assert "obj:3" in told
