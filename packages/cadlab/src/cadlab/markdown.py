"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["head", "row", "table"]


def table(titles: Sequence[str], rows: Iterable[Iterable[object]], numbers: bool = False) -> list[str]:
    """The lines of a table.

    Args:
        titles: of the columns.
        rows: a cell for each column; cells are written as they are.
        numbers: whether all columns but the first hold numbers, which stand at the right.
    """
    return [*head(titles, numbers), *map(row, rows)]


def head(titles: Sequence[str], numbers: bool = False) -> list[str]:
    """The first two lines of a table; see ``table``."""
    rule = "|:---|" + "---:|" * (len(titles) - 1) if numbers else "|" + "---|" * len(titles)
    return [row(titles), rule]


def row(cells: Iterable[object]) -> str:
    """One line of a table."""
    return "| " + " | ".join(map(str, cells)) + " |"
