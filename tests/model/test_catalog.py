import io
import json
import struct
import zipfile

import numpy as np
import pytest

import knobs
import shapes
from cadgraph.errors import LabelError
from cadgraph.model.catalog import Catalog, Entry, read_catalog, rows_of, write_catalog
from cadgraph.model.scene import Scene

KNOB = Entry("", "Valve assembly", "handwheel", "knob.step", "/knob")


@pytest.fixture
def catalog():
    return Catalog.of(Scene.from_meshes([knobs.knob(), shapes.box()]), [KNOB, Entry("", "Tank", None)])


@pytest.fixture
def file(catalog, tmp_path):
    return write_catalog(catalog, tmp_path / "parts.cadgraph-catalog")


def arrays_of(file):
    with np.load(file, allow_pickle=False) as found:
        return {name: found[name] for name in found.files}


def spoilt(file, **changes):
    """The file with some arrays, or with entries of its head, changed."""
    arrays = arrays_of(file)
    head = json.loads(arrays["head"].tobytes())
    for name, value in changes.items():
        if name in arrays:
            arrays[name] = value
        else:
            head[name] = value
    if "head" not in changes:
        arrays["head"] = np.frombuffer(json.dumps(head).encode(), np.uint8)
    with file.open("wb") as target:
        np.savez_compressed(target, **arrays)
    return file


def test_a_catalogue_comes_back_as_it_was(catalog, file):
    again = read_catalog(file)
    assert again.entries == catalog.entries
    assert again.file == str(file)
    for i in range(2):
        assert np.array_equal(again.shapes.mesh(i)[0], catalog.shapes.mesh(i)[0])
        assert np.array_equal(again.shapes.mesh(i)[1], catalog.shapes.mesh(i)[1])


def test_the_same_entries_give_the_same_bytes(catalog, file, tmp_path):
    other = write_catalog(read_catalog(file), tmp_path / "again")
    assert other.read_bytes() == file.read_bytes()


def test_places_are_forgotten_and_ids_are_those_of_the_shape(catalog):
    moved = Scene.from_meshes([shapes.moved(shapes.box(), translation=(4, 8, 16))])
    assert Catalog.of(moved, [Entry("", "Tank", None)]).entries[0].id == catalog.entries[1].id
    assert catalog.entries[0].id != catalog.entries[1].id


def test_an_empty_catalogue_can_be_kept(tmp_path):
    file = write_catalog(Catalog((), Scene.from_meshes([])), tmp_path / "none")
    assert read_catalog(file).entries == ()


def test_rows_say_what_entries_are(catalog):
    first = rows_of(catalog)[0]
    assert (first["group"], first["name"], first["file"]) == ("Valve assembly", "handwheel", "knob.step")
    assert first["size"][0] == pytest.approx(0.1)


def refused(file):
    with pytest.raises(LabelError) as caught:
        read_catalog(file)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_missing_file_says_how_to_make_one(tmp_path):
    assert "catalog add" in refused(tmp_path / "none")


@pytest.mark.parametrize("keep", [0, 10, 200, -30])
def test_a_cut_file_is_damaged(file, keep):
    content = file.read_bytes()
    file.write_bytes(content[:keep])
    refused(file)


def test_flipped_bytes_never_end_in_another_error(file):
    content = file.read_bytes()
    for at in range(0, len(content), 37):
        file.write_bytes(content[:at] + bytes([content[at] ^ 0x5A]) + content[at + 1 :])
        try:
            read_catalog(file)
        except LabelError as error:
            assert "\n" not in str(error)  # noqa: PT017


def test_another_version_is_told(file):
    assert "version 2" in refused(spoilt(file, version=2))


def test_a_foreign_npz_is_refused(file):
    with file.open("wb") as target:
        np.savez(target, weights=np.zeros(3))
    assert "holds other things" in refused(file)


def test_pickles_are_refused_unread(file):
    arrays = arrays_of(file) | {"vertices": np.array([{"a": 1}], dtype=object)}
    with file.open("wb") as target:
        np.savez(target, **arrays)
    refused(file)


def test_an_array_that_claims_to_be_huge_is_refused_before_memory_is_taken(file):
    header = b"{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000000, 3), }"
    header += b" " * (118 - len(header)) + b"\n"
    forged = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + b"\0" * 12
    source = zipfile.ZipFile(io.BytesIO(file.read_bytes()))
    with zipfile.ZipFile(file, "w") as target:
        for name in source.namelist():
            target.writestr(name, forged if name == "vertices.npy" else source.read(name))
    assert "cut short or too long" in refused(file)


@pytest.mark.parametrize(
    "change",
    [
        {"entries": "none"},
        {"entries": [1, 2]},
        {"entries": [{"id": 1, "group": "Tank"}] * 2},
        {"entries": [{"id": "a", "group": "Tank:x"}] * 2},
        {"entries": [{"id": "a", "group": "Tank", "name": "UPPER"}] * 2},
        {"entries": [{"id": "a", "group": "Tank"}]},
        {"format": "other"},
        {"faces": np.full((4, 3), 10**6, np.int32)},
        {"faces": np.full((4, 3), -1, np.int32)},
        {"vertices": np.zeros((3, 2), np.float32)},
        {"vertex_offsets": np.array([0, 5, 3])},
        {"face_offsets": np.array([0, 10**12, 3])},
        {"head": np.frombuffer(b"[" * 100_000, np.uint8)},
        {"head": np.frombuffer(b"\xff\xfe", np.uint8)},
    ],
    ids=str,
)
def test_what_contradicts_itself_is_damaged(file, change):
    refused(spoilt(file, **change))


def test_infinite_vertices_are_damage(file):
    vertices = arrays_of(file)["vertices"].copy()
    vertices[0, 0] = np.inf
    assert "not finite" in refused(spoilt(file, vertices=vertices))
