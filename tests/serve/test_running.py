import os
import random
import signal
import socket
import sys
import threading
import time
import urllib.error
import urllib.request
from http.client import HTTPException

import pytest

import serving
from cadgraph._io.folder_lock import holding
from cadgraph.errors import OutputError
from cadgraph.model.corrections import read_corrections
from cadgraph.model.graph import SceneGraph
from cadgraph.serve import listening, running
from cadgraph.serve.guard import Doors
from cadgraph.serve.running import Options
from cadgraph.session.correct import amend
from cadgraph.session.demo import DEMO_SCENE
from command_line import refused
from serving import label

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="signals as on POSIX systems")
MANY = 40
NAMES = ("tee", "elbow", "pipe", "reducer")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return serving.make_folder(tmp_path_factory.mktemp("run"), MANY)


@pytest.mark.slow
def test_a_killed_server_has_lost_nothing_that_it_confirmed(folder):
    confirmed = {}
    with serving.served(folder, "--who", "Ada") as server:
        state = server.wait_until_ready()
        assert (state["who"], state["version"], state["read_only"]) == ("Ada", 1, None)

        def correct():
            for number in range(MANY):
                edit = label(f"part-{number:05}", "Pipe assembly", NAMES[number % len(NAMES)])
                try:
                    status, told = server.ask("/api/edit", {"version": number + 1, "edits": [edit], "why": "seen"})
                except (OSError, ValueError, HTTPException):  # killed before, amid or after its answer
                    return
                assert status == 200, told
                confirmed[f"/b{number}"] = edit["name"]

        person = threading.Thread(target=correct)
        person.start()
        while len(confirmed) < 5:
            time.sleep(0.01)
        time.sleep(random.Random(os.getpid()).uniform(0, 0.3))
        server.process.kill()
        person.join(60)
    kept = {one.mesh: one.name for one in read_corrections(folder)}
    assert confirmed.items() <= kept.items()
    assert len(kept) - len(confirmed) in (0, 1), "one may have been under way"
    with serving.served(folder) as server:
        assert server.wait_until_ready()["n_edits"] == len(kept)
        parts = server.ask("/api/content")[1]["parts"]
        found = dict(zip((f"/b{number}" for number in range(MANY)), parts["name"], strict=True))
        assert confirmed.items() <= found.items()
        server.process.send_signal(signal.SIGINT)
        assert server.process.wait(20) == 0
    names = {part.meshes[0]: part.label and part.label.name for part in SceneGraph.load(folder).parts()}
    assert confirmed.items() <= names.items()


def is_free(folder):
    """Whether no process holds a folder."""
    try:
        with holding(folder):
            return True
    except OutputError:
        return False


@pytest.mark.slow
def test_while_a_server_runs_nobody_else_writes_and_ctrl_c_ends_it_in_a_second(folder, capsys):
    with serving.served(folder) as server:
        server.wait_until_ready()
        states = server.states()
        assert next(states)["status"] == "ready"
        for command in (("view", folder, "--no-browser"), ("relabel", folder, "part-00001", "--as", "tee")):
            assert "another cadgraph is at work in it" in refused(capsys, *command)
        assert server.ask("/api/part/part-00001")[0] == 200
        before = time.monotonic()
        server.process.send_signal(signal.SIGINT)
        assert list(states) == [], "who follows the state is let go"
        while not is_free(folder):
            time.sleep(0.01)
        assert time.monotonic() - before < 2, "a second, and another for a busy machine"
        assert server.process.wait(30) == 0
    amend(folder, "part-00001", "tee", this_only=True, report=False)


@pytest.mark.slow
def test_ctrl_c_while_a_scene_is_built_ends_as_other_commands_do(tmp_path):
    with serving.served(DEMO_SCENE, "-o", tmp_path / "out") as server:
        first = next(server.states())
        assert (first["status"], first["version"]) == ("building", 0)
        assert server.ask("/api/content")[0] == 423
        assert server.ask("/api/edit", {"version": 0, "edits": [{}]})[0] in (400, 423)
        server.process.send_signal(signal.SIGINT)
        assert server.process.wait(30) == 130
        assert "stopped" in server.process.stderr.read()
    assert not (tmp_path / "out").exists()


def test_a_port_that_is_taken_is_said_in_one_line(folder, capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        said = refused(capsys, "view", folder, "--no-browser", "--port", port)
    assert f"127.0.0.1:{port}" in said
    assert "--port" in said


def test_the_extra_that_is_missing_is_named(folder, capsys, monkeypatch):
    for name in [name for name in sys.modules if name.startswith("cadgraph.serve")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    assert "pip install '.[view]'" in refused(capsys, "view", folder)


@pytest.mark.parametrize(
    ("host", "shown", "minds"),
    [
        ("127.0.0.1", "127.0.0.1", False),
        ("::1", "[::1]", False),
        ("0.0.0.0", "127.0.0.1", True),
        ("10.0.0.7", "10.0.0.7", True),
    ],
)
def test_who_else_is_let_in_is_said(host, shown, minds):
    said = []
    running._welcome(Doors(host, 8123), "secret", Options(host, browser=False), said.append)
    assert said[0] == f"http://{shown}:8123/?token=secret"
    assert any("everybody who has this address" in line for line in said) == minds


def test_a_folder_is_held_by_one_at_a_time(tmp_path):
    with holding(tmp_path), pytest.raises(OutputError, match="another cadgraph"), holding(tmp_path):
        pass
    assert list(tmp_path.iterdir()) == []
    with holding(tmp_path):
        pass


def test_connections_on_which_nobody_asks_keep_nobody_out(monkeypatch):
    monkeypatch.setattr(listening, "_SILENCE", 0.3)
    monkeypatch.setattr(listening, "_MOST_CONNECTIONS", 4)

    async def app(scope, receive, send):
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"here"})

    def ask():
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=5) as answer:
            return answer.read()

    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        server = listening.Server(app, lambda: None)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        silent = [socket.create_connection(("127.0.0.1", port)) for _ in range(4)]
        silent[0].sendall(b"GET / HTTP/1.1\r\nHost: x\r\n")
        with pytest.raises(urllib.error.HTTPError, match="503"):
            ask()
        assert [one.recv(1) for one in silent] == [b""] * 4
        assert ask() == b"here"
        server.should_exit = True
        thread.join(10)
        for one in silent:
            one.close()
