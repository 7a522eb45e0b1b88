from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from cadgraph.config import Config, LoadConfig
from cadgraph.errors import LoadError, MissingExtra
from cadgraph.load import formats, load

CUBE = b'#usda 1.0\n(\n metersPerUnit = 1\n upAxis = "Z"\n)\ndef Cube "c" {}\n'


def test_formats_name_suffixes_and_extras():
    known = {form.name: form for form in formats()}
    assert ".usdz" in known["usd"].suffixes
    assert known["usd"].extra is None
    assert known["step"].extra == "cad"


def test_suffixes_belong_to_one_format_each():
    suffixes = [suffix for form in formats() for suffix in form.suffixes]
    assert len(suffixes) == len(set(suffixes))


@pytest.mark.parametrize("isolate", [True, False])
def test_source_is_recorded(tmp_path, isolate):
    path = tmp_path / "a.USDA"
    path.write_bytes(CUBE)
    source = load(path, LoadConfig(isolate=isolate)).source
    assert source.path == str(path)
    assert source.sha256 == hashlib.sha256(CUBE).hexdigest()
    assert (source.format, source.meters_per_unit, source.up_axis) == ("usd", 1.0, "Z")


def test_missing_file(tmp_path):
    with pytest.raises(LoadError, match=r"gone\.usd: no such file"):
        load(tmp_path / "gone.usd")


def test_folder(tmp_path):
    with pytest.raises(LoadError, match="a folder; give one of the files"):
        load(tmp_path)


@pytest.mark.parametrize("what", [None, 3, ["a.usd"], b"a.usd"])
def test_what_is_no_path_is_a_type_error(what):
    with pytest.raises(TypeError, match="load takes the path of a file"):
        load(what)


def test_the_settings_of_everything_are_not_those_of_loading(tmp_path):
    with pytest.raises(TypeError, match=r"config\.load of a Config"):
        load(tmp_path / "a.usd", Config())


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
@pytest.mark.parametrize("isolate", [True, False])
def test_a_named_pipe_is_refused_at_once(tmp_path, isolate):
    os.mkfifo(tmp_path / "a.usda")
    with pytest.raises(LoadError, match=r"a\.usda: not a regular file but a named pipe; give a file on a disk"):
        load(tmp_path / "a.usda", LoadConfig(isolate=isolate))


@pytest.mark.skipif(not Path("/dev/null").is_char_device(), reason="needs devices")
def test_a_device_is_refused(tmp_path):
    (tmp_path / "a.usda").symlink_to("/dev/zero")
    with pytest.raises(LoadError, match="not a regular file but a device"):
        load(tmp_path / "a.usda")


def test_empty_file(tmp_path):
    (tmp_path / "a.usd").touch()
    with pytest.raises(LoadError, match="empty"):
        load(tmp_path / "a.usd")


def test_null_byte_in_the_path():
    with pytest.raises(LoadError):
        load("a\0.usd")


def test_unknown_suffix_lists_what_can_be_read(tmp_path):
    (tmp_path / "a.abc").write_text("x")
    with pytest.raises(LoadError, match=r"'\.abc'.*\.usda.*\.step"):
        load(tmp_path / "a.abc")


def test_known_content_under_another_suffix_says_so(tmp_path):
    (tmp_path / "a.txt").write_bytes(CUBE)
    with pytest.raises(LoadError, match=r"looks like OpenUSD; rename it to end in \.usd"):
        load(tmp_path / "a.txt")


def test_missing_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    (tmp_path / "a.step").write_text("ISO-10303-21;")
    with pytest.raises(MissingExtra, match=r"STEP.*'\.\[cad\]'"):
        load(tmp_path / "a.step")


def test_importing_the_registry_loads_no_library():
    code = "import sys, cadgraph.load; sys.exit(any(m in sys.modules for m in ('pxr', 'cascadio', 'trimesh', 'scipy')))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
