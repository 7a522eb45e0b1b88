"""Small plants for tests, put together piece by piece, each with its label."""

from __future__ import annotations

import numpy as np

import shapes
import tubes
from cadgraph.config import Config
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.records import Connected, Junction, System, Terminal
from cadgraph.model.scene import Scene
from cadgraph.pipeline import build

PIPE, VALVE, GAUGE, PUMP, TANK = "Pipe assembly", "Valve assembly", "Gauge assembly", "Pump unit", "Tank"
STEEL, FASTENER = "Structural element", "Connection assembly"
R, BORE = 0.03015, 0.0264  # DN 50


def turned(mesh, point, direction):
    """A mesh about z from its own origin, moved to a point and turned so that z runs along a direction."""
    z = np.asarray(direction, float) / np.linalg.norm(direction)
    return shapes.moved(mesh, tubes._turn(np.array([0.0, 0.0, 1.0]), z), point)


def merged(*meshes):
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([np.asarray(f) + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


def pipe(start, end, radius=R, bore=BORE, sides=24):
    return tubes.pipe([start, end], radius, sides, bore, caps=bore is None)


def bend(start, corner, end, reach=0.076, radius=R, bore=BORE, steps=6, sides=24):
    """An elbow between two legs that it meets ``reach`` before and after the corner."""
    start, corner, end = (np.asarray(p, float) for p in (start, corner, end))
    a, b = (start - corner) / np.linalg.norm(start - corner), (end - corner) / np.linalg.norm(end - corner)
    angles = np.linspace(0, np.pi / 2, steps + 1)[:, None]
    middle = corner + reach * (a + b)
    path = middle - reach * (np.cos(angles) * b + np.sin(angles) * a)
    return tubes.pipe(path, radius, sides, bore, caps=bore is None)


def ring(point, direction, length=0.02, outer=0.075, inner=R):
    """A flange or gasket whose face towards ``-direction`` is at a point."""
    return turned(shapes.tube(outer, inner, length), np.add(point, np.multiply(direction, length / 2)), direction)


def plate(point, direction, length=0.02, outer=0.075):
    """A blind flange likewise."""
    return turned(shapes.cylinder(outer, length), np.add(point, np.multiply(direction, length / 2)), direction)


def valve_mesh(middle, direction=(1, 0, 0), length=0.178, up=(0, 0, 1)):
    """A whole valve as one mesh: flanged body, bonnet, wheel."""
    d, u = np.asarray(direction, float), np.asarray(up, float)
    middle = np.asarray(middle, float)
    body = turned(shapes.sphere(0.05), middle, d)
    barrel = turned(shapes.tube(0.04, R, length), middle, d)
    ends = [turned(shapes.tube(0.075, R, 0.016), middle + sign * (length / 2 - 0.008) * d, d) for sign in (-1, 1)]
    stem = turned(shapes.cylinder(0.012, 0.15), middle + 0.12 * u, u)
    wheel = turned(shapes.tube(0.08, 0.065, 0.012), middle + 0.19 * u, u)
    return merged(body, barrel, *ends, stem, wheel)


def gauge_mesh(foot, up=(0, 0, 1), side=(0, 1, 0), stem=0.06):
    """A gauge as one mesh: stem and case."""
    foot, u = np.asarray(foot, float), np.asarray(up, float)
    return merged(
        turned(shapes.cylinder(0.008, stem), foot + stem / 2 * u, u),
        turned(shapes.cylinder(0.035, 0.03), foot + (stem + 0.034) * u, side),
    )


class Plant:
    """Meshes with labels, in the order in which they are added."""

    def __init__(self):
        self.meshes, self.labels = [], []

    def add(self, mesh, group, name=None):
        self.meshes.append(mesh)
        self.labels.append((group, name))
        return self

    def pipe(self, start, end, **kind):
        return self.add(pipe(start, end, **kind), PIPE, "pipe")

    def graph(self, order=None, moved=None, **settings):
        order = list(range(len(self.meshes))) if order is None else order
        meshes = [self.meshes[i] if moved is None else moved(self.meshes[i]) for i in order]
        paths = [f"/m{i}" for i in range(len(meshes))]
        scene = Scene.from_meshes(meshes, paths)
        given = [GivenLabel(p, *self.labels[i]) for p, i in zip(paths, order, strict=True) if self.labels[i][0]]
        changes = {"label.labeler": "none", "ground.find": "none", **settings}
        return build(scene, Config().replace(changes), labels=given)


def tags(graph):
    return {unit.id: unit.tag for unit in graph.units()}


def links(graph):
    """The connections between units as pairs of tags, junctions and terminals by their letter."""
    names = tags(graph)
    names.update({node.id: "J" for node in graph.of_layer(Junction)})
    names.update({node.id: node.kind for node in graph.of_layer(Terminal)})
    return sorted(tuple(sorted((names[c.source], names[c.target]))) for c in graph.of_kind(Connected))


def connections(graph):
    return list(graph.of_kind(Connected))


def junctions(graph):
    return list(graph.of_layer(Junction))


def terminals(graph):
    return sorted(node.kind for node in graph.of_layer(Terminal))


def systems(graph):
    return list(graph.of_layer(System))
