"""Small scenes for tests of the stage that finds relations: meshes, who says what of each, and what is likely."""

from __future__ import annotations

import numpy as np

import shapes
from cadgraph.config import Config
from cadgraph.model.labels import Evidence, Guess, Label
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import analyse
from cadgraph.stages.relate import RelateInput, connect_units
from cadgraph.stages.relate.role import find_roles
from cadgraph.stages.relate.trace import drop_shapeless, trace_lines
from piping import PIPE, R, pipe

VOCABULARY = default_vocabulary()
CLASSES = tuple((group, name) for group, held in VOCABULARY.groups.items() for name in held.names)
X, UP = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


class Sketch:
    """Meshes with what is said of them, numbered as they are added."""

    def __init__(self):
        self.meshes, self.labels, self.opinions, self.likely = [], [], [], []

    def add(self, mesh, group=None, name=None, sure=0.9, source="geometry", likely=None, opinion=None, guesses=()):
        """Adds a mesh and returns its number.

        Args:
            mesh: vertices and triangles.
            group: of its label; none where missing.
            name: of its label.
            sure: confidence of its label.
            source: who says so; what the labeler says is its own opinion.
            likely: probabilities by group and name; that of its label where missing.
            opinion: what the labeler says where somebody else has named it, as a label.
            guesses: of its label.
        """
        label = None if group is None else Label(group, name, sure, source, Evidence(), guesses=tuple(guesses))
        self.meshes.append(mesh)
        self.labels.append(label)
        self.opinions.append(label if source == "geometry" else opinion)
        said = {(group, name): sure} if group and name and source == "geometry" else {}
        self.likely.append(said if likely is None else likely)
        return len(self.meshes) - 1

    def pipe(self, start, end, source="geometry", **kind):
        return self.add(pipe(start, end, **kind), PIPE, "pipe", source=source)

    def given(self, known=True, **settings):
        """What relations are found from; without ``known`` the labeler's probabilities are missing."""
        scene = Scene.from_meshes(self.meshes, [f"/m{k}" for k in range(len(self.meshes))])
        config = Config().replace({"ground.find": "none", "group.max_volume": 0.0, **settings})
        analysis = analyse(scene, config)
        assert analysis.parts.meshes == tuple((k,) for k in range(len(self.meshes)))
        values = np.array([[said.get(one, 0.0) for one in CLASSES] for said in self.likely])
        probabilities = Probabilities(CLASSES, values) if known else None
        return RelateInput(analysis, self.labels, self.opinions, VOCABULARY, config, probabilities)

    def piping(self, **settings):
        """The lines and units as labels and shapes have them, before anything is recovered."""
        given = self.given(**settings)
        return drop_shapeless(trace_lines(given, find_roles(given.parts, given.labels, given.opinions)))

    def connected(self, **settings):
        """The network, the labels that agree with it, and what is said of it."""
        return connect_units(self.given(**settings))


def guess(group, name, sure):
    return Guess(group, name, sure)


def block(middle, size):
    """A box; what the pipes at it meet has no line of its own."""
    return shapes.box(np.broadcast_to(size, 3), middle)


# Where pipes of a length of 0.5 m meet a box about the origin: direction, and offset across it.
SIDES = {
    "one": [((1, 0, 0), (0, 0, 0))],
    "aligned": [((1, 0, 0), (0, 0, 0)), ((-1, 0, 0), (0, 0, 0))],
    "square": [((1, 0, 0), (0, 0, 0)), ((0, 0, 1), (0, 0, 0))],
    "two": [((1, 0, 0), (0, 0.07, 0)), ((1, 0, 0), (0, -0.07, 0))],
    "many": [((1, 0, 0), (0, 0, 0)), ((-1, 0, 0), (0, 0, 0)), ((0, 0, 1), (0, 0, 0))],
}


def around(size, sides, named_by="geometry", radius=R, **said):
    """A box with pipes at it, the box first, whose longest side is along y where sides differ.

    Args:
        size: of the box along x, y and z [m].
        sides: a key of ``SIDES``.
        named_by: who has named the pipes.
        radius: of the pipes [m].
        said: of the box, as ``Sketch.add`` takes it.
    """
    sketch = Sketch()
    sketch.add(block((0, 0, 0), size), **said)
    half = np.broadcast_to(size, 3) / 2
    for way, aside in SIDES[sides]:
        way = np.array(way, float)
        start = half * way + aside
        sketch.pipe(start, start + 0.5 * way, source=named_by, radius=radius, bore=0.85 * radius)
    return sketch
