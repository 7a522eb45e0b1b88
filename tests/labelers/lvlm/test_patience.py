"""Servers that ask to wait, that are down, and that say nothing."""

import errno
import socket
import threading
import time
from email.utils import formatdate

import pytest

from cadgraph.labelers.lvlm.answer import Answer
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.patience import Gone, Patience, resolves, retry_after
from home_server import HomeServer, question, refused, said

QUESTIONS = [question(f"What is part {i}?", n_pictures=1, side=16) for i in range(40)]


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    for name in ("OPENAI_BASE_URL", "OPENAI_API_KEY", "HTTP_PROXY", "http_proxy", "ALL_PROXY", "all_proxy"):
        monkeypatch.delenv(name, raising=False)


def ask_all(address, n=40, **more):
    client = Client("m", base_url=address, **more)
    asking = Asking(client, Cache(":memory:"), concurrency=4)
    outcomes = asking.ask_all(QUESTIONS[:n], Answer, lambda asked, reason: asked)
    client.close()
    return outcomes, asking


@pytest.mark.parametrize(
    ("headers", "seconds"),
    [
        ({}, None),
        ({"retry-after": "7"}, 7),
        ({"retry-after": "3600"}, 3600),
        ({"retry-after": "0"}, 0),
        ({"retry-after-ms": "250", "retry-after": "1"}, 0.25),
        ({"retry-after-ms": "soon", "retry-after": "2"}, 2),
        ({"retry-after": formatdate(1_000_090, usegmt=True)}, 90),
        ({"retry-after": formatdate(999_000, usegmt=True)}, 0),
        ({"retry-after": "-5"}, None),
        ({"retry-after": "inf"}, None),
        ({"retry-after": "nan"}, None),
        ({"retry-after": "later"}, None),
        ({"retry-after": "Mon, 99 Foo 99999999999 99:99:99 GMT"}, None),
    ],
)
def test_a_wait_is_read_as_seconds_or_as_a_date(headers, seconds):
    assert retry_after(headers, now=1_000_000) == seconds


def test_a_wait_within_the_limit_is_waited():
    def reply(body, server):
        return (429, refused("slow down"), {"retry-after": "1"}) if len(server.bodies) == 1 else (200, said())

    server = HomeServer(reply)
    began = time.monotonic()
    with server.running() as address:
        outcomes, _ = ask_all(address, 1, retries=1)
    assert outcomes[0].answer is not None
    assert time.monotonic() - began >= 1


@pytest.mark.parametrize(("wait", "words"), [("90", "90 s"), ("3600", "60 min"), ("86400", "24 h")])
def test_a_longer_wait_ends_the_run_and_says_for_how_long(wait, words):
    server = HomeServer(lambda body, server: (429, refused("slow down"), {"retry-after": wait}))
    with server.running() as address:
        outcomes, _ = ask_all(address, wait=60)
    assert all(f"asks to wait {words}" in each.reason and "lvlm.wait" in each.reason for each in outcomes)
    assert len(server.bodies) <= 4


def test_a_wait_ends_where_somebody_presses_ctrl_c():
    patience = Patience(1000, 1, "x")
    patience.asked_to_wait(500)
    threading.Timer(0.05, patience.hurry).start()
    with pytest.raises(Gone, match="stopped"):
        patience.ready()


def test_an_account_without_credit_ends_the_run():
    broke = {"error": {"message": "You exceeded your quota", "type": "x", "code": "insufficient_quota"}}
    server = HomeServer(lambda body, server: (429, broke, {"retry-after": "0"}))
    with server.running() as address:
        outcomes, _ = ask_all(address)
    assert all("no credit" in each.reason for each in outcomes)
    assert len(server.bodies) <= 4


