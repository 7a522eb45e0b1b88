"""A server that is killed while somebody corrects, and started again in the same folder."""

import time

import pytest

import serving
from browsing import until

pytestmark = [pytest.mark.slow, pytest.mark.long]
NAMES = "() => { const p = cadgraph.store.content.parts; return [p.group, p.name] }"


def test_a_server_killed_amid_corrections_loses_none_that_the_page_showed(window, folder):
    with serving.served(folder) as first, window(first.address) as page:
        page.ready().press("r")
        page.until("() => cadgraph.store.shown.question")
        begun = page.version
        page.page.wait_for_timeout(600)
        end = time.monotonic() + 60
        while page.version < begun + 3:
            assert time.monotonic() < end
            page.press("2")
            page.page.wait_for_timeout(40)
        first.process.kill()
        first.process.wait()
        page.press("1")
        until(lambda: "does not answer" in page.text("toasts"), "the page says that the server is gone")
        assert "cadgraph view" in page.text("toasts"), "and what to do"
        assert "kept" in page.text("toasts") or "lost" in page.text("toasts")
        until(lambda: page.text("read-only") == "No server", "a sign that stays")
        assert page.by("undo").is_disabled()
        confirmed, n_edits, names = page.version - begun, page.js("() => cadgraph.store.state.n_edits"), page.js(NAMES)
        assert confirmed >= 3
        port = first.host.rpartition(":")[2]
        # The same port is answered by another server with another token, which the page has not.
        with serving.served(folder, "--port", port) as second:
            assert second.token != first.token
            kept = second.wait_until_ready()["n_edits"]
            until(lambda: "open the address that 'cadgraph view' printed" in page.text("toasts"), "where to go on")
            with window(second.address) as again:
                again.ready()
                assert "another window" not in again.text("toasts")
                shown = again.js(NAMES)
                assert kept >= n_edits, "what was under way may be there, too"
                if kept == n_edits:
                    assert shown == names
                assert again.page.locator("[data-test=edit-count]").inner_text().startswith(f"{kept} correction")
                again.press("r")
                again.until("() => cadgraph.store.shown.question")
                before = again.version
                again.page.wait_for_timeout(600)
                again.press("1")
                until(lambda: again.version > before, "it goes on")
                assert again.troubles == []
