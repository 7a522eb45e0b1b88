"""The pictures of a finished graph: as it is, by cluster, by group, and structure by structure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import ReportConfig
from cadgraph.draw.colors import BACKDROP, RELATION, UNLABELLED, color_of_unit_type, group_colors
from cadgraph.draw.render.annotation import Annotated, LegendEntry, Mark, Segment, Tag, annotate
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import distinct_colors, from_hex, source_colors, to_hex
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.draw.report.overview import MARGIN, Overview, can_be_drawn, look_over
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Cluster, Connected, Edge, Junction, Part, Point, Related, Terminal, Unit
from cadgraph.model.scene import Ints, Scene

__all__ = ["Picture", "cluster_colors", "draw_pictures", "kind_words", "largest_first"]

Bools = npt.NDArray[np.bool_]

_CROWDED = 48  # units from which on lines and balls are thinner, and only tags that stand clear are shown
_CLUTTER = 3.0  # of a tag in a crowded picture, see annotate
_AT_ONCE = 2  # pictures of structures: while one is drawn, another is annotated
_LEGEND_CLUSTERS = 10
_END = "#5b6470"  # of junctions and ends of runs
_NEARLY_ALL = 0.7
_LEAD = 0.45  # of a line's width: from a line to the ball of what stands at it
_SIDE_BY_SIDE, _LETTERS = 0.75, 1.2  # size of pictures that the page shows at half its width, and of their letters


@dataclass(frozen=True)
class Picture:
    """One picture of the report.

    Args:
        name: short, for links.
        title: a heading.
        caption: one or two sentences.
        alternative: what the picture shows, for those who don't see it.
        image: RGB.
        legend: colours and their meaning, for the page; the image holds none.
        camera: that it was taken with.
    """

    name: str
    title: str
    caption: str
    alternative: str
    image: Image.Image
    legend: tuple[LegendEntry, ...]
    camera: Camera


@dataclass(frozen=True)
class _Ready:
    """What all pictures are drawn from.

    Args:
        scene: that the graph was made from.
        graph: the finished graph.
        config: of the report.
        renderer: of the scene.
        look: how pictures are drawn.
        parts: all of the graph.
        row_of_mesh: ``(n_meshes,)`` each mesh's part among these, -1 where it has none.
        colors: by group.
        unit_colors: by unit type.
    """

    scene: Scene
    graph: SceneGraph
    config: ReportConfig
    renderer: Renderer
    look: Look
    parts: list[Part]
    row_of_mesh: Ints
    colors: dict[str, str]
    unit_colors: dict[str, str]

    @cached_property
    def kind_of_mesh(self) -> Ints:
        """``(n_meshes,)`` row of a mesh's group among the colours; then one for the ground, and one for the rest."""
        groups = {group: row for row, group in enumerate(self.colors)}
        ground, rest = len(groups), len(groups) + 1
        kinds = [groups[p.label.group] if p.label is not None else ground if p.ground else rest for p in self.parts]
        return np.array([*kinds, rest], np.int64)[self.row_of_mesh]

    @cached_property
    def heights(self) -> tuple[float, float]:
        """Of the lowest and the highest point [m]."""
        heights = self.renderer.points()[:, 2]
        return float(heights.min()), float(heights.max())

    def meshes_of(self, members: set[str]) -> Bools:
        """``(n_meshes,)`` whether a mesh belongs to one of these parts."""
        inside = np.zeros(len(self.parts) + 1, bool)
        inside[[self.row_of_part[name] for name in members]] = True
        return inside[self.row_of_mesh]

    @cached_property
    def row_of_part(self) -> dict[str, int]:
        """The row of each part among all, by its id."""
        return {part.id: row for row, part in enumerate(self.parts)}


