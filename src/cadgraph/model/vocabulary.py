"""The label tree: root -> group -> name (paper, section III-A)."""

from __future__ import annotations

import functools
import re
import reprlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import yaml

from cadgraph._io.limits import VOCABULARY, read_text_within
from cadgraph._io.strict_yaml import parse_yaml
from cadgraph.errors import LabelError

__all__ = ["FASTENERS", "OPERATORS", "Group", "Vocabulary", "default_vocabulary", "read_vocabulary", "spell_label"]

FASTENERS = frozenset({"bolt", "nut", "washer", "stud", "screw"})
"""Names of what holds a joint together."""
OPERATORS = frozenset(
    {"valve stem", "handwheel", "lever", "yoke", "gland", "gearbox", "actuator", "position indicator"}
)
"""Names of what moves a valve."""

_FORBIDDEN = ":;,&|!"  # what USD semantics taxonomies and labels may not hold
_MAX_LENGTH = 80  # of a label, ours: it has to fit into a legend
_KEYS = ("names", "unit", "connector")
_UNIT = re.compile(r"[a-z][a-z0-9]*(?:[ -][a-z0-9]+)*")


@dataclass(frozen=True)
class Group:
    """One group of labels.

    Args:
        names: the names in this group, most general first.
        unit: the type of functional unit that connected parts of this group form (``"valve"``), or None.
        connector: whether Algorithm 1 walks through parts of this group.
    """

    names: tuple[str, ...]
    unit: str | None = None
    connector: bool = False


@dataclass(frozen=True)
class Vocabulary:
    """The groups by name, in order."""

    groups: Mapping[str, Group]

    @property
    def connector_groups(self) -> frozenset[str]:
        """The groups that Algorithm 1 walks through."""
        return frozenset(name for name, group in self.groups.items() if group.connector)

    @property
    def unit_of_group(self) -> dict[str, str]:
        """The unit type of each group that forms functional units."""
        return {name: group.unit for name, group in self.groups.items() if group.unit}

    def groups_of(self, unit_type: str) -> list[str]:
        """The groups that form units of a type, in alphabetical order."""
        return sorted(name for name, group in self.groups.items() if group.unit == unit_type)

    def holds(self, group: str, name: str | None = None) -> bool:
        """Whether this group, or this name in this group, is in the tree."""
        return group in self.groups and (name is None or name in self.groups[group].names)

    def to_json(self) -> dict[str, Any]:
        """As ``graph.json`` keeps it."""
        result: dict[str, Any] = {}
        for name, group in self.groups.items():
            result[name] = {"names": list(group.names)}
            if group.unit:
                result[name]["unit"] = group.unit
            if group.connector:
                result[name]["connector"] = True
        return result

    @classmethod
    def from_json(cls, tree: Mapping[str, Any], where: str = "vocabulary") -> Vocabulary:
        """Reads ``{group: {"names": [...], "unit": ..., "connector": ...}}``; other keys are passed over.

        Labels are text of at most 80 characters without ``:;,&|!``, names in lower case; the type of a unit is made
        of lower-case letters, digits, spaces and hyphens.

        Args:
            tree: what was parsed.
            where: the file's name, for messages.

        Raises:
            LabelError: a group or name is malformed or there twice.
        """
        if not isinstance(tree, Mapping) or not tree:
            raise LabelError(f"{where}: no groups; expected groups: {{name: {{names: [...]}}}}")
        groups = {name: _group(name, content, where) for name, content in tree.items()}
        repeated = _first_repeat(name.lower() for name in groups)
        if repeated is not None:
            raise LabelError(f"{where}: group {repeated!r} is there twice; put all its names in one")
        return cls(groups)


def _group(name: Any, content: Any, where: str) -> Group:
    shown = reprlib.repr(name)
    if not isinstance(content, Mapping) or not isinstance(content.get("names"), (list, tuple)):
        raise LabelError(f"{where}: group {shown} needs a list 'names'")
    names = tuple(content["names"])
    for label in (name, *names):
        if not _is_label(label):
            raise LabelError(
                f"{where}: {reprlib.repr(label)} in group {shown} is not a label "
                f"(text of at most {_MAX_LENGTH} characters without {_FORBIDDEN})"
            )
    for label in names:
        if label != label.lower():
            raise LabelError(f"{where}: name {label!r} of group {shown} must be lower case: {label.lower()!r}")
    repeated = _first_repeat(names)
    if repeated is not None:
        raise LabelError(f"{where}: name {repeated!r} is twice in group {shown}; keep one")
    unit, connector = content.get("unit"), content.get("connector", False)
    if unit is not None and not (isinstance(unit, str) and len(unit) <= _MAX_LENGTH and _UNIT.fullmatch(unit)):
        raise LabelError(
            f"{where}: 'unit' of group {shown} must be text of lower-case letters and digits, as 'valve', "
            f"not {reprlib.repr(unit)}"
        )
    if not isinstance(connector, bool):
        raise LabelError(f"{where}: 'connector' of group {shown} must be true or false, not {reprlib.repr(connector)}")
    return Group(names, unit, connector)


def _is_label(label: Any) -> bool:
    return (
        isinstance(label, str)
        and 0 < len(label) <= _MAX_LENGTH
        and label == " ".join(label.split())
        and label.isprintable()
        and not any(c in _FORBIDDEN for c in label)
    )


def _first_repeat(names: Iterable[str]) -> str | None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return None


@functools.cache
def default_vocabulary() -> Vocabulary:
    """The built-in tree."""
    text = resources.files("cadgraph.model").joinpath("vocabulary.yaml").read_text(encoding="utf-8")
    return Vocabulary.from_json(yaml.safe_load(text)["groups"], "the built-in vocabulary")


def read_vocabulary(path: str | Path) -> Vocabulary:
    """Reads a user's tree from YAML or JSON, laid out like the built-in one (``groups: {group: {names: [...]}}``).

    Raises:
        LabelError: the file can't be read or is malformed.
    """
    text = read_text_within(path, VOCABULARY, LabelError, "give a YAML vocabulary")
    content = parse_yaml(text, str(path), LabelError)
    groups = content
    if isinstance(content, Mapping) and isinstance(content.get("groups"), Mapping):
        groups = content["groups"]
        _refuse_unknown(content, ("groups", "version"), str(path))
    if isinstance(groups, Mapping):
        for name, group in groups.items():
            if isinstance(group, Mapping):
                _refuse_unknown(group, _KEYS, f"{path}: group {reprlib.repr(name)}")
    return Vocabulary.from_json(groups, str(path))


def _refuse_unknown(content: Mapping[Any, Any], known: tuple[str, ...], where: str) -> None:
    for key in content:
        if key not in known:
            raise LabelError(f"{where}: unknown key {reprlib.repr(key)}; known are {', '.join(known)}")


def spell_label(group: str, name: str | None) -> str:
    """A label as people write it: ``group/name``, or the group where no name is known."""
    return f"{group}/{name}" if name else group
