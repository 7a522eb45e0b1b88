"""Modelling sins: a hand's gaps, overlaps and unevenness; duplicates, hidden bodies and broken meshes at random."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.environment.frame import at
from cadgraph.environment.hand import Hand
from cadgraph.environment.plant import Assembly, Component, Plant
from cadgraph.environment.solid import Solid, box
from cadgraph.scene import Floats, Scene

__all__ = ["Sins", "loosen", "spoil"]

_LEAST_SCALE = 0.6  # thin parts (gaskets, washers) keep this share of their thickness


def loosen(assembly: Assembly, hand: Hand, seed: int) -> Assembly:
    """Leaves gaps and overlaps between parts and makes surfaces uneven, as this hand does; nothing else changes.

    Args:
        assembly: whose parts touch exactly.
        hand: ``gap`` and ``wobble`` are used.
        seed: of the sizes of gaps and waves.
    """
    if hand.gap == (0.0, 0.0) and not hand.wobble:
        return assembly
    rng = np.random.default_rng([seed, 8])
    components = []
    for component in assembly.components:
        gap = float(rng.uniform(*hand.gap))
        component = replace(component, pose=component.pose @ _shrunk(component.solid, gap), gap=gap)
        if hand.wobble:
            component = replace(component, solid=_uneven(component.solid, hand.wobble, rng))
        components.append(component)
    loose = replace(assembly, components=tuple(components))
    return replace(loose, contacts=(*loose.contacts, *_met(loose))) if hand.gap[0] < 0 or hand.wobble else loose


def _met(assembly: Assembly) -> list[tuple[int, int]]:
    """Pairs that were not meant to touch, but do since they grew."""
    from cadgraph.geometry.contact import touching

    meant = {tuple(sorted(pair)) for pair in assembly.contacts}
    scene = Scene.from_meshes([(c.vertices, c.faces) for c in assembly.components])
    return [(a, b) for a, b in touching(scene, 0.0).tolist() if (a, b) not in meant]


def _shrunk(solid: Solid, gap: float) -> Floats:
    """Takes half a gap off each side of a solid's box."""
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    middle, extent = (low + high) / 2, high - low
    scale = np.maximum(1 - gap / extent, _LEAST_SCALE)
    pose = np.diag([*scale, 1.0])
    pose[:3, 3] = middle - scale * middle
    return pose


def _uneven(solid: Solid, height: float, rng: np.random.Generator) -> Solid:
    """Waves of a few centimetres to decimetres over the surface, up to ``height`` [m]."""
    waves = rng.normal(size=(3, 3)) * 2 * np.pi / rng.uniform(0.08, 0.5, (3, 1))
    phases = rng.uniform(0, 2 * np.pi, 3)
    amplitude = height * rng.uniform(0.3, 1.0, 3) / np.sqrt(3)
    return Solid(solid.vertices + amplitude * np.sin(solid.vertices @ waves.T + phases), solid.faces)


@dataclass(frozen=True)
class Sins:
    """What share of a plant's meshes is spoilt, each between 0 and 1.

    Args:
        duplicates: meshes that lie there twice.
        hidden: meshes with a body inside that can't be seen.
        flipped: meshes with their faces inward.
        soup: meshes whose triangles share no corners.
        degenerate: meshes with triangles without area.
        gray: whether all meshes have one colour.
    """

    duplicates: float = 0.0
    hidden: float = 0.0
    flipped: float = 0.0
    soup: float = 0.0
    degenerate: float = 0.0
    gray: bool = False


def spoil(plant: Plant, sins: Sins, seed: int = 0) -> Plant:
    """The plant with sins, all of them recorded in its truth.

    Args:
        plant: clean.
        sins: how much of each.
        seed: which meshes.
    """
    rng = np.random.default_rng([seed, 9])
    components = list(plant.components)
    n = len(components)

    def some(share: float) -> list[int]:
        return [int(i) for i in np.sort(rng.permutation(n)[: round(share * n)])]

    flaws: tuple[tuple[str, float, Callable[[Solid], Solid]], ...] = (
        ("flipped", sins.flipped, _flipped),
        ("degenerate", sins.degenerate, _degenerate),
        ("soup", sins.soup, _soup),
    )
    for name, share, change in flaws:
        for i in some(share):
            one = components[i]
            components[i] = replace(one, solid=change(one.solid), flaws=(*one.flaws, name))
    duplicates, hidden = [], []
    for i in some(sins.duplicates):
        duplicates.append((i, len(components)))
        components.append(components[i])
    for i in some(sins.hidden):
        inside = _body_inside(plant.components[i])
        if inside is not None:
            hidden.append(len(components))
            components.append(inside)
    if sins.gray:
        components = [replace(c, color=(0.5, 0.5, 0.5)) for c in components]
    return replace(plant, components=tuple(components), duplicates=tuple(duplicates), hidden=tuple(hidden))


def _flipped(solid: Solid) -> Solid:
    return Solid(solid.vertices, solid.faces[:, ::-1])


def _soup(solid: Solid) -> Solid:
    count = 3 * len(solid.faces)
    return Solid(solid.vertices[solid.faces.reshape(-1)], np.arange(count, dtype=np.int32).reshape(-1, 3))


def _degenerate(solid: Solid) -> Solid:
    some = solid.faces[:: max(1, len(solid.faces) // 5)]
    return Solid(solid.vertices, np.concatenate([solid.faces, some[:, [0, 1, 1]]]))


def _body_inside(component: Component) -> Component | None:
    """A small cube about the middle of a solid, where that lies inside it with room; else None."""
    vertices = component.vertices
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    corners = vertices[component.faces] - middle
    a, b, c = np.moveaxis(corners, 1, 0)
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    solid_angle = 2 * np.arctan2(
        np.einsum("ij,ij->i", a, np.cross(b, c)),
        la * lb * lc
        + np.einsum("ij,ij->i", a, b) * lc
        + np.einsum("ij,ij->i", b, c) * la
        + np.einsum("ij,ij->i", c, a) * lb,
    )
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    # The planes of the faces are never farther than the faces: a cautious distance.
    room = float(np.abs(np.einsum("ij,ij->i", a, normals)[areas > 0] / areas[areas > 0]).min())
    if solid_angle.sum() < 2 * np.pi or room < 0.003:
        return None
    side = room / np.sqrt(3)
    return replace(component, solid=box((side, side, side)), pose=at(*middle))