def draw_pictures(
    scene: Scene,
    graph: SceneGraph,
    config: ReportConfig,
    progress: Progress = quiet,
    overview: Callable[[], Overview | None] = lambda: None,
) -> list[Picture]:
    """Draws all pictures of a report.

    Args:
        scene: that the graph was made from; meshes are found by their source paths.
        graph: the finished graph.
        config: size, anti-aliasing and number of pictures.
        progress: told how many of the pictures are drawn.
        overview: gives what the pictures of the whole scene show, if that is known already.

    Returns:
        The pictures by group (with connections), as it is, by structure; then the structures with pipes, the largest
        first.
        None at all if the scene has nothing to draw.
    """
    known = overview()
    if known is None and not can_be_drawn(scene):
        return []
    parts = graph.parts()
    owner = {mesh: row for row, part in enumerate(parts) for mesh in part.meshes}
    row_of_mesh = np.array([owner.get(path, -1) for path in scene.paths], np.int64)
    ground = np.array([*(part.ground for part in parts), False], bool)[row_of_mesh]
    seen = known if known is not None and known.is_of(scene, ground, config) else look_over(scene, ground, config)
    camera, colors = seen.camera, group_colors(graph)
    ready = _Ready(
        scene, graph, config, seen.renderer, seen.sight.look, parts, row_of_mesh, colors,
        color_of_unit_type(graph, colors),
    )  # fmt: skip
    groups, hatched, legend = _group_paint(ready)
    clusters = _cluster_paint(ready)
    paints = [Paint(groups, hatched), Paint(source_colors(scene)), Paint(clusters)]
    images = ready.renderer.painted(seen.sight, paints)
    del known, seen  # the samples of a large picture take as much room as the plant
    pictures = [
        _by_group(ready, camera, images[0], legend),
        _as_it_is(ready, camera, images[1]),
        _by_cluster(ready, camera, images[2], bool((clusters == from_hex(BACKDROP)).all(axis=1).any())),
    ]
    structures = largest_first(graph.clusters("pipe system"))[: config.max_systems]
    # The page shows a single one over its whole width, several side by side.
    whole = config.width, config.height
    size, letters = (whole, 1.0) if len(structures) == 1 else (_smaller(whole), _LETTERS)

    def draw(number: int) -> Picture | None:
        cluster = structures[number]
        return _structure(ready, cluster, f"Structure {number + 1}: {cluster.id}", camera, size, letters)

    with ThreadPoolExecutor(_AT_ONCE) as pool:
        for number, picture in enumerate(pool.map(draw, range(len(structures))), 1):
            progress("draw report", number / (len(structures) + 1))
            if picture is not None:
                pictures.append(picture)
    return pictures


def largest_first(clusters: Sequence[Cluster]) -> list[Cluster]:
    """By number of parts, descending; of equals by id."""
    return sorted(clusters, key=lambda cluster: (-cluster.n_parts, cluster.id))


def kind_words(cluster: Cluster) -> str:
    """What a structure is, in words; a system is something else, so that "pipe system" is not among them."""
    return {"pipe system": "pipes", None: "unlabelled"}.get(cluster.kind, cluster.kind or "")


def cluster_colors(graph: SceneGraph) -> dict[str, str]:
    """``"#rrggbb"`` by cluster id, the largest cluster first."""
    clusters = largest_first(graph.clusters())
    return {c.id: to_hex(color) for c, color in zip(clusters, distinct_colors(len(clusters)), strict=True)}


def _drawn_edges(graph: SceneGraph) -> list[Edge]:
    """What the red lines stand for: connections along pipes; Algorithm 1's relations in paper mode or without them."""
    connected, related = list[Edge](graph.of_kind(Connected)), list[Edge](graph.of_kind(Related))
    return related or connected if graph.config.get("method") == "paper" else connected or related


def _by_group(ready: _Ready, camera: Camera, image: Image.Image, legend: tuple[LegendEntry, ...]) -> Picture:
    units, edges = ready.graph.units(), _drawn_edges(ready.graph)
    image, tagged = _related(ready, image, camera, units, edges)
    told = "Every part in the colour of its group. "
    if any(isinstance(edge, Connected) for edge in edges):
        told += "Red lines are the connections along the pipes; red balls are units, grey ones junctions and ends. "
    elif edges:
        told += "Red lines are the relations of the paper's Algorithm 1 between units, with balls at their centroids. "
    elif units:
        told += "Red balls stand at the centroids of the functional units. "
    told += _untagged(len(units), tagged)
    groups = ", ".join(entry.text for entry in legend) or "none"
    return Picture(
        "groups", f"By group, with {_edge_word(edges)}s", told.strip(),
        f"The scene, coloured by group ({groups}), with {_counted(len(units), 'unit')} and "
        f"{_counted(len(edges), _edge_word(edges))}.",
        image, legend, camera,
    )  # fmt: skip


def _as_it_is(ready: _Ready, camera: Camera, image: Image.Image) -> Picture:
    given = np.isfinite(ready.scene.colors).all(axis=1)
    told = "in the colours of the source" + ("" if given.all() else ", light grey where it has none")
    if not given.any():
        told = "in grey, since the source gives no colours"
    return Picture(
        "source", "As it is", f"The scene {told}.", f"The scene from obliquely above, {told}.", image, (), camera
    )


