"""Names from a file are text: none becomes an element, none is run."""

import json
import struct

import pytest

import serving
from browsing import until
from cadgraph.export.html import write_html
from cadgraph.model.graph import SceneGraph
from cadgraph.session.run import run
from cadplants import make
from cadplants.writers import write_plant

pytestmark = pytest.mark.slow
STRIKE = "window.struck=1"
NAMES = (
    f'<img src=x onerror="{STRIKE}">',
    f"</script><script>{STRIKE}</script>",
    f"<!--<script>{STRIKE}",
    f'"><svg onload={STRIKE}>',
    f"javascript:{STRIKE}",
    f"</style><iframe srcdoc='<script>parent.{STRIKE}</script>'>",
    "{{constructor.constructor('" + STRIKE + "')()}}",
    "\u202etxt.exe\u0000\u0007 ' ; DROP TABLE",
)
ELEMENTS = "() => document.querySelectorAll('img, iframe, object, embed, base, form, [onerror], [onload]').length"


def rename(path):
    """Gives the nodes of a binary glTF file names and tags that would be markup."""
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    tree = json.loads(data[20 : 20 + length])
    for number, node in enumerate(tree["nodes"]):
        name = NAMES[number % len(NAMES)]
        node["name"] = f"{name} {number}"
        node["extras"] = {"Tag": f"{name} {number}", "Description": name, name: name}
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
    path.write_bytes(head + struct.pack("<I4s", len(text), b"JSON") + text + rest)


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """A folder of a plant whose file, nodes and tags have names that would be markup."""
    place = tmp_path_factory.mktemp("hostile")
    scene = place / "<img src=x onerror=window.struck=1>.glb"
    write_plant(make("riser"), scene)
    rename(scene)
    run(scene, place / "out", report=False)
    return scene, place / "out"


@pytest.fixture(scope="module")
def hostile_server(hostile):
    with serving.served(hostile[1], "--who", NAMES[0]) as server:
        server.wait_until_ready()
        yield server


def look_everywhere(page):
    """Has everything shown that tells a name."""
    for tab in ("find", "network", "warnings", "history", "review"):
        if page.by(f"tab-{tab}").is_visible():
            page.by(f"tab-{tab}").click()
            page.page.wait_for_timeout(50)
    page.js("() => cadgraph.store.set({ schematic: true, table: true })")
    for kind in ("parts", "units", "lines"):
        page.by(f"table-{kind}").click()
    page.leave_fields()
    for select in (
        "() => cadgraph.store.select([3])",
        "() => cadgraph.store.selectPlace(cadgraph.store.content.network.units[0].id)",
    ):
        page.js(select)
        page.js("() => document.querySelectorAll('details').forEach(fold => (fold.open = true))")
        page.page.wait_for_timeout(150)
    page.by("search").fill("img")
    until(page.by("found").count, "something found")
    page.leave_fields()


def check(page):
    assert page.js("() => window.struck ?? null") is None
    assert page.js(ELEMENTS) == 0
    assert page.page.url.split("#")[0] == page.address


def test_names_from_the_file_and_from_people_are_text(window, hostile, hostile_server):
    title = hostile[0].name
    content = hostile_server.ask("/api/content")[1]
    assert content["title"] == title
    assert any(NAMES[0] in value for facts in content["parts"]["facts"] for _, value in facts)
    tag = {"kind": "tag", "unit": content["network"]["units"][0]["id"], "tag": NAMES[0]}
    body = {"version": content["version"], "edits": [tag], "why": NAMES[1]}
    assert hostile_server.ask("/api/edit", body)[0] == 200
    with window(hostile_server.address) as page:
        page.ready()
        look_everywhere(page)
        assert page.text("title") == title
        page.js(
            "tag => cadgraph.store.selectPlace(cadgraph.store.content.network.units.find(u => u.tag === tag).id)",
            tag["tag"],
        )
        until(lambda: page.text("unit-tag") == NAMES[0], "the tag as it is")
        page.by("tab-history").click()
        until(
            lambda: NAMES[1] in page.text("audit") and NAMES[0] in page.text("audit"), "reason and person as they are"
        )
        page.press("?")
        check(page)
        assert page.troubles == []


