"""A real browser for tests and pictures: which one, how it is started, and the viewer's page in it."""

import os
import shutil
import time
from contextlib import contextmanager
from io import BytesIO

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge")
FLAGS = (
    "--use-angle=swiftshader",  # pictures by the processor alone, the same on every machine
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-dev-shm-usage",  # small in containers
)
MISSING = "no browser was found: 'make browser' installs Chromium, or CADGRAPH_BROWSER names one"
PATIENCE = 60  # s, on a machine that is busy with other things, too


def find_browser():
    """The path of a Chromium of the system, or the one that ``CADGRAPH_BROWSER`` names; None where there is none."""
    named = os.environ.get("CADGRAPH_BROWSER")
    if named:
        return shutil.which(named)
    return next((found for name in NAMES if (found := shutil.which(name))), None)


@contextmanager
def browsing():
    """A browser without a window."""
    from playwright.sync_api import sync_playwright

    # Chromium's own sandbox refuses to be run by root.
    flags = [*FLAGS, *(["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else [])]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_browser(), args=flags)
        try:
            yield browser
        finally:
            browser.close()


def until(test, what, patience=PATIENCE):
    """What a test gives as soon as it is true of something; an error that says what did not come true."""
    end = time.monotonic() + patience
    while not (found := test()):
        assert time.monotonic() < end, f"waited in vain for: {what}"
        time.sleep(0.02)
    return found


class Viewer:
    """The page of the viewer, and all that went wrong in it.

    Args:
        context: of a browser.
        address: of the page; opened at once.
    """

    def __init__(self, context, address):
        self.context = context
        self.address = address
        self.page = context.new_page()
        self.troubles = []
        self.requests = []
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.troubles.append(f"error: {error}"))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(address)

    def _heard(self, message):
        # A browser complains of refused policies here, too.
        if message.type in ("error", "warning"):
            self.troubles.append(f"{message.type}: {message.text}")

    def js(self, function, argument=None):
        """What a function gives in the page."""
        return self.page.evaluate(function, argument)

    def until(self, function, argument=None, patience=PATIENCE):
        """Waits until a function gives something true in the page."""
        return until(lambda: self.js(function, argument), f"{function} of {argument!r}", patience)

    def drawn(self):
        """Waits until a frame shows what was changed just now; picks go by what was drawn."""
        self.js(
            "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 20))))"
        )
        return self

    def rest(self):
        """Waits until the picture is finished, and the tags have found their places."""
        self.drawn()
        self.until("() => cadgraph.view?.isAtRest")
        return self

    def ready(self):
        """Waits until the plant is there and can be corrected."""
        self.until(
            """() => {
              const { content, state } = window.cadgraph?.store ?? {};
              return state?.status === 'ready' && content?.version === state.version;
            }"""
        )
        return self

    @property
    def content(self):
        return self.js("() => cadgraph.store.content")

    @property
    def parts(self):
        return self.js("() => cadgraph.store.content.parts")

    @property
    def units(self):
        """The units by their tags."""
        return {unit["tag"]: unit for unit in self.js("() => cadgraph.store.content.network.units")}

    @property
    def version(self):
        return self.js("() => cadgraph.store.content.version")

    def shown(self, key):
        """Something of what is shown; sets as lists."""
        return self.js("k => { const v = cadgraph.store.shown[k]; return v instanceof Set ? [...v] : v }", key)

    def has(self, key, value, **more):
        """Waits until what is shown has a value."""
        return until(lambda: self.shown(key) == value, f"{key} = {value!r}", **more)

    def by(self, name, within=""):
        """The elements of a name for tests."""
        return self.page.locator(f'{within} [data-test="{name}"]')

    def text(self, name):
        """The text of the first element of a name; "" where there is none."""
        found = self.by(name)
        return found.first.inner_text() if found.count() else ""

    def press(self, *keys):
        """Presses keys, one after the other."""
        for key in keys:
            self.page.keyboard.press(key)
        return self

    def gone(self, selector):
        """Waits until there is no such element."""
        until(lambda: not self.page.locator(selector).count(), f"no {selector}")

    def leave_fields(self):
        """Takes the keyboard out of any field."""
        self.js("() => document.activeElement?.blur()")
        return self

    def look_at(self, row):
        """Brings a part into the middle of the picture and says where its own middle is on the page."""
        self.js("row => cadgraph.view.flyTo([row])", row)
        self.drawn()
        return self.place_of(row)

    def place_of(self, row):
        """Where the middle of a part is on the page [px]."""
        at = self.js(
            """row => {
              const at = cadgraph.view.project(cadgraph.store.content.parts.center.slice(3 * row, 3 * row + 3));
              const box = document.querySelector('[data-test=canvas]').getBoundingClientRect();
              return [box.left + at.x, box.top + at.y];
            }""",
            row,
        )
        return tuple(at)

    def picture(self, clip=None):
        """What is seen when the picture is finished, as ``(height, width, 3)`` bytes."""
        import numpy as np
        from PIL import Image

        self.rest()
        data = self.page.screenshot(clip=clip, timeout=60_000)
        with Image.open(BytesIO(data)) as image:
            return np.asarray(image.convert("RGB"))

    def box(self, name):
        """Where an element is, as a clip for pictures."""
        return self.by(name).first.bounding_box()

    def close(self):
        self.page.close()
