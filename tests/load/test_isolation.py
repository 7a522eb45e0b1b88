from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.sandbox import isolation
from cadgraph.load.sandbox.isolation import read_isolated

LIMITED = LoadConfig(timeout=60)


@pytest.fixture(scope="module")
def crate(tmp_path_factory):
    path = tmp_path_factory.mktemp("crate") / "scene.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, "Z")
    rng = np.random.default_rng(0)
    for i in range(12):
        mesh = UsdGeom.Mesh.Define(stage, f"/world/group_{i % 3}/mesh_{i}")
        mesh.CreatePointsAttr(rng.normal(size=(60, 3)).tolist())
        mesh.CreateFaceVertexCountsAttr([3] * 40)
        mesh.CreateFaceVertexIndicesAttr(rng.integers(0, 60, 120).tolist())
    stage.Save()
    return path.read_bytes()


def outcome(path, config=LIMITED):
    """The scene, or the text of the error after checking that it is one line that names the file."""
    try:
        scene = load(path, config)
    except LoadError as error:
        text = str(error)
        assert "\n" not in text
        assert "Traceback" not in text
        assert str(path) in text
        assert len(text) < 700
        return text
    assert np.isfinite(scene.vertices).all()
    return scene


@pytest.fixture
def scratch(tmp_path, monkeypatch):
    folder = tmp_path / "scratch"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def test_isolated_and_direct_reading_agree(tmp_path, crate, scratch):
    path = tmp_path / "a.usdc"
    path.write_bytes(crate)
    isolated, direct = load(path), load(path, LoadConfig(isolate=False))
    assert isolated.vertices.tobytes() == direct.vertices.tobytes()
    assert isolated.faces.tobytes() == direct.faces.tobytes()
    assert (isolated.paths, isolated.anchors, isolated.source) == (direct.paths, direct.anchors, direct.source)
    assert isolated.diagnostics == direct.diagnostics
    assert list(scratch.iterdir()) == []


def test_crate_cut_at_fifty_places_is_an_error(tmp_path, crate):
    for cut in np.linspace(1, len(crate) - 1, 50).astype(int):
        path = tmp_path / f"cut_{cut}.usdc"
        path.write_bytes(crate[:cut])
        assert isinstance(outcome(path), str)


def test_crate_cut_but_named_usd_is_an_error(tmp_path, crate):
    for cut in (4, 20, 90, len(crate) // 2, len(crate) - 1):
        path = tmp_path / f"cut_{cut}.usd"
        path.write_bytes(crate[:cut])
        assert isinstance(outcome(path), str)


@pytest.mark.slow
def test_flipped_bytes_never_take_the_caller_down(tmp_path, crate):
    rng = np.random.default_rng(1)
    paths = []
    for i in range(12):
        damaged = np.frombuffer(crate, np.uint8).copy()
        # The tail holds the tables that a reader follows: damage there does most.
        first = 0 if i % 2 else len(crate) * 3 // 4
        damaged[rng.integers(first, len(crate), 1 + i % 8)] ^= rng.integers(1, 256, dtype=np.uint8)
        paths.append(tmp_path / f"flip_{i}.usdc")
        paths[-1].write_bytes(damaged.tobytes())
    with ThreadPoolExecutor(2) as pool:
        assert len(list(pool.map(outcome, paths))) == len(paths)


@pytest.mark.parametrize(
    ("name", "content", "isolate"),
    [
        ("text.usd", b"just some words\n" * 100, True),
        ("text.usda", b"just some words\n", True),
        ("text.usdc", b"just some words\n", True),
        ("text.usdz", b"just some words\n", True),
        ("half.usdz", b"PK\x03\x04" + b"\0" * 100, True),
        ("syntax.usda", b'#usda 1.0\ndef Mesh "a" {{{\n', True),
        ("binary.usda", b"#usda 1.0\n" + bytes(range(256)), True),
        ("binary.usda", b"#usda 1.0\n" + bytes(range(256)), False),
        ("escape.usda", b"#usda 1.0\n\x1b[31mred\x1b[0m\n", False),
        ("latin.usda", b'#usda 1.0\ndef Cube "Stra\xdfe" {}\n', False),
        ("header.usda", b"#usda 1.0\n", False),
        ("future.usda", b"#usda 99.0\n", False),
    ],
)
def test_damaged_files_are_one_line_errors(tmp_path, name, content, isolate):
    path = tmp_path / name
    path.write_bytes(content)
    text = outcome(path, LIMITED.model_copy(update={"isolate": isolate}))
    assert isinstance(text, str)
    assert text.isprintable()


def loader(tmp_path, monkeypatch, body):
    """A loader module that does as told, in place of one that meets a damaged file."""
    (tmp_path / "strange_loader.py").write_text(f"import os, sys, time, signal\ndef read(path, config):\n    {body}\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    return "strange_loader"


@pytest.mark.skipif(not hasattr(signal, "SIGSEGV") or sys.platform == "win32", reason="needs signals")
def test_crash_is_an_error(tmp_path, monkeypatch, scratch):
    module = loader(tmp_path, monkeypatch, "os.kill(os.getpid(), signal.SIGSEGV)")
    with pytest.raises(LoadError, match=r"a\.usd: reading it crashed \(SIGSEGV\)"):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LIMITED)
    assert list(scratch.iterdir()) == []


def test_surprise_in_the_loader_is_one_line(tmp_path, monkeypatch):
    module = loader(tmp_path, monkeypatch, "raise RuntimeError('out of ideas')")
    with pytest.raises(LoadError, match="out of ideas") as caught:
        read_isolated(module, tmp_path / "a.usd", "a.usd", LIMITED)
    assert "\n" not in str(caught.value)


def test_endless_reading_is_given_up(tmp_path, monkeypatch, scratch):
    module = loader(tmp_path, monkeypatch, "time.sleep(600)")
    with pytest.raises(LoadError, match=r"longer than 1 s; raise load\.timeout"):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LoadConfig(timeout=1))
    assert list(scratch.iterdir()) == []


