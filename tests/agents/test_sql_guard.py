"""Queries of anybody: nothing is written, nothing but the tables is read, all stop in time, and the next one works."""

import os
import sqlite3
import subprocess
import sys
import threading
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.agents.plant import Plant
from cadgraph.agents.sql import child
from cadgraph.agents.sql.guard import SECONDS, Database, Stopped
from cadgraph.agents.sql.tables import make_tables
from cadgraph.errors import AskError
from networks import pumping

SHORT = 0.4  # s; that queries may take in most tests here
SLACK = 5.0  # s; a busy machine is slow, a query that nothing stops takes for ever
N_UNITS = 26
COUNT = "SELECT count(*) FROM unit"
SERIES = "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r WHERE n < {}) "
ENDLESS = "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r) "
LONG = "(SELECT replace(printf('%900000d', 1), ' ', 'a') u)"  # a text near the longest that there can be
SECRET = "the-secret-words"

REFUSED = {
    "attach": "ATTACH 'made.db' AS other",
    "attach what is there": "ATTACH 'secret.txt' AS other",
    "attach by address": "ATTACH 'file:made.db?mode=rwc' AS other",
    "detach": "DETACH main",
    "copy to a file": "VACUUM INTO 'made.db'",
    "vacuum": "VACUUM",
    "writing again": "PRAGMA query_only = OFF",
    "writable schema": "PRAGMA writable_schema = ON",
    "temporary files": "PRAGMA temp_store_directory = '.'",
    "journal": "PRAGMA journal_mode = WAL",
    "more memory": "PRAGMA hard_heap_limit = 0",
    "reading a pragma": "PRAGMA database_list",
    "pragma as a table": "SELECT * FROM pragma_database_list",
    "pragma as a table, counted": "SELECT count(*) FROM pragma_database_list",
    "pragma in another schema": "SELECT * FROM main.pragma_table_info('unit')",
    "extension": "SELECT load_extension('made.so')",
    "reading a file": "SELECT readfile('secret.txt')",
    "writing a file": "SELECT writefile('made.txt', 'x')",
    "editing": "SELECT edit('x', 'touch made.txt')",
    "folder": "SELECT * FROM fsdir('.')",
    "tokenizer": "SELECT fts3_tokenizer('simple', x'4141414141414141')",
    "pages": "SELECT * FROM dbstat",
    "statements": "SELECT * FROM sqlite_stmt",
    "json as a table": "SELECT * FROM json_each('[1, 2]')",
    "json as a table, counted": "SELECT count(*) FROM json_each('[1, 2]')",
    "insert": "INSERT INTO unit (tag) VALUES ('V-999')",
    "delete": "DELETE FROM unit",
    "update": "UPDATE unit SET kind = 'ball valve'",
    "update in a with": "WITH a AS (SELECT 1) UPDATE unit SET kind = 'x'",
    "drop": "DROP TABLE unit",
    "schema": "UPDATE sqlite_master SET sql = ''",
    "temporary table": "CREATE TEMP TABLE t AS SELECT * FROM unit",
    "view": "CREATE VIEW v AS SELECT * FROM unit",
    "trigger": "CREATE TEMP TRIGGER t AFTER INSERT ON unit BEGIN SELECT 1; END",
    "virtual table": "CREATE VIRTUAL TABLE temp.t USING fts5(x)",
    "transaction": "BEGIN IMMEDIATE",
    "savepoint": "SAVEPOINT s",
    "analysis": "ANALYZE",
    "index": "REINDEX",
    "several": "SELECT 1; DROP TABLE unit",
    "several, hidden": "SELECT 1 /* ; */; -- \n ATTACH 'made.db' AS other",
    "comment only": "-- SELECT 1",
    "comment without an end": "/* SELECT 1",
    "nothing": "",
    "blanks": " \t\n;",
    "nul": "SELECT 1\0; DROP TABLE unit",
    "nul first": "\0",
    "half a character": "SELECT '\ud800'",
    "letters alike": "ＳＥＬＥＣＴ 1",
    "direction of writing": "SELECT \u202e1 FROM unit\u202c x y",
    "parentheses": f"SELECT {'(' * 2000}1{')' * 2000}",
    "sums": "SELECT " + "1+" * 3000 + "1",
    "selects in selects": f"SELECT {'(SELECT ' * 200}1{')' * 200}",
    "compounds": "SELECT 1" + " UNION SELECT 1" * 300,
    "too long": "SELECT 1 --" + "x" * 20_000,
    "columns": "SELECT " + "1," * 500 + "1",
    "joins": "SELECT 1 FROM " + ",".join(f"unit u{n}" for n in range(70)),
    "binding": "SELECT ?",
    "text of nothing": "SELECT zeroblob(900000)",
    "random text": "SELECT randomblob(900000)",
    "a text too long": "SELECT length(printf('%900000d', 1) || printf('%900000d', 1))",
    "a group too long": SERIES.format(10_000) + "SELECT group_concat(printf('%1000d', n)) FROM r",
    "a row too wide": f"SELECT {'u || u,' * 60} u FROM {LONG}",
    "nested names": "WITH a0 AS (SELECT 1 x FROM unit), "
    + ", ".join(f"a{n} AS (SELECT l.x FROM a{n - 1} l, a{n - 1} r)" for n in range(1, 40))
    + " SELECT count(*) FROM a39",
    "nested unions": "WITH a0 AS (SELECT 1 x), "
    + ", ".join(f"a{n} AS (SELECT * FROM a{n - 1} UNION ALL SELECT * FROM a{n - 1})" for n in range(1, 40))
    + " SELECT count(*) FROM a39",
}
STOPPED = {
    "endless": ENDLESS + "SELECT count(*) FROM r",
    "everything with everything": "SELECT count(*) FROM pipe a, pipe b, pipe c, pipe d, pipe e, pipe f",
    "sorted": SERIES.format(4000) + "SELECT a.n * b.n * 7919 % 100003 k FROM r a, r b ORDER BY k, a.n * b.n % 71",
    "no step for long: instr": f"SELECT instr(u, substr(u, 1, 450000) || 'b') FROM {LONG}, unit, unit",
    "no step for long: like": f"SELECT sum(u LIKE '%{'_aaaa' * 35}b%') FROM {LONG}, unit",
    "no step for long: glob": f"SELECT sum(u GLOB '*{'?[a-z]' * 30}b*') FROM {LONG}, unit",
}
FULL = {
    "sorted texts": ENDLESS + "SELECT n, printf('%100000d', n) FROM r ORDER BY 2",
    "growing": "WITH RECURSIVE r(n, s) AS (SELECT 1, '' UNION SELECT n + 1, s || printf('%1000d', n) FROM r) "
    "SELECT count(*) FROM r",
    "window": f"SELECT group_concat(n) OVER (ORDER BY n), u || n FROM ({SERIES.format(3000)} SELECT n FROM r), {LONG}",
}


