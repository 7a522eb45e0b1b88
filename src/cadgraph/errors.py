"""Every error that cadgraph raises on purpose.

::

    CadGraphError
    ├── LoadError      a source file can't be turned into a scene
    ├── LabelError     labels given from outside, or a labeler's answers, can't be used
    ├── FormatError    a graph on disk is not what ``graph.json`` promises
    ├── ScenarioError  a scenario of a simulation can't be used
    ├── OutputError    a result can't be written
    ├── MissingExtra   a command needs an optional dependency that isn't installed
    ├── MissingPackage a command comes with a package that isn't installed
    ├── AskError       a tool can't answer what it was asked; also a ``ValueError``
    ├── UnknownNode    nothing in a graph is called so; also a ``KeyError`` and a ``ValueError``
    └── Unconnected    no line was found at a unit that a question about lines is asked of; also a ``ValueError``

Bad arguments raise ``ValueError``. What is merely skipped, repaired or guessed is no error: it is listed in the
graph's ``diagnostics``.
"""

from __future__ import annotations

from collections.abc import Sequence

__all__ = [
    "AskError",
    "CadGraphError",
    "FormatError",
    "LabelError",
    "LoadError",
    "MissingExtra",
    "MissingPackage",
    "OutputError",
    "ScenarioError",
    "Unconnected",
    "UnknownNode",
]


_MOST = 2_000  # characters of a message: whoever reads it sees where it begins and how it ends
_END = 300


class CadGraphError(Exception):
    """The base of all errors below; its text is one line that names the file, the mesh and the remedy.

    Messages may quote files, which hold anything: what can't be printed becomes a space, and the middle of a message of
    more than 2,000 characters is left out.
    """

    def __init__(self, *arguments: object) -> None:
        super().__init__(*(_one_line(one) if isinstance(one, str) else one for one in arguments))


def _one_line(text: str) -> str:
    if not text.isprintable():
        text = "".join(letter if letter.isprintable() else " " for letter in text)
    return text if len(text) <= _MOST else f"{text[: _MOST - _END - 5]} ... {text[-_END:]}"


class LoadError(CadGraphError):
    """A source file can't be turned into a scene."""


class LabelError(CadGraphError):
    """Labels from outside, or the answers of a labeler, can't be used."""


class FormatError(CadGraphError):
    """A graph on disk does not follow the format."""


class ScenarioError(CadGraphError):
    """A scenario names what is not in the plant, or holds values that can't be."""


class OutputError(CadGraphError):
    """A result can't be written."""


class MissingExtra(CadGraphError):
    """An optional dependency is missing.

    Args:
        purpose: what needs it, as a person would say it (``"reading STEP files"``).
        extra: the extra to install, as in ``cadgraph[cad]``.
    """

    def __init__(self, purpose: str, extra: str) -> None:
        self.purpose, self.extra = purpose, extra
        super().__init__(
            # Of no package index: whoever took the name there would be installed.
            f"{purpose} needs an extra: in the checkout of cadgraph, pip install '.[{extra}]'"
        )


class MissingPackage(CadGraphError):
    """A package that brings a command is not installed.

    Args:
        command: the command, without ``cadgraph``.
        package: the package to install.
    """

    def __init__(self, command: str, package: str) -> None:
        self.package = package
        super().__init__(
            f"'cadgraph {command}' comes with the package {package}: in the checkout of cadgraph, "
            f"pip install ./packages/{package}"
        )


class AskError(CadGraphError, ValueError):
    """A tool can't answer, as an argument is wrong; its text tells the one who asked what would be right."""


class UnknownNode(CadGraphError, KeyError, ValueError):
    """Nothing in a graph is called by this tag, id or path of a mesh.

    A ``KeyError``, as a look-up fails, and a ``ValueError``, as an argument of a query or a command is wrong.
    """

    __str__ = Exception.__str__  # that of KeyError would put the message in quotes


class Unconnected(CadGraphError, ValueError):
    """A question about lines can't be answered, as no line was found at the unit that it is asked of.

    That no line was found doesn't say that there is none: an answer as "nothing flows to it" would be wrong.

    Args:
        name: tag of the unit.
        asked: what can't be said, as a person would say it (``"what isolates it"``).
        mounted_at: tags of the units that it sits at, if any: a gauge without a pipe shows what is in one of them.
    """

    def __init__(self, name: str, asked: str, mounted_at: Sequence[str] = ()) -> None:
        self.name, self.mounted_at = name, tuple(mounted_at)
        beside = f", which is mounted at {' or '.join(mounted_at)}" if mounted_at else ""
        instead = f"ask about {mounted_at[0]}; " if len(mounted_at) == 1 else ""
        super().__init__(
            f"no line was found at {name}{beside}; can't say {asked}: {instead}'cadgraph explain FOLDER {name}' says "
            "what is near it, 'cadgraph relabel' corrects a label"
        )
