"""A key that a server gives back is found nowhere."""

import base64
import json
from urllib.parse import quote

import pytest

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.batch import read_results
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.secret import scrubber
from home_server import ANSWER, HomeServer, question, refused, said

KEY = "sk-proj-4f/+Q9xWzt7Lq2"


@pytest.fixture(autouse=True)
def _key(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.setenv("OPENAI_API_KEY", KEY)


def forms():
    return [
        KEY, KEY.upper(), f"Bearer {KEY}", quote(KEY, safe=""), KEY.encode().hex(),
        base64.b64encode(KEY.encode()).decode(), base64.b64encode(f"Bearer {KEY}".encode()).decode(),
    ]  # fmt: skip


@pytest.mark.parametrize("form", forms())
def test_a_key_is_taken_out_in_every_form(form):
    scrub = scrubber("OPENAI_API_KEY")
    told = scrub(f"your key {form} is wrong")
    assert "[key]" in told
    assert KEY.lower() not in told.lower()
    assert form[:-2] not in told


def test_placeholders_are_words(monkeypatch):
    monkeypatch.setenv("OPENAI_API_KEY", "flange")
    assert scrubber("OPENAI_API_KEY")("a flange") == "a flange"
    monkeypatch.delenv("OPENAI_API_KEY")
    assert scrubber("OPENAI_API_KEY", "")("a flange") == "a flange"


@pytest.mark.parametrize("status", [400, 401, 404, 429, 500])
def test_an_error_that_holds_the_key_is_told_without_it(status):
    server = HomeServer(lambda body, server: (status, refused(f"bad key {KEY}"), {"retry-after": "0", "x-key": KEY}))
    with server.running() as address:
        client = Client("m", base_url=address, retries=1)
        try:
            told = client.ask(question(n_pictures=1, side=16)).error
        except LabelError as error:
            told = str(error)
        client.close()
    assert told
    assert KEY not in told


def test_an_error_that_is_no_json_is_told_without_the_key():
    server = HomeServer(lambda body, server: (500, f"<html>{KEY}</html>".encode()))
    with server.running() as address:
        client = Client("m", base_url=address, retries=0)
        told = client.ask(question(n_pictures=1, side=16)).error
        client.close()
    assert "500" in told
    assert KEY not in told


def test_nothing_that_a_run_writes_holds_the_key(tmp_path):
    parts = plates.parts_of(plates.scene_of(4, 1))

    def reply(body, server):
        # Each question meets another way to give the key back.
        way = len(server.bodies) % 4
        if way == 0:
            return 500, refused(f"failed for {KEY}"), {"retry-after": "0"}
        if way == 1:
            return 200, said(None, refusal=f"not for {KEY}")
        label = KEY if way == 2 else "agitator"
        content = ANSWER | {
            "seen": f"{KEY} on a sign",
            "group": label,
            "name": label,
            "propose_group": KEY,
            "reason": KEY,
        }
        return 200, said(json.dumps(content)), {"x-request-id": KEY}

    server = HomeServer(reply)
    with server.running() as address:
        asking = Asking(
            Client("m", base_url=address, retries=1),
            Cache(tmp_path / "answers.sqlite"),
            size=64,
            keep=tmp_path / "renders",
        )
        labeler = LvlmLabeler(asking, Way(again_below=0), folder=tmp_path)
        labeling = labeler.label(parts, plates.NO_CONTACTS, plates.VOCABULARY)
    assert KEY not in repr(labeling)
    asking.cache.close()
    written = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert {"run.json", "proposals.json", "answers.sqlite", "reply.json"} <= {path.name for path in written}
    for path in written:
        assert KEY.encode() not in path.read_bytes(), path


def test_results_of_a_batch_are_read_without_the_key(tmp_path):
    response = {"status_code": 200, "body": said(f"{KEY}: a flange")}
    path = tmp_path / "results.jsonl"
    path.write_text(json.dumps({"custom_id": "a", "response": response}) + "\n")
    cache = Cache(":memory:")
    read_results(path, cache, "m", scrubber("OPENAI_API_KEY"))
    assert cache.get("a").text == "[key]: a flange"
