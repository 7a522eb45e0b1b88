"""Pipes, bends and branch outlets."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, Device
from cadplants.model.standards import ELBOW_LONG_RADIUS, PIPES, REDUCER_LENGTH, TEE_CENTER_TO_END
from cadplants.parts.long_fittings import long_reducer, ring
from cadplants.solids.mesh_ops import (
    Branch,
    Solid,
    about_x,
    branched,
    loft,
    planar,
    reverse,
    revolve,
    shared,
    tube,
    weld,
)
from cadplants.solids.transforms import arc
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["bend_tangent", "cap", "eccentric_reducer", "elbow", "outlet", "pipe", "reducer", "spool", "stub", "tee"]


@shared
def _pipe_solid(dn: int, length: float, style: ModelingStyle) -> Solid:
    size = PIPES[dn]
    path = np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]])
    return tube(path, size.radius, size.bore if style.hollow else 0.0, style.round(size.radius))


def pipe(dn: int, length: float, style: ModelingStyle) -> Assembly:
    """A straight pipe along x from 0 to ``length`` [m]."""
    solid = _pipe_solid(dn, round(length, 9), style)
    return Assembly((Component(solid, "Pipe assembly", "pipe", style.color("pipe")),))


def bend_tangent(radius: float, first: Floats, second: Floats) -> float:
    """How far before the corner a bend of this radius begins, for unit directions of its two legs [m]."""
    turn = np.arccos(np.clip(first @ second, -1, 1))
    return float(radius * np.tan(turn / 2))


@shared
def _elbow_solid(dn: int, turn: float, style: ModelingStyle) -> Solid:
    size, radius = PIPES[dn], ELBOW_LONG_RADIUS[dn]
    reach = radius * np.tan(turn / 2)
    end = np.array([reach + reach * np.cos(turn), reach * np.sin(turn), 0.0])
    path = arc((0.0, 0.0, 0.0), (reach, 0.0, 0.0), end, style.bend(radius + size.radius, turn))
    return tube(path, size.radius, size.bore if style.hollow else 0.0, style.round_fitting(size.radius))


def elbow(dn: int, turn: float, style: ModelingStyle) -> Assembly:
    """A long-radius elbow from the origin along +x that turns towards +y by ``turn`` [rad]."""
    solid = _elbow_solid(dn, round(turn, 9), style)
    return Assembly((Component(solid, "Pipe assembly", "elbow", style.color("pipe")),))


def spool(dn: int, path: Floats, style: ModelingStyle) -> Assembly:
    """A bent pipe as one mesh along a path in outer coordinates, ``(n, 3)`` [m]."""
    size = PIPES[dn]
    solid = tube(path, size.radius, size.bore if style.hollow else 0.0, style.round(size.radius))
    return Assembly((Component(solid, "Pipe assembly", "pipe", style.color("pipe")),))


@shared
def _outlet_solid(dn: int, foot: float, top: float, height: float, style: ModelingStyle) -> Solid:
    radius = PIPES[dn].radius
    sides = style.round(radius)
    foot = min(foot, 0.85 * radius)
    if style.devices == "primitives":
        return _snout(radius, foot, top, height, style)
    sunk = radius * (1 - np.cos(np.pi / sides)) + 0.0001
    angles = np.arange(24) * 2 * np.pi / 24
    x, y = foot * np.cos(angles), foot * np.sin(angles)
    saddle = np.column_stack([x, y, np.sqrt(radius**2 - y**2) - sunk])
    collar = np.column_stack([x, y, np.full(24, radius + 0.35 * height)])
    ring = np.column_stack([top * np.cos(angles), top * np.sin(angles), np.full(24, radius + height)])
    poles = [np.array([[0.0, 0.0, radius - sunk]]), np.array([[0.0, 0.0, radius + height]])]
    return weld([loft([poles[0], saddle, collar, ring, poles[1]])])


def _snout(radius: float, foot: float, top: float, height: float, style: ModelingStyle) -> Solid:
    """An outlet as a bare cone, a bare cylinder or a cylinder with a flared foot, which runs into its pipe; how coarse
    the style is decides which [m].
    """
    low, high, sides = 0.5 * radius, radius + height, style.round(foot)
    kind = (style.sides[0] // 2 + style.sides[1] // 2 + round(style.sag * 1e7)) % 3
    if kind == 0:
        outline = [(0.0, low), (foot, low), (top, high), (0.0, high)]
    elif kind == 1:
        outline = [(0.0, low), (top, low), (top, high), (0.0, high)]
    else:
        flare = radius + 0.4 * height
        outline = [(0.0, low), (1.4 * foot, low), (1.4 * foot, radius), (top, flare), (top, high), (0.0, high)]
    return weld([revolve(outline, sides)])


def outlet(dn: int, style: ModelingStyle, foot: float = 0.012, top: float = 0.0095, height: float = 0.024) -> Assembly:
    """A welded branch outlet (after MSS SP-97) for an instrument; the pipe lies along x through the origin.

    Its saddle follows the pipe and bites less than 0.5 mm into it; its top is at radius + ``height`` over the axis.
    """
    solid = _outlet_solid(dn, foot, top, height, style)
    return Assembly((Component(solid, "Pipe assembly", "branch outlet", style.color("pipe")),))


@shared
def _tee_solid(dn: int, branch: int, style: ModelingStyle) -> Solid:
    size, small, reach = PIPES[dn], PIPES[branch], TEE_CENTER_TO_END[dn]
    sides, long = style.round_fitting(size.radius), style.fittings == "long"
    # A branch of the same size is a hair narrower, so that its foot does not reach round to the other side.
    foot = min(small.radius, 0.985 * size.radius)
    shells = []
    rims = []
    for radius, narrow, end in (
        (size.radius, foot, small.radius),
        (size.bore, min(small.bore, 0.985 * size.bore), small.bore),
    ):
        if not style.hollow and radius != size.radius:
            continue
        profile = [(radius, 0.0), (radius, 2 * reach)]
        out = ((end, 0.6 * (reach - size.radius) + size.radius), (end, reach))
        shell, (rim,) = branched(profile, sides, [Branch(reach, np.pi / 2, narrow, out)], 1 if long else 2, long)
        shells.append(shell if radius == size.radius else reverse(shell))
        rims.append(rim)
    if not style.hollow:
        poles = [
            revolve([(0.0, 0.0), (size.radius, 0.0)], sides),
            revolve([(size.radius, 2 * reach), (0.0, 2 * reach)], sides),
        ]
        lid = loft([rims[0], rims[0].mean(axis=0, keepdims=True)])
        return about_x(weld([*shells, *poles, lid]))
    ends = [revolve([(size.bore, 0.0), (size.radius, 0.0)], sides)]
    ends.append(revolve([(size.radius, 2 * reach), (size.bore, 2 * reach)], sides))
    # The mouth of the branch looks to +y; in its plane x and z swap to keep the turn counter-clockwise.
    flat = planar(rims[0][:, [2, 0]], (rims[1][:, [2, 0]],), reach)
    mouth = Solid(flat.vertices[:, [1, 2, 0]], flat.faces)
    return about_x(weld([*shells, *ends, mouth]))


def tee(dn: int, branch: int, style: ModelingStyle) -> Device:
    """A butt-welding tee along x with its branch towards +z from the middle; its mouth is as far as its ends."""
    component = Component(_tee_solid(dn, branch, style), "Pipe assembly", "tee", style.color("pipe"))
    return Device(Assembly((component,)), 2 * TEE_CENTER_TO_END[dn])


@shared
def _reducer_solid(dn: int, other: int, style: ModelingStyle) -> Solid:
    if style.fittings == "long":
        return long_reducer(dn, other, style)
    first, last = PIPES[dn], PIPES[other]
    length = REDUCER_LENGTH[max(dn, other)]
    shares = (0.0, 0.12, 0.3, 0.5, 0.7, 0.88, 1.0)
    ease = [0.5 - 0.5 * np.cos(np.pi * min(max((s - 0.12) / 0.76, 0.0), 1.0)) for s in shares]
    outside = [(first.radius + e * (last.radius - first.radius), s * length) for e, s in zip(ease, shares, strict=True)]
    inside = [(first.bore + e * (last.bore - first.bore), s * length) for e, s in zip(ease, shares, strict=True)]
    sides = style.round(max(first.radius, last.radius))
    if style.hollow:
        return about_x(weld([revolve([*outside, *inside[::-1]], sides, closed=True)]))
    return about_x(weld([revolve([(0.0, 0.0), *outside, (0.0, length)], sides)]))


def reducer(dn: int, other: int, style: ModelingStyle) -> Device:
    """A concentric butt-welding reducer along x from one size to another."""
    component = Component(_reducer_solid(dn, other, style), "Pipe assembly", "reducer", style.color("pipe"))
    return Device(Assembly((component,)), REDUCER_LENGTH[max(dn, other)])


@shared
def _eccentric_solid(dn: int, other: int, style: ModelingStyle) -> Solid:
    if style.fittings == "long":
        return long_reducer(dn, other, style, eccentric=True)
    first, last, length = PIPES[dn], PIPES[other], REDUCER_LENGTH[max(dn, other)]
    sides = style.round(max(first.radius, last.radius))
    shares = (0.0, 0.12, 0.3, 0.5, 0.7, 0.88, 1.0)
    ease = [0.5 - 0.5 * np.cos(np.pi * min(max((s - 0.12) / 0.76, 0.0), 1.0)) for s in shares]
    rise = first.radius - last.radius

    def skin(start: float, end: float) -> list[Floats]:
        return [ring(s * length, start + e * (end - start), sides, e * rise) for e, s in zip(ease, shares, strict=True)]

    outside = skin(first.radius, last.radius)
    if style.hollow:
        return weld([loft([*outside, *skin(first.bore, last.bore)[::-1]], closed=True)])
    poles = [np.array([[0.0, 0.0, 0.0]]), np.array([[length, 0.0, rise]])]
    return weld([loft([poles[0], *outside, poles[1]])])


def eccentric_reducer(dn: int, other: int, style: ModelingStyle) -> Device:
    """A reducer along x with a flat top, as before pumps: the axis of its other end lies higher."""
    component = Component(_eccentric_solid(dn, other, style), "Pipe assembly", "reducer", style.color("pipe"))
    return Device(Assembly((component,)), REDUCER_LENGTH[max(dn, other)])


@shared
def _cap_solid(dn: int, style: ModelingStyle) -> Solid:
    size = PIPES[dn]
    angles = np.linspace(0, np.pi / 2, 7)
    skirt, depth = 0.3 * size.radius, 0.5 * size.radius
    wall = size.radius - size.bore
    outside = [(size.radius, 0.0)] + [(size.radius * np.cos(a), skirt + (depth + wall) * np.sin(a)) for a in angles]
    outside[-1] = (0.0, skirt + depth + wall)
    inside = [(0.0, skirt + depth)] + [(size.bore * np.cos(a), skirt + depth * np.sin(a)) for a in angles[::-1][1:]]
    inside.append((size.bore, 0.0))
    shell = revolve([*outside, *inside], style.round(size.radius))
    lip = revolve([(size.bore, 0.0), (size.radius, 0.0)], style.round(size.radius))
    if style.hollow:
        return about_x(weld([shell, lip]))
    return about_x(weld([revolve([(0.0, 0.0), *outside], style.round(size.radius))]))


def cap(dn: int, style: ModelingStyle) -> Assembly:
    """A butt-welding pipe cap (ASME B16.9), its open end at x = 0, its dome towards +x."""
    return Assembly((Component(_cap_solid(dn, style), "Pipe assembly", "pipe cap", style.color("pipe")),))


@shared
def _stub_solid(dn: int, radius: float, length: float, sunk: float, style: ModelingStyle) -> Solid:
    size = PIPES[dn]
    sides = style.round(size.radius)
    angles = np.arange(sides) * 2 * np.pi / sides
    loops = []
    for r in (size.radius, size.bore) if style.hollow else (size.radius,):
        x, y = r * np.cos(angles), r * np.sin(angles)
        foot = np.sqrt(radius**2 - y**2) - sunk if radius else np.full(sides, -sunk)
        loops.append((np.column_stack([x, y, foot]), np.column_stack([x, y, np.full(sides, radius + length)])))
    if style.hollow:
        (foot, top), (inner_foot, inner_top) = loops
        return weld([loft([foot, top, inner_top, inner_foot], closed=True)])
    foot, top = loops[0]
    return weld([loft([foot.mean(axis=0, keepdims=True), foot, top, top.mean(axis=0, keepdims=True)])])


def stub(
    dn: int, radius: float, length: float, sunk: float, style: ModelingStyle, group: str, name: str, color: str
) -> Assembly:
    """A piece of pipe set on a cylinder of this radius about x, or on a plane where the radius is 0, towards +z.

    Args:
        dn: of the piece.
        radius: of what it stands on [m].
        length: over it [m].
        sunk: how deep its foot bites [m].
        style: that models it.
        group: of its label.
        name: of its label.
        color: kind of material.
    """
    solid = _stub_solid(dn, round(radius, 9), round(length, 9), sunk, style)
    return Assembly((Component(solid, group, name, style.color(color)),))
