"""The head that is lost in a link by the flow through it, and how that changes with the flow.

Friction is that of Darcy and Weisbach as EPANET 2.2 takes it (Users Manual, section 3.1; its source, ``hydcoeffs.c``):
64/Re below a Reynolds number of 2,000, the formula of Swamee and Jain above 4,000, a cubic between. Every law here
rises with the flow, so that a network has one solution.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from cadgraph.hydraulics.settings import GRAVITY

__all__ = ["CREEP", "Friction", "area", "quadratic"]

Array = npt.NDArray[np.float64]

CREEP = 1e-3
"""Velocity below which a quadratic loss goes over into a linear one, so that it has a slope at rest [m/s]; ours."""
_LAMINAR, _TURBULENT = 2000.0, 4000.0
_AT_TURBULENT = 5.74 / _TURBULENT**0.9
_LOG = -2.0 / np.log(10.0)


def area(diameter: Array) -> Array:
    """The area of a bore [m2].

    Args:
        diameter: m.
    """
    return np.pi / 4 * diameter**2


def quadratic(q: Array, coefficient: Array, creep: Array) -> tuple[Array, Array]:
    """A loss that grows with the square of the flow, and its slope.

    Args:
        q: (..., n_links) flows [m3/s].
        coefficient: likewise, of the square [s2/m5].
        creep: (n_links,) flows below which the law is about linear [m3/s].

    Returns:
        Head [m] and slope [s/m2], both (..., n_links).
    """
    size = np.sqrt(q * q + creep * creep)
    return coefficient * q * size, coefficient * (2 * q * q + creep * creep) / size


@dataclass(frozen=True)
class Friction:
    """The friction of links; those without length have none.

    Args:
        laminar: (n_links,) head per flow in laminar flow [s/m2].
        square: (n_links,) head per square of the flow at a friction factor of 1 [s2/m5].
        reynolds: (n_links,) Reynolds number per flow [s/m3].
        rough: (n_links,) roughness by 3.7 diameters.
    """

    laminar: Array
    square: Array
    reynolds: Array
    rough: Array

    @classmethod
    def of(cls, length: Array, diameter: Array, roughness: float, viscosity: float) -> Friction:
        """The friction of round pipes.

        Args:
            length: (n_links,) [m].
            diameter: (n_links,) [m].
            roughness: of the wall [m].
            viscosity: kinematic [m2/s].
        """
        return cls(
            laminar=128 * viscosity * length / (np.pi * GRAVITY * diameter**4),
            square=length / diameter / (2 * GRAVITY * area(diameter) ** 2),
            reynolds=4 / (np.pi * diameter * viscosity),
            rough=roughness / (3.7 * diameter),
        )

    def loss(self, q: Array) -> tuple[Array, Array]:
        """The head lost and its slope.

        Args:
            q: (..., n_links) flows [m3/s].

        Returns:
            Head [m] and slope [s/m2], both (..., n_links).
        """
        size = np.abs(q)
        reynolds = self.reynolds * size
        # Each law is worked out where another holds as well, but at a number where it stays finite.
        turbulent, turbulent_slope = self._turbulent(np.maximum(reynolds, _TURBULENT))
        middle, middle_slope = self._transitional(np.clip(reynolds, _LAMINAR, _TURBULENT))
        rough = reynolds >= _TURBULENT
        factor = np.where(rough, turbulent, middle)
        by_reynolds = np.where(rough, turbulent_slope, middle_slope)
        smooth = reynolds <= _LAMINAR
        head = np.where(smooth, self.laminar * q, self.square * factor * q * size)
        slope = np.where(
            smooth, self.laminar, self.square * (2 * factor * size + by_reynolds * self.reynolds * size * size)
        )
        return head, slope

    def _turbulent(self, reynolds: Array) -> tuple[Array, Array]:
        """The factor of Swamee and Jain, and its slope by the Reynolds number."""
        smooth = 5.74 / reynolds**0.9
        inner = self.rough + smooth
        root = _LOG * np.log(inner)
        factor = 1 / root**2
        return factor, 1.8 * factor * _LOG * smooth / (inner * root * reynolds)

    def _transitional(self, reynolds: Array) -> tuple[Array, Array]:
        """The cubic between laminar and turbulent flow (Dunlop), and its slope by the Reynolds number."""
        a, b, c, d = self._cubic
        share = reynolds / _LAMINAR
        return a + share * (b + share * (c + share * d)), (b + share * (2 * c + 3 * share * d)) / _LAMINAR

    @cached_property
    def _cubic(self) -> tuple[Array, Array, Array, Array]:
        """The coefficients of that cubic."""
        inner = self.rough + _AT_TURBULENT
        root = _LOG * np.log(inner)
        first = 1 / root**2
        second = (2 + 0.9 * _LOG * 2 * _AT_TURBULENT / (inner * root)) * first
        return (
            7 * first - second,
            0.128 - 17 * first + 2.5 * second,
            -0.128 + 13 * first - 2 * second,
            0.032 - 3 * first + 0.5 * second,
        )
