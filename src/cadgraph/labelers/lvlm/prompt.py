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

VERSION = 1
"""Of the templates; raise it with every change of meaning."""


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
