"""The built-in shapes of USD (Cube, Sphere, Cylinder, Cone, Capsule, Plane) as triangles.

Sizes and axes as in the OpenUSD schema ``usdGeom``; round shapes are inscribed: their corners lie on the true surface.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from cadgraph.model.scene import Faces, Floats

__all__ = ["SHAPES", "Shape"]

Shape = tuple[Floats, Faces]
Sizes = Mapping[str, float | str]


def _cube(sizes: Sizes, sides: int) -> Shape:
    half = _size(sizes, "size") / 2
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) * half
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], np.int32)
    return corners, quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def _sphere(sizes: Sizes, sides: int) -> Shape:
    radius = _size(sizes, "radius")
    tilt = np.linspace(-np.pi / 2, np.pi / 2, max(3, sides // 2) + 1)[1:-1]
    rings = [(radius * np.cos(t), radius * np.sin(t)) for t in tilt]
    return _turned([(0.0, -radius), *rings, (0.0, radius)], sides)


def _cylinder(sizes: Sizes, sides: int) -> Shape:
    half = _size(sizes, "height") / 2
    bottom, top = _two_radii(sizes)
    return _along_axis(_turned([(0.0, -half), (bottom, -half), (top, half), (0.0, half)], sides), sizes)


def _cone(sizes: Sizes, sides: int) -> Shape:
    half = _size(sizes, "height") / 2
    return _along_axis(_turned([(0.0, -half), (_size(sizes, "radius"), -half), (0.0, half)], sides), sizes)


def _capsule(sizes: Sizes, sides: int) -> Shape:
    half = _size(sizes, "height") / 2
    bottom, top = _two_radii(sizes)
    quarter = np.linspace(0, np.pi / 2, max(2, sides // 4) + 1)
    low = [(bottom * np.sin(t), -half - bottom * np.cos(t)) for t in quarter[1:]]
    high = [(top * np.cos(t), half + top * np.sin(t)) for t in quarter[:-1]]
    return _along_axis(_turned([(0.0, -half - bottom), *low, *high, (0.0, half + top)], sides), sizes)


def _plane(sizes: Sizes, sides: int) -> Shape:
    # Axis Z: width along x, length along y; X: width along z, length along y; Y: width along x, length along z.
    w, h = _size(sizes, "width") / 2, _size(sizes, "length") / 2
    x, y = np.array([-w, w, w, -w]), np.array([-h, -h, h, h])
    zero = np.zeros(4)
    points = {"X": [zero, y, -x], "Y": [x, zero, -y]}.get(str(sizes["axis"]), [x, y, zero])
    return np.column_stack(points), np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def _turned(profile: Sequence[tuple[float, float]], sides: int) -> Shape:
    """A closed surface about z from (radius, height) points, upward, whose first and last radius are 0."""
    angles = np.arange(sides) * 2 * np.pi / sides
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    rings: list[Floats] = []
    numbers: list[np.ndarray[tuple[int], np.dtype[np.int32]]] = []
    n = 0
    for radius, height in profile:
        size = 1 if radius == 0 else sides
        rings.append(np.column_stack([circle[:size] * radius, np.full(size, height)]))
        numbers.append(np.broadcast_to(np.arange(n, n + size, dtype=np.int32), (sides,)))
        n += size
    faces = []
    for low, high in zip(numbers[:-1], numbers[1:], strict=True):
        next_low, next_high = np.roll(low, -1), np.roll(high, -1)
        if low[0] != low[1]:
            faces.append(np.column_stack([low, next_low, next_high]))
        if high[0] != high[1]:
            faces.append(np.column_stack([low, next_high, high]))
    # Of radius 0 it is a line, without a face.
    return np.concatenate(rings), np.concatenate(faces or [np.zeros((0, 3), np.int32)])


def _along_axis(shape: Shape, sizes: Sizes) -> Shape:
    # Cyclic swaps are rotations: the triangles keep facing outward.
    points, faces = shape
    order = {"X": [2, 0, 1], "Y": [1, 2, 0]}.get(str(sizes["axis"]), [0, 1, 2])
    return points[:, order], faces


def _two_radii(sizes: Sizes) -> tuple[float, float]:
    if "radius" in sizes:
        return _size(sizes, "radius"), _size(sizes, "radius")
    return _size(sizes, "radiusBottom"), _size(sizes, "radiusTop")


def _size(sizes: Sizes, name: str) -> float:
    return float(sizes[name])


SHAPES: Mapping[str, tuple[tuple[str, ...], Callable[[Sizes, int], Shape]]] = {
    "Cube": (("size",), _cube),
    "Sphere": (("radius",), _sphere),
    "Cylinder": (("radius", "height", "axis"), _cylinder),
    "Cylinder_1": (("radiusBottom", "radiusTop", "height", "axis"), _cylinder),
    "Cone": (("radius", "height", "axis"), _cone),
    "Capsule": (("radius", "height", "axis"), _capsule),
    "Capsule_1": (("radiusBottom", "radiusTop", "height", "axis"), _capsule),
    "Plane": (("width", "length", "axis"), _plane),
}
"""For each type name: the attributes that it needs, and the function that makes triangles of them."""
