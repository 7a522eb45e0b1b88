"""A reply is read no further than a limit, whatever it claims and however it comes."""

import gzip
import itertools
import json
import time
import zlib

import pytest

from cadgraph._io.limits import REPLY
from cadgraph.labelers.lvlm.client import Client
from home_server import HomeServer, question, refused, said

PIECE = b" " * (1 << 16)
IN_BUFFERS = 16 << 20  # what the system's sockets may take from the server beside what is read


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)


def ask(reply, **more):
    server = HomeServer(reply)
    with server.running() as address:
        client = Client("m", base_url=address, **{"timeout": 20, "retries": 0} | more)
        answer = client.ask(question(n_pictures=1, side=32))
        client.close()
    return answer, server


def zeros(n):
    pack = zlib.compressobj(9, zlib.DEFLATED, zlib.MAX_WBITS | 16)
    return b"".join(pack.compress(b" " * (1 << 20)) for _ in range(n >> 20)) + pack.flush()


@pytest.mark.parametrize("status", [200, 400, 500])
def test_a_reply_without_end_and_without_length_is_read_to_the_limit_only(status):
    reply, server = ask(lambda body, server: (status, itertools.repeat(PIECE)))
    assert "did not end within 4 MB" in reply.error
    assert REPLY.most <= server.sent < REPLY.most + IN_BUFFERS


@pytest.mark.parametrize("status", [200, 500])
def test_a_reply_that_unpacks_to_a_thousandfold_is_unpacked_to_the_limit_only(status):
    packed = zeros(256 << 20)
    assert len(packed) < REPLY.most
    reply, _ = ask(lambda body, server: (status, packed, {"content-encoding": "gzip"}))
    assert "did not end within 4 MB" in reply.error


def test_a_reply_that_says_that_it_is_long_is_not_read_at_all():
    reply, _ = ask(lambda body, server: (200, b" " * (REPLY.most + 1)))
    assert "at most 4 MB are read" in reply.error


def test_a_reply_of_just_the_limit_is_read():
    text = json.dumps(said())
    reply, _ = ask(lambda body, server: (200, (text + " " * (REPLY.most - len(text))).encode()))
    assert reply.error is None


@pytest.mark.parametrize("encoding", ["gzip", "deflate"])
def test_a_packed_reply_is_read(encoding):
    text = json.dumps(said()).encode()
    packed = gzip.compress(text) if encoding == "gzip" else zlib.compress(text)
    reply, server = ask(lambda body, server: (200, packed, {"content-encoding": encoding}))
    assert "flange" in reply.text
    assert server.headers[0]["accept-encoding"] == "gzip"


def test_an_error_that_is_packed_is_understood():
    packed = gzip.compress(json.dumps(refused("nobody is at home")).encode())
    reply, _ = ask(lambda body, server: (500, packed, {"content-encoding": "gzip"}))
    assert "nobody is at home" in reply.error


@pytest.mark.parametrize(("encoding", "words"), [("br", "packed as 'br'"), ("gzip", "can't be unpacked")])
def test_a_reply_that_is_packed_otherwise_or_wrongly_is_refused(encoding, words):
    reply, _ = ask(lambda body, server: (200, b"nonsense", {"content-encoding": encoding}))
    assert words in reply.error


def test_a_reply_that_drips_without_end_is_given_up_after_the_timeout():
    def drip():
        while True:
            yield b" "
            time.sleep(0.05)

    began = time.monotonic()
    reply, _ = ask(lambda body, server: (200, drip()), timeout=0.5)
    assert reply.error
    assert time.monotonic() - began < 15
