"""Parts of a kind that no plant has, for tests of catalogues and corrections."""

import numpy as np

import shapes


def knob(radius=0.05, waist=0.4, height=0.06, sides=24):
    """A knob: a dish, a thin neck and a ball-like head; neither a prism nor known to the vocabulary."""
    r, h = radius, height
    return shapes.lathe(
        [(0, 0), (r, 0), (r, 0.15 * h), (waist * r, 0.4 * h), (0.7 * r, 0.75 * h), (0.5 * r, h), (0, 1.05 * h)], sides
    )


def hook(size=0.1):
    """Three boxes that no mirror image of it can be turned into."""
    pieces = [
        shapes.box((1.0, 0.2, 0.2), (0, 0, 0)),
        shapes.box((0.2, 0.6, 0.2), (0.4, 0.4, 0)),
        shapes.box((0.2, 0.2, 0.9), (-0.4, 0, 0.55)),
    ]
    vertices = np.concatenate([v for v, _ in pieces]) * size
    faces = np.concatenate([f + 8 * k for k, (_, f) in enumerate(pieces)])
    return vertices, faces


def mirrored(mesh):
    vertices, faces = mesh
    return vertices * [-1.0, 1.0, 1.0], faces[:, ::-1]


def turn_of(angles):
    a, b, c = angles
    x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    return x @ y @ z
