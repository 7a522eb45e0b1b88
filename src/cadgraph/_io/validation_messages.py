"""What a value should have been, in plain words in place of those of a library."""

from __future__ import annotations

import json
import reprlib
from collections.abc import Mapping
from typing import Any

__all__ = ["expectation"]

_EXPECTED = {
    "bool": "true or false",
    "dict": "a table of names and values",
    "float": "a number",
    "int": "a whole number",
    "list": "a list",
    "model": "a table of names and values",
    "string": "text",
    "tuple": "a list",
}
_LIMITS = {
    "greater_than": ("gt", "above"),
    "greater_than_equal": ("ge", "at least"),
    "less_than": ("lt", "below"),
    "less_than_equal": ("le", "at most"),
}


def expectation(detail: Mapping[str, Any]) -> str:
    """What was expected in place of a value that pydantic refuses, in plain words.

    Args:
        detail: one entry of ``ValidationError.errors()``.

    Returns:
        A clause as ``"must be a number, not True"`` or ``"is missing"``.
    """
    kind, context = str(detail["type"]), detail.get("ctx", {})
    value = _shown(detail.get("input"))
    if kind == "missing":
        return "is missing"
    if kind == "finite_number":
        return f"must be a finite number, not {value}"
    if kind == "int_from_float":
        return f"must be a whole number, not {value}"
    if kind in _LIMITS:
        key, words = _LIMITS[kind]
        return f"must be {words} {context[key]:g}, not {value}"
    if kind in ("literal_error", "union_tag_invalid"):
        value = repr(context["tag"]) if "tag" in context else value
        return f"must be {context.get('expected') or context.get('expected_tags')}, not {value}"
    if kind in ("too_short", "too_long"):
        bound = "at least" if kind == "too_short" else "at most"
        return f"must have {bound} {context.get('min_length', context.get('max_length'))} values, not {value}"
    expected = _EXPECTED.get(kind.partition("_")[0])
    return f"must be {expected}, not {value}" if expected else f"is refused: {detail['msg']}"


def _shown(value: Any) -> str:
    # As TOML and JSON write them, which is where the value comes from.
    return json.dumps(value) if isinstance(value, bool) else reprlib.repr(value)
