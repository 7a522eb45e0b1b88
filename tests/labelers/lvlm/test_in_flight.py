"""What was on its way when a run was killed is known, told, and asked again under the same id."""

import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

import pytest

from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.answer import Answer
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.reply import Reply, key_of
from home_server import HomeServer, question, refused, said

QUESTIONS = [question(f"What is part {i}?", n_pictures=1, side=16) for i in range(8)]
IDS = ("idempotency-key", "x-request-id", "x-client-request-id")


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)


class Answers:
    """Answers from a function of the question."""

    name, looks, keeps, again = "m", False, True, False

    def __init__(self, answer):
        self.ask = answer

    def close(self):
        pass


def keys():
    return [key_of(each, "m", "high") for each in QUESTIONS]


def asked(cache, answer, n=1):
    asking = Asking(Answers(answer), cache, concurrency=2)
    return asking, asking.ask_all(QUESTIONS[:n], Answer, lambda one, reason: one)


def test_a_question_is_noted_before_it_is_sent_and_no_longer_after_its_answer():
    cache = Cache(":memory:")
    seen = []

    def answer(question):
        seen.append(cache.on_the_way(keys()))
        return Reply("{}")

    asked(cache, answer)
    assert seen == [{keys()[0]}]
    assert cache.on_the_way(keys()) == set()
    assert cache.get(keys()[0]).text == "{}"


@pytest.mark.parametrize(("lost", "n"), [(False, 0), (True, 1)])
def test_an_error_leaves_a_note_only_where_the_answer_may_have_been_made(lost, n):
    cache = Cache(":memory:")
    asked(cache, lambda question: Reply(None, error="no", lost=lost))
    assert len(cache.on_the_way(keys())) == n


def test_a_key_that_is_refused_leaves_no_note():
    cache = Cache(":memory:")

    def answer(question):
        raise LabelError("no")

    with pytest.raises(LabelError):
        asked(cache, answer)
    assert cache.on_the_way(keys()) == set()


def test_what_was_on_its_way_is_in_the_estimate_and_the_tally(tmp_path):
    cache = Cache(tmp_path / "answers.sqlite")
    cache.sending(keys()[1], "m")
    cache.sending("of another scene", "m")
    cache.close()
    cache = Cache(tmp_path / "answers.sqlite")
    asking = Asking(Answers(lambda question: Reply("{}")), cache)
    assert asking.estimate(QUESTIONS).resumed == 1
    asking.ask_all(QUESTIONS, Answer, lambda one, reason: one)
    assert asking.tally.resumed == 1
    assert asking.record()["sent_before_without_an_answer"] == 1
    assert cache.on_the_way([*keys(), "of another scene"]) == {"of another scene"}


def test_a_file_of_an_older_version_gets_the_notes_and_keeps_its_answers(tmp_path):
    path = tmp_path / "answers.sqlite"
    old = Cache(path)
    old.put("a", "m", Reply("x"))
    old.close()
    with sqlite3.connect(path) as base:
        base.execute("DROP TABLE sent")
    base.close()
    cache = Cache(path)
    cache.sending("b", "m")
    assert cache.get("a").text == "x"
    assert cache.on_the_way(["a", "b"]) == {"b"}


def ids(n, reply, **more):
    server = HomeServer(reply)
    with server.running() as address:
        client = Client("m", base_url=address, **more)
        for each in QUESTIONS[:n]:
            client.ask(each)
        client.close()
    for headers in server.headers:
        assert len({headers[name] for name in IDS}) == 1
    return [headers["idempotency-key"] for headers in server.headers]


def test_a_request_has_the_same_id_in_every_run_and_each_question_its_own():
    first = ids(3, lambda body, server: (200, said()))
    assert first == ids(3, lambda body, server: (200, said()))
    assert len(set(first)) == 3
    assert all(len(each) <= 64 for each in first)


def test_the_id_stays_after_a_broken_connection_and_changes_after_an_error_that_was_told():
    # A server that knows ids again repeats what it said to one, be it an error.
    def reply(body, server):
        n = len(server.bodies)
        return None if n == 1 else (500, refused("oops"), {"retry-after": "0"}) if n == 2 else (200, said())

    first, second, third = ids(1, reply, retries=3)
    assert first == second != third


def test_another_way_of_asking_has_another_id():
    def reply(body, server):
        form = body.get("response_format", {}).get("type")
        return (400, refused("response_format is not supported")) if form == "json_schema" else (200, said())

    first, second = ids(1, reply)
    assert first != second


PROGRAM = """
import sys
from cadgraph.labelers.lvlm.answer import Answer
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from home_server import question
questions = [question(f"What is part {i}?", n_pictures=1, side=16) for i in range(8)]
asking = Asking(Client("m", base_url=sys.argv[1]), Cache(sys.argv[2]), concurrency=2)
resumed = asking.estimate(questions).resumed
outcomes = asking.ask_all(questions, Answer, lambda one, reason: one)
print(resumed, sum(each.answer is not None for each in outcomes))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no kill -9 on Windows")
def test_a_provider_that_knows_ids_is_paid_once_for_each_question_after_kill_9(tmp_path):
    paid, lock, held = Counter(), threading.Lock(), threading.Event()

    def reply(body, server):
        with lock:
            ident = server.headers[server.bodies.index(body)]["idempotency-key"]
            paid[ident] += 1
            slow = len(server.bodies) > 4 and not held.is_set()
        if slow:
            held.wait(20)
        return 200, said()

    server = HomeServer(reply)
    tests = str(Path(__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([tests, os.environ.get("PYTHONPATH", "")])}
    with server.running() as address:
        command = [sys.executable, "-c", PROGRAM, address, str(tmp_path / "answers.sqlite")]
        with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) as first:
            while len(server.bodies) < 6:
                assert first.poll() is None
                time.sleep(0.01)
            first.send_signal(signal.SIGKILL)
        held.set()
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    resumed, answered = map(int, done.stdout.split())
    assert answered == 8
    # What was on its way came again under the id that it had; a provider that knows ids makes it once.
    assert resumed == 2
    assert len(paid) == 8
    assert sum(paid.values()) == 10
