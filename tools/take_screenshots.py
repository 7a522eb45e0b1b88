"""Takes the pictures of the viewer in docs/: the demo and the preset ``field``, in a real browser.

python tools/take_screenshots.py [--only NAME] [--field FOLDER]

Needs a Chromium ('make browser'). Building ``field`` takes a minute; ``--field`` names a folder of its results instead.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.run import run
from cadplants import make
from cadplants.writers import write_plant

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from browsing import MISSING, Viewer, browsing, find_browser, until  # noqa: E402
from serving import served  # noqa: E402

SIZE = {"width": 1280, "height": 800}
MOST = 250_000  # bytes of a picture


def select(viewer: Viewer, tag: str) -> None:
    """Selects a unit by its tag."""
    viewer.js("t => cadgraph.store.selectPlace(cadgraph.store.content.network.units.find(u => u.tag === t).id)", tag)


def schematic(viewer: Viewer) -> None:
    """Shows the schematic, whole."""
    viewer.press("d")
    until(viewer.page.locator("svg.schematic [data-id]").count, "the schematic")
    viewer.by("sheet-fit").click()
    viewer.leave_fields()


def turn(viewer: Viewer, left: int, up: int, nearer: int = 0) -> None:
    """Turns the plant by steps of the arrow keys."""
    viewer.js("() => document.querySelector('[data-test=canvas]').focus()")
    viewer.press(
        *["ArrowLeft" if left > 0 else "ArrowRight"] * abs(left), *["ArrowUp" if up > 0 else "ArrowDown"] * abs(up)
    )
    viewer.press(*["+"] * nearer)
    viewer.leave_fields()


def ask(viewer: Viewer, subject: str) -> None:
    """Opens the review queue at a question of those that come next."""
    viewer.press("r")
    until(viewer.by("question").count, "a question")
    viewer.by("next-question").filter(has_text=subject).first.click()
    until(lambda: subject in viewer.text("question"), f"the question about {subject}")
    viewer.leave_fields()


def whole(viewer: Viewer) -> None:
    """The review queue, the plant with lines and tags, the inspector, and the schematic."""
    schematic(viewer)
    ask(viewer, "Valve body of V-008")
    viewer.by("legend-fold").click()
    viewer.press("0")
    turn(viewer, 0, 0, 2)


def review(viewer: Viewer) -> None:
    """A question with what it is about, close by."""
    ask(viewer, "Valve body of V-008")
    viewer.press("f")


def isolate(viewer: Viewer) -> None:
    """What is to be closed to work at a pump, in the plant and in the schematic."""
    schematic(viewer)
    select(viewer, "P-001")
    viewer.press("v")
    until(viewer.by("net-close-tick").count, "valves to close")
    viewer.press("0")


def correct(viewer: Viewer) -> None:
    """A part that nobody was sure of, said by hand: what it is now, with its repeat, and the way back."""
    viewer.js(
        """() => {
          const { parts, network } = cadgraph.store.content;
          const unit = network.units.find(unit => unit.tag === 'V-008');
          const row = unit.parts.reduce((a, b) => (parts.area[a] > parts.area[b] ? a : b));
          cadgraph.store.select([row]);
          cadgraph.view.flyTo([row]);
        }"""
    )
    viewer.by("guess").first.click()
    until(viewer.by("toast").count, "an answer")
    viewer.by("tab-history").click()
    until(viewer.by("audit").count, "the list of what was corrected")
    viewer.leave_fields()
    viewer.by("toast").hover()  # so it stays


def field(viewer: Viewer) -> None:
    """A plant of 8,000 meshes as it is first seen."""
    turn(viewer, 0, 0, 1)


def dark(viewer: Viewer) -> None:
    """A part of it, dark, with the table of its units."""
    viewer.page.emulate_media(color_scheme="dark")
    viewer.by("legend-fold").click()
    viewer.press("b")
    viewer.by("table-units").click()
    viewer.leave_fields()
    turn(viewer, 3, 0, 4)


PICTURES: dict[str, tuple[str, Callable[[Viewer], None]]] = {
    "viewer": ("demo", whole),
    "viewer_review": ("demo", review),
    "viewer_isolate": ("demo", isolate),
    "viewer_corrected": ("demo", correct),
    "viewer_field": ("field", field),
    "viewer_dark": ("field", dark),
}
"""Name, plant, and what is done before the picture is taken; those that correct come last of their plant."""


@contextmanager
def plant(name: str, made: Path | None) -> Iterator[str]:
    """The address of a server of a plant, while it runs."""
    with tempfile.TemporaryDirectory() as place:
        folder = made or Path(place) / "out"
        if made is None:
            scene = DEMO_SCENE if name == "demo" else Path(place) / "field.usdc"
            if name == "field":
                write_plant(make("field"), scene)
            run(scene, folder, report=False)
        with served(folder, "--who", "Ada") as server:
            server.wait_until_ready()
            yield server.address


def settle(viewer: Viewer) -> None:
    """Waits until the picture is finished, and tags have found their places."""
    seen, same = -1, 0
    while same < 4:
        viewer.rest().page.wait_for_timeout(250)
        now = viewer.page.locator("[data-test=net-tags] button").count()
        seen, same = now, same + 1 if now == seen else 0


def take(name: str, address: str, work: Callable[[Viewer], None]) -> None:
    """Takes one picture, as good as fits into the size that pages may have."""
    with browsing() as browser:
        viewer = Viewer(browser.new_context(viewport=SIZE), address)
        viewer.ready().rest()
        work(viewer)
        settle(viewer)
        for quality in (88, 80, 70, 60, 50):
            data = viewer.page.screenshot(type="jpeg", quality=quality, timeout=60_000)
            if len(data) <= MOST:
                break
        write_atomically(ROOT / "docs" / f"{name}.jpg", data)
        for line in (f"docs/{name}.jpg: {len(data) / 1000:.0f} kB, quality {quality}", *viewer.troubles):
            sys.stdout.write(f"{line}\n")


def main() -> int:
    """Takes the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=list(PICTURES), help="this picture alone")
    parser.add_argument("--field", type=Path, help="folder of results of the preset field")
    given = parser.parse_args()
    if find_browser() is None:
        sys.exit(MISSING)
    for name in ("demo", "field"):
        wanted = {n: work for n, (of, work) in PICTURES.items() if of == name and given.only in (None, n)}
        if wanted:
            with plant(name, given.field if name == "field" else None) as address:
                for picture, work in wanted.items():
                    take(picture, address, work)
    return 0


if __name__ == "__main__":
    sys.exit(main())
