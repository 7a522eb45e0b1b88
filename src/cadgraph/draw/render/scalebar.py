"""A scale bar in the corner of a picture."""

from __future__ import annotations

import functools
import math

from PIL import Image, ImageDraw, ImageFont

__all__ = ["draw_scale_bar", "round_length"]

_SHARE = 0.3  # of the picture's width that the bar takes at most
_INK = (20, 24, 30)


def round_length(limit: float) -> float:
    """The greatest of 1, 2, 5 times a power of ten that is at most ``limit`` [m].

    Raises:
        ValueError: the limit is not positive and finite.
    """
    if not (math.isfinite(limit) and limit > 0):
        raise ValueError(f"a scale bar can't be {limit} m long; give a positive length")
    power = 10.0 ** math.floor(math.log10(limit) + 1e-9)
    factor = max(f for f in (1, 2, 5) if f * power <= limit * (1 + 1e-9) or f == 1)
    return factor * power


def draw_scale_bar(image: Image.Image, pixel: float) -> float:
    """Draws a bar and its length into the lower left corner.

    Args:
        image: RGB; changed.
        pixel: size of a pixel where the bar counts [m].

    Returns:
        The length that the bar stands for [m].
    """
    width, height = image.size
    length = round_length(_SHARE * width * pixel)
    across = length / pixel
    draw = ImageDraw.Draw(image)
    unit = max(1, round(height / 256))
    left, base = 6 * unit, height - 6 * unit
    text = length_text(length)
    font = _font(max(9, round(height / 30)))
    box = (left - 3 * unit, base - 11 * unit, left + max(across, font.getlength(text)) + 3 * unit, base + 3 * unit)
    draw.rectangle(box, (255, 255, 255))
    draw.rectangle((left, base - unit, left + across, base + unit - 1), _INK)
    for x in (left, left + across):
        draw.rectangle((x - unit / 2, base - 2 * unit, x + unit / 2, base + 2 * unit - 1), _INK)
    draw.text((left, base - 2.5 * unit), text, font=font, fill=_INK, anchor="ls")
    return length


def length_text(length: float) -> str:
    """A length as people say it: ``"5 mm"``, ``"20 cm"``, ``"2 m"``."""
    for unit, size in (("m", 1.0), ("cm", 0.01), ("mm", 0.001)):
        if length >= size * (1 - 1e-9):
            return f"{length / size:.3g} {unit}"
    return f"{length / 1e-3:.1g} mm"


@functools.cache
def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)
