"""Draws the contact sheet of docs/lvlm.md: ``python benchmarks/_contact_sheet.py -o docs/lvlm_parts.jpg``.

Forty parts of a generated plant, one of each name as far as there are so many; for each the three pairs of pictures
that a model is shown, the question's figures, and the truth.
"""

from __future__ import annotations

import argparse
import io
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from cadgraph.labelers.lvlm.gallery import Gallery
from cadgraph.labelers.lvlm.prompt import size_text
from cadgraph.labelers.lvlm.question_groups import find_question_groups
from cadgraph.model.parts import Parts
from cadgraph.pipeline import analyse
from cadplants import make
from cadplants.truth_writer import truth_of

SIDE = 150  # px of one picture; a model sees 512
HEAD = 34
COLUMNS = 2
MOST_BYTES = 1_000_000


def chosen(parts: Parts, names: Sequence[str], count: int) -> list[tuple[int, int]]:
    """Parts of as many names as possible, each with how many there are of it."""
    first: dict[str, tuple[int, int]] = {}
    rest: list[tuple[int, int]] = []
    for kind in sorted(find_question_groups(parts), key=lambda kind: -len(kind.parts)):
        part = kind.parts[len(kind.parts) // 2]
        if names[part] in first:
            rest.append((part, len(kind.parts)))
        else:
            first[names[part]] = part, len(kind.parts)
    both = [*(first[name] for name in sorted(first)), *rest]
    if len(first) > count:
        keep = np.linspace(0, len(first) - 1, count).round().astype(int)
        return [both[i] for i in keep]
    return both[:count]


def tile(gallery: Gallery, parts: Parts, part: int, repeats: int, truth: str) -> Image.Image:
    image = Image.new("RGB", (6 * SIDE, SIDE + HEAD), "white")
    draw = ImageDraw.Draw(image)
    extents = " x ".join(size_text(float(e)) for e in parts.properties.obb_extents[part])
    views = gallery.views(part)
    notes = [
        " ".join(
            [f"{view.span:.2g} m"] + ["section"] * view.section + [f"cutaway of {len(view.hidden)}"] * bool(view.hidden)
        )
        for view in views
    ]
    draw.text((4, 2), f"{truth}", font=ImageFont.load_default(13), fill=(150, 0, 90))
    draw.text(
        (4, 18), f"What is the marked part? {extents}; {repeats} times", font=ImageFont.load_default(11), fill="black"
    )
    for i, note in enumerate(notes):
        draw.text((2 * i * SIDE + 2 * SIDE - 4, 4), note, font=ImageFont.load_default(10), fill="grey", anchor="ra")
    for i, picture in enumerate(gallery.pictures(part)):
        with Image.open(io.BytesIO(picture.draw())) as shown:
            image.paste(shown.resize((SIDE, SIDE), Image.Resampling.LANCZOS), (i * SIDE, HEAD))
    draw.rectangle((0, 0, 6 * SIDE - 1, SIDE + HEAD - 1), outline=(205, 210, 216))
    return image


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", "-o", type=Path, default=Path("lvlm_parts.jpg"))
    parser.add_argument("--preset", default="field")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=40)
    options = parser.parse_args()
    plant = make(options.preset, options.seed)
    parts = analyse(plant.scene()).parts
    named = {mesh["mesh"]: (mesh["group"], mesh["name"]) for mesh in truth_of(plant)["meshes"]}
    truth = [named[path] for path in parts.scene.paths]
    gallery = Gallery(parts.scene)
    picked = chosen(parts, [name for _, name in truth], options.count)
    with ThreadPoolExecutor(2) as pool:
        tiles = list(pool.map(lambda each: tile(gallery, parts, each[0], each[1], ": ".join(truth[each[0]])), picked))
    rows = -(-len(tiles) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * 6 * SIDE, rows * (SIDE + HEAD)), "white")
    for i, each in enumerate(tiles):
        sheet.paste(each, (i % COLUMNS * 6 * SIDE, i // COLUMNS * (SIDE + HEAD)))
    for quality in range(90, 30, -4):
        buffer = io.BytesIO()
        sheet.save(buffer, "JPEG", quality=quality, optimize=True)
        if buffer.tell() < MOST_BYTES:
            break
    options.output.write_bytes(buffer.getvalue())
    print(f"{options.output}: {len(tiles)} parts, {buffer.tell() / 1000:.0f} kB")


if __name__ == "__main__":
    main()
