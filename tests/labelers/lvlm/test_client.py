import pytest

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.address import check_address, is_local
from cadgraph.labelers.lvlm.answer import Answer
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.price import read_price
from chat_server import ChatServer

SCENE = plates.scene_of(5, 1)
PARTS = plates.parts_of(SCENE)
TRUTH = plates.truth_of(PARTS)
SIZE = 64


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.setenv("OPENAI_API_KEY", "right")


def labelled(server, *, way=None, timeout=10.0, retries=3, concurrency=1, size=SIZE):
    with server.running() as address:
        client = Client("gpt-4o", base_url=address, timeout=timeout, retries=retries)
        asking = Asking(client, Cache(":memory:"), read_price("gpt-4o"), concurrency=concurrency, size=size)
        labeler = LvlmLabeler(asking, way or Way(again_below=0))
        labeler.said = labeler.label(PARTS, plates.NO_CONTACTS, plates.VOCABULARY)
    return labeler.said.answers, labeler


def names(labels):
    return [None if each is None else (each.group, each.name) for each in labels]


def test_answers_of_a_server_become_labels():
    server = ChatServer(plates.oracle(PARTS))
    labels, labeler = labelled(server, concurrency=4)
    assert names(labels) == TRUTH
    assert labeler.tally.asked == 5
    body = server.bodies[0]
    kinds = [part["type"] for part in body["messages"][1]["content"]]
    assert kinds == ["text", *["text", "image_url"] * 6]
    assert body["response_format"]["json_schema"]["schema"]["additionalProperties"] is False
    assert set(body["response_format"]["json_schema"]["schema"]["required"]) == set(Answer.model_fields)


def test_the_estimate_is_within_a_tenth_of_what_the_server_counts():
    server = ChatServer(plates.oracle(PARTS))
    _, labeler = labelled(server, size=512)
    price = read_price("gpt-4o")
    counted = price.cost(server.prompt_tokens, server.answer_tokens)
    assert labeler.estimate.cost == pytest.approx(counted, rel=0.1)
    assert labeler.estimate.prompt_tokens == pytest.approx(server.prompt_tokens, rel=0.1)
    assert labeler.tally.cost == pytest.approx(counted)


@pytest.mark.parametrize("order", ["429", "500", "drop"])
def test_the_client_tries_again(order):
    server = ChatServer(plates.oracle(PARTS), [order])
    labels, labeler = labelled(server)
    assert names(labels) == TRUTH
    assert len(server.bodies) == 6
    assert labeler.tally.failed == 0


def test_a_slow_answer_is_given_up_and_asked_for_again():
    server = ChatServer(plates.oracle(PARTS), ["slow"])
    labels, _ = labelled(server, timeout=0.4)
    assert names(labels) == TRUTH


@pytest.mark.parametrize("order", ["broken", "refuse", "huge", "empty"])
def test_an_answer_that_is_no_use_is_asked_for_once_more(order):
    server = ChatServer(plates.oracle(PARTS), [order])
    labels, labeler = labelled(server)
    assert names(labels) == TRUTH
    assert labeler.tally.again == 1
    assert "could not be used" in server.bodies[1]["messages"][1]["content"][0]["text"]


@pytest.mark.parametrize("order", ["broken", "refuse", "huge", "empty", "wrong"])
def test_what_stays_no_use_leaves_the_part_unlabelled_with_a_reason(order):
    server = ChatServer(plates.oracle(PARTS), [order, order])
    labels, labeler = labelled(server)
    missing = [i for i, each in enumerate(labels) if each is None]
    assert len(missing) == (1 if order != "wrong" else 2)
    told = {mesh for finding in labeler.said.diagnostics for mesh in finding.meshes}
    assert told == {SCENE.paths[i] for i in missing}


def test_a_server_that_keeps_failing_leaves_reasons():
    server = ChatServer(plates.oracle(PARTS), ["500"] * 99)
    with pytest.raises(LabelError, match=r"500 \(server error\)"):
        labelled(server, retries=0)


@pytest.mark.parametrize("order", ["enormous", "endless", "packed"])
def test_an_enormous_reply_is_not_read(order):
    server = ChatServer(plates.oracle(PARTS), [order])
    labels, labeler = labelled(server, retries=0)
    told = [None if each is None else (each.group, each.name) for each in labels]
    assert told.count(None) == 1
    assert all(said in (None, true) for said, true in zip(told, TRUTH, strict=True))
    assert labeler.tally.failed == 1


