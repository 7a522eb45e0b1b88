"""An evaluation as plain JSON values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from cadlab.evaluate.evaluation import Evaluation

__all__ = ["FORMAT", "VERSION", "to_json"]

FORMAT = "cadgraph-evaluation"
VERSION = 1


def to_json(evaluation: Evaluation) -> dict[str, Any]:
    """Everything in an evaluation, counts as well as the shares that follow from them, as plain JSON values.

    Keys are the names of the fields and properties; a share of nothing is null; nine significant digits.
    """
    content: dict[str, Any] = _plain(evaluation)
    return {"format": FORMAT, "version": VERSION, **content}


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        names = [field.name for field in fields(value)]
        for base in reversed(type(value).__mro__):
            names += [name for name, member in vars(base).items() if isinstance(member, property)]
        return {name: _plain(getattr(value, name)) for name in names}
    if isinstance(value, Mapping):
        return {str(key): _plain(content) for key, content in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(content) for content in value]
    return float(f"{value:.9g}") if isinstance(value, float) else value
