"""Directions across another."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled

__all__ = ["Vector", "across"]

Vector: TypeAlias = tuple[float, float, float]


@compiled
def across(x: float, y: float, z: float) -> tuple[Vector, Vector]:
    """Two unit vectors across a unit vector and each other: any that will do, far from it by its least component."""
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        a, b, c = 0.0, -z, y
    elif abs(y) <= abs(z):
        a, b, c = z, 0.0, -x
    else:
        a, b, c = -y, x, 0.0
    long = np.sqrt(a * a + b * b + c * c)
    a, b, c = a / long, b / long, c / long
    return (a, b, c), (y * c - z * b, z * a - x * c, x * b - y * a)
