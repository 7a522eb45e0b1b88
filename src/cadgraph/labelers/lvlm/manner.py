"""What a server understands, and a question put so that it does: form, roles, pictures in number and size."""

from __future__ import annotations

import base64
import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from cadgraph.labelers.lvlm.gallery import Picture, to_jpeg
from cadgraph.labelers.lvlm.reply import Question

__all__ = ["GAP", "LEVELS", "Manner", "adapted", "blind", "body_of", "encoded", "sent", "too_long"]

LEVELS: tuple[tuple[int | None, float], ...] = ((None, 1.0), (384, 1.0), (256, 1.0), (256, 0.5), (256, 0.0))
"""What is sent where a context is too small, one after the other: greatest side of a picture [px], and the share of the
pictures, the first ones; at least one."""

GAP = 6
"""Between the pictures of a sheet [px]."""


@dataclass(frozen=True)
class Manner:
    """What a server understands; from a profile, then found out by asking.

    Args:
        schema: ``json_schema``, ``json_object`` or ``none``: how it can be held to a form.
        limit: what it calls the greatest length of an answer.
        temperature: whether it may be set.
        system: whether a message may come from the system; else its text goes before the question.
        pictures: of a message at most; what is more is tiled into sheets. None: any number.
        side: greatest side of a picture [px]; None: any.
        level: which of ``LEVELS`` the context leaves room for.
    """

    schema: str = "json_schema"
    limit: str = "max_completion_tokens"
    temperature: bool = True
    system: bool = True
    pictures: int | None = None
    side: int | None = None
    level: int = 0


_CONTEXT = re.compile(
    r"context.{0,3}(length|size|window)|exceed_context|too many (input )?tokens|prompt is too long|n_ctx|"
    r"maximum model length|max_model_len|request entity too large|payload too large"
)
_BLIND = re.compile(
    r"image input is not supported|does(n't| not) support (image|vision|multimodal)|not a multimodal model|mmproj|"
    r"at most 0 image|unknown variant `?image_url|image_url.{0,20} (is )?not supported"
)
_MANY = re.compile(
    r"at most (\d+) image|multiple images|(only|just) (one|1|a single) image|more than (one|1) image|"
    r"limit.mm.per.prompt|too many images|single image"
)
_SYSTEM = re.compile(r"system.{0,12}(role|message|prompt)|roles? .{0,20}system|roles must alternate")
_FORM = re.compile(r"response_format|json_schema|json_object|schema|structured|guided|grammar")


def sent(level: int, n: int) -> tuple[int | None, int]:
    """Greatest side of the pictures that are sent at a level [px], None for any, and how many of ``n`` they are."""
    side, share = LEVELS[level]
    return side, max(1, math.ceil(share * n))


def blind(message: str) -> bool:
    """Whether a server says that its model sees no pictures."""
    return _BLIND.search(message.lower()) is not None


def too_long(message: str) -> bool:
    """Whether a server says that a question is longer than its context."""
    return _CONTEXT.search(message.lower()) is not None


def adapted(tried: Manner, message: str, settled: bool) -> Manner | None:
    """Another way of asking after a server refused one; None where none is worth a try.

    Args:
        tried: that it refused.
        message: in which it did.
        settled: whether it understood this way before, so that the form can't be what it minds.
    """
    words = message.lower()
    many = _MANY.search(words)
    other = tried
    if too_long(words):
        # Also names 'max_tokens', often.
        other = replace(tried, level=min(tried.level + 1, len(LEVELS) - 1))
    elif many is not None:
        most = max(1, int(many.group(1) or 1))
        other = replace(tried, pictures=most if tried.pictures is None or most < tried.pictures else 1)
    elif tried.system and _SYSTEM.search(words):
        other = replace(tried, system=False)
    elif "max_completion_tokens" in words or "max_tokens" in words:
        other = replace(tried, limit="max_tokens" if tried.limit != "max_tokens" else "max_completion_tokens")
    elif "temperature" in words and tried.temperature:
        other = replace(tried, temperature=False)
    elif tried.schema != "none" and (_FORM.search(words) or not settled):
        other = replace(tried, schema="json_object" if tried.schema == "json_schema" else "none")
    return None if other == tried else other


