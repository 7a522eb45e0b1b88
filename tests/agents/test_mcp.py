"""The server for agents, asked by the client that comes with the protocol's library."""

import base64
import http.client
import io
import json
import math
import os
import signal
import subprocess
import sys
import threading
from contextlib import closing, contextmanager

import anyio
import pytest
from mcp import Client, MCPError
from mcp.client.stdio import StdioServerParameters, stdio_client
from PIL import Image

import networks
from agents_asking import ask, text
from cadgraph.agents.answer import Answer
from cadgraph.agents.mcp import server as mcp_server
from cadgraph.agents.mcp.server import GUIDE, make_server
from cadgraph.agents.plants import Plants
from cadgraph.agents.tools import TOOLS, Tool
from cadgraph.errors import FormatError, LabelError
from command_line import refused
from serving import make_folder

CALLS = {
    "describe": {"id": "V-001"},
    "neighbors": {"id": "V-001"},
    "trace": {"start": "T-001"},
    "route": {"start": "T-001", "end": "V-010"},
    "isolate": {"target": "P-001"},
    "what_if": {"close": ["V-001"]},
    "measure": {"a": "T-001", "b": "P-001"},
    "query": {"sql": "SELECT count(*) FROM unit"},
    "approach": {"target": "V-001"},
    "plan": {"goals": "close V-001"},
}
MOST_TOKENS = {"one": 3300, "several": 3900}  # of several plants, each tool says that it takes one


@pytest.fixture(scope="module")
def several(tmp_path_factory):
    """A folder of two plants: a pumping station without its scene, and four blocks with it."""
    place = tmp_path_factory.mktemp("several")
    make_folder(place).rename(place / "blocks")
    (place / "pumps").mkdir()
    networks.pumping().save(place / "pumps" / "graph.json")
    return place


def listed(plants):
    async def run():
        async with Client(make_server(plants)) as client:
            return (await client.list_tools()).tools

    return anyio.run(run)


def command(*arguments):
    more = {"PYTHONPATH": os.pathsep.join(sys.path)}
    return StdioServerParameters(
        command=sys.executable, args=["-m", "cadgraph", "serve", *map(str, arguments)], env=os.environ | more
    )


async def call_each_once(client, plant):
    """Calls each tool once; those that a graph alone answers, and the picture."""
    results = {}
    for tool in (await client.list_tools()).tools:
        if tool.name in ("plants", "picture", "correct"):
            continue
        results[tool.name] = await client.call_tool(tool.name, {"plant": plant, **CALLS.get(tool.name, {})})
    return results


@pytest.mark.slow
def test_each_tool_answers_over_standard_input_and_output(several):
    async def run():
        # What the server prints beside is seen where a test fails.
        async with Client(stdio_client(command(several, "--write", "--who", "robot"), errlog=sys.__stderr__)) as client:
            results = await call_each_once(client, "pumps")
            names = await client.call_tool("plants", {})
            picture = await client.call_tool("picture", {"plant": "blocks", "target": "part-00001"})
            edit = {"plant": "blocks", "target": "part-00001", "label": "gauge", "why": "a test"}
            tried = await client.call_tool("correct", edit)
            return results, names, picture, tried

    results, names, picture, tried = anyio.run(run)
    assert set(results) == {tool.name for tool in TOOLS}
    assert {name: text(result) for name, result in results.items() if result.is_error} == {}
    assert "blocks" in text(names)
    assert "pumps" in text(names)
    image = Image.open(io.BytesIO(base64.b64decode(picture.content[1].data)))
    assert (image.size, picture.content[1].mime_type) == ((768, 576), "image/png")
    assert text(tried).startswith("dry run, nothing was changed")


def test_nothing_but_the_protocol_is_written_to_standard_output(several):
    lines = [
        {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {
            "protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}}},
        {"jsonrpc": "2.0", "method": "notifications/initialized"},
        {"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": {
            "name": "overview", "arguments": {"plant": "pumps"}}},
    ]  # fmt: skip
    process = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "serve", several],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        process.stdin.write("".join(f"{json.dumps(line)}\n" for line in lines))
        process.stdin.flush()
        answers = [json.loads(process.stdout.readline()) for _ in range(2)]
        rest, errors = process.communicate(timeout=30)
    finally:
        process.kill()
    assert [answer["id"] for answer in answers] == [1, 2]
    assert "structuredContent" not in answers[1]["result"]
    assert (rest, errors, process.returncode) == ("", "", 0)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_though_the_client_says_nothing(several, number):
    process = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "serve", several / "pumps"],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        process.stdin.write('{"jsonrpc": "2.0", "id": 1, "method": "ping"}\n')
        process.stdin.flush()
        assert json.loads(process.stdout.readline())["id"] == 1
        process.send_signal(number)
        assert process.wait(timeout=20) == 0
    finally:
        process.kill()
        assert process.communicate() == ("", "")