def test_a_server_that_is_down_ends_the_run_within_ten_seconds():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    began = time.monotonic()
    outcomes, asking = ask_all(f"http://127.0.0.1:{port}/v1")
    assert time.monotonic() - began < 10
    assert all("can't be reached" in each.reason and str(port) in each.reason for each in outcomes)
    assert "refused" in outcomes[0].reason.lower()
    assert asking.tally.failed == 40
    assert asking.cache.on_the_way([]) == set()


def test_a_server_whose_name_is_unknown_ends_the_run_within_ten_seconds(monkeypatch):
    def unknown(*_, **__):
        raise socket.gaierror(-2, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    began = time.monotonic()
    outcomes, _ = ask_all("http://nobody.example.invalid/v1")
    assert time.monotonic() - began < 10
    assert all("can't be reached (its name has no address)" in each.reason for each in outcomes)


def test_a_name_server_that_says_nothing_is_not_waited_for(monkeypatch):
    stop = threading.Event()
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: stop.wait(20))
    began = time.monotonic()
    assert not resolves("http://nobody.example.invalid/v1", 0.05)
    assert time.monotonic() - began < 10
    stop.set()


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(errno.ENETUNREACH, "Network is unreachable"), "Network is unreachable"),
        (TimeoutError("timed out"), "no connection in time"),
    ],
)
def test_an_address_without_a_route_ends_the_run_within_ten_seconds(monkeypatch, error, words):
    def unreachable(address, timeout, **_):
        if isinstance(error, TimeoutError):
            assert timeout <= 5
            time.sleep(timeout)
        raise error

    monkeypatch.setattr(socket, "create_connection", unreachable)
    began = time.monotonic()
    outcomes, _ = ask_all("http://192.0.2.1:9/v1")
    assert time.monotonic() - began < 10
    assert all(f"can't be reached ({words})" in each.reason for each in outcomes)


def test_a_server_that_takes_questions_and_never_answers_ends_by_the_timeout():
    stop = threading.Event()
    server = HomeServer(lambda body, server: stop.wait(20) and None)
    began = time.monotonic()
    with server.running() as address:
        outcomes, _ = ask_all(address, timeout=0.3, retries=5)
        stop.set()
    assert time.monotonic() - began < 10
    assert all("answered none within 0.3 s (lvlm.timeout)" in each.reason for each in outcomes)
    assert len(server.bodies) <= 8


def test_a_server_that_loads_its_model_for_longer_than_one_timeout_is_waited_for():
    def reply(body, server):
        if len(server.bodies) <= 4:
            time.sleep(0.7)
            return None
        return 200, said()

    server = HomeServer(reply)
    with server.running() as address:
        outcomes, _ = ask_all(address, 8, timeout=0.5, retries=2)
    assert all(each.answer is not None for each in outcomes)


def test_a_server_that_comes_back_is_asked_on():
    def reply(body, server):
        return None if len(server.bodies) in (2, 3) else (200, said())

    server = HomeServer(reply)
    with server.running() as address:
        outcomes, _ = ask_all(address, 6, retries=3)
    assert all(each.answer is not None for each in outcomes)


def test_failed_questions_are_named_with_what_they_are_about():
    server = HomeServer(lambda body, server: (500, refused("out of order")))
    with server.running() as address:
        outcomes, asking = ask_all(address, 3, retries=0)
    assert [each.reason for each in outcomes] == [
        "the server answered 500 (server error) to every try: out of order"
    ] * 3
    (finding,) = asking.findings()
    assert finding.code == "lvlm-failed"
    assert finding.message.startswith("3 questions failed, the server answered 500")
    for asked in QUESTIONS[:3]:
        assert f"q-{asked.id} about /plant/mesh_3" in finding.message


def test_many_that_fail_are_one_finding_with_the_first_few_names():
    server = HomeServer(lambda body, server: (400, refused(f"no. {len(server.bodies)}")))
    with server.running() as address:
        _, asking = ask_all(address, 40, retries=0)
    messages = [finding.message for finding in asking.findings()]
    assert len(messages) <= 3
    assert all(len(message) <= 400 for message in messages)
    assert any(" more" in message for message in messages)
