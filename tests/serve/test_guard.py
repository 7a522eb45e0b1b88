import pytest

import serving
from cadgraph.serve import app as serve_app
from cadgraph.serve.guard import POLICY, Doors, is_loopback
from cadgraph.serve.order import Order
from cadgraph.serve.plant import Plant

CALLS = (
    *("state", "events", "content", "scene", "scene/x", "schematic", "part/part-00000", "unit/V-001"),
    *("trace?at=V-001", "isolate?at=V-001", "review", "audit"),
)
POSTS = ("edit", "undo", "redo", "answer")


@pytest.fixture(scope="module")
def plant(tmp_path_factory):
    place = tmp_path_factory.mktemp("guarded")
    plant = Plant(Order(serving.make_folder(place)), "somebody")
    plant.open()
    assert plant.feed.state.status == "ready"
    yield plant
    plant.close()


@pytest.fixture
def client(plant, tmp_path):
    return serving.client_of(plant, serving.make_page(tmp_path), raise_server_exceptions=False)


@pytest.mark.parametrize(
    "token", [None, "", "Bearer", "Bearer wrong", "Basic a-token", "Bearer a-token2", "Bearer \xff"]
)
def test_without_the_token_nothing_is_told_or_done(client, token):
    headers = {"authorization": "" if token is None else token.encode("latin-1")}
    for path in CALLS:
        assert client.get(f"/api/{path}", headers=headers).status_code == 403, path
    for path in POSTS:
        assert client.post(f"/api/{path}", json={"version": 1}, headers=headers).status_code == 403, path


def test_the_page_itself_needs_the_token_in_its_address(client):
    assert client.get("/", params={"token": serving.TOKEN}).text == "the index.html"
    for refused in (client.get("/"), client.get("/?token=wrong"), client.get("/?token=")):
        assert refused.status_code == 403
        assert refused.headers["content-type"].startswith("text/plain")
        assert len(refused.text.splitlines()) == 1
    assert client.get("/viewer.js", headers={"authorization": ""}).text == "the viewer.js"


@pytest.mark.parametrize(
    "host",
    [
        *("evil.example:8000", "127.0.0.1", "127.0.0.1:8001", "localhost.evil.example:8000", "0.0.0.0:8000"),
        *("", "evil@127.0.0.1:8000", "[::1", "127.0.0.1:8000.evil.example", "localhost:", "127.0.0.1:08000"),
    ],
)
def test_a_name_that_leads_here_from_another_site_is_refused(client, host):
    assert client.get("/api/state", headers={"host": host}).status_code == 403


@pytest.mark.parametrize("host", ["127.0.0.1:8000", "localhost:8000", "LOCALHOST:8000"])
def test_the_names_of_this_machine_are_let_in(client, host):
    assert client.get("/api/state", headers={"host": host}).status_code == 200
    assert client.get("/api/state", headers={"host": host, "origin": f"http://{host}"}).status_code == 200


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "https://127.0.0.1:8000", "http://127.0.0.1:8001", ""]
)
def test_pages_of_other_sites_are_refused_even_with_the_token(client, origin):
    assert client.post("/api/undo", json={"version": 1}, headers={"origin": origin}).status_code == 403
    assert client.get("/api/state", headers={"origin": origin}).status_code == 403


@pytest.mark.parametrize(
    "kind", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x", ""]
)
def test_what_a_form_can_post_is_refused(client, kind):
    assert client.post("/api/undo", content='{"version": 1}', headers={"content-type": kind}).status_code == 415


def test_all_addresses_of_a_machine_let_in_bare_addresses_but_no_foreign_names(monkeypatch):
    monkeypatch.setattr("socket.gethostname", lambda: "Plant-PC")
    doors = Doors("0.0.0.0", 8000)
    assert all(
        doors.lets_in(host) for host in ("192.168.1.5:8000", "[fe80::1]:8000", "plant-pc:8000", "localhost:8000")
    )
    assert not any(
        doors.lets_in(host) for host in ("evil.example:8000", "192.168.1.5", "192.168.1.5.evil.example:8000")
    )
    named = Doors("plant.local", 80)
    assert named.lets_in("plant.local")
    assert named.lets_in("Plant.local:80")
    assert not named.lets_in("localhost")
    assert [is_loopback(host) for host in ("127.0.0.1", "::1", "localhost", "0.0.0.0", "10.0.0.1", "plant")] == (
        [True, True, True, False, False, False]
    )


def test_every_answer_carries_the_policy(client, monkeypatch, plant):
    answers = [client.get(f"/api/{path}") for path in CALLS if path != "events"]
    answers += [client.get("/"), client.get("/nothing"), client.put("/api/state"), client.get("/viewer.css")]
    monkeypatch.setattr(type(plant), "audit", lambda self: 1 / 0)
    answers.append(client.get("/api/audit"))
    assert {answer.status_code for answer in answers} >= {200, 403, 404, 405, 500}
    for answer in answers:
        assert answer.headers["content-security-policy"] == POLICY
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["cache-control"] == "no-store"
        assert "access-control-allow-origin" not in answer.headers


@pytest.mark.parametrize(
    "name", ["..%2f..%2fgraph.json", "%2e%2e/graph.json", "%2fetc%2fpasswd", "..\\graph.json", "%00"]
)
def test_a_scene_has_no_files_but_its_own(client, name):
    assert client.get(f"/api/scene/{name}").status_code == 404


def test_what_is_asked_for_reaches_no_header_and_breaks_no_line(client):
    for name in ("a%0d%0aset-cookie:%20x=1%0d%0a", "%1b[31m<img%20src=x%20onerror=1>"):
        answer = client.get(f"/api/part/{name}")
        assert answer.status_code == 404
        assert "set-cookie" not in answer.headers
        assert answer.headers["content-type"] == "application/json"
        assert answer.json()["error"].isprintable()
    assert "<img src=x onerror=1>" in answer.json()["error"]


@pytest.mark.parametrize(
    "body",
    [
        *("", "nonsense", "[]", "1", "{}", "[" * 100_000, '{"version": true}', '{"version": "1"}', '{"version": 1}'),
        *('{"version": 1, "edits": []}', '{"version": 1, "edits": [1]}', '{"version": 1, "edits": {}}'),
        *('{"version": 1, "edits": [{}]}', '{"version": 1, "edits": [{"kind": "a later one", "part": "part-00000"}]}'),
        *('{"version": NaN, "edits": [{}]}', '{"version": 1, "edits": [{"kind": "label"}], "why": 1}'),
        *('{"version": 1, "edits": [{"kind": []}]}', '{"version": 1, "edits": [{"kind": "label", "part": {}}]}'),
    ],
)
def test_what_is_no_edit_is_refused_in_one_line_and_changes_nothing(client, plant, body):
    answer = client.post("/api/edit", content=body, headers={"content-type": "application/json"})
    assert answer.status_code == 400
    assert answer.json()["error"].isprintable()
    assert plant.feed.state.version == 1


def test_more_than_a_body_may_be_long_is_not_read(client, monkeypatch):
    monkeypatch.setattr(serve_app, "_MOST_BODY", 1000)
    answer = client.post("/api/edit", json={"version": 1, "edits": [{"kind": "label", "part": "x" * 2000}]})
    assert answer.status_code == 413
