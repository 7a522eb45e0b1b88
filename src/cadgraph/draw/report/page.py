"""``report.html``: one page that needs nothing else, and ``picture.png`` beside it."""

from __future__ import annotations

import base64
import hashlib
import io
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cadgraph._io.atomic import write_atomically
from cadgraph._io.progress import Progress, quiet
from cadgraph._io.text import file_name
from cadgraph.config import ReportConfig
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected
from cadgraph.model.scene import Scene
from cadgraph.query.doubt import mounted_words
from cadgraph.query.summary import connection_words, end_words, share_words, summarize

if TYPE_CHECKING:
    from cadgraph.draw.report.overview import Overview
    from cadgraph.draw.report.pictures import Picture

__all__ = ["write_report"]

_JPEG_QUALITY = 90
_PLURALS = {"equipment": "equipment"}


def write_report(
    scene: Scene,
    graph: SceneGraph,
    path: str | Path,
    config: ReportConfig | None = None,
    progress: Progress = quiet,
    overview: Callable[[], Overview | None] = lambda: None,
) -> Path:
    """Writes the report, and the main picture as ``picture.png`` in the same folder.

    The page holds its pictures, styles and script, asks nothing of a network, and shows every name from the source as
    text. The same scene and graph give the same bytes.

    Args:
        scene: that the graph was made from.
        graph: the finished graph.
        path: the file, or a folder that gets ``report.html``.
        config: size and number of pictures; the defaults if None.
        progress: told how many of the pictures are drawn.
        overview: gives what the pictures of the whole scene show, where that was worked out meanwhile.

    Returns:
        The path of the page.

    Raises:
        OutputError: a file can't be written.
    """
    from cadgraph.draw.report.pictures import draw_pictures

    target = Path(path)
    target = target if target.suffix.lower() in (".html", ".htm") else target / "report.html"
    pictures = draw_pictures(scene, graph, config or ReportConfig(), progress, overview)
    if pictures:
        write_atomically(target.parent / "picture.png", _png(pictures[0]))
    write_atomically(target, _page(graph, pictures))
    return target


def _page(graph: SceneGraph, pictures: list[Picture]) -> str:
    import jinja2

    from cadgraph import __version__
    from cadgraph.draw.colors import color_of_unit_type, group_colors
    from cadgraph.draw.report import tables
    from cadgraph.draw.report.chart import draw_bars

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(_asset), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    colors = group_colors(graph)
    style, script = _asset("page.css"), _asset("page.js")
    return environment.get_template("page.html").render(
        name=file_name(graph.source.path) or "scene",
        version=__version__,
        style=style,
        script=script,
        policy=_policy(style, script),
        source=graph.source,
        facts=_facts(graph),
        overview=[_shown(picture) for picture in pictures[:3]],
        structures=[_shown(picture) for picture in pictures[3:]],
        n_structures=len(graph.clusters("pipe system")),
        schematic=_schematic(graph),
        lines=tables.line_table(graph),
        chart=draw_bars(tables.label_bars(graph, colors)),
        labels=tables.label_table(graph, colors),
        units=tables.unit_table(graph, color_of_unit_type(graph, colors)),
        connections=tables.connection_table(graph),
        related=tables.related_table(graph),
        clusters=tables.cluster_table(graph),
        findings=tables.findings(graph),
        settings=tables.setting_table(graph),
    )


def _facts(graph: SceneGraph) -> dict[str, Any]:
    """What the head of the page says."""
    summary = summarize(graph)
    parts = graph.parts()
    lows = [part.aabb[0] for part in parts if not part.ground] or [part.aabb[0] for part in parts]
    highs = [part.aabb[1] for part in parts if not part.ground] or [part.aabb[1] for part in parts]
    extent = [max(h[i] for h in highs) - min(low[i] for low in lows) for i in range(3)] if parts else []
    return {
        "meshes": summary.n_meshes,
        "triangles": summary.n_triangles,
        "parts": summary.n_parts,
        "clusters": summary.n_clusters,
        "with_pipes": summary.n_with_pipes,
        "extent": " × ".join(f"{length:.2f}" for length in extent),
        "labelled": share_words(summary.n_labelled, len(parts)),
        "units": sum(len(tags) for tags in summary.units.values()),
        "unit_types": [_plural(len(tags), name) for name, tags in summary.units.items()],
        "without_line": mounted_words(summary.without_line),
        "connections": summary.n_connected,
        "connection_words": connection_words(summary),
        "ends": sum(summary.ends.values()),
        "end_words": end_words(summary),
        "systems": summary.n_systems,
    }


def _shown(picture: Picture) -> dict[str, Any]:
    buffer = io.BytesIO()
    # Thin red lines on saturated colours need chroma at full resolution.
    picture.image.save(buffer, "JPEG", quality=_JPEG_QUALITY, subsampling=0, optimize=True)
    return {
        "name": picture.name,
        "title": picture.title,
        "caption": picture.caption,
        "alternative": picture.alternative,
        "legend": picture.legend,
        "width": picture.image.width,
        "height": picture.image.height,
        "data": base64.b64encode(buffer.getvalue()).decode("ascii"),
    }


def _schematic(graph: SceneGraph) -> str:
    """The schematic as base64, or nothing where no two units are connected along a pipe.

    As a picture of its own, so that nothing in it can act on the page.
    """
    from cadgraph.draw.schematic import draw_diagram

    if not graph.of_kind(Connected):
        return ""
    return base64.b64encode(draw_diagram(graph).encode("utf-8")).decode("ascii")


def _png(picture: Picture) -> bytes:
    from cadgraph.draw.render.annotation import annotate

    image = annotate(picture.image, picture.camera, legend=picture.legend).image
    buffer = io.BytesIO()
    image.save(buffer, "PNG", compress_level=6)
    return buffer.getvalue()


def _policy(style: str, script: str) -> str:
    """A Content-Security-Policy that lets in this very style and script, embedded pictures, and nothing else."""
    hashes = [
        base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii") for text in (style, script)
    ]
    return (
        f"default-src 'none'; img-src data:; style-src 'sha256-{hashes[0]}'; script-src 'sha256-{hashes[1]}'; "
        "base-uri 'none'; form-action 'none'"
    )


def _asset(name: str) -> str:
    # A browser reads CRLF as LF, and the policy's hashes are of what it reads.
    text = resources.files("cadgraph.draw.report").joinpath(name).read_text(encoding="utf-8")
    return text.replace("\r\n", "\n")


def _plural(count: int, noun: str) -> str:
    return f"{count:,}\N{NO-BREAK SPACE}" + (noun if count == 1 else _PLURALS.get(noun, noun + "s"))