def _cluster_paint(ready: _Ready) -> npt.NDArray[np.float32]:
    rows = {cluster: row for row, cluster in enumerate(cluster_colors(ready.graph))}
    found = (ready.graph.cluster_of(part) for part in ready.parts)
    row_of_part = [len(rows) if cluster is None else rows[cluster.id] for cluster in found]
    colors = np.array([*map(from_hex, cluster_colors(ready.graph).values()), from_hex(BACKDROP)], np.float32)
    paint: npt.NDArray[np.float32] = colors[np.array([*row_of_part, len(rows)])[ready.row_of_mesh]]
    return paint


def _by_cluster(ready: _Ready, camera: Camera, image: Image.Image, others: bool) -> Picture:
    colors = cluster_colors(ready.graph)
    clusters = largest_first(ready.graph.clusters())
    legend = [
        LegendEntry(colors[c.id], f"{c.id}: {kind_words(c)}, {_counted(c.n_parts, 'part')}")
        for c in clusters[:_LEGEND_CLUSTERS]
    ]
    more = len(clusters) - len(legend)
    if others:
        legend.append(LegendEntry(BACKDROP, "ground, and parts outside all clusters"))
    told = f"Every connected structure in a colour of its own, {len(clusters)} in all"
    told += f"; the legend names the {_LEGEND_CLUSTERS} largest." if more > 0 else "."
    return Picture(
        "clusters", "By cluster", told, f"The scene coloured by cluster: {_counted(len(clusters), 'cluster')}.",
        image, tuple(legend), camera,
    )  # fmt: skip


def _structure(
    ready: _Ready, cluster: Cluster, title: str, overview: Camera, size: tuple[int, int], letters: float
) -> Picture | None:
    graph, renderer = ready.graph, ready.renderer
    members = {part.id for part in graph.parts(cluster=cluster.id)}
    inside = ready.meshes_of(members)
    meshes = np.flatnonzero(inside & (np.diff(ready.scene.face_offsets) > 0))
    if not len(ready.renderer.points(meshes)):
        return None
    paint, hatched, legend = _group_paint(ready, inside)
    units, ends, edges = _functions_of(graph, members)
    # A structure that is nearly everything would look as in the overview: it is shown from the other side.
    unlike = -overview.forward if len(meshes) > _NEARLY_ALL * ready.scene.n_meshes else None
    aspect = ready.config.width / ready.config.height
    direction = three_quarter_view(renderer, meshes, alone=True, aspect=aspect, unlike=unlike)
    camera = frame(renderer.points(meshes), direction, size, margin=MARGIN)
    image = renderer.picture(camera, Paint(paint, hatched, ghosted=~inside), _grounded(ready, meshes))
    open_ends = [end for end in ends if end.kind != "blind"]
    image, tagged = _related(ready, image, camera, units, edges, letters, open_ends)
    untagged = _untagged(len(units) + len(open_ends), tagged)
    contents = _contents(cluster, units, edges)
    extent = " × ".join(f"{high - low:.2f}" for low, high in zip(*cluster.aabb, strict=True))
    return Picture(
        f"structure-{cluster.id}", title, f"{contents}; {extent} m. {untagged}".strip(),
        f"Structure {cluster.id} coloured by group, all else faint: {contents}.", image, legend, camera,
    )  # fmt: skip


def _functions_of(graph: SceneGraph, members: set[str]) -> tuple[list[Unit], list[Terminal], list[Edge]]:
    """The units, ends of lines and drawn edges of some parts."""
    units = [unit for unit in graph.units() if members.intersection(unit.parts)]
    ends = [end for end in graph.of_layer(Terminal) if members.intersection(end.parts)]
    junctions = [junction for junction in graph.of_layer(Junction) if members.intersection(junction.parts)]
    names = {*(unit.id for unit in units), *(end.id for end in ends), *(junction.id for junction in junctions)}
    return units, ends, [edge for edge in _drawn_edges(graph) if edge.source in names and edge.target in names]


def _contents(cluster: Cluster, units: Sequence[Unit], edges: Sequence[Edge]) -> str:
    """How many of what a structure holds, as text."""
    types = Counter(unit.unit_type for unit in units)
    counts = [_counted(count, name) for name, count in types.items()]
    return ", ".join([_counted(cluster.n_parts, "part"), *counts, _counted(len(edges), _edge_word(edges))])


def _edge_word(edges: Sequence[Edge]) -> str:
    """What drawn edges are called: relations where they are those of Algorithm 1."""
    return "relation" if any(isinstance(edge, Related) for edge in edges) else "connection"


