"""Draws every preset, and five seeds of the small ones side by side: docs/presets.png, docs/seeds.png."""

from __future__ import annotations

import argparse
import io
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from cadgraph._io.atomic import write_atomically
from cadgraph.draw.render.camera import direction_from_angles, frame
from cadgraph.draw.render.color import source_colors
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.scene import Scene
from cadplants import make
from cadplants.model.plant import Plant

PRESETS = ("skid", "riser", "tank", "pumps", "rack", "field")
SEEDS = range(5)
CELL, WIDE = (470, 330), (940, 560)  # px
TITLE = 22  # px
COLORS = 224


def picture(plant: Plant, size: tuple[int, int]) -> Image.Image:
    """The plant from the front, half above."""
    kept = [c for c in plant.components if c.name != "ground"]
    scene = Scene.from_meshes([(c.vertices, c.faces) for c in kept], None, [c.color for c in kept])
    renderer = Renderer(scene)
    look = Look(samples=4)
    camera = frame(renderer.points(), direction_from_angles(-1.05, 0.42), size, margin=0.05)
    return renderer.picture(camera, Paint(source_colors(scene)), look)


def sheet(cells: list[list[tuple[str, Image.Image]]]) -> Image.Image:
    """Pictures in rows, each under its title."""
    width = max(sum(image.width for _, image in row) for row in cells)
    height = sum(max(image.height for _, image in row) + TITLE for row in cells)
    result = Image.new("RGB", (width, height), "white")
    draw = ImageDraw.Draw(result)
    top = 0
    for row in cells:
        left = 0
        for title, image in row:
            result.paste(image, (left, top + TITLE))
            draw.text((left + image.width / 2, top + TITLE / 2), title, "#1f2933", ImageFont.load_default(15), "mm")
            left += image.width
        top += max(image.height for _, image in row) + TITLE
    return result


def save(image: Image.Image, path: Path) -> None:
    """Writes a PNG of few colours."""
    content = io.BytesIO()
    image.quantize(COLORS, dither=Image.Dither.NONE).save(content, "PNG", optimize=True)
    write_atomically(path, content.getvalue())


def main() -> None:
    """Draws what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=Path("docs"))
    parser.add_argument("--only", default="", help="a preset to draw in five seeds, as FOLDER/PRESET.png")
    only = parser.parse_args()
    if only.only:
        row = [(f"{only.only}, seed {seed}", picture(make(only.only, seed), CELL)) for seed in SEEDS]
        save(sheet([row]), only.folder / f"{only.only}.png")
        return
    sizes = {"rack": (940, 380), "field": WIDE}
    pictures = [(name, picture(make(name), sizes.get(name, CELL))) for name in PRESETS]
    save(sheet([pictures[:2], pictures[2:4], pictures[4:5], pictures[5:]]), only.folder / "presets.png")
    rows = [[(f"{name}, seed {s}", picture(make(name, s), (300, 220))) for s in SEEDS] for name in PRESETS[:5]]
    save(sheet(rows), only.folder / "seeds.png")


if __name__ == "__main__":
    main()
