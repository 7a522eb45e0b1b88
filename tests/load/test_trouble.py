"""What the machine lacks is told as that, and not as a fault of the file."""

from __future__ import annotations

import errno
import sys
import tempfile

import pytest

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load.sandbox.isolation import read_isolated
from cadgraph.load.sandbox.trouble import Trouble, trouble_in, trouble_of


def loader(tmp_path, monkeypatch, body):
    (tmp_path / "poor_loader.py").write_text(
        f"import errno, os, sys\nfrom cadgraph.errors import LoadError\ndef read(path, config):\n    {body}\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    return "poor_loader"


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("raise OSError(errno.ENOSPC, 'full')", "no space left in .*; make room, or set TMPDIR"),
        ("raise OSError(errno.EFBIG, 'large')", "larger than a file may be here; raise that limit"),
        ("raise MemoryError", r"not enough memory to read it within 2 GB; .*raise load\.memory"),
        ("sys.stderr.write('write failed: No space left on device'); os._exit(1)", "no space left in"),
        (
            "sys.stderr.write('OpenBLAS error: Memory allocation still failed after 10 retries'); os._exit(1)",
            r"not enough memory to read it within 2 GB; .*raise load\.memory",
        ),
        ("raise ImportError('_tf.so: failed to map segment from shared object')", "not enough memory to read it"),
        # What is said of the file is lost where there is no room for it.
        ("open(sys.argv[1] + '/error.json', 'w'); raise OSError(errno.ENOSPC, 'full')", "no space left in"),
    ],
)
def test_what_the_machine_lacks_is_no_fault_of_the_file(tmp_path, monkeypatch, body, told):
    module = loader(tmp_path, monkeypatch, body)
    with pytest.raises(LoadError, match=rf"^a\.usd: .*{told}") as caught:
        read_isolated(module, tmp_path / "a.usd", "a.usd", LoadConfig(memory=2.0))
    assert "damaged" not in str(caught.value)


@pytest.mark.skipif(sys.platform == "win32", reason="has no such limit")
def test_a_limit_on_the_size_of_files_is_told(tmp_path, monkeypatch):
    body = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (9, 9)); raise LoadError('a.usd: too much said')"
    with pytest.raises(LoadError, match=r"larger than a file may be here; .*ulimit"):
        read_isolated(loader(tmp_path, monkeypatch, body), tmp_path / "a.usd", "a.usd", LoadConfig())


def test_no_folder_for_temporary_files_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "gone"))
    with pytest.raises(LoadError, match=r"^a\.usd: can't write to a temporary folder \(.*\); set TMPDIR"):
        read_isolated(loader(tmp_path, monkeypatch, "pass"), tmp_path / "a.usd", "a.usd", LoadConfig())


@pytest.mark.parametrize(
    "said",
    ["terminate called after throwing an instance of 'std::bad_alloc'", "MemoryError", "Cannot allocate memory"],
)
def test_the_last_words_tell_of_memory(said):
    assert trouble_in(f"Traceback\n{said}\n") is Trouble.MEMORY
    assert trouble_in("Segmentation fault") is None


def test_other_errors_are_no_trouble_of_the_machine():
    assert trouble_of(OSError(errno.ENOENT, "gone")) is None
    assert trouble_of(OSError("no number")) is None
    assert trouble_of(ValueError("wrong")) is None


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no system holds a process to it")
@pytest.mark.parametrize(("memory", "told"), [(2.0, r"load\.max_growth"), (0.2, r"load\.memory")])
def test_what_holds_reading_back_is_what_is_named(tmp_path, monkeypatch, memory, told):
    # More than a file of a few bytes can become, or more than may be taken at all.
    body = (
        "from cadgraph.load.budget import Budget; budget = Budget(path, config, 9); budget.watch()\n"
        "    try: import numpy; numpy.empty(900_000_000, numpy.uint8)\n"
        "    except MemoryError: budget.refuse_arrays(); raise"
    )
    with pytest.raises(LoadError, match=told):
        read_isolated(loader(tmp_path, monkeypatch, body), tmp_path / "a.usd", "a.usd", LoadConfig(memory=memory))