def poisoned(content):
    """A content in which also those texts are markup that readers of files make plain: paths, labels, messages."""
    paths = content["meshes"]["path"]
    content["meshes"]["path"] = [f"/{NAMES[i % len(NAMES)]}/{i}" for i in range(len(paths))]
    for i, group in enumerate(content["groups"]):
        group["name"] = f"{NAMES[i % len(NAMES)]} {i}"
    parts, network = content["parts"], content["network"]
    parts["name"] = [f"{NAMES[i % len(NAMES)]} {i}" for i in range(len(parts["name"]))]
    parts["source"] = [NAMES[0]] * len(parts["source"])
    for i, node in enumerate([*network["units"], *network["lines"]]):
        node["tag"] = f"{NAMES[i % len(NAMES)]} {i}"
    for i, node in enumerate([*network["ends"], *network["clusters"], *network["systems"]]):
        node["name"] = node["kind"] = NAMES[i % len(NAMES)]
    for joint in network["joints"]:
        joint["reasons"] = list(NAMES)
    content["diagnostics"] = [{"code": "likely", "message": name, "parts": [0]} for name in NAMES]
    return content


DRAWING = f"""<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200" onload="{STRIKE}">
<script>{STRIKE}</script>
<style>@import url(http://example.com/x.css)</style><image href="x" onerror="{STRIKE}" width="9" height="9"/>
<foreignObject width="99" height="99">
<img xmlns="http://www.w3.org/1999/xhtml" src="x" onerror="{STRIKE}"/></foreignObject>
<a href="javascript:{STRIKE}"><text>{STRIKE}</text></a>
<rect data-id="unit-G-001" x="150" y="100" width="40" height="40" fill="red" onclick="{STRIKE}" style="fill:red"/>
<use href="http://example.com/x.svg#a"/><animate attributeName="href" to="javascript:{STRIKE}"/></svg>"""


def test_the_page_itself_takes_no_text_for_markup(window, hostile_server):
    """Also where a server or a file said it: the page doesn't rely on what others made plain."""

    def poison(context):
        def content(route):
            route.fulfill(json=poisoned(route.fetch().json()))

        context.route("**/api/content", content)
        context.route("**/api/schematic", lambda route: route.fulfill(body=DRAWING, content_type="image/svg+xml"))

    with window(hostile_server.address, poison) as page:
        page.ready()
        look_everywhere(page)
        drawn = page.page.locator('[data-test="schematic"] [data-id="unit-G-001"]')
        until(drawn.count, "the drawing, without what is none")
        drawn.first.click(force=True)
        for _ in range(3):
            page.press("w")
        page.js("() => cadgraph.store.select([1])")
        until(lambda: NAMES[1] in page.text("inspector"), "the path as it is")
        check(page)
        assert (
            drawn.first.evaluate("e => e.getAttributeNames().some(name => name === 'style' || name.startsWith('on'))")
            is False
        )
        drawing = "name => document.querySelectorAll('[data-test=schematic] ' + name).length"
        assert [
            page.js(drawing, name) for name in ("script", "style", "image", "foreignObject", "a", "use", "animate")
        ] == [0] * 7
        assert {url.split("/")[2] for url in page.requests if url.startswith("http")} == {hostile_server.host}


def test_the_page_in_one_file_holds_them_as_text_too(window, hostile, tmp_path):
    scene, folder = hostile
    write_html(SceneGraph.load(folder), scene, tmp_path / "page.html")
    with window((tmp_path / "page.html").as_uri()) as page:
        page.until("() => window.cadgraph?.store.content")
        look_everywhere(page)
        check(page)
        assert page.troubles == []
