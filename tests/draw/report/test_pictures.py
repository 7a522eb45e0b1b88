import numpy as np
import pytest

from cadgraph.config import ReportConfig
from cadgraph.draw.colors import RELATION, group_colors
from cadgraph.draw.report.overview import look_over
from cadgraph.draw.report.pictures import cluster_colors, draw_pictures, largest_first
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal

CONFIG = ReportConfig(width=240, height=150, samples=1)


def test_overviews_come_first_then_the_structures_with_pipes(scene, graph):
    pictures = draw_pictures(scene, graph, CONFIG)
    assert [p.name for p in pictures] == ["groups", "source", "clusters", "structure-cluster-000"]


def test_legend_names_the_groups_in_use_and_the_unlabelled(scene, graph):
    by_group = draw_pictures(scene, graph, CONFIG)[0]
    assert [e.text for e in by_group.legend] == [
        "Pipe assembly", "Valve assembly", "Gauge assembly", "Tank", "unlabelled",
    ]  # fmt: skip
    assert by_group.legend[-1].hatched


def test_relation_is_drawn_in_red_between_its_units(scene, graph):
    by_group = draw_pictures(scene, graph, CONFIG)[0]
    ends = [graph.unit(tag).centroid for tag in ("V-001", "G-001")]
    places, _ = by_group.camera.project(ends)
    column, row = (places[0] * 0.4 + places[1] * 0.6).astype(int)
    patch = np.asarray(by_group.image)[row - 2 : row + 3, column - 2 : column + 3].astype(int)
    assert (patch[..., 0] - patch[..., 2]).max() > 100
    assert RELATION.startswith("#e")


def test_graph_and_scene_far_out_agree(build_scene, build_graph):
    origin = (4.5e6, -2.4e7, 120.0)
    near = draw_pictures(build_scene(), build_graph(), CONFIG)
    far = draw_pictures(build_scene(origin), build_graph(origin), CONFIG)
    assert [p.image.tobytes() for p in near] == [p.image.tobytes() for p in far]


def test_overview_that_was_looked_at_before_gives_the_same_pictures(scene, graph):
    ground = _ground_of(scene, graph)
    plain = draw_pictures(scene, graph, CONFIG)
    ahead = draw_pictures(scene, graph, CONFIG, overview=lambda: look_over(scene, ground, CONFIG))
    assert [p.image.tobytes() for p in ahead] == [p.image.tobytes() for p in plain]


@pytest.mark.parametrize("of", ["another scene", "other ground", "another size", "other samples"])
def test_overview_of_something_else_is_not_used(of, build_scene, scene, graph):
    ground = _ground_of(scene, graph)
    config = {
        "another size": CONFIG.model_copy(update={"width": 200}),
        "other samples": ReportConfig(width=240, height=150, samples=2),
    }
    other = look_over(
        build_scene() if of == "another scene" else scene,
        np.arange(scene.n_meshes) == 0 if of == "other ground" else ground,
        config.get(of, CONFIG),
    )  # fmt: skip
    assert not other.is_of(scene, ground, CONFIG)
    pictures = draw_pictures(scene, graph, CONFIG, overview=lambda: other)
    assert [p.image.tobytes() for p in pictures] == [p.image.tobytes() for p in draw_pictures(scene, graph, CONFIG)]


def test_look_ends_where_nobody_waits_for_it(scene, graph):
    def stop():
        raise InterruptedError

    with pytest.raises(InterruptedError):
        look_over(scene, _ground_of(scene, graph), CONFIG, stop)


def _ground_of(scene, graph):
    ground = {mesh for part in graph.parts() if part.ground for mesh in part.meshes}
    return np.array([path in ground for path in scene.paths])


def test_largest_cluster_comes_first(graph):
    assert [c.id for c in largest_first(graph.clusters())] == ["cluster-000", "cluster-001", "cluster-002"]
    assert len(set(cluster_colors(graph).values())) == 3


def test_group_outside_the_vocabulary_gets_a_colour_of_its_own(build_graph):
    colors = group_colors(build_graph(vocabulary={"Rotor": {"names": ["blade"]}}))
    assert next(iter(colors)) == "Rotor"
    assert colors["Tank"] != colors["Rotor"]
    assert len(set(colors.values())) == len(colors)


def _crowd(build_graph, count):
    """The little plant's graph with more gauges than one picture has room for."""
    graph = build_graph()
    (x, y, z) = graph.unit("G-001").centroid
    more = tuple(
        graph.unit("G-001").model_copy(
            update={"id": f"unit-X-{i:03d}", "tag": f"X-{i:03d}", "centroid": (x - 0.01 * i, y, z)}
        )
        for i in range(count)
    )
    return SceneGraph(graph.document.model_copy(update={"nodes": (*graph.document.nodes, *more)}))


def test_caption_says_how_many_tags_found_no_room(scene, graph, build_graph):
    assert "left out" not in draw_pictures(scene, graph, CONFIG)[0].caption
    assert "tags are left out for lack of room" in draw_pictures(scene, _crowd(build_graph, 80), CONFIG)[0].caption


def test_open_ends_are_tagged_in_the_picture_of_their_structure(scene, build_graph):
    graph = build_graph()
    end = Terminal(id="terminal-000", kind="open", point=(1.0, 0.0, 0.0), parts=("part-00000",))

    def picture(more):
        document = graph.document.model_copy(update={"nodes": (*graph.document.nodes, *more)})
        return np.asarray(draw_pictures(scene, SceneGraph(document), CONFIG)[3].image).astype(int)

    changed = np.abs(picture([end]) - picture([end.model_copy(update={"kind": "blind"})])).sum(axis=2) > 60
    assert changed.sum() > 100
