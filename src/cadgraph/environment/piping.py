"""Pipes, bends and branch outlets."""

from __future__ import annotations

from functools import cache

import numpy as np

from cadgraph.environment.frame import arc
from cadgraph.environment.hand import Hand
from cadgraph.environment.plant import Assembly, Component
from cadgraph.environment.solid import Solid, loft, tube, weld
from cadgraph.environment.standard import ELBOW_LONG_RADIUS, PIPES
from cadgraph.scene import Floats

__all__ = ["bend_tangent", "elbow", "outlet", "pipe", "spool"]


@cache
def _pipe_solid(dn: int, length: float, hand: Hand) -> Solid:
    size = PIPES[dn]
    path = np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]])
    return tube(path, size.radius, size.bore if hand.hollow else 0.0, hand.round(size.radius))


def pipe(dn: int, length: float, hand: Hand) -> Assembly:
    """A straight pipe along x from 0 to ``length`` [m]."""
    solid = _pipe_solid(dn, round(length, 9), hand)
    return Assembly((Component(solid, "Pipe assembly", "pipe", hand.color("pipe")),))


def bend_tangent(radius: float, first: Floats, second: Floats) -> float:
    """How far before the corner a bend of this radius begins, for unit directions of its two legs [m]."""
    turn = np.arccos(np.clip(first @ second, -1, 1))
    return float(radius * np.tan(turn / 2))


@cache
def _elbow_solid(dn: int, turn: float, hand: Hand) -> Solid:
    size, radius = PIPES[dn], ELBOW_LONG_RADIUS[dn]
    reach = radius * np.tan(turn / 2)
    end = np.array([reach + reach * np.cos(turn), reach * np.sin(turn), 0.0])
    path = arc((0.0, 0.0, 0.0), (reach, 0.0, 0.0), end, hand.bend(radius + size.radius, turn))
    return tube(path, size.radius, size.bore if hand.hollow else 0.0, hand.round(size.radius))


def elbow(dn: int, turn: float, hand: Hand) -> Assembly:
    """A long-radius elbow from the origin along +x that turns towards +y by ``turn`` [rad]."""
    solid = _elbow_solid(dn, round(turn, 9), hand)
    return Assembly((Component(solid, "Pipe assembly", "elbow", hand.color("pipe")),))


def spool(dn: int, path: Floats, hand: Hand) -> Assembly:
    """A bent pipe as one mesh along a path in outer coordinates, ``(n, 3)`` [m]."""
    size = PIPES[dn]
    solid = tube(path, size.radius, size.bore if hand.hollow else 0.0, hand.round(size.radius))
    return Assembly((Component(solid, "Pipe assembly", "pipe", hand.color("pipe")),))


@cache
def _outlet_solid(dn: int, foot: float, top: float, height: float, hand: Hand) -> Solid:
    radius = PIPES[dn].radius
    sides = hand.round(radius)
    foot = min(foot, 0.85 * radius)
    sunk = radius * (1 - np.cos(np.pi / sides)) + 0.0001
    angles = np.arange(24) * 2 * np.pi / 24
    x, y = foot * np.cos(angles), foot * np.sin(angles)
    saddle = np.column_stack([x, y, np.sqrt(radius**2 - y**2) - sunk])
    collar = np.column_stack([x, y, np.full(24, radius + 0.35 * height)])
    ring = np.column_stack([top * np.cos(angles), top * np.sin(angles), np.full(24, radius + height)])
    poles = [np.array([[0.0, 0.0, radius - sunk]]), np.array([[0.0, 0.0, radius + height]])]
    return weld([loft([poles[0], saddle, collar, ring, poles[1]])])


def outlet(dn: int, hand: Hand, foot: float = 0.012, top: float = 0.0095, height: float = 0.024) -> Assembly:
    """A welded branch outlet (after MSS SP-97) for an instrument; the pipe lies along x through the origin.

    Its saddle follows the pipe and bites less than 0.5 mm into it; its top is at radius + ``height`` over the axis.
    """
    solid = _outlet_solid(dn, foot, top, height, hand)
    return Assembly((Component(solid, "Pipe assembly", "branch outlet", hand.color("pipe")),))
