"""A viewer's server for tests: within the process, or as the command that users run."""

import http.client
import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from urllib.parse import parse_qs, urlsplit

import shapes
from cadgraph.config import Config
from cadgraph.session.run import run

NONE = Config().replace({"label.labeler": "none", "load.isolate": False})
TOKEN, ADDRESS = "a-token", "http://127.0.0.1:8000"


def write_blocks(path, count=4):
    """A scene of separate blocks of different sizes, ``/b0``, ``/b1``..."""
    lines = ['#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)']
    for number in range(count):
        vertices, faces = shapes.box((0.1 + 0.01 * number, 0.2, 0.3), (number, 0, 0))
        points = ", ".join(f"({x!r}, {y!r}, {z!r})" for x, y, z in vertices.tolist())
        indices = ", ".join(str(i) for i in faces.reshape(-1).tolist())
        lines.append(
            f'def Mesh "b{number}" {{\n  int[] faceVertexCounts = [{", ".join("3" * len(faces))}]\n'
            f"  int[] faceVertexIndices = [{indices}]\n  point3f[] points = [{points}]\n}}"
        )
    path.write_text("\n".join(lines))
    return path


def make_folder(place, count=4):
    """A folder of results of blocks without labels, with the scene beside it."""
    scene = write_blocks(place / "plant.usda", count)
    run(scene, place / "out", NONE, report=False)
    return place / "out"


def make_page(place):
    """A page for tests."""
    page = place / "page"
    page.mkdir(exist_ok=True)
    for name in ("index.html", "viewer.js", "viewer.css"):
        (page / name).write_text(f"the {name}")
    return page


def client_of(plant, page, **more):
    """A client of a server of a plant; it has the token and comes from the server's own page."""
    from starlette.testclient import TestClient

    from cadgraph.serve.app import make_app
    from cadgraph.serve.guard import Doors

    app = make_app(plant, ThreadPoolExecutor(1), TOKEN, Doors("127.0.0.1", 8000), page)
    return TestClient(app, base_url=ADDRESS, headers={"authorization": f"Bearer {TOKEN}"}, **more)


def label(part, group, name=None):
    """An edit that says what one part alone is."""
    return {"kind": "label", "part": part, "group": group, "name": name, "this_only": True}


class Served:
    """A server as its users run it, and what it answers."""

    def __init__(self, process, address):
        self.process = process
        self.address = address
        self.host = urlsplit(address).netloc
        self.token = parse_qs(urlsplit(address).query)["token"][0]

    def ask(self, path, body=None):
        """The status and the content of an answer."""
        connection = http.client.HTTPConnection(self.host, timeout=30)
        try:
            headers = {"Authorization": f"Bearer {self.token}"}
            if body is None:
                connection.request("GET", path, headers=headers)
            else:
                headers["Content-Type"] = "application/json"
                connection.request("POST", path, json.dumps(body), headers)
            answer = connection.getresponse()
            return answer.status, json.loads(answer.read())
        finally:
            connection.close()

    def states(self):
        """The states as the page is told of them, for as long as the server runs."""
        connection = http.client.HTTPConnection(self.host, timeout=30)
        try:
            connection.request("GET", "/api/events", headers={"Authorization": f"Bearer {self.token}"})
            with connection.getresponse() as answer:
                for line in answer:
                    if line.startswith(b"data: "):
                        yield json.loads(line[6:])
        finally:
            connection.close()

    def wait_until_ready(self):
        """The first state in which the plant can be worked on."""
        return next(state for state in self.states() if state["status"] != "building")


@contextmanager
def served(*arguments):
    """The command ``cadgraph view`` while it runs; killed at the end, if it still does."""
    process = subprocess.Popen(
        [sys.executable, "-m", "cadgraph", "view", *map(str, arguments), "--no-browser"],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        address = process.stdout.readline().strip()
        assert address.startswith("http://"), process.communicate(timeout=30)
        yield Served(process, address)
    finally:
        process.kill()
        process.communicate()


def copy_of(folder, place):
    """A copy of a folder of results, which a test may change."""
    return shutil.copytree(folder, place)