def test_a_faulty_run_ends_with_every_part_labelled_or_told():
    orders = ["429", "drop", "broken", "wrong", "refuse", "refuse", "ok", "500", "huge", "empty", "ok"]
    server = ChatServer(plates.oracle(PARTS), orders)
    labels, labeler = labelled(server, concurrency=4)
    told = {mesh for finding in labeler.said.diagnostics for mesh in finding.meshes}
    assert all(each is not None or SCENE.paths[i] in told for i, each in enumerate(labels))


@pytest.mark.parametrize(("accepts", "last"), [(("json_object", "none"), {"type": "json_object"}), (("none",), None)])
def test_a_server_without_schemas_is_asked_in_a_way_it_knows(accepts, last):
    server = ChatServer(plates.oracle(PARTS), accepts=accepts)
    labels, _ = labelled(server)
    assert names(labels) == TRUTH
    assert server.bodies[-1].get("response_format") == last
    refused = sum(body.get("response_format", {}).get("type", "none") not in accepts for body in server.bodies)
    assert refused == 3 - len(accepts)


def test_a_key_that_is_refused_stops_the_run(monkeypatch):
    monkeypatch.setenv("OPENAI_API_KEY", "wrong")
    with pytest.raises(LabelError, match="refuses the key"):
        labelled(ChatServer(plates.oracle(PARTS)))


def test_without_a_key_openai_is_not_asked(monkeypatch):
    monkeypatch.delenv("OPENAI_API_KEY")
    with pytest.raises(LabelError, match="OPENAI_API_KEY"):
        Client("gpt-4o")
    Client("llava", base_url="http://localhost:11434/v1")


@pytest.mark.parametrize(
    "address",
    [
        "ftp://x/v1", "localhost:8000", "http://me:secret@host/v1", "https://host/v1?key=secret", "http://[",
        "http://localhost@example.com/v1", "http://@example.com/v1", "http://example.com\\@localhost/v1",
        "http://example.com /v1", "http://127.0.0.1%2eexample.com/v1", "http://localhost:port/v1",
        "http://2130706433/v1", "http://0x7f000001/v1", "http://127.1/v1", "http://0177.0.0.1/v1",
        "http://127.0.0.1.2/v1", "http://\uff11\uff12\uff17.1/v1",
    ],
)  # fmt: skip
def test_addresses_that_are_none_or_hold_a_secret_are_refused(address):
    with pytest.raises(LabelError, match="base_url"):
        check_address(address)


@pytest.mark.parametrize(
    ("address", "local"),
    [
        ("http://localhost:11434/v1", True),
        ("http://LOCALHOST./v1", True),
        ("http://plant.localhost/v1", True),
        ("http://localhost.example.com/v1", False),
        ("http://notlocalhost/v1", False),
        ("http://127.0.0.1:8000/v1", True),
        ("http://127.200.3.4/v1", True),
        ("http://127.0.0.1.example.com/v1", False),
        ("http://0.0.0.0:8000/v1", True),
        ("http://[::1]:8000/v1", True),
        ("http://[::]/v1", True),
        ("http://[::ffff:127.0.0.1]/v1", True),
        ("http://[::ffff:8.8.8.8]/v1", False),
        ("http://[fe80::1%25eth0]/v1", True),
        ("http://[fd00::7]/v1", True),
        ("http://[2001:db8::1]/v1", False),
        ("http://192.168.1.7/v1", True),
        ("http://10.example.com/v1", False),
        ("http://172.16.0.9/v1", True),
        ("http://172.32.0.9/v1", False),
        ("http://172.200.0.9/v1", False),
        ("http://8.8.8.8/v1", False),
        ("http://172.217.4.4/v1", False),
        ("http://172.15.255.255/v1", False),
        ("http://172.31.255.255/v1", True),
        ("http://169.254.1.1/v1", True),
        ("http://workstation.local:1234/v1", True),
        ("http://server.lan/v1", False),
        ("http://gateway.internal/v1", False),
        ("http://lan/v1", False),
        ("http://2130706433/v1", False),
        ("http://localhost@example.com/v1", False),
        ("https://api.example.com/v1", False),
        ("", False),
    ],
)
def test_servers_of_ones_own(address, local):
    assert is_local(address) is local