def test_flood_of_messages_stays_off_the_terminal(tmp_path, monkeypatch, capfd):
    module = loader(tmp_path, monkeypatch, "sys.stderr.write('w' * 3_000_000); sys.stdout.write('x'); sys.exit(3)")
    with pytest.raises(LoadError):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LIMITED)
    assert capfd.readouterr() == ("", "")


def test_files_beside_the_user_are_not_imported(tmp_path, crate, monkeypatch):
    (tmp_path / "numpy.py").write_text("raise SystemExit('imported from the working folder')")
    (tmp_path / "a.usdc").write_bytes(crate)
    monkeypatch.chdir(tmp_path)
    assert load("a.usdc").source.path == "a.usdc"


def test_damage_is_one_line_without_isolation_too(tmp_path):
    for name, content in {
        "latin.usda": b'#usda 1.0\ndef Cube "Stra\xdfe" {}\n',
        "words.usda": b"#usda 1.0\nwords\n",
    }.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(LoadError, match="not readable as USD") as caught:
            load(tmp_path / name, LoadConfig(isolate=False))
        assert "\n" not in str(caught.value)


@pytest.mark.skipif(sys.platform == "win32", reason="needs signals")
def test_interrupt_ends_the_child_and_leaves_nothing(tmp_path, scratch):
    (tmp_path / "slow_loader.py").write_text(
        "import os, pathlib, time\n"
        "def read(path, config):\n"
        f"    pathlib.Path({str(tmp_path / 'pid')!r}).write_text(str(os.getpid()))\n"
        "    time.sleep(600)\n"
    )
    caller = (
        "import signal, sys, tempfile, pathlib\n"
        # Whoever runs the tests in the background may have made them deaf to it.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"sys.path.insert(0, {str(tmp_path)!r}); tempfile.tempdir = {str(scratch)!r}\n"
        "from cadgraph.config import LoadConfig\n"
        "from cadgraph.load.sandbox.isolation import read_isolated\n"
        "read_isolated('slow_loader', pathlib.Path('a'), 'a', LoadConfig())\n"
    )
    process = subprocess.Popen([sys.executable, "-c", caller], stderr=subprocess.PIPE)
    pid_file = tmp_path / "pid"
    deadline = time.monotonic() + 60
    while not (pid_file.exists() and pid_file.read_text()) and time.monotonic() < deadline:
        time.sleep(0.05)
    child = int(pid_file.read_text())
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in stderr
    with pytest.raises(ProcessLookupError):
        os.kill(child, 0)
    assert list(scratch.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="needs signals")
