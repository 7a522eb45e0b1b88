import contextlib
import io
import os
import sqlite3
import struct
import sys
import zipfile

import numpy as np
import pytest

from cadgraph._io import limits
from cadgraph._io.arrays import check_array, read_arrays
from cadgraph._io.limits import Limit, lines_within, read_bytes_within, read_text_within
from cadgraph.config import read_config
from cadgraph.errors import FormatError, LabelError, LoadError
from cadgraph.export.dexpi import read_dexpi
from cadgraph.labelers.embedded.model import read_model
from cadgraph.labelers.lvlm.batch import read_results
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.merging import read_wishes
from cadgraph.labelers.lvlm.price import read_price
from cadgraph.labelers.lvlm.reply import Reply
from cadgraph.load.sandbox.exchange import read_scene, write_scene
from cadgraph.model.catalog import read_catalog
from cadgraph.model.corrections import read_corrections
from cadgraph.model.given_labels import read_labels
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary, read_vocabulary
from cadlab.agentbench.question_file import read_set

TEN = Limit(10, "a test file")


def read(path, limit=TEN):
    return read_bytes_within(path, limit, LabelError, "give a smaller one")


@pytest.mark.parametrize("size", [0, 9, 10])
def test_file_up_to_the_limit_is_read(tmp_path, size):
    (tmp_path / "a").write_bytes(b"x" * size)
    assert len(read(tmp_path / "a")) == size


def test_file_beyond_the_limit_is_refused_with_all_that_one_needs_to_know(tmp_path):
    (tmp_path / "a").write_bytes(b"x" * 11)
    with pytest.raises(LabelError, match=r"a: 11 bytes large, and at most 10 bytes are read of a test file; give a sm"):
        read(tmp_path / "a")
    os.truncate(tmp_path / "a", 2_621_440)
    with pytest.raises(LabelError, match=r"2\.5 MB large"):
        read(tmp_path / "a")


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device here")
def test_device_is_refused():
    with pytest.raises(LabelError, match="a device"):
        read("/dev/zero")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such pipes")
def test_pipe_is_read_no_further_than_the_limit(tmp_path):
    import threading

    def feed():
        with open(tmp_path / "pipe", "wb", buffering=0) as pipe, contextlib.suppress(BrokenPipeError):
            pipe.write(b"x" * 1000)

    os.mkfifo(tmp_path / "pipe")
    writer = threading.Thread(target=feed)
    writer.start()
    with pytest.raises(LabelError, match="over 10 bytes large"):
        read(tmp_path / "pipe")
    writer.join()


def test_missing_file_and_what_is_no_text_are_told(tmp_path):
    with pytest.raises(LabelError, match="no such file"):
        read(tmp_path / "nothing")
    (tmp_path / "a").write_bytes(b"\xff")
    with pytest.raises(LabelError, match="not UTF-8"):
        read_text_within(tmp_path / "a", TEN, LabelError, "")


def test_text_has_line_feeds_and_no_byte_order_mark(tmp_path):
    (tmp_path / "a").write_bytes(b"\xef\xbb\xbfa\r\nb\rc")
    assert read_text_within(tmp_path / "a", TEN, LabelError, "") == "a\nb\nc"


def test_long_lines_come_in_pieces():
    assert list(lines_within(io.StringIO("abcd\nef\n"), 3)) == ["abc", "d\n", "ef\n"]


READERS = {
    "GRAPH": (FormatError, SceneGraph.load, "graph.json"),
    "TRUTH": (FormatError, Truth.load, "a.truth.json"),
    "LABELS": (LabelError, lambda path: read_labels(path, default_vocabulary()), "a.csv"),
    "CORRECTIONS": (LabelError, read_corrections, "corrections.json"),
    "VOCABULARY": (LabelError, read_vocabulary, "a.yaml"),
    "CATALOG": (LabelError, read_catalog, "a.cadgraph-catalog"),
    "MODEL": (LabelError, read_model, "a.npz"),
    "CONFIG": (ValueError, read_config, "a.toml"),
    "PRICES": (LabelError, lambda path: read_price("gpt", path), "a.yaml"),
    "PROPOSALS": (LabelError, read_wishes, "a.json"),
    "BATCH": (LabelError, lambda path: read_results(path, None, "gpt"), "a.jsonl"),
    "DEXPI": (FormatError, read_dexpi, "a.xml"),
    "QUESTIONS": (FormatError, read_set, "a.jsonl"),
}