def body_of(
    question: Question,
    pictures: list[dict[str, Any]],
    model: str,
    manner: Manner,
    max_tokens: int,
    temperature: float | None,
) -> dict[str, Any]:
    """The body of a request to ``/chat/completions``, as plain values."""
    text = question.text if manner.system else f"{question.system}\n\n{question.text}"
    asked = {"role": "user", "content": [{"type": "text", "text": text}, *pictures]}
    body: dict[str, Any] = {
        "model": model,
        "messages": [{"role": "system", "content": question.system}, asked] if manner.system else [asked],
        manner.limit: max_tokens,
    }
    if temperature is not None and manner.temperature:
        body["temperature"] = temperature
    if manner.schema == "json_schema":
        form = {"name": "answer", "strict": True, "schema": question.schema}
        body["response_format"] = {"type": "json_schema", "json_schema": form}
    elif manner.schema == "json_object":
        body["response_format"] = {"type": "json_object"}
    return body


def encoded(question: Question, detail: str, manner: Manner | None = None) -> list[dict[str, Any]]:
    """The pictures of a question, each after its caption, as parts of a message."""
    manner = manner or Manner()
    pictures = question.pictures()
    side, n_sent = sent(manner.level, len(pictures))
    side = min((limit for limit in (side, manner.side) if limit is not None), default=None)
    shown = pictures[:n_sent]
    parts: list[dict[str, Any]] = []
    if len(shown) < len(pictures):
        parts.append({"type": "text", "text": f"Only the first {len(shown)} of {len(pictures)} pictures follow."})
    if manner.pictures is None or len(shown) <= manner.pictures:
        for picture in shown:
            parts += _part(picture.caption, _shrunk(picture.draw(), side), detail)
        return parts
    per = math.ceil(len(shown) / manner.pictures)
    for first in range(0, len(shown), per):
        group = shown[first : first + per]
        captions = [f"{first + i + 1}: {picture.caption.rstrip(':')}" for i, picture in enumerate(group)]
        told = "One picture with several views, each with its number in the corner. " + "; ".join(captions) + ":"
        parts += _part(told, _sheet(group, first + 1, side, manner.side), detail)
    return parts


def _part(caption: str, jpeg: bytes, detail: str) -> list[dict[str, Any]]:
    url = "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")
    return [{"type": "text", "text": caption}, {"type": "image_url", "image_url": {"url": url, "detail": detail}}]


def _shrunk(jpeg: bytes, side: int | None) -> bytes:
    """A picture with no side greater than a limit [px]; the same bytes where it has none."""
    from PIL import Image

    if side is None:
        return jpeg
    with Image.open(io.BytesIO(jpeg)) as image:
        if max(image.size) <= side:
            return jpeg
        image.thumbnail((side, side), Image.Resampling.LANCZOS)
        return to_jpeg(image)


def _sheet(pictures: Sequence[Picture], first: int, side: int | None, most: int | None) -> bytes:
    """Several pictures as one, with their numbers.

    Args:
        pictures: one or more.
        first: number of the first.
        side: greatest side of each [px], or None.
        most: greatest side of all together [px], or None.
    """
    from PIL import Image, ImageDraw, ImageFont

    drawn = [Image.open(io.BytesIO(picture.draw())).convert("RGB") for picture in pictures]
    columns = math.ceil(math.sqrt(len(drawn)))
    rows = math.ceil(len(drawn) / columns)
    tile = max(max(image.size) for image in drawn)
    tile = tile if side is None else min(tile, side)
    tile = tile if most is None else min(tile, (most - (columns - 1) * GAP) // columns)
    step = tile + GAP
    sheet = Image.new("RGB", (columns * step - GAP, rows * step - GAP), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(max(14, tile // 12))
    for i, image in enumerate(drawn):
        image.thumbnail((tile, tile), Image.Resampling.LANCZOS)
        corner = (i % columns * step, i // columns * step)
        sheet.paste(image, corner)
        box = pen.textbbox((corner[0] + 6, corner[1] + 4), str(first + i), font=font)
        pen.rectangle((box[0] - 5, box[1] - 4, box[2] + 5, box[3] + 4), fill="white", outline="black")
        pen.text((corner[0] + 6, corner[1] + 4), str(first + i), fill="black", font=font)
    return to_jpeg(sheet)