@contextmanager
def served(folder):
    """The address of a server over HTTP while it runs."""
    process = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "serve", folder, "--http"],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        yield process.stderr.readline().strip(), process
    finally:
        process.kill()
        process.communicate()


def test_each_tool_answers_over_http_to_its_own_name_alone(several):
    async def run(address):
        async with Client(address) as client:
            return await call_each_once(client, "pumps")

    with served(several) as (address, process):
        assert address.startswith("http://127.0.0.1:")
        results = anyio.run(run, address)
        host = address.removeprefix("http://").removesuffix("/mcp")
        port = host.rpartition(":")[2]
        statuses = {
            "evil.example": status(host, {"Host": "evil.example"}),
            "rebound": status(host, {"Host": f"evil.example:{port}"}),
            "other port": status(host, {"Host": "127.0.0.1:1"}),
            "origin": status(host, {"Origin": "http://evil.example"}),
            "origin of another port": status(host, {"Origin": "http://127.0.0.1:1"}),
            "null": status(host, {"Origin": "null"}),
            "own": status(host, {"Origin": f"http://127.0.0.1:{port}"}),
        }
        process.terminate()
        assert process.wait(timeout=20) == 0
    assert {name: text(result) for name, result in results.items() if result.is_error} == {}
    assert list(statuses.values()) == [421, 421, 421, 403, 403, 403, 200]


def status(host, headers):
    """How a request to list the tools is answered."""
    plain = {"Content-Type": "application/json", "Accept": "application/json, text/event-stream"}
    body = json.dumps({"jsonrpc": "2.0", "id": 1, "method": "tools/list"})
    with closing(http.client.HTTPConnection(host, timeout=30)) as connection:
        connection.request("POST", "/mcp", body, plain | headers)
        return connection.getresponse().status


def test_no_neighbour_answers_for_a_folder_that_is_not_there(several):
    for gone in (several / "typo", several / "typo" / "graph.json"):
        with pytest.raises(FormatError, match="no such folder"):
            Plants(gone)


@pytest.mark.parametrize("form", ["one", "several"])
def test_the_list_of_tools_is_short_and_says_that_they_only_read(several, form):
    plants = Plants(several / "pumps" if form == "one" else several)
    tools = listed(plants)
    names = [tool.name for tool in tools]
    assert names == ["plants"] * (form == "several") + [tool.name for tool in TOOLS] + ["picture"]
    assert all(tool.annotations.read_only_hint for tool in tools)
    assert not any(tool.output_schema for tool in tools)
    rows = [tool.model_dump(mode="json", by_alias=True, exclude_none=True) for tool in tools]
    content = json.dumps([GUIDE, rows], separators=(",", ":"), ensure_ascii=False)
    assert math.ceil(len(content.encode()) / 1.9) <= MOST_TOKENS[form]


def test_the_tool_for_corrections_is_there_only_where_it_is_allowed(several):
    assert "correct" not in {tool.name for tool in listed(Plants(several))}
    correct = {tool.name: tool for tool in listed(Plants(several, "robot"))}["correct"]
    assert correct.annotations.read_only_hint is False


@pytest.mark.parametrize(
    ("name", "arguments", "words"),
    [
        ("describe", {"id": "V-O01"}, "V-001"),
        ("describe", {}, "id"),
        ("describe", {"id": "V-001", "idd": 1}, "did you mean id"),
        ("trace", {"start": "%%%%"}, "the tool lines prints all"),
        ("descripe", {"id": "V-001"}, "did you mean describe"),
        ("trace", {"start": "V-001", "direction": "sideways"}, "upstream"),
        ("picture", {"target": "V-001"}, "isn't where it was"),
        ("correct", {}, "no tool 'correct'"),
        ("plants", {}, "no tool 'plants'"),
    ],
)
def test_an_error_names_the_remedy_in_one_line(several, name, arguments, words):
    (result,) = ask(Plants(several / "pumps"), (name, arguments))
    assert result.is_error
    assert words in text(result)
    assert "\n" not in text(result)
    assert "Traceback" not in text(result)