@pytest.mark.skipif(sys.platform == "win32", reason="needs files with holes")
@pytest.mark.parametrize("kind", READERS)
def test_no_reader_takes_more_than_its_limit(kind, tmp_path):
    error, reader, name = READERS[kind]
    limit = getattr(limits, kind)
    with open(tmp_path / name, "wb") as file:
        file.truncate(limit.most + 1)
    with pytest.raises(error, match=rf"{name}: [0-9,.]+ MB large, and at most [0-9,.]+ MB are read of {limit.what}; "):
        reader(tmp_path / name)


def packed(**arrays):
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)
    return content.getvalue()


def test_arrays_are_read_up_to_their_size_unpacked():
    content = packed(a=np.zeros(1000), b=np.arange(3))
    assert len(content) < 1000
    assert read_arrays(content, Limit(9000, "x"))["b"].tolist() == [0, 1, 2]
    with pytest.raises(ValueError, match="at most"):
        read_arrays(content, Limit(7000, "x"))


def test_array_that_claims_more_than_it_has_is_refused():
    content = io.BytesIO()
    np.lib.format.write_array_header_1_0(content, {"descr": "<f8", "fortran_order": False, "shape": (1 << 40,)})
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as file:
        file.writestr("a.npy", content.getvalue())
    with pytest.raises(ValueError, match="cut short"):
        read_arrays(archive.getvalue(), Limit(1 << 20, "x"))


def test_arrays_of_objects_are_refused():
    with pytest.raises(ValueError, match="objects"):
        read_arrays(packed(a=np.array([{}], dtype=object)), Limit(1 << 20, "x"))


def test_exchange_folder_with_an_array_of_another_size_is_refused(tmp_path):
    write_scene(Scene.from_meshes([]), tmp_path)
    assert read_scene(tmp_path).n_meshes == 0
    content = bytearray((tmp_path / "vertices.npy").read_bytes())
    (tmp_path / "vertices.npy").write_bytes(content.replace(b"(0, 3)", b"(9, 3)"))
    with pytest.raises(ValueError, match=r"vertices\.npy"):
        read_scene(tmp_path)


def test_line_of_batch_results_that_never_ends_is_refused(tmp_path):
    with open(tmp_path / "a.jsonl", "wb") as file:
        file.truncate(limits.REPLY.most + 2)
    with pytest.raises(LabelError, match="line 1 is no JSON object"):
        read_results(tmp_path / "a.jsonl", None, "gpt")


def test_answer_in_a_cache_that_is_larger_than_any_is_as_good_as_none(tmp_path):
    cache = Cache(tmp_path / "a.sqlite")
    cache.put("small", "gpt", Reply("{}"))
    cache.close()
    base = sqlite3.connect(tmp_path / "a.sqlite")
    base.execute("INSERT INTO answers VALUES ('large', 'gpt', ?, NULL, 0, 0, 0, 0)", ("x" * (limits.REPLY.most + 1),))
    base.commit()
    base.close()
    cache = Cache(tmp_path / "a.sqlite")
    assert cache.get("small").text == "{}"
    assert cache.get("large") is None
    cache.close()


def test_npy_of_a_foreign_version_is_refused():
    with pytest.raises(ValueError, match="unknown kind"):
        check_array(io.BytesIO(b"\x93NUMPY\x09\x00" + struct.pack("<H", 0)), 10, "a")


def test_error_of_the_reading_process_is_told_whatever_it_left(tmp_path):
    from cadgraph.load.sandbox.isolation import _told

    (tmp_path / "error.json").write_text("no JSON", encoding="utf-8")
    with pytest.raises(LoadError, match=r"plant\.usd: reading it failed"):
        _told(tmp_path, "plant.usd")
