import os
from contextlib import contextmanager

import pytest

import browsing
import serving
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.run import run

SIZE = {"width": 1280, "height": 720}


@pytest.fixture(scope="session", autouse=True)
def _can_be_run():
    if not hasattr(os, "fork"):
        pytest.skip("servers are ended as on POSIX systems")
    pytest.importorskip("playwright", reason="pip install playwright (it is in the extra 'dev')")
    if browsing.find_browser() is None:
        pytest.skip(browsing.MISSING)


@pytest.fixture(scope="module")
def browser(_can_be_run):
    with browsing.browsing() as browser:
        yield browser


@pytest.fixture(scope="session")
def built(_can_be_run, tmp_path_factory):
    """A folder of results of the demo plant; for copying."""
    folder = tmp_path_factory.mktemp("demo") / "out"
    run(DEMO_SCENE, folder, report=False)
    return folder


@pytest.fixture(scope="module")
def folder(built, tmp_path_factory):
    """A copy of it, which the module's server works in."""
    return serving.copy_of(built, tmp_path_factory.mktemp("served") / "plant")


@pytest.fixture(scope="module")
def server(folder):
    with serving.served(folder, "--who", "Ada") as server:
        yield server


@pytest.fixture(scope="module")
def window(browser):
    """Opens pages, each in a browser of its own that knows nothing of the others."""

    @contextmanager
    def opened(address, prepare=lambda context: None):
        context = browser.new_context(viewport=SIZE)
        try:
            prepare(context)
            yield browsing.Viewer(context, address)
        finally:
            context.close()

    return opened


@pytest.fixture(scope="module")
def shared(window, server):
    """A page that the tests of a module use one after the other."""
    with window(server.address) as page:
        yield page.ready()


@pytest.fixture
def page(shared):
    """The shared page as it was at first, which has nothing to complain about at the end."""
    shared.press("Escape")
    shared.leave_fields()
    shared.js(
        """() => cadgraph.store.set({
          selection: [], place: null, hidden: new Set(), isolated: null, ghost: true, marks: null, section: null,
          explode: null, colorBy: 'group', leftTab: 'find', schematic: false, table: false })"""
    )
    shared.until("() => { cadgraph.view?.home(); return !!cadgraph.view }")
    yield shared
    assert shared.troubles == []