@pytest.fixture(scope="module")
def rows():
    plant = Plant(pumping())
    return make_tables(plant.network, plant.lines, plant.extent)


@pytest.fixture(scope="module")
def database(rows):
    base = Database(rows, SHORT)
    yield base
    base.close()


@pytest.fixture
def bare(tmp_path, monkeypatch):
    """A folder to be in, and for temporary files, with a secret in it; nothing may be made there."""
    (tmp_path / "secret.txt").write_text(SECRET)
    monkeypatch.chdir(tmp_path)
    for name in ("TMPDIR", "SQLITE_TMPDIR"):
        monkeypatch.setenv(name, str(tmp_path))
    return tmp_path


def still_sound(database, folder):
    assert database.ask(COUNT).rows == ((N_UNITS,),)
    assert [path.name for path in folder.iterdir()] == ["secret.txt"]
    assert (folder / "secret.txt").read_text() == SECRET


@pytest.mark.parametrize("name", REFUSED)
def test_what_does_anything_but_read_the_tables_is_refused_and_the_next_query_works(database, bare, name):
    began = time.monotonic()
    with pytest.raises(AskError) as refused:
        database.ask(REFUSED[name])
    assert time.monotonic() - began < SHORT + SLACK
    assert SECRET not in str(refused.value)
    assert "\n" not in str(refused.value)
    still_sound(database, bare)


@pytest.mark.parametrize("name", [*STOPPED, *FULL])
def test_what_takes_too_much_is_stopped_and_the_next_query_works(rows, bare, name):
    database = Database(rows, SHORT if name in STOPPED else SECONDS)
    database.ask(COUNT)
    began = time.monotonic()
    with pytest.raises(Stopped, match="stopped after|memory" if name in STOPPED else "memory"):
        database.ask((STOPPED | FULL)[name] + " -- ")
    assert time.monotonic() - began < database.seconds + SLACK
    still_sound(database, bare)
    database.close()


def test_three_seconds_are_three_seconds_and_others_wait_no_longer(rows):
    database = Database(rows)
    database.ask(COUNT)
    answered = []
    other = threading.Timer(0.2, lambda: answered.append((database.ask(COUNT).rows, time.monotonic())))
    began = time.monotonic()
    other.start()
    with pytest.raises(Stopped, match="stopped after 3 s"):
        database.ask(ENDLESS + "SELECT count(*) FROM r")
    assert 2.9 < time.monotonic() - began < 3.5
    other.join()
    assert answered[0][0] == ((N_UNITS,),)
    assert answered[0][1] - began < 3.8
    database.close()


