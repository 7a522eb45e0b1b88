"""What the first bytes tell: content under a wrong suffix, and files cut short."""

from __future__ import annotations

import zipfile

import pytest

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.sandbox.signature import name_content

HEADS = {
    "gltf": [b"glTF\2\0\0\0" + bytes(20), b'{"asset": {"version": "2.0"}}'],
    "ply": [b"ply\nformat ascii 1.0\n", b"ply\r\nformat ascii 1.0\r\n"],
    "collada": [b'<?xml version="1.0"?>\n<COLLADA version="1.4.1">'],
    "stl": [b"solid a\n facet normal 0 0 1\n"],
}


@pytest.mark.parametrize(("name", "head"), [(name, head) for name, heads in HEADS.items() for head in heads])
def test_content_is_told_from_the_first_bytes(tmp_path, name, head):
    path = tmp_path / "a.bin"
    path.write_bytes(head)
    assert name_content(path) == name
    with pytest.raises(LoadError, match=r"looks like .*; rename it to end in \."):
        load(path)


def test_a_3mf_is_a_zip_that_holds_a_model(tmp_path):
    for name, expected in (("3D/3dmodel.model", "3mf"), ("other.txt", None)):
        path = tmp_path / "a.zip"
        with zipfile.ZipFile(path, "w") as package:
            package.writestr(name, "x")
        assert name_content(path) == expected


@pytest.mark.parametrize("content", [b"", b"#usdx", b"solid ground", b"{}", b"PK\3\4 no zip", b"plyers"])
def test_other_content_has_no_name(tmp_path, content):
    path = tmp_path / "a.bin"
    path.write_bytes(content)
    assert name_content(path) is None


@pytest.mark.parametrize(("suffix", "content", "reason"), [
    (".glb", b"no glTF", "no glTF file"), (".glb", b"glTF\2\0\0\0\xff\0\0\0", "12 of 255 bytes are there"),
    (".ply", b"solid x", "no PLY file"), (".3mf", b"no zip", "not a zip archive"), (".dae", b"<xml/>", "no COLLADA"),
    (".dae", b"<COLLADA>", "cut short"), (".stl", b"short", "only 5 bytes are there"),
    (".obj", b"glTF\2\0\0\0", "looks like gltf"),
])  # fmt: skip
@pytest.mark.parametrize("isolate", [True, False])
def test_damage_is_told_before_any_library_reads(tmp_path, suffix, content, reason, isolate):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(LoadError, match=reason) as caught:
        load(path, LoadConfig(isolate=isolate))
    assert "\n" not in str(caught.value)
