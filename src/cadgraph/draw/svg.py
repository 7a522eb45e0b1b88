"""SVG as text: elements whose attributes and contents are escaped where they are not SVG themselves."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from cadgraph._io.text import xml_text

__all__ = ["Svg", "element", "joined", "number"]


class Svg(str):
    """A piece of SVG, which needs no escaping any more; templates take it as it is."""

    __slots__ = ()

    def __html__(self) -> str:
        """What templates that escape text write for it."""
        return str(self)

    def __add__(self, other: str) -> Svg:
        return joined((self, other))


def element(name: str, /, *contents: str, **attributes: str | float | None) -> Svg:
    """An element.

    Args:
        name: its tag.
        contents: texts, which are escaped, and pieces of SVG, in order.
        attributes: in order, an underscore for each hyphen and one at the end of a word that Python reserves
            (``class_``); numbers are written to a hundredth, None is left out.
    """
    words = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{_text(value if isinstance(value, str) else number(value))}"'
        for key, value in attributes.items()
        if value is not None
    )
    inner = joined(contents)
    return Svg(f"<{name}{words}>{inner}</{name}>" if inner else f"<{name}{words}/>")


def joined(pieces: Iterable[str]) -> Svg:
    """Pieces after each other; those that are no SVG are escaped."""
    return Svg("".join(piece if isinstance(piece, Svg) else _text(piece) for piece in pieces))


def number(value: float) -> str:
    """A number to a hundredth, without trailing zeros."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")


def _text(text: str) -> str:
    return escape(xml_text(text))
