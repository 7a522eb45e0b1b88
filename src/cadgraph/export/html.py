"""The plant as one page that opens from disk: to look at, without a server and without a network."""

from __future__ import annotations

import base64
import hashlib
import re
import zlib
from collections.abc import Iterator
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import size_text
from cadgraph.draw.schematic import draw_diagram
from cadgraph.draw.web.assets import DATA_MARK, HEAD_MARK, SCRIPT, STYLE, page_text
from cadgraph.draw.web.content import as_bytes, content_of, shown_meshes
from cadgraph.draw.web.packing import pack_scene
from cadgraph.errors import FormatError
from cadgraph.export.source import refuse_source, scene_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene

__all__ = ["one_page", "write_html"]

_LARGE = 300 << 20  # bytes from which on browsers are known to be slow, or give up
# What would end an element that holds text, or change how a browser reads what follows in it.
_ENDS = re.compile(r"</(?:script|style)|<!--", re.IGNORECASE)


def write_html(graph: SceneGraph, source: str | Path, path: str | Path) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes the page of ``cadgraph view`` with everything it shows in one file, to look at only.

    Args:
        graph: the finished graph.
        source: the file that it was made from, which is read again for the geometry.
        path: the file to write.

    Returns:
        The file, and a note (``large-page``) where it is so large that browsers may not open it.

    Raises:
        FormatError: the graph was read with settings that aren't known any more.
        LoadError: the source can't be read.
        OutputError: the file can't be written, or would replace the source.
    """
    origin, target = Path(source), Path(path)
    refuse_source(origin, target)
    page = one_page(graph, scene_of(graph, origin))
    write_atomically(target, page)
    if len(page) <= _LARGE:
        return target, ()
    message = f"the page holds {size_text(len(page))}; a browser may not open it, 'cadgraph view' shows it all the same"
    return target, (Diagnostic("large-page", message),)


def one_page(graph: SceneGraph, scene: Scene) -> bytes:
    """The page with all data in it; the same graph and scene give the same bytes.

    Data stand in elements ``cadgraph-data-NAME`` that no browser runs, deflated (zlib) and in base64: ``content``,
    ``manifest``, ``schematic``, and each file that the manifest names. The page's policy allows its very script and
    style, and no connection to anything.

    Args:
        graph: the finished graph.
        scene: that it was made from.

    Raises:
        FormatError: the installed page is damaged.
    """
    script, style = (_sound(name) for name in ("viewer.js", "viewer.css"))
    page = _put(page_text("index.html"), STYLE, f"<style>{style}</style>")
    head, rest = _split(_put(page, HEAD_MARK, _policy(script, style)), DATA_MARK)
    data = b"".join(_data(name, content) for name, content in _contents(graph, scene))
    return head.encode() + data + _put(rest, SCRIPT, f'<script type="module">{script}</script>').encode()


def _contents(graph: SceneGraph, scene: Scene) -> Iterator[tuple[str, bytes]]:
    packed = pack_scene(scene, shown_meshes(graph, scene))
    yield "content", as_bytes(content_of(graph, scene))
    yield "manifest", as_bytes(packed.manifest)
    yield "schematic", draw_diagram(graph, for_page=True).encode("utf-8", "replace")
    yield from packed.files.items()


def _data(name: str, content: bytes) -> bytes:
    text = base64.b64encode(zlib.compress(content, 9))
    return b'<script type="application/octet-stream;base64" id="cadgraph-data-%s">%s</script>\n' % (name.encode(), text)


def _sound(name: str) -> str:
    text = page_text(name)
    if _ENDS.search(text):
        raise FormatError(f"{name} of the page can't stand in a page; install cadgraph again")
    return text


def _policy(script: str, style: str) -> str:
    """Lets in this very script and style, pictures made by the page itself, and nothing else."""
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii") for text in (script, style)]
    policy = (
        f"default-src 'none'; script-src 'sha256-{hashes[0]}'; style-src 'sha256-{hashes[1]}'; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
    return f'<meta http-equiv="Content-Security-Policy" content="{policy}">'


def _put(page: str, mark: str, text: str) -> str:
    before, after = _split(page, mark)
    return before + text + after


def _split(page: str, mark: str) -> tuple[str, str]:
    if page.count(mark) != 1:
        raise FormatError(f"index.html of the page must have {mark} once; install cadgraph again")
    before, _, after = page.partition(mark)
    return before, after
