"""A report that stays beside a graph that was made anew says so itself, at its top."""

from __future__ import annotations

import re

__all__ = ["marked_as_earlier"]

_NOTE = (
    b'<p id="earlier" role="note"><strong>This report shows an earlier graph.</strong> The graph beside it was made '
    b"anew since, without a report: 'cadgraph build' or 'cadgraph relabel' draws it.</p>"
)
_BODY = re.compile(rb"<body>\r?\n?")


def marked_as_earlier(page: bytes, earlier: bool) -> bytes:
    """A report with the note that it shows an earlier graph, or without it.

    Args:
        page: content of a report.
        earlier: whether it does.

    Returns:
        The page; as it was where it says the right thing already.
    """
    plain = page.replace(_NOTE + b"\n", b"", 1)
    if not earlier:
        return plain
    body = _BODY.search(plain)
    place = body.end() if body else 0
    return plain[:place] + _NOTE + b"\n" + plain[place:]
