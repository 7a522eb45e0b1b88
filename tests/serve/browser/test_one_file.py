"""``cadgraph export --to html``: one file that opens from disk, to look at only."""

import numpy as np
import pytest

from browsing import until
from cadgraph.export.html import write_html
from cadgraph.model.graph import SceneGraph
from cadgraph.session.demo import DEMO_SCENE

pytestmark = pytest.mark.slow


def test_the_file_opens_from_disk_with_everything_to_see_and_nothing_to_correct(window, built, tmp_path):
    write_html(SceneGraph.load(built), DEMO_SCENE, tmp_path / "plant.html")
    with window((tmp_path / "plant.html").as_uri()) as page:
        page.until("() => window.cadgraph?.view")
        picture = page.picture(page.box("canvas"))
        assert len(np.unique(picture.reshape(-1, 3) // 16, axis=0)) > 60, "a plant in colours"
        assert {url.partition(":")[0] for url in page.requests} <= {"file", "data", "blob"}
        assert page.by("view-only").is_visible()
        for name in ("tab-review", "tab-history"):
            assert not page.by(name).is_visible()
        for name in ("undo", "redo", "review-count", "edit-count"):
            assert page.by(name).count() == 0
        at = page.look_at(page.content["network"]["units"][9]["parts"][0])
        page.press("t", "n")
        page.drawn()
        page.page.mouse.click(*at)
        until(lambda: page.shown("selection"), "a selected part")
        for name in (
            "guess",
            "other-label",
            "forget",
            "merge",
            "split",
            "ground",
            "edit-tag",
            "net-isolate",
            "net-cut",
        ):
            assert page.by(name).count() == 0
        page.press("l", "Control+z", "1")
        assert page.by("picker-input").count() == 0
        page.press("d")
        until(page.page.locator("svg.schematic [data-id]").count, "the schematic")
        assert page.troubles == []
