"""The label tree: root -> group -> name (paper, section III-A)."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import yaml

from cadgraph.errors import LabelError

__all__ = ["Group", "Vocabulary", "default_vocabulary", "read_vocabulary"]

_FORBIDDEN = ":;,&|!"  # what USD semantics taxonomies and labels may not hold


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
        """Reads ``{group: {"names": [...], "unit": ..., "connector": ...}}``.

        Args:
            tree: what was parsed.
            where: the file's name, for messages.

        Raises:
            LabelError: a group or name is malformed.
        """
        if not isinstance(tree, Mapping) or not tree:
            raise LabelError(f"{where}: no groups; expected groups: {{name: {{names: [...]}}}}")
        groups: dict[str, Group] = {}
        for group_name, content in tree.items():
            if not isinstance(content, Mapping) or not isinstance(content.get("names"), (list, tuple)):
                raise LabelError(f"{where}: group {group_name!r} needs a list 'names'")
            names = tuple(content["names"])
            for label in (group_name, *names):
                if not isinstance(label, str) or not label.strip() or any(c in _FORBIDDEN for c in label):
                    raise LabelError(
                        f"{where}: {label!r} in group {group_name!r} is not a label (text without {_FORBIDDEN})"
                    )
            unit, connector = content.get("unit"), content.get("connector", False)
            if unit is not None and not isinstance(unit, str):
                raise LabelError(f"{where}: 'unit' of group {group_name!r} must be text, not {unit!r}")
            if not isinstance(connector, bool):
                raise LabelError(
                    f"{where}: 'connector' of group {group_name!r} must be true or false, not {connector!r}"
                )
            groups[group_name] = Group(names, unit, connector)
        return cls(groups)


@functools.cache
def default_vocabulary() -> Vocabulary:
    """The built-in tree."""
    text = resources.files("cadgraph").joinpath("data/vocabulary.yaml").read_text(encoding="utf-8")
    return Vocabulary.from_json(yaml.safe_load(text)["groups"], "the built-in vocabulary")


def read_vocabulary(path: str | Path) -> Vocabulary:
    """Reads a user's tree from YAML or JSON, laid out like the built-in one (``groups: {group: {names: [...]}}``).

    Raises:
        LabelError: the file can't be read or is malformed.
    """
    try:
        content = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise LabelError(f"{path}: can't be read ({error.strerror}); give a YAML vocabulary") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise LabelError(f"{path}: not YAML ({str(error).splitlines()[0]})") from error
    if isinstance(content, Mapping) and isinstance(content.get("groups"), Mapping):
        content = content["groups"]
    return Vocabulary.from_json(content, str(path))
