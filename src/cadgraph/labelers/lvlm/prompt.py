"""The words of a question, from the templates beside this module."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Wording", "grow_text", "label_text", "size_text", "system_text", "version"]

VERSION = 2
"""Of the templates; raise it with every change of meaning."""

_FASTENERS = ("bolt", "nut", "stud", "washer", "screw")
_DEFINITIONS: tuple[tuple[tuple[str, ...], str], ...] = (
    (
        ("gasket", "flange"),
        "A gasket is a ring or sheet of a few millimetres between flanges; a flange is a thick disc.",
    ),
    (
        ("plate", "bracket"),
        "A plate is flat and of one piece; a bracket is bent or put together and carries something.",
    ),
    (("pipe", "nipple"), "A nipple is a short piece of pipe, hardly longer than wide, between two fittings."),
    (("railing", "fence"), "Whatever fills a railing (knee rails, posts, toe boards, bars) is railing too."),
    (("gauge case", "gauge face"), "The bezel and the back of a gauge are gauge case; the face is the dial alone."),
    (("gland", "lever"), "The small nut or collar round the stem under a lever or handwheel is the gland."),
    (("base plate", "flange"), "A plate under a column or post is its base plate, also if it is round and drilled."),
    (("nozzle", "flange"), "The neck and the flange that are made in one with a tank are its nozzle."),
)
"""What is mistaken, a line each: said where the vocabulary has all of these names."""


@dataclass(frozen=True)
class Wording:
    """What goes into the text of a question about a part.

    Args:
        box: extents of the part along its own axes [m], descending.
        height: it takes up in space [m].
        vocabulary: the labels to choose from.
        paper: whether the pictures are the paper's plain ones.
        hints: what geometry knows, a line each; made by us, never from the scene's own words.
        before: a label given before, or None.
        again: why the last answer could not be used, or None.
        mark: the word for the colour that marks the part.
    """

    box: tuple[float, float, float]
    height: float
    vocabulary: Vocabulary
    paper: bool = False
    hints: Sequence[str] = ()
    before: str | None = None
    again: str | None = None
    mark: str = "magenta"


def system_text() -> str:
    """What every conversation starts with."""
    return _filled("system")


def label_text(wording: Wording) -> str:
    """The question what a part is."""
    return _filled(
        "label",
        paper=wording.paper,
        mark=wording.mark,
        box=" x ".join(size_text(e) for e in wording.box),
        height=size_text(wording.height),
        hints=[_one_line(hint) for hint in wording.hints],
        before=wording.before and _one_line(wording.before),
        definitions=_definitions(wording.vocabulary),
        vocabulary=_listed(wording.vocabulary),
        again=wording.again and _one_line(wording.again),
    )


def grow_text(vocabulary: Vocabulary, most: int, again: str | None = None) -> str:
    """The question which labels are missing."""
    return _filled("grow", vocabulary=_listed(vocabulary), most=most, again=again and _one_line(again))


def version(name: str) -> str:
    """A template's name, version and digest, for the provenance of a label: ``"label-1-3f2a9c01"``."""
    text = _source("system") + _source(name)
    return f"{name}-{VERSION}-{hashlib.sha256(text.encode()).hexdigest()[:8]}"


def size_text(length: float) -> str:
    """A length in the unit that people would use."""
    if length >= 1:
        return f"{length:.3g} m"
    return f"{length * 1000:.3g} mm"


def _definitions(vocabulary: Vocabulary) -> list[str]:
    """What tells names apart that are mistaken for each other, of those that are to choose from."""
    places = {name: group for group, content in vocabulary.groups.items() for name in content.names}
    lines = [line for names, line in _DEFINITIONS if all(name in places for name in names)]
    fasteners = [name for name in _FASTENERS if name in places]
    if fasteners:
        groups = list(dict.fromkeys(places[name] for name in fasteners))
        names = " and ".join(filter(None, (", ".join(_many(name) for name in fasteners[:-1]), _many(fasteners[-1]))))
        whose = "wherever they are: on a flange, a valve, a pump or a gauge"
        lines.insert(0, f"{names[0].upper()}{names[1:]} always belong to {' or '.join(groups)}, {whose}.")
    return [_one_line(line) for line in lines]


def _many(name: str) -> str:
    return f"{name}s"


def _listed(vocabulary: Vocabulary) -> str:
    return "\n".join(f"{group}: {', '.join(content.names)}" for group, content in vocabulary.groups.items()) or "(none)"


def _one_line(text: str) -> str:
    """On one line and without the marks that end a block of data."""
    return " ".join(text.replace("<", "(").replace(">", ")").split())


@functools.cache
def _source(name: str) -> str:
    # Git on Windows may have turned the line ends; questions must stay the same.
    folder = resources.files("cadgraph.labelers.lvlm").joinpath("templates")
    return folder.joinpath(f"{name}.txt").read_text(encoding="utf-8").replace("\r\n", "\n")


def _filled(name: str, **values: Any) -> str:
    return str(_template(name).render(**values)).strip()


@functools.cache
def _template(name: str) -> Any:
    from jinja2 import Environment, StrictUndefined

    # Plain text for a model, not HTML: nothing to escape.
    return Environment(undefined=StrictUndefined, autoescape=False).from_string(_source(name))
