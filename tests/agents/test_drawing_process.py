"""Pictures of the server for agents: drawn in a process of their own, which keeps nobody waiting and ends with it."""

import json
import os
import shutil
import signal
import subprocess
import sys

import anyio
import pytest
from mcp import Client

from agents_asking import ask, text
from cadgraph.agents.child_process import ChildProcess
from cadgraph.agents.mcp.server import make_server
from cadgraph.agents.picture import picture
from cadgraph.agents.plants import Plants
from cadgraph.errors import AskError, LoadError
from cadgraph.model.graph import SceneGraph
from serving import copy_of, make_folder

DRAW = ("picture", {"plant": "blocks", "target": "part-00001"})


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """A folder of folders of results, first of one, which has its scene beside it."""
    place = tmp_path_factory.mktemp("several")
    make_folder(place).rename(place / "blocks")
    (place / "plant.usda").rename(place / "blocks" / "plant.usda")
    return place


@pytest.fixture(scope="module")
def plants(folders):
    """The folders as a server has them; what draws is ended after the tests."""
    plants = Plants(folders)
    yield plants
    plants.close()


def process_of(plants):
    """The process that draws."""
    return plants._drawing._child._process


@pytest.mark.skipif(sys.platform == "win32", reason="no process can be held there")
def test_a_call_is_answered_while_a_picture_is_being_drawn(plants):
    plants.picture("blocks", "part-00001")
    drawing = process_of(plants)
    drawing.send_signal(signal.SIGSTOP)
    answered = []

    async def run():
        async with Client(make_server(plants)) as client, anyio.create_task_group() as group:

            async def draw():
                answered.append(await client.call_tool(*DRAW))

            # More than there are threads.
            for _ in range(50):
                group.start_soon(draw)
            while not plants._drawing._drawing.locked():
                await anyio.sleep(0.01)
            # Would wait for ever if the pictures kept it waiting, as they wait for this one.
            answered.append(await client.call_tool("overview", {"plant": "blocks"}))
            group.cancel_scope.cancel()

    try:
        anyio.run(run)
    finally:
        drawing.send_signal(signal.SIGCONT)
    assert len(answered) == 1
    assert not answered[0].is_error


def test_a_process_that_was_killed_is_told_in_one_line_and_replaced(plants, monkeypatch):
    first = plants.picture("blocks", "part-00001")
    talk = ChildProcess.talk

    def killed(child, line):
        child._process.kill()
        return talk(child, line)

    with monkeypatch.context() as patch:
        patch.setattr(ChildProcess, "talk", killed)
        (result,) = ask(plants, DRAW)
    assert result.is_error
    assert text(result) == "the process that draws pictures was ended, perhaps for want of memory; ask again"
    process_of(plants).wait()
    assert plants.picture("blocks", "part-00001").png == first.png


def test_it_draws_what_the_command_draws(plants):
    assert plants.picture("blocks", "part-00001") == picture(plants.get("blocks"), "part-00001")


def test_what_can_not_be_drawn_is_refused_as_by_the_command(plants, folders):
    with pytest.raises(AskError, match="part-99999"):
        plants.picture("blocks", "part-99999")
    copy_of(folders / "blocks", folders / "changed")
    (folders / "changed" / "plant.usda").write_text("#usda 1.0\n")
    document = plants.get("changed").graph.document.model_dump(mode="json")
    for sha256, error, words in (("0" * 64, AskError, "has changed"), ("", LoadError, r"plant\.usda")):
        document["source"]["sha256"] = sha256
        SceneGraph.from_json(document).save(folders / "changed")
        with pytest.raises(error, match=words):
            plants.picture("changed", "part-00001")


def test_a_plant_that_is_built_anew_is_drawn_anew(plants, folders):
    place = folders / "place"
    place.mkdir()
    for count in (2, 5):
        shutil.rmtree(folders / "anew", ignore_errors=True)
        make_folder(place, count).rename(folders / "anew")
        last = f"part-{count - 1:05d}"
        assert plants.picture("anew", last) == picture(plants.get("anew"), last)


def test_nothing_is_drawn_after_the_end(folders):
    plants = Plants(folders)
    plants.close()
    with pytest.raises(AskError, match="ending"):
        plants.picture("blocks", "part-00001")


@pytest.mark.slow
@pytest.mark.parametrize("end", ["input", "SIGTERM", "SIGKILL"])
def test_the_end_of_the_server_leaves_no_process_and_no_word(folders, end):
    lines = [
        {"method": "initialize", "id": 1, "params": {
            "protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}}},
        {"method": "notifications/initialized"},
        {"method": "tools/call", "id": 2, "params": {"name": DRAW[0], "arguments": DRAW[1]}},
    ]  # fmt: skip
    server = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "serve", folders],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        server.stdin.write("".join(json.dumps({"jsonrpc": "2.0"} | line) + "\n" for line in lines))
        server.stdin.flush()
        answers = [json.loads(server.stdout.readline()) for _ in range(2)]
        if end != "input":
            server.send_signal(getattr(signal, end))
            server.wait(timeout=20)
        # The drawing process holds the other end of standard error for as long as it is there.
        told = server.communicate(timeout=20)
    finally:
        server.kill()
        server.communicate()
    assert answers[1]["result"]["content"][1]["type"] == "image"
    assert told == ("", "")
    assert server.returncode == (-signal.SIGKILL if end == "SIGKILL" else 0)
