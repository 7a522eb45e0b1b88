"""The page in a real browser: what is seen, picked, hidden, coloured, traced, and found again by a link."""

import colorsys
import json
from urllib.parse import urlsplit

import numpy as np
import pytest

from browsing import until

pytestmark = pytest.mark.slow
CANVAS = '[data-test="canvas"]'


def near(colors, wanted, within=40):
    """How many pixels have nearly a colour, ``#rrggbb``."""
    target = np.array([int(wanted[i : i + 2], 16) for i in (1, 3, 5)])
    return int((np.abs(colors.astype(int) - target).max(axis=-1) <= within).sum())


def hue_at(page, at):
    """The hue of a small patch, as an angle, and its saturation."""
    x, y = at
    patch = page.picture({"x": x - 2, "y": y - 2, "width": 5, "height": 5}).reshape(-1, 3).mean(axis=0) / 255
    hue, _, saturation = colorsys.rgb_to_hls(*patch)
    return 360 * hue, saturation


def hue_of(color):
    return 360 * colorsys.rgb_to_hls(*(int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)))[0]


def apart(first, second):
    """The angle between two hues."""
    return abs((first - second + 180) % 360 - 180)


def largest(page, rows):
    """The part that takes the most room."""
    size = np.array(page.parts["size"]).reshape(-1, 3)
    return max(rows, key=lambda row: size[row].prod())


def select_unit(page, tag):
    page.js("id => cadgraph.store.selectPlace(id)", page.units[tag]["id"])


def test_the_plant_is_seen_and_the_page_loads_nothing_but_its_own_files(page, server):
    colors = page.picture(page.box("canvas"))
    groups = {group["name"]: group["color"] for group in page.content["groups"]}
    seen = {name for name, color in groups.items() if near(colors, color) > 300}
    assert {"Tank", "Pump unit", "Pipe assembly"} <= seen
    assert page.text("title") == "demo_plant.usdc"
    assert "303 parts" in page.text("inspector")
    first, *more = (url for url in page.requests if not url.startswith("data:"))
    assert first == server.address
    assert {urlsplit(url)[:2] for url in more} == {("http", server.host)}
    assert all(server.token not in url for url in more), "the token goes in the header"


def test_a_click_selects_the_part_that_is_there_and_a_second_one_its_unit(page):
    page.press("t", "n")  # tags and lines would be in the way
    try:
        for tag in ("T-001", "T-002", "P-001"):
            unit = page.units[tag]
            row = largest(page, unit["parts"])
            at = page.look_at(row)
            assert page.js("([x, y]) => document.elementFromPoint(x, y).dataset.test", list(at)) == "canvas"
            page.page.mouse.click(*at)
            page.has("selection", [row])
            paths = page.content["meshes"]["path"]
            mesh = page.content["meshes"]["part"].index(row)
            assert paths[mesh] in page.text("inspector")
            page.page.wait_for_timeout(400)  # else it were a double click
            page.page.mouse.click(*at)
            page.has("place", unit["id"])
            assert page.text("unit-tag") == tag
        page.press("Escape")
        page.has("selection", [])
    finally:
        page.press("t", "n")


def test_colours_follow_the_choice_and_the_legend_says_what_they_mean(page):
    content = page.content
    row = largest(page, page.units["T-001"]["parts"])
    at = page.look_at(row)
    group = content["groups"][content["parts"]["group"][row]]
    hue, saturation = hue_at(page, at)
    assert saturation > 0.2
    assert apart(hue, hue_of(group["color"])) < 20
    assert {group["name"], "Not sure"} <= {text.split("\n")[0] for text in page.by("legend-row").all_inner_texts()}
    for choice, words in (("source", "Geometry"), ("unit", "T-001"), ("confidence", "")):
        page.by("color-by").select_option(choice)
        rows = page.by("legend-row").all_inner_texts()
        assert any(words in text for text in rows)
        if choice == "source":
            assert apart(hue_at(page, at)[0], hue_of("#4477aa")) < 20, "all that its geometry tells has one colour"
    page.by("color-by").select_option("group")
    assert apart(hue_at(page, at)[0], hue) < 2


