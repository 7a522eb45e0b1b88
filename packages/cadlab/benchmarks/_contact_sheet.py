"""Draws the sheet of questions of docs/lvlm.md: ``python benchmarks/_contact_sheet.py -o docs/lvlm_questions.jpg``.

Twelve questions about a generated plant in a modelling style that no labeler was trained on: for each the six pictures
that a model is shown with their captions, the figures of its text, and the truth, which the model is not told.
"""

from __future__ import annotations

import argparse
import io
import textwrap
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from cadgraph.labelers.lvlm.gallery import Gallery
from cadgraph.labelers.lvlm.prompt import size_text
from cadgraph.labelers.lvlm.question_groups import QuestionGroup, find_question_groups
from cadgraph.model.parts import Parts
from cadgraph.pipeline import analyse
from cadplants import make
from cadplants.truth.truth_writer import truth_of

SIDE, GAP = 216, 6  # px of one picture, and between two; a model sees 512
HEAD, CAPTION = 42, 54
MOST_BYTES = 690_000
INK, TRUTH, RULE = (30, 34, 40), (190, 0, 20), (205, 210, 216)


def chosen(parts: Parts, truth: Sequence[tuple[str, str]], count: int) -> list[QuestionGroup]:
    """Kinds of as many groups as possible, then of as many names: one of each group in turn."""
    names: dict[str, dict[str, QuestionGroup]] = {}
    for kind in sorted(find_question_groups(parts), key=lambda kind: (-len(kind.parts), kind.parts[0])):
        group, name = truth[kind.parts[0]]
        names.setdefault(group, {}).setdefault(name, kind)
    rows = [[kinds[name] for name in kinds] for _, kinds in sorted(names.items())]
    picked = [row[turn] for turn in range(max(map(len, rows))) for row in rows if turn < len(row)][:count]
    return sorted(picked, key=lambda kind: (*truth[kind.parts[0]], kind.parts[0]))


def question(gallery: Gallery, parts: Parts, kind: QuestionGroup, truth: tuple[str, str]) -> Image.Image:
    """One question: a line of figures, six pictures and their captions."""
    part = kind.parts[len(kind.parts) // 2]
    image = Image.new("RGB", (6 * SIDE + 5 * GAP, HEAD + SIDE + CAPTION), "white")
    draw = ImageDraw.Draw(image)
    box = " x ".join(size_text(float(e)) for e in parts.properties.obb_extents[part])
    height = size_text(float(parts.properties.aabb[part, 1, 2] - parts.properties.aabb[part, 0, 2]))
    figures = f"What is the marked part? It is {gallery.mark.name}. Box along its own axes: {box}; height: {height}."
    draw.text((4, 5), figures, font=ImageFont.load_default(15), fill=INK)
    repeats = len(kind.parts)
    asked = f"{truth[0]}: {truth[1]}" + f"  (asked once for {repeats})" * (repeats > 1)
    draw.text((4, 23), asked, font=ImageFont.load_default(15), fill=TRUTH)
    for i, picture in enumerate(gallery.pictures(part)):
        left = i * (SIDE + GAP)
        with Image.open(io.BytesIO(picture.draw())) as shown:
            image.paste(shown.resize((SIDE, SIDE), Image.Resampling.LANCZOS), (left, HEAD))
        caption = "\n".join(textwrap.wrap(picture.caption.rstrip(":"), 41)[:4])
        draw.text((left + 2, HEAD + SIDE + 2), caption, font=ImageFont.load_default(11), fill=INK, spacing=1)
    draw.line((0, image.height - 1, image.width, image.height - 1), fill=RULE)
    return image


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", "-o", type=Path, default=Path("lvlm_questions.jpg"))
    parser.add_argument("--preset", default="field")
    parser.add_argument("--style", default="mechanical", help="a published style; '' for the preset's own")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=12)
    options = parser.parse_args()
    plant = make(options.preset, options.seed, options.style or None)
    parts = analyse(plant.scene()).parts
    named = {mesh["mesh"]: (mesh["group"], mesh["name"]) for mesh in truth_of(plant)["meshes"]}
    truth = [named[path] for path in parts.scene.paths]
    gallery = Gallery(parts.scene)
    picked = chosen(parts, truth, options.count)
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda kind: question(gallery, parts, kind, truth[kind.parts[0]]), picked))
    sheet = Image.new("RGB", (rows[0].width, sum(row.height for row in rows)), "white")
    for i, row in enumerate(rows):
        sheet.paste(row, (0, sum(before.height for before in rows[:i])))
    for quality in range(88, 30, -4):
        buffer = io.BytesIO()
        sheet.save(buffer, "JPEG", quality=quality, optimize=True)
        if buffer.tell() < MOST_BYTES:
            break
    options.output.write_bytes(buffer.getvalue())
    print(f"{options.output}: {len(rows)} questions, quality {quality}, {buffer.tell() / 1000:.0f} kB")


if __name__ == "__main__":
    main()
