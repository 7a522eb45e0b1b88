"""Text that goes in order, into XML, or onto one line."""

from __future__ import annotations

import re

__all__ = ["natural_key", "printable", "tag_key", "xml_text"]

_DIGITS = re.compile(r"([0-9]+)")
# XML 1.0, production [2] Char: everything else can't stand in a document, not even escaped.
_NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


NaturalKey = tuple[tuple[str | int, ...], str]


def natural_key(text: str) -> NaturalKey:
    """A key that sorts ``mesh_2`` before ``mesh_10``, and paths before those below them."""
    steps = _DIGITS.split(text.replace("/", "\x00"))
    return tuple(int(step) if i % 2 else step for i, step in enumerate(steps)), text


def tag_key(tag: str) -> NaturalKey:
    """A key that sorts ``V-2`` before ``V-10``, capitals as small letters."""
    return natural_key(tag.casefold())


def printable(text: str, instead: str = " ") -> str:
    """A text with something else in place of each control character, line break or lone surrogate."""
    return "".join(letter if letter.isprintable() else instead for letter in text)


def xml_text(text: str) -> str:
    """A text without the characters that XML can't hold; what has a meaning there is still to be escaped."""
    return _NO_XML.sub("", text)
