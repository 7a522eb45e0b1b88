"""Draws the gallery of devices: every family, five draws each, with the parameters that they were built from.

``python tools/draw_devices.py`` writes docs/devices/; ``--kind valve`` only those pictures. The
draws differ in seed and nominal size; all are in one modelling style, coloured by what the parts are.
"""

from __future__ import annotations

import argparse
import io
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from PIL import Image

from cadgraph._io.atomic import write_atomically
from cadgraph.draw.render.camera import direction_from_angles, frame
from cadgraph.draw.render.color import source_colors
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.scene import Scene
from cadlab.markdown import table
from cadplants.model.family import Family
from cadplants.model.plant import Plant
from cadplants.presets.single_device import draw_parameters, make_device
from cadplants.presets.taste import ALL_FAMILIES

SEEDS = range(5)
CELL = (168, 150)  # px
STYLE = "mechanical"
QUALITY = 62  # of WebP
LOOK = Look(samples=3, sky_rays=2, floor=False, top="#ffffff", bottom="#ffffff")


def sizes(family: Family) -> list[int]:
    """The nominal size of each draw, from the least to the greatest."""
    last = len(family.sizes) - 1
    return [family.sizes[round(last * k / (len(SEEDS) - 1))] for k in SEEDS]


def picture(plant: Plant) -> Image.Image:
    """A device from the front, half above."""
    scene = Scene.from_meshes(
        [(c.vertices, c.faces) for c in plant.components], None, [c.color for c in plant.components]
    )
    renderer = Renderer(scene, threads=1)
    camera = frame(renderer.points(), direction_from_angles(-1.05, 0.42), CELL, margin=0.04)
    return renderer.picture(camera, Paint(source_colors(scene)), LOOK)


def strip(name: str) -> bytes:
    """The draws of a family side by side, as WebP."""
    family = ALL_FAMILIES[name]
    result = Image.new("RGB", (CELL[0] * len(SEEDS), CELL[1]), "white")
    for k, (seed, dn) in enumerate(zip(SEEDS, sizes(family), strict=True)):
        result.paste(picture(make_device(name, seed, STYLE, dn)), (k * CELL[0], 0))
    content = io.BytesIO()
    result.save(content, "WEBP", quality=QUALITY, method=6)
    return content.getvalue()


def parameters(family: Family) -> Iterable[str]:
    """The parameters of the draws as a table."""
    draws = zip(SEEDS, sizes(family), strict=True)
    drawn = [draw_parameters(family.name, seed, {"dn": dn}, STYLE) for seed, dn in draws]
    rows: dict[str, list[str]] = {}
    about: dict[str, tuple[str, str]] = {}
    for k, one in enumerate(drawn):
        for name, value, limits, what in one.rows():
            rows.setdefault(name, [""] * len(SEEDS))[k] = value
            about.setdefault(name, (limits, what))
    body = [[f"`{name}`", *values, *about[name]] for name, values in rows.items()]
    yield from table(["parameter", *(f"draw {k + 1}" for k in SEEDS), "can be", "what it is"], body)


def page(kind: str, families: Sequence[Family]) -> str:
    """The families of one kind."""
    lines = [f"# {kind}", "", "[All kinds](index.md)", ""]
    for family in families:
        doc = (getattr(getattr(family.build, "device", None), "__doc__", "") or "").split("\n")[0]
        lines += [f"## {family.name.split('/')[1]}", ""]
        lines += [*([doc, ""] if doc else []), f"![{family.name}]({file_name(family.name)})", ""]
        lines += [f"{family.group}, {family.place}, DN {', '.join(map(str, sizes(family)))}", ""]
        lines += [*parameters(family), ""]
    return "\n".join(lines).rstrip() + "\n"


def file_name(name: str) -> str:
    """Of the picture of a family."""
    return name.replace("/", "_").replace(" ", "_").replace("&", "and") + ".webp"


def index(kinds: dict[str, list[Family]]) -> str:
    """The page that names all kinds, by group."""
    groups: dict[str, list[str]] = {}
    for kind, families in kinds.items():
        groups.setdefault(families[0].group, []).append(f"[{kind}]({kind.replace(' ', '_')}.md) {len(families)}")
    total = sum(map(len, kinds.values()))
    lines = [
        "# Devices",
        "",
        f"{total} families of {len(kinds)} kinds, five draws each, in the modelling style `{STYLE}`.",
        "",
    ]
    lines += [
        "`cadgraph environment device FAMILY --set NAME=VALUE -o FILE` makes one; "
        "`python tools/draw_devices.py` made this.",
        "",
    ]
    for group, entries in sorted(groups.items()):
        lines += [f"**{group}**: " + " · ".join(entries), ""]
    return "\n".join(lines).rstrip() + "\n"


def main() -> None:
    """Draws what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="?", default=Path("docs/devices"))
    parser.add_argument("--kind", default="", help="only the pictures of families with this in their names")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    kinds: dict[str, list[Family]] = {}
    for name, family in sorted(ALL_FAMILIES.items()):
        kinds.setdefault(name.split("/")[0], []).append(family)
    names = [name for name in sorted(ALL_FAMILIES) if options.kind in name]
    with ProcessPoolExecutor(options.workers) as pool:
        for name, content in zip(names, pool.map(strip, names, chunksize=4), strict=True):
            write_atomically(options.folder / file_name(name), content)
    for kind, families in kinds.items():
        write_atomically(options.folder / f"{kind.replace(' ', '_')}.md", page(kind, families))
    write_atomically(options.folder / "index.md", index(kinds))


if __name__ == "__main__":
    main()
