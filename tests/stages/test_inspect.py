import numpy as np
import pytest

import cadgraph
import shapes
from cadgraph.config import InspectConfig
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene
from cadgraph.stages.inspect import inspect_meshes

MESHES = [shapes.box(), shapes.box(), shapes.box((0.2, 0.2, 0.2)), shapes.box(center=(3, 0, 0))]
PATHS = ["/outer", "/again", "/inner", "/other"]


def inspected(**settings):
    scene = Scene.from_meshes(MESHES, PATHS)
    kept, properties, told = inspect_meshes(scene, measure(scene), InspectConfig(**settings))
    return kept, properties, {d.code: d.meshes for d in told}


def test_odd_meshes_are_kept_and_told():
    kept, _, told = inspected()
    assert kept.paths == tuple(PATHS)
    assert told["duplicate-mesh"] == ("/again", "/outer")
    assert told["hidden-mesh"] == ("/inner",)


def test_they_are_left_out_if_set_and_named():
    kept, properties, told = inspected(exclude=("duplicate", "hidden"))
    assert kept.paths == ("/outer", "/other")
    assert len(properties.area) == 2
    assert properties.centroid[1] == pytest.approx([3, 0, 0])
    assert told["excluded"] == ("/again", "/inner")


@pytest.mark.parametrize(("what", "code"), [("duplicates", "duplicate-mesh"), ("hidden", "hidden-mesh")])
def test_what_is_switched_off_is_not_looked_for(what, code):
    assert code not in inspected(**{what: False})[2]


def test_a_scene_without_meshes_has_no_findings():
    scene = Scene.from_meshes([])
    assert inspect_meshes(scene, measure(scene), InspectConfig())[2] == ()


def test_every_mesh_is_in_a_part_or_named_as_excluded():
    config = cadgraph.Config().replace({"inspect.exclude": ["duplicate"], "label.labeler": "none"})
    graph = cadgraph.build(Scene.from_meshes(MESHES, PATHS), config)
    in_parts = {m for p in graph.parts() for m in p.meshes}
    excluded = {m for f in graph.diagnostics if f.code == "excluded" for m in f.meshes}
    assert in_parts | excluded == set(PATHS)
    assert not in_parts & excluded
    assert np.isclose(graph.part("/other").volume, 1.0)