def test_rows_and_cells_are_cut_and_that_is_said(rows):
    database = Database(rows, SECONDS)
    found = database.ask(SERIES.format(501) + "SELECT n FROM r")
    assert ([row[0] for row in found.rows], found.complete) == (list(range(1, 501)), False)
    found = database.ask(SERIES.format(500) + "SELECT n FROM r")
    assert (len(found.rows), found.complete) == (500, True)
    found = database.ask(f"SELECT u, length(u), x'0001', 9e999 FROM {LONG}")
    assert found.rows == (("a" * 399 + "…", 900_000, "(2 bytes)", "inf"),)
    wide = database.ask(SERIES.format(500) + "SELECT " + "substr(u, 1, 400)," * 10 + f"n FROM r, {LONG}")
    assert not wide.complete
    assert 40 < len(wide.rows) < 100
    database.close()


def test_the_tables_that_a_query_makes_itself_can_be_counted(database):
    assert database.ask("WITH a AS (SELECT tag FROM unit) SELECT count(*) FROM a").rows == ((N_UNITS,),)
    assert database.ask("SELECT count(*) FROM (SELECT DISTINCT a FROM pipe) AS s, (VALUES (1), (2))").complete


def test_the_mathematics_of_distances_are_there(database):
    found = database.ask("SELECT sqrt(pow(3, 2) + power(4, 2)), floor(1.5), ceil(1.5), round(2.345, 1), atan2(0, 1)")
    assert found.rows == ((5.0, 1.0, 2.0, 2.3, 0.0),)
    assert database.ask("SELECT sqrt(-1), sqrt(NULL)").rows == ((None, None),)


def test_mathematics_come_from_python_where_sqlite_lacks_them():
    class Lacking(sqlite3.Connection):
        def execute(self, sql, *more):
            if any(f"SELECT {name}(" in sql for name in ("sqrt", "pow")):
                raise sqlite3.OperationalError("no such function")
            return super().execute(sql, *more)

    base = sqlite3.connect(":memory:", factory=Lacking)
    child.add_mathematics(base)
    asked = sqlite3.Connection.execute(base, "SELECT sqrt(9), sqrt(-1), sqrt(NULL), pow(2, 3), pow(10, 999), sqrt('a')")
    assert asked.fetchall() == [(3.0, None, None, 8.0, None, None)]
    base.close()


@pytest.mark.skipif(sys.platform == "win32", reason="has no such limits")
def test_the_system_too_keeps_the_process_from_files(tmp_path):
    code = f"""
import runpy, sys
limit = runpy.run_path({child.__file__!r})["limit_process"]
open({str(tmp_path / "before")!r}, "w").close()
limit(1 << 30)
for mode, name in (("r", "before"), ("w", "made")):
    try:
        open({str(tmp_path)!r} + "/" + name, mode)
    except OSError:
        print("refused")
"""
    done = subprocess.run([sys.executable, "-I", "-S", "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["refused", "refused"]
    assert os.listdir(tmp_path) == ["before"]


def test_a_process_that_died_is_replaced(rows):
    database = Database(rows)
    database.ask(COUNT)
    database._worker._process._process.kill()
    database._worker._process._process.wait()
    assert database.ask("SELECT 1").rows == ((1,),)
    database.close()


def test_the_process_ends_with_the_tables(rows):
    database = Database(rows)
    database.ask(COUNT)
    process = database._worker._process._process
    assert process.poll() is None
    del database
    assert process.poll() is not None


WORDS = """
SELECT FROM WHERE WITH RECURSIVE UNION ALL JOIN ON GROUP BY ORDER LIMIT VALUES ATTACH PRAGMA VACUUM INTO INSERT UPDATE
DELETE CREATE TEMP TABLE VIEW EXPLAIN QUERY PLAN BEGIN DROP ALTER REPLACE AS IN EXISTS unit pipe part point tag a b n x
sqlite_master json_each pragma_table_info dbstat made.db secret.txt load_extension( readfile( zeroblob( printf( count(*)
group_concat( instr( like 1 1e999 -1 'x' x'00' ( ) , ; * = || . -- /* */ ' " ` [ ] ? :a @b $c ! ~ < > \0 😀
"""


@settings(max_examples=150, deadline=None)
@given(sql=st.one_of(st.lists(st.sampled_from(WORDS.split()), max_size=14).map(" ".join), st.text(max_size=40)))
def test_whatever_is_asked_ends_in_rows_or_in_one_line(database, sql):
    before = set(os.listdir("."))
    began = time.monotonic()
    said = ""
    try:
        assert len(database.ask(sql).rows) <= 500
    except AskError as error:
        said = str(error)
    assert "\n" not in said
    assert time.monotonic() - began < SHORT + SLACK
    assert database.ask(COUNT).rows == ((N_UNITS,),)
    assert set(os.listdir(".")) == before
