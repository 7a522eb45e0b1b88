"""The page itself: its markup, script and style, as the sources under ``web/`` give them."""

from __future__ import annotations

from importlib import resources

__all__ = ["DATA_MARK", "HEAD_MARK", "SCRIPT", "STYLE", "page_text"]

HEAD_MARK = "<!--cadgraph:head-->"
"""Where in the head of ``index.html`` anything may be put."""

DATA_MARK = "<!--cadgraph:data-->"
"""Where in its body data may be put, before the script."""

SCRIPT = '<script type="module" src="viewer.js"></script>'
"""How ``index.html`` refers to its script."""

STYLE = '<link rel="stylesheet" href="viewer.css">'
"""How it refers to its style."""


def page_text(name: str) -> str:
    """A file of the page: ``index.html``, ``viewer.js`` or ``viewer.css``, with line feeds.

    Raises:
        OSError: it isn't there.
    """
    # A browser reads CRLF as LF, and hashes in a policy are of what it reads.
    text = resources.files("cadgraph.draw.web").joinpath("page", name).read_text(encoding="utf-8")
    return text.replace("\r\n", "\n")
