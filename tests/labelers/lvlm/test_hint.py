import numpy as np
import pytest

import plates
import shapes
import tubes
from cadgraph.labelers.lvlm.hint import Hints
from cadgraph.model.scene import Scene


def wheel():
    arms = [
        tubes.pipe(np.outer([0.02, 0.15], [np.cos(a), np.sin(a), 0]), 0.006, 12) for a in np.arange(5) * 0.4 * np.pi
    ]
    pieces = [tubes.elbow(0.15, 0.01, 2 * np.pi, 60, 12), shapes.cylinder(0.03, 0.04), *arms]
    starts = np.cumsum([0, *(len(v) for v, _ in pieces)])
    faces = [f + s for (_, f), s in zip(pieces, starts[:-1], strict=True)]
    return np.concatenate([v for v, _ in pieces]), np.concatenate(faces)


def hint(mesh):
    parts = plates.parts_of(Scene.from_meshes([mesh]))
    return Hints(parts, {}).lines(0, 1, [None])[0]


FORMS = {
    "tube": (
        shapes.tube(0.05, 0.04, 0.3),
        "a cylinder, outer diameter 100 mm, 300 mm long, open along its axis with a bore of 80 mm",
    ),
    "rod": (shapes.cylinder(0.05, 0.3), "a cylinder, outer diameter 100 mm, 300 mm long, without a bore"),
    "disc": (shapes.cylinder(0.1, 0.02), "a flat disc, outer diameter 200 mm, 20 mm long, without a bore"),
    "ring": (
        shapes.tube(0.1, 0.05, 0.02),
        "a flat ring, outer diameter 200 mm, 20 mm long, open along its axis with a bore of 100 mm",
    ),
    "ball": (shapes.sphere(0.05), "a sphere, outer diameter 100 mm"),
    "cone": (
        shapes.lathe([(0, 0), (0.1, 0), (0.05, 0.2), (0, 0.2)]),
        "a cone, outer diameter 200 mm, 200 mm long, without a bore",
    ),
    "wheel": (wheel(), "a ring with 5 spokes, outer diameter 320 mm"),
    "bend": (
        tubes.elbow(0.2, 0.03, np.pi / 2, 24, 24),
        "a bent tube of one round section, outer diameter 60 mm, 314 mm along its middle",
    ),
    "box": (shapes.box((0.3, 0.2, 0.1)), "a box"),
    "profile": (shapes.tube(0.1, 0.09, 2, 4), "one cross-section all along an axis, 2 m long"),
    "tee": (tubes.tee(0.05, 0.045, 0.2, 0.2), "none of the simple solids, with 3 round ends"),
}


@pytest.mark.parametrize("name", FORMS)
def test_form_and_sizes_are_said_in_words(name):
    mesh, words = FORMS[name]
    assert hint(mesh) == f"its form is {words}"
