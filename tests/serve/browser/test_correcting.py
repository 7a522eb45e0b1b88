"""Correcting in a real browser: clicks, keys, undo and redo, another load, and two windows at once."""

import json

import numpy as np
import pytest

from browsing import until

pytestmark = pytest.mark.slow
MANY = 20


def labels(page):
    """The label of each part as the page has it."""
    return page.js("() => { const p = cadgraph.store.content.parts; return [p.group, p.name, p.source] }")


def settled(page, server):
    """Waits until all that was sent is answered and shown; the state of the server."""

    def met():
        state = server.ask("/api/state")[1]
        return state if state["version"] == page.version else None

    return until(met, "the page shows what the server has")


def events_in(folder):
    """What is kept on the disk."""
    kept = folder / "corrections.json"
    return json.loads(kept.read_text())["events"] if kept.exists() else []


def question(page):
    return page.by("question").get_attribute("data-id")


def answer(page, key):
    """Answers the question that is shown by a key; waits for the next one."""
    page.until("() => cadgraph.store.shown.question")
    page.page.wait_for_timeout(30)
    before = question(page)
    # Right after a question was replaced by the server, keys are not taken: they were meant for the one before.
    until(lambda: page.press(key) and question(page) != before, "another question", 20)


def corrected(page):
    return page.js("() => cadgraph.store.state.n_edits")


@pytest.fixture(autouse=True)
def _nothing_stays(page, server):
    """Takes back all that tests before it corrected."""
    while (state := settled(page, server))["can_undo"]:
        assert server.ask("/api/undo", {"version": state["version"]})[0] == 200
    settled(page, server)


def test_the_queue_needs_no_mouse(page, server):
    page.press("r")
    page.until("() => cadgraph.store.shown.question")
    start = question(page)
    row = page.shown("question")["parts"][0]
    page.page.wait_for_timeout(600)
    page.press("o")
    page.page.keyboard.type("sight glass")
    page.press("Enter")
    until(lambda: question(page) != start, "the next question")
    until(lambda: corrected(page), "it is confirmed")
    until(lambda: page.parts["name"][row] == "sight glass", "the part has its name")
    assert page.parts["source"][row] == "human"
    assert "sight glass" in page.text("review-last").lower()
    answer(page, "s")
    answer(page, "u")
    assert settled(page, server)["n_edits"] == corrected(page) > 0
    for left in (2, 1, 0):
        asked = question(page)
        page.press("Backspace")
        until(lambda asked=asked: question(page) != asked, f"the answer before, {left} left")
    assert question(page) == start
    until(lambda: corrected(page) == 0, "nothing corrected")
    assert page.parts["name"][row] != "sight glass"
    # By Tab alone to an answer, and pressed as any button is.
    page.leave_fields()
    reached = "() => document.activeElement.dataset.test"
    for _ in range(80):
        page.press("Tab")
        if page.js(reached) == "option-1":
            break
    assert page.js(reached) == "option-1"
    page.page.wait_for_timeout(600)
    page.press("Enter")
    until(lambda: corrected(page), "a correction")


def repeated(page):
    """A part that has repeats, is well seen and may be something else, and how many they are."""
    parts = page.parts
    shape, size = np.array(parts["shape"]), np.array(parts["size"]).reshape(-1, 3).prod(axis=1)
    counts = np.bincount(shape)[shape]
    open_to_others = np.array([len(guesses) > 1 for guesses in parts["guesses"]])
    rows = np.flatnonzero((counts >= 3) & ~np.array(parts["ground"]) & open_to_others)
    row = int(rows[size[rows].argmax()])
    return row, int(counts[row])


def test_a_wrong_label_is_right_with_its_repeats_after_three_clicks(page, server):
    row, alike = repeated(page)
    at = page.look_at(row)
    page.press("t", "n")
    page.drawn()
    page.page.mouse.click(*at)
    page.press("t", "n")
    chosen = until(lambda: page.shown("selection"), "a selected part")
    parts = page.parts
    assert parts["shape"][chosen[0]] == parts["shape"][row]
    page.by("guess").nth(1).click()
    state = until(lambda: corrected(page) == 1 and settled(page, server), "a correction, by two clicks")
    now = page.parts
    same = [i for i, shape in enumerate(now["shape"]) if shape == now["shape"][row]]
    assert len(same) == alike
    assert {now["source"][i] for i in same} <= {"human", "repeat"}
    assert len({now["name"][i] for i in same}) == 1
    assert now["name"][row] != parts["name"][row]
    page.page.locator("[data-test=toast] button", has_text="Undo").click()
    until(lambda: corrected(page) == 0, "taken back by the message's own button")
    assert state["undo"]


