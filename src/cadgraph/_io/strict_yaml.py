"""YAML as plain values, no key twice, errors on one line."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import yaml

__all__ = ["parse_yaml"]


def parse_yaml(text: str, where: str, error: type[Exception]) -> Any:
    """The plain values that a YAML text holds; a key that stands twice in a mapping is an error, too.

    Args:
        text: of the file.
        where: name of the file, for messages.
        error: class of the error where it is no such YAML; the message names the line.

    Raises:
        error: it isn't.
    """
    try:
        return yaml.load(text, Loader=_StrictLoader)
    except (yaml.YAMLError, ValueError, TypeError, RecursionError) as failure:
        raise error(f"{where}: not YAML ({_what(failure)})") from failure


class _StrictLoader(yaml.SafeLoader):
    """Plain values only, like its base, but no key twice: of two groups of one name the first would be lost."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """A mapping whose keys are all there once."""
        seen: set[Any] = set()
        for key_node, _ in node.value:
            if key_node.tag == "tag:yaml.org,2002:merge":
                continue
            key = self.construct_object(key_node, deep=True)
            if isinstance(key, Hashable) and key in seen:
                raise yaml.constructor.ConstructorError(None, None, f"{key!r} is there twice", key_node.start_mark)
            seen.add(key)
        return super().construct_mapping(node, deep)


def _what(error: Exception) -> str:
    """What is wrong and in which line, on one line."""
    mark, problem = getattr(error, "problem_mark", None), getattr(error, "problem", None)
    if mark is None or not problem:
        return str(error).splitlines()[0] if str(error) else type(error).__name__
    return f"{problem} in line {mark.line + 1}"
