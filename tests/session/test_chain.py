"""A session keeps what a correction leaves as it was; what comes out is what a build anew gives, to the byte."""

import json

import numpy as np
import pytest

import cadgraph
from cadgraph.model.scene import Scene
from cadgraph.session.demo import DEMO_SCENE
from cadplants import make_riser, make_tank

CHAIN = (
    ("elbow", "Pipe assembly/tee"),
    ("valve body", "Pipe assembly/coupling"),
    ("bolt", "Pipe assembly/gasket"),
    ("gauge case", "Valve assembly/valve body"),
    ("flange", "Pipe assembly/pipe"),
)


def demo():
    return cadgraph.load(DEMO_SCENE)


def structures():
    """Two plants of one kind and another between them, apart from each other."""
    meshes, paths = [], []
    for number, plant in enumerate([make_riser(), make_tank(), make_riser()]):
        scene = plant.scene()
        for mesh, path in enumerate(scene.paths):
            vertices, faces = scene.mesh(mesh)
            meshes.append((vertices + np.array([20.0 * number, 0.0, 0.0]), faces))
            paths.append(f"/plant{number}{path}")
    return Scene.from_meshes(meshes, paths)


def told(graph):
    return json.dumps(graph.to_json())


@pytest.mark.slow
@pytest.mark.parametrize("plant", [demo, structures])
def test_a_chain_of_corrections_gives_the_bytes_of_a_build_with_all_of_them(plant):
    session = cadgraph.Session.start(plant())
    assert len(session.graph.clusters("pipe system")) == (1 if plant is demo else 3)
    session.prepare()
    start, texts = session.graph, [told(session.graph)]
    for name, label in CHAIN:
        part = next((p for p in session.graph.parts() if p.label is not None and p.label.name == name), None)
        if part is not None:
            session.correct(part.id, label)
            texts.append(told(session.graph))
    assert len(texts) > 4
    assert told(cadgraph.build(plant(), corrections=session.corrections)) == texts[-1]
    for text in reversed(texts[:-1]):
        session.undo()
        assert told(session.graph) == text
    # Parts are the very records that they were: only what changed is made anew.
    same = [new is old for new, old in zip(session.graph.parts(), start.parts(), strict=True)]
    assert sum(same) > len(same) / 4


def test_a_scene_without_meshes_is_prepared_too():
    session = cadgraph.Session.start(Scene.from_meshes([]))
    session.prepare()
    assert session.graph.parts() == []
