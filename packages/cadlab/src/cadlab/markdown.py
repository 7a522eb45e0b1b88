"""Tables in Markdown, and the places in a page that they are written to."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["head", "put", "row", "table"]


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


def put(page: str, place: str, text: str) -> str:
    """The page with a text between ``<!-- place: begin -->`` and ``<!-- place: end -->``, in place of what was there.

    Args:
        page: a text in Markdown.
        place: the name in the two marks.
        text: what is to stand between them, without line ends around it.

    Raises:
        ValueError: the page has no such marks.
    """
    begin, end = f"<!-- {place}: begin -->", f"<!-- {place}: end -->"
    before, first, rest = page.partition(begin)
    _, last, after = rest.partition(end)
    if not first or not last:
        raise ValueError(f"the page has no place called {place!r}: write {begin} and {end} where it shall be")
    return f"{before}{begin}\n{text}\n{end}{after}"
