import threading

import pytest

from cadgraph.errors import LabelError, OutputError
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.reply import Reply


def test_an_answer_is_there_after_closing_and_opening(tmp_path):
    path = tmp_path / "deep" / "answers.sqlite"
    cache = Cache(path)
    reply = Reply('{"a": 1}', None, 100, 20, batch=True)
    cache.put("k", "gpt-4o", reply)
    cache.close()
    assert Cache(path).get("k") == reply
    assert Cache(path).get("other") is None


def test_the_first_answer_stays():
    cache = Cache(":memory:")
    cache.put("k", "m", Reply("first"))
    cache.put("k", "m", Reply("second"))
    assert cache.get("k").text == "first"
    assert len(cache) == 1
    assert cache.known(["k", "l"]) == {"k"}


def test_threads_share_it(tmp_path):
    cache = Cache(tmp_path / "a.sqlite")
    threads = [threading.Thread(target=lambda i=i: cache.put(str(i), "m", Reply(str(i)))) for i in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(cache) == 20


def test_a_file_that_is_something_else_is_left_alone(tmp_path):
    path = tmp_path / "notes.txt"
    path.write_text("my notes, long enough to be no empty database\n" * 30)
    with pytest.raises(LabelError, match=r"notes\.txt"):
        Cache(path)
    assert path.read_text().startswith("my notes")


def test_a_database_of_somebody_else_is_left_alone(tmp_path):
    import sqlite3

    path = tmp_path / "other.sqlite"
    base = sqlite3.connect(path)
    base.execute("CREATE TABLE mine (x)")
    base.commit()
    base.close()
    with pytest.raises(LabelError, match="not a cache"):
        Cache(path)


def test_a_place_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(OutputError):
        Cache(tmp_path / "file" / "answers.sqlite")