def test_what_is_hidden_or_not_isolated_is_neither_drawn_nor_picked(page):
    row = largest(page, page.units["T-001"]["parts"])
    at = page.look_at(row)
    box = page.box("canvas")
    inside = [at[0] - box["x"], at[1] - box["y"]]
    picked = "([x, y]) => cadgraph.view.pick(x, y)?.part ?? -1"
    before = page.picture(box)
    page.page.mouse.click(*at)
    page.press("h")
    page.has("hidden", [row])
    page.drawn()
    assert page.js(picked, inside) != row
    changed = np.abs(page.picture(box).astype(int) - before).max(axis=-1) > 30
    assert changed.mean() > 0.05
    page.press("a")
    page.has("hidden", [])
    page.drawn()
    assert page.js(picked, inside) == row
    other = largest(page, page.units["T-002"]["parts"])
    page.js("row => cadgraph.store.select([row])", other)
    page.press("i", "g")
    page.has("isolated", [other])
    page.drawn()
    assert page.js(picked, inside) == -1
    page.press("i", "g")
    page.has("isolated", None)


def test_schematic_and_plant_select_each_other(page):
    page.press("d")
    symbol = page.page.locator('[data-test="schematic"] svg.schematic [data-id]')
    until(symbol.count, "a schematic")
    places = {unit["id"]: unit for unit in page.content["network"]["units"]}
    unit = page.units["V-003"]
    page.page.locator(f'[data-test="schematic"] svg.schematic [data-id="{unit["id"]}"]').first.click(force=True)
    page.has("place", unit["id"])
    assert page.text("unit-tag") == "V-003"
    tag = page.page.locator(f'[data-test="net-place"][data-id="{unit["id"]}"].is-selected')
    until(tag.count, "its tag over the plant, marked")
    row = largest(page, page.units["T-002"]["parts"])
    at = page.look_at(row)
    page.js("row => cadgraph.store.select([row])", row)
    page.press("t")
    page.page.mouse.click(*at)
    page.press("t")
    page.has("place", page.units["T-002"]["id"])
    page.until(
        """() => [...document.querySelectorAll('svg.schematic .is-selected[data-id]')]
          .some(e => e.dataset.id === cadgraph.store.shown.place)"""
    )
    lit = page.js("() => [...document.querySelectorAll('svg.schematic .is-selected[data-id]')].map(e => e.dataset.id)")
    assert {place for place in lit if place in places} == {page.units["T-002"]["id"]}


def test_valves_to_close_and_the_way_of_the_flow_are_marked_in_both_views(page, server):
    page.press("d")
    until(page.page.locator("svg.schematic [data-id]").count, "a schematic")
    select_unit(page, "P-001")
    page.press("v")
    until(lambda: page.shown("marks"), "marks of the isolation")
    told = server.ask("/api/isolate?at=P-001")[1]
    marks = page.js("() => ({ kind: cadgraph.store.shown.marks.kind, close: [...cadgraph.store.shown.marks.close] })")
    assert marks == {"kind": "isolate", "close": told["close"]}
    assert told["close"], "there is something to close"
    marked = "name => [...document.querySelectorAll(name)].map(e => e.dataset.id)"
    until(lambda: set(page.js(marked, "svg.schematic .is-close[data-id]")) == set(told["close"]), "the schematic")
    until(lambda: set(page.js(marked, '[data-test="net-place"].is-close')) == set(told["close"]), "tags over the plant")
    assert page.by("net-close-tick").count() == len(told["close"])
    assert page.by("net-note").count() == 1
    page.press("Shift+ArrowDown")
    until(lambda: page.js("() => cadgraph.store.shown.marks?.kind") == "trace", "marks of the trace")
    told = server.ask("/api/trace?at=P-001&direction=downstream")[1]
    until(lambda: set(page.js(marked, "svg.schematic .is-marked[data-id]")) >= set(told["places"]), "the schematic")
    assert not page.js(marked, "svg.schematic .is-close[data-id]")
    page.press("c")
    page.has("marks", None)
    until(lambda: not page.js(marked, "svg.schematic .is-marked[data-id]"), "no marks in the schematic")