def test_a_killed_caller_takes_the_child_and_its_folder_with_it(tmp_path, scratch):
    (tmp_path / "slow_loader.py").write_text(
        "import os, pathlib, time\n"
        "def read(path, config):\n"
        f"    pathlib.Path({str(tmp_path / 'pid')!r}).write_text(str(os.getpid()))\n"
        "    time.sleep(600)\n"
    )
    caller = (
        "import sys, tempfile, pathlib\n"
        f"sys.path.insert(0, {str(tmp_path)!r}); tempfile.tempdir = {str(scratch)!r}\n"
        "from cadgraph.config import LoadConfig\n"
        "from cadgraph.load.sandbox.isolation import read_isolated\n"
        "read_isolated('slow_loader', pathlib.Path('a'), 'a', LoadConfig())\n"
    )
    process = subprocess.Popen([sys.executable, "-c", caller])
    pid_file = tmp_path / "pid"
    deadline = time.monotonic() + 60
    while not (pid_file.exists() and pid_file.read_text()) and time.monotonic() < deadline:
        time.sleep(0.05)
    process.kill()
    process.wait(60)
    while list(scratch.iterdir()) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert list(scratch.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="needs locks that end with a process")
def test_folders_of_killed_processes_are_cleared_and_those_in_use_kept(tmp_path, crate, scratch):
    import fcntl

    for name in ("cadgraph-dead", "cadgraph-alive", "other-dead", "cadgraph-foreign"):
        (scratch / name).mkdir()
        (scratch / name / "vertices.npy").touch()
    for name in ("cadgraph-dead", "cadgraph-alive", "other-dead"):
        (scratch / name / "lock").touch()
    (tmp_path / "a.usdc").write_bytes(crate)
    with (scratch / "cadgraph-alive" / "lock").open("wb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        load(tmp_path / "a.usdc")
    assert sorted(path.name for path in scratch.iterdir()) == ["cadgraph-alive", "cadgraph-foreign", "other-dead"]


@pytest.mark.skipif(sys.platform == "win32", reason="needs locks that end with a process")
def test_a_folder_that_is_not_locked_yet_is_not_taken_for_abandoned(tmp_path, crate, scratch, monkeypatch):
    (tmp_path / "a.usdc").write_bytes(crate)
    lock, begun = isolation._try_to_lock, []

    def clearing_up_first(file):
        if not begun:
            begun.append(file)
            isolation._clear_abandoned(scratch)  # as another process does that begins to read at this moment
        return lock(file)

    monkeypatch.setattr(isolation, "_try_to_lock", clearing_up_first)
    assert load(tmp_path / "a.usdc").n_meshes == 12
    assert begun
    assert list(scratch.iterdir()) == []


def test_want_of_memory_is_no_damage(tmp_path, monkeypatch):
    module = loader(tmp_path, monkeypatch, "raise MemoryError('Unable to allocate 99 GiB')")
    with pytest.raises(LoadError, match="not enough memory to read it") as caught:
        read_isolated(module, tmp_path / "a.usd", "a.usd", LIMITED)
    assert "damaged" not in str(caught.value)


def test_a_cut_crate_says_what_to_do(tmp_path, crate):
    for cut in (len(crate) // 2, len(crate) - 1, 90):
        (tmp_path / "cut.usdc").write_bytes(crate[:cut])
        assert "export it again" in outcome(tmp_path / "cut.usdc")


def test_result_holds_no_pickles(tmp_path, monkeypatch):
    body = (
        "import numpy, pathlib, json; folder = pathlib.Path(sys.argv[1]); "
        "numpy.save(folder / 'vertices.npy', numpy.array([{}], object), allow_pickle=True); os._exit(0)"
    )
    module = loader(tmp_path, monkeypatch, body)
    with pytest.raises(LoadError, match="no whole result"):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LIMITED)


def test_request_is_plain_json():
    assert json.loads(json.dumps(LoadConfig().model_dump())) == LoadConfig().model_dump(mode="json")


def test_works_from_another_folder(tmp_path, crate, monkeypatch):
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "a.usdc").write_bytes(crate)
    monkeypatch.chdir(tmp_path)
    assert load(Path("inner/a.usdc")).n_meshes == 12