@pytest.mark.parametrize("name", ["../pumps", "/etc", "", "pump", "pumps/../pumps", "\x00", ["pumps"], None])
def test_a_plant_is_chosen_by_name_never_by_path(several, name):
    (result,) = ask(Plants(several), ("overview", {"plant": name}))
    assert result.is_error
    assert "pumps" in text(result) or "plants lists" in text(result)


def test_a_folder_without_graphs_is_refused(tmp_path, capsys):
    with pytest.raises(FormatError, match=r"holds no graph\.json"):
        Plants(tmp_path)
    assert "holds no graph.json" in refused(capsys, "serve", tmp_path)


def test_a_graph_that_is_written_anew_is_read_anew(tmp_path):
    networks.pumping().save(tmp_path / "graph.json")
    plants = Plants(tmp_path)
    before = plants.get("")
    assert plants.get("") is before
    networks.network([networks.unit("V-777")], []).save(tmp_path / "graph.json")
    (result,) = ask(plants, ("describe", {"id": "V-777"}))
    assert not result.is_error


def test_plants_not_asked_about_for_long_are_closed(tmp_path):
    for number in range(10):
        (tmp_path / f"plant{number}").mkdir()
        networks.network([networks.unit("V-001")], []).save(tmp_path / f"plant{number}" / "graph.json")
    plants = Plants(tmp_path)
    first = plants.get("plant0")
    for number in range(1, 10):
        plants.get(f"plant{number}")
    assert plants.get("plant0") is not first
    assert plants.get("plant9") is plants.get("plant9")


def test_a_slow_call_keeps_no_other_waiting_and_tells_that_it_goes_on(several, monkeypatch):
    may_end, told = threading.Event(), []

    def wait(plant):
        return Answer("ended" if may_end.wait(30) else "kept waiting", {})

    monkeypatch.setattr(mcp_server, "TOOLS", (*TOOLS, Tool("slow", "Waits.", wait)))
    monkeypatch.setattr(mcp_server, "_EVERY", 0.02)

    async def tell(progress, total, message):
        told.append((progress, message))

    async def run():
        async with Client(make_server(Plants(several / "pumps"))) as client, anyio.create_task_group() as group:
            results = []

            async def slow():
                results.append(await client.call_tool("slow", {}, progress_callback=tell))

            group.start_soon(slow)
            while len(told) < 3:
                await anyio.sleep(0.01)
            # Would wait for ever if the slow one held a lock, as that waits for this one.
            results.append(await client.call_tool("overview", {}))
            may_end.set()
        return [text(result) for result in results]

    first, second = anyio.run(run)
    assert (second, "pumping" in first or "valve" in first) == ("ended", True)
    assert [one for one, _ in told] == sorted({one for one, _ in told})
    assert "slow: at work" in told[0][1]


def test_want_of_the_library_names_the_extra(several, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "cadgraph.agents.mcp.stdio", None)
    monkeypatch.delitem(sys.modules, "cadgraph.agents.mcp.stdio")
    monkeypatch.setitem(sys.modules, "mcp.server.stdio", None)
    assert "pip install '.[agents]'" in refused(capsys, "serve", several)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--port", "8000"), "go with --http"),
        (("--who", "me"), "goes with --write"),
        (("--http", "--write", "--host", "0.0.0.0"), "everybody who reaches this machine"),
    ],
)
def test_options_that_do_not_go_together_are_refused(several, capsys, arguments, words):
    assert words in refused(capsys, "serve", several, *arguments)


def test_closest_labels_are_found_for_a_name_alone():
    from cadgraph.model.given_labels import split_label
    from cadgraph.model.vocabulary import default_vocabulary

    with pytest.raises(LabelError, match="did you mean 'Valve assembly/handwheel'"):
        split_label("handweel", default_vocabulary())


def test_a_fault_of_ours_is_no_stack_for_the_client_and_no_end_of_the_server(several, monkeypatch):
    def fail(plant):
        raise RuntimeError("a secret path")

    monkeypatch.setattr(mcp_server, "TOOLS", (*TOOLS, Tool("fails", "Fails.", fail)))

    async def run():
        async with Client(make_server(Plants(several / "pumps"))) as client:
            with pytest.raises(MCPError) as caught:
                await client.call_tool("fails", {})
            return str(caught.value), await client.call_tool("overview", {})

    message, after = anyio.run(run)
    assert "secret" not in message
    assert "Traceback" not in message
    assert not after.is_error