def view_of(page):
    """What a link carries."""
    camera = page.js("() => cadgraph.view.getCamera()")
    shown = {key: page.shown(key) for key in ("selection", "place", "colorBy", "hidden", "isolated")}
    return shown, np.array([camera["eye"], camera["target"]])


def same(first, second):
    """Whether two views are the same, to the millimetre that a link keeps."""
    return first[0] == second[0] and np.allclose(first[1], second[1], atol=2e-3)


def test_a_link_and_the_address_bring_the_same_view_back(page, server):
    select_unit(page, "V-003")
    page.press("f")
    page.js("() => document.querySelector('[data-test=canvas]').focus()")
    page.press("ArrowLeft", "ArrowLeft", "ArrowUp", "+")
    page.by("color-by").select_option("unit")
    page.js("rows => cadgraph.store.set({ hidden: new Set(rows) })", page.units["T-001"]["parts"])
    wanted = view_of(page)
    page.leave_fields()
    page.press("k")
    link = page.by("link-text").input_value()
    assert server.token not in link
    page.by("link-input").fill("a link without what it is about")
    page.by("link-go").click()
    assert page.page.locator("[role=alert]", has_text="A link has").count() == 1
    page.press("Escape")
    page.gone("dialog")
    page.js("() => cadgraph.store.set({ selection: [], place: null, hidden: new Set(), colorBy: 'group' })")
    page.js("() => cadgraph.view.home()")
    assert not same(view_of(page), wanted)
    page.press("k")
    page.by("link-input").fill(link)
    page.press("Enter")
    page.gone("dialog")
    page.has("colorBy", "unit")
    assert same(view_of(page), wanted)
    page.until("() => location.hash.includes('by=unit')")
    page.page.reload()
    page.ready().until("() => cadgraph.view")
    assert same(view_of(page), wanted)


def test_dark_follows_the_system_until_somebody_chooses(page):
    brightness = """() => {
      const [red, green, blue] = getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number);
      return (red + green + blue) / 3;
    }"""
    assert page.js(brightness) > 200
    page.page.emulate_media(color_scheme="dark")
    page.has("theme", "dark")
    assert page.js(brightness) < 70
    sky = page.picture({"x": 640, "y": 60, "width": 40, "height": 40})
    assert sky.mean() < 100, "the picture is dark, too"
    page.by("theme").click()
    page.has("theme", "light")
    assert page.js(brightness) > 200
    page.page.emulate_media(color_scheme="light")
    page.page.emulate_media(color_scheme="dark")
    assert page.shown("theme") == "light", "chosen by hand"
    page.js("() => localStorage.clear()")
    page.page.emulate_media(color_scheme="light")


def test_the_help_lists_the_keys_and_keeps_them_from_the_page(page):
    page.press("?")
    words = page.text("help")
    for told in ("Hide the selection", "Undo", "Trace upstream of the selection", "Skip: ask me later", "Ctrl + click"):
        assert told in words
    page.press("b", "d")
    assert not page.shown("table")
    assert not page.shown("schematic")
    page.press("Escape")
    page.gone("dialog")
    page.press("b")
    page.has("table", True)
    page.by("table-units").click()
    until(lambda: "24" in page.text("table-count"), "a table of all units")


def test_search_finds_a_tag_by_keys_alone(page):
    page.press("/")
    page.page.keyboard.type("V-011")
    until(page.by("found").count, "something found")
    page.press("Enter")
    page.has("place", page.units["V-011"]["id"])
    saved = json.dumps(page.shown("selection"))
    assert saved == json.dumps(page.units["V-011"]["parts"])
