import shutil

import pytest

import serving
from cadgraph.model.records import Unit
from cadgraph.serve.order import Order
from cadgraph.serve.plant import Plant
from serving import label

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def plant(demo, tmp_path_factory):
    folder = tmp_path_factory.mktemp("served") / "demo"
    shutil.copytree(demo / "demo", folder)
    plant = Plant(Order(folder), "Ada", delay=1e9)
    plant.open()
    assert plant.feed.state.status == "ready"
    yield plant
    plant.close()


@pytest.fixture
def client(plant, tmp_path):
    return serving.client_of(plant, serving.make_page(tmp_path))


def content_after(content, update):
    """The content of a page that has taken an update up."""
    assert not update["reload"]
    for column, values in update["parts"].items():
        width = len(content["parts"][column]) // len(content["parts"]["id"])
        for place, row in enumerate(update["rows"]):
            content["parts"][column][row * width : (row + 1) * width] = values[place * width : (place + 1) * width]
    changed = {key: update[key] for key in ("version", "network", "diagnostics")}
    return {**content, **changed}


def test_updates_lead_to_the_content_that_a_new_window_gets(client, plant):
    content = client.get("/api/content").json()
    units = content["network"]["units"]
    valve = next(unit for unit in units if unit["type"] == "valve")
    pipe = content["parts"]["name"].index("pipe")
    steps = [
        [label(content["parts"]["id"][part], "Pipe assembly", "pipe") for part in valve["parts"]],
        [{**label(content["parts"]["id"][pipe], "Equipment"), "this_only": False}],
    ]
    for edits in steps:
        told = client.post("/api/edit", json={"version": content["version"], "edits": edits, "why": "seen"}).json()
        assert set(told["changed"]) <= set(told["rows"])
        assert told["changed"]
        content = content_after(content, told)
        assert content == client.get("/api/content").json()
    assert len(content["network"]["units"]) != len(units)
    for back in ("undo", "undo", "redo", "undo"):
        told = client.post(f"/api/{back}", json={"version": content["version"]}).json()
        content = content_after(content, told)
    assert content == client.get("/api/content").json()
    assert content["network"]["units"] == units
    state = told["state"]
    assert (state["can_undo"], state["can_redo"], state["n_edits"]) == (False, True, 0)
    assert state["version"] == told["version"] == plant.feed.state.version
    assert {row["who"] for row in client.get("/api/audit").json()} == {"Ada"}
    refused = client.post("/api/undo", json={"version": content["version"]})
    assert (refused.status_code, refused.json()) == (400, {"error": "nothing to undo"})


def test_the_geometry_comes_as_the_manifest_says(client):
    manifest = client.get("/api/scene").json()
    sizes = {chunk["file"]: chunk["bytes"] for chunk in manifest["chunks"]}
    sizes[manifest["instances"]] = 36 * manifest["n_meshes"]
    for file, size in sizes.items():
        answer = client.get(f"/api/scene/{file}")
        assert (len(answer.content), answer.headers["content-type"]) == (size, "application/octet-stream")


def test_what_lies_along_the_pipes_is_told_with_its_places(client, plant):
    graph = plant.shown().graph
    pump = next(unit for unit in graph.units("pump") if graph.connections(unit))
    content = client.get("/api/content").json()
    n_parts, connections = len(content["parts"]["id"]), content["network"]["connections"]
    down = client.get("/api/trace", params={"at": pump.tag, "direction": "downstream"}).json()
    assert down["title"] == f"downstream of {pump.tag}"
    assert down["places"][0] == pump.id
    ends = {end for row in down["connections"] for end in (connections[row]["source"], connections[row]["target"])}
    assert ends == set(down["places"])
    last = next(place for place in reversed(down["places"]) if isinstance(graph.nodes[place], Unit))
    way = client.get("/api/trace", params={"at": pump.tag, "to": last}).json()
    assert (way["places"][0], way["places"][-1]) == (pump.id, last)
    assert len(way["connections"]) == len(way["places"]) - 1
    cut = client.get("/api/isolate", params={"at": pump.tag}).json()
    assert cut["close"]
    assert {graph.nodes[place].unit_type for place in cut["close"]} == {"valve"}
    assert pump.id in cut["places"]
    touched = {end for row in cut["connections"] for end in (connections[row]["source"], connections[row]["target"])}
    assert set(cut["close"]) <= touched
    for doubt in (*down["doubts"], *cut["doubts"]):
        assert all(0 <= part < n_parts for part in doubt["parts"])
        assert doubt["parts"] if doubt["place"] is None else doubt["place"] in graph.nodes
    assert any("valve" in line for line in cut["lines"])


def test_what_cannot_be_answered_is_refused_in_words(client):
    for question in (
        "trace",
        "trace?at=",
        "isolate",
        "trace?at=P-001&direction=sideways",
        "review?limit=x",
        "review?limit=0",
    ):
        assert client.get(f"/api/{question}").status_code == 400, question
    unknown = client.get("/api/isolate?at=X-999")
    assert unknown.status_code == 404
    assert "X-999" in unknown.json()["error"]


def test_parts_and_units_are_explained_as_on_the_command_line(client, plant):
    unit = plant.shown().graph.units("valve")[0]
    assert f"unit        {unit.tag}" in client.get(f"/api/unit/{unit.id}").json()["lines"][0]
    assert "part-00003" in client.get("/api/part/part-00003").json()["lines"][0]


def test_the_schematic_is_drawn_for_the_page(client):
    answer = client.get("/api/schematic")
    assert answer.headers["content-type"].startswith("image/svg+xml")
    assert "<style" not in answer.text
    assert "data-id=" in answer.text


def test_a_question_is_answered_by_an_option_or_put_aside(client, plant):
    version = plant.feed.state.version
    first, second, third = client.get("/api/review?limit=3").json()
    for question, option in ((first, "skip"), (second, "unsure")):
        told = client.post(
            "/api/answer", json={"version": version, "question": question["id"], "option": option}
        ).json()
        assert (told["version"], told["rows"], told["changed"]) == (version, [], [])
    asked = {question["id"] for question in client.get("/api/review?limit=500").json()}
    assert third["id"] in asked
    assert not {first["id"], second["id"]} & asked
    answer = {"version": version, "question": third["id"], "option": 0}
    told = client.post("/api/answer", json=answer).json()
    assert told["version"] == version + 1
    assert set(told["changed"]) <= {*third["parts"], *third["alike"]}
    assert client.get("/api/audit").json()[0]["why"] == third["title"]
    assert client.post("/api/answer", json=answer).status_code == 409
    for wrong in (99, -1, True, "later", None):
        answer = {"version": version + 1, "question": first["id"], "option": wrong}
        assert client.post("/api/answer", json=answer).status_code in (400, 404)
    client.post("/api/undo", json={"version": version + 1})