def _grounded(ready: _Ready, meshes: Ints) -> Look:
    """A floor only where the structure stands on the scene's own ground: else its shadow would hang in the air."""
    low, high = ready.heights
    lowest = float(ready.renderer.points(meshes)[:, 2].min())
    return replace(ready.look, floor=lowest - low < 0.1 * (high - low))


def _group_paint(
    ready: _Ready, inside: Bools | None = None
) -> tuple[npt.NDArray[np.float32], Bools, tuple[LegendEntry, ...]]:
    """Colours and stripes of all meshes, and the legend of those inside."""
    kinds, ground = ready.kind_of_mesh, len(ready.colors)
    colors = [*ready.colors.values(), BACKDROP, UNLABELLED]
    hatched = kinds > ground
    used = set(np.unique(kinds if inside is None else kinds[inside]).tolist())
    legend = [LegendEntry(color, group) for row, (group, color) in enumerate(ready.colors.items()) if row in used]
    if ground + 1 in used:
        legend.append(LegendEntry(UNLABELLED, "unlabelled", hatched=True))
    return np.array([from_hex(color) for color in colors], np.float32)[kinds], hatched, tuple(legend)


def _untagged(wanted: int, tagged: int) -> str:
    """What a caption says about tags that found no room."""
    return f"{wanted - tagged} of {wanted} tags are left out for lack of room." if tagged < wanted else ""


def _related(
    ready: _Ready, image: Image.Image, camera: Camera, units: Sequence[Unit], edges: Sequence[Edge],
    letters: float = 1.0, open_ends: Sequence[Terminal] = (),
) -> Annotated:  # fmt: skip
    """Draws units, connections and open ends over a picture."""
    crowded = len(units) > _CROWDED
    pairs = sorted({(min(e.source, e.target), max(e.source, e.target)) for e in edges})
    segments = _lines(ready, edges, 3.0 if crowded else 4.5)
    marks = [Mark(_local(ready, unit.centroid), RELATION, 4.5 if crowded else 7.0) for unit in units]
    ends = {name for pair in pairs for name in pair if not isinstance(ready.graph.nodes[name], Unit)}
    ends.update(end.id for end in open_ends)
    marks += [Mark(_place(ready, name), _END, 4.5) for name in sorted(ends)]
    # What there are few of is what people look for first.
    count = Counter(unit.unit_type for unit in units)
    tags = [
        Tag(_local(ready, unit.centroid), unit.tag, ready.unit_colors.get(unit.unit_type, _END))
        for unit in sorted(units, key=lambda unit: count[unit.unit_type])
    ]
    tags += [Tag(_local(ready, end.point), end.id, _END) for end in open_ends]
    return annotate(
        image,
        camera,
        segments=segments,
        marks=marks,
        tags=tags,
        size=letters,
        clutter=_CLUTTER if crowded else math.inf,
    )


def _lines(ready: _Ready, edges: Sequence[Edge], width: float) -> list[Segment]:
    """Connections along their pipes, with a thinner lead from there to a unit's ball; relations straight."""
    found: dict[tuple[Point, Point], float] = {}
    for edge in edges:
        path = [_local(ready, point) for point in edge.path] if isinstance(edge, Connected) else []
        start, end = _place(ready, edge.source), _place(ready, edge.target)
        if len(path) < 2:
            found.setdefault((min(start, end), max(start, end)), width)
            continue
        for a, b in pairwise(path):
            found.setdefault((min(a, b), max(a, b)), width)
        for a, b in ((start, path[0]), (path[-1], end)):
            found.setdefault((min(a, b), max(a, b)), width * _LEAD)
    return [Segment(a, b, RELATION, size) for (a, b), size in sorted(found.items()) if a != b]


def _place(ready: _Ready, name: str) -> Point:
    node = ready.graph.nodes[name]
    if isinstance(node, Junction | Terminal):
        return _local(ready, node.point)
    if isinstance(node, Unit | Part | Cluster):
        return _local(ready, node.centroid)
    raise ValueError(f"node {name!r} of layer {node.layer!r} has no place in the picture, so no relation can end there")


def _local(ready: _Ready, point: Point) -> Point:
    x, y, z = ready.scene.origin.tolist()
    return point[0] - x, point[1] - y, point[2] - z


def _smaller(size: tuple[int, int]) -> tuple[int, int]:
    """The size of pictures side by side; even, so that what is only hinted at can be drawn at half of it."""
    width, height = size
    return 2 * round(_SIDE_BY_SIDE * width / 2), 2 * round(_SIDE_BY_SIDE * height / 2)


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}" + ("" if count == 1 else "s")
