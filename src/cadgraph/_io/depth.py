"""How deep values of a file lie within each other, before what writes or prints them falls over it."""

from __future__ import annotations

from typing import Any

__all__ = ["MOST_LEVELS", "is_too_deep"]

MOST_LEVELS = 100
"""Ours: those of our files are below ten; pydantic writes about 250."""


def is_too_deep(content: Any) -> bool:
    """Whether plain values lie within more than ``MOST_LEVELS`` lists and tables."""
    level = [content] if isinstance(content, dict | list) else []
    for _ in range(MOST_LEVELS + 1):
        level = [
            inner
            for holder in level
            for inner in (holder.values() if type(holder) is dict else holder)
            if type(inner) is dict or type(inner) is list
        ]
        if not level:
            return False
    return True