def test_tags_units_and_directions_are_put_right_in_the_inspector(page, server):
    wanted = page.units
    page.js("id => cadgraph.store.selectPlace(id)", wanted["V-003"]["id"])
    page.by("edit-tag").click()
    page.by("tag-input").fill("V-004")
    page.press("Enter")
    until(lambda: "V-004" in page.page.locator(".tag-line .trouble").inner_text(), "why this tag is not taken")
    assert ["400" in trouble for trouble in page.troubles] == [True], "what a browser says of any refusal"
    page.troubles.clear()
    page.by("tag-input").fill("PSV 4711/a")
    page.press("Enter")
    until(lambda: page.text("unit-tag") == "PSV 4711/a", "the new tag")
    assert page.units["PSV 4711/a"]["parts"] == wanted["V-003"]["parts"]
    page.by("edit-kind").click()
    page.by("kind-input").fill("relief valve")
    page.press("Enter")
    until(lambda: page.text("unit-kind") == "Relief valve", "what it is")
    assert page.units["PSV 4711/a"]["kind"] == "relief valve"
    page.leave_fields()
    # Two units are one: from the inspector of the first one, by a click on the second one.
    page.page.locator("details", has_text="More corrections").locator("summary").click()
    page.by("merge").click()
    assert page.by("pick-hint").is_visible()
    page.js("id => cadgraph.store.selectPlace(id)", wanted["V-001"]["id"])
    both = sorted([*wanted["V-003"]["parts"], *wanted["V-001"]["parts"]])
    until(lambda: any(sorted(unit["parts"]) == both for unit in page.units.values()), "one unit of both")
    assert not page.by("pick-hint").is_visible()
    # The way that a line flows.
    row = page.js("() => cadgraph.store.content.network.lines.findIndex(line => line.flow === 'forward')")
    before = page.content["network"]["lines"][row]
    page.by("tab-network").click()
    page.page.locator(f'[data-test="net-tree-line"][data-line="{before["tag"]}"]').click()
    page.by("net-flow-backward").click()

    # A line begins where what flows in it comes from.
    turned = (before["end"], before["start"], "forward")
    until(
        lambda: any((line["start"], line["end"], line["flow"]) == turned for line in page.content["network"]["lines"]),
        "the line flows the other way",
    )
    whats = [row["what"] for row in server.ask("/api/audit")[1]]
    assert [what for what in whats[:3] if "PSV 4711/a" in what] == whats[1:3]


def put(page, row):
    """Selects a part and clicks another label for it, the second one that is offered; which."""
    # Read before the click: a quick server's answer leaves nothing else to be guessed of a part that is corrected.
    name = page.parts["guesses"][row][1][1]
    page.js("row => cadgraph.store.select([row])", row)
    page.by("guess").nth(1).click()
    return name


def test_of_two_windows_the_slower_one_is_told_and_both_corrections_stay(page, server, window):
    parts = page.parts
    # Of different names: a correction follows to what looks alike and is called the same, whatever its shape.
    offered = {parts["name"][row]: row for row, guesses in enumerate(parts["guesses"]) if len(guesses) > 1}
    first, second, third = list(offered.values())[:3]
    with window(server.address) as other:
        other.ready()
        put(page, first)
        until(lambda: corrected(page) == 1 and other.version == page.version, "the other window follows")
        until(lambda: "another window" in other.text("toasts"), "it says so")
        assert labels(other) == labels(page)
        # What it sends now arrives after the first window has corrected something else.
        held = []
        other.page.route("**/api/edit", lambda route: held.append(route))
        name = put(other, second)
        until(lambda: other.page.wait_for_timeout(20) or held, "a correction on its way")
        put(page, third)
        until(lambda: corrected(page) == 2, "the first window is quicker")
        held[0].continue_()
        other.page.unroute("**/api/edit")
        until(lambda: "Another window was quicker" in other.text("toasts"), "the slower one is told")
        until(lambda: labels(other) == labels(page), "it shows what the first one did")
        assert settled(other, server)["n_edits"] == 2
        assert other.parts["name"][second] != name
        other.page.locator("[data-test=toast] button", has_text="Do mine as well").click()
        until(lambda: corrected(other) == 3, "its own as well")
        until(lambda: labels(page) == labels(other), "in both windows")
        assert page.parts["name"][second] == name
        assert [trouble for trouble in other.troubles if "409" not in trouble] == []


def test_what_could_not_be_sent_is_not_shown_as_corrected(page):
    begun = page.version
    page.context.set_offline(True)
    page.js("all => cadgraph.store.select([all.findIndex(one => one.length > 1)])", page.parts["guesses"])
    page.by("guess").nth(1).click()
    until(lambda: "does not answer" in page.text("toasts"), "the page says so")
    assert page.version == begun
    page.context.set_offline(False)
    page.by("guess").nth(1).click()
    until(lambda: page.version > begun, "corrected now")
    assert all("DISCONNECTED" in trouble for trouble in page.troubles)
    page.troubles.clear()


@pytest.mark.long
def test_twenty_answers_by_keys_are_kept_undone_redone_and_there_after_a_reload(page, server, folder):
    first, begun, past = labels(page), page.version, len(events_in(folder))
    page.press("r")
    page.until("() => cadgraph.store.shown.question")
    assert page.shown("leftTab") == "review"
    for turn in range(MANY):
        answer(page, "1" if turn % 3 else "2")
    # The page goes on at once; the server answers one after the other.
    until(lambda: page.version == begun + MANY, "all twenty confirmed")
    n_edits = settled(page, server)["n_edits"]
    assert n_edits >= MANY
    until(lambda: page.text("edit-count").startswith(f"{n_edits} corrections"), "the count in the bar")
    after = labels(page)
    assert sum(one != other for one, other in zip(first[2], after[2], strict=True)) >= MANY
    assert len(events_in(folder)) == past + MANY
    audit = server.ask("/api/audit")[1]
    assert {row["who"] for row in audit} == {"Ada"}
    page.by("tab-history").click()
    until(lambda: page.by("audit").count() == len(audit), "the list of what was corrected")
    undone = page.page.locator(".audit li.undone")
    already = undone.count()
    page.leave_fields()
    for _ in range(MANY):
        before = page.version
        page.press("Control+z")
        until(lambda before=before: page.version > before, "undone")
    assert labels(page) == first
    assert not settled(page, server)["can_undo"]
    until(lambda: undone.count() == already + MANY, "marks of what was undone")
    for _ in range(MANY):
        before = page.version
        page.press("Control+y")
        until(lambda before=before: page.version > before, "done again")
    assert labels(page) == after
    page.page.reload()
    page.ready()
    assert labels(page) == after
    assert page.text("edit-count").startswith(f"{n_edits} corrections")
