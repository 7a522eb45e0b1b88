"""Modelling defects: gaps, overlaps, unevenness; duplicates, hidden bodies, broken meshes and odd paint at random."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from cadgraph.model.scene import Floats, Scene
from cadplants.faults.body_defects import cut, incomplete, insulated
from cadplants.faults.joint_gaps import Span, open_joints
from cadplants.faults.retessellate import doubled, quartered, shuffled
from cadplants.model.plant import Assembly, Component, Plant
from cadplants.solids.mesh_ops import Solid, box
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["DEFECTS", "Defects", "degrade", "draw_defects", "loosen"]

_LEAST_SCALE = 0.6  # thin parts (gaskets, washers) keep this share of their thickness


def loosen(assembly: Assembly, style: ModelingStyle, seed: int) -> Assembly:
    """Leaves gaps and overlaps between parts and makes surfaces uneven, as this style does; nothing else changes.

    Args:
        assembly: whose parts touch exactly.
        style: ``gap`` and ``wobble`` are used.
        seed: of the sizes of gaps and waves.
    """
    if style.gap == (0.0, 0.0) and not style.wobble:
        return assembly
    rng = np.random.default_rng([seed, 8])
    components = []
    for component in assembly.components:
        gap = float(rng.uniform(*style.gap))
        component = replace(component, pose=component.pose @ _shrunk(component.solid, gap), gap=gap)
        if style.wobble:
            component = replace(component, solid=_uneven(component.solid, style.wobble, rng))
        components.append(component)
    loose = replace(assembly, components=tuple(components))
    return replace(loose, contacts=(*loose.contacts, *_met(loose))) if style.gap[0] < 0 or style.wobble else loose


def _met(assembly: Assembly) -> list[tuple[int, int]]:
    """Pairs that were not meant to touch, but do since they grew."""
    from cadgraph.geometry.contact.pairs import touching

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
class Defects:
    """What share of a plant's meshes is spoilt, each between 0 and 1.

    Args:
        duplicates: meshes that lie there twice.
        hidden: meshes with a body inside that can't be seen.
        flipped: meshes with their faces inward.
        soup: meshes whose triangles share no corners.
        degenerate: meshes with triangles without area.
        gaps: meshes that no longer reach their neighbours, or run into them.
        gap: least and greatest gap of these, half of it on each side; negative: overlap [m].
        colors: ``own`` leaves them, ``gray`` gives all meshes one, ``random`` each its own.
        joints: how far the ends of pipes, the faces of flanges and the feet of branch outlets stay from what they meet,
            all over; negative: they run into it [m].
        faces: how far the faces of flanged joints are apart, which then have no gaskets [m].
        setback: how far behind its flange's face a pipe ends [m].
        screwed: how far instruments stand over what they are screwed into [m].
        doubled: meshes that have all their triangles twice.
        insulation: lines whose pipes have a larger hollow body around them, of which the truth says no label.
        cut: straight pipes that are of several pieces.
        incomplete: devices of several pieces that lack one.
        split: how often each triangle is cut into four.
        shuffled: whether the triangles of each mesh, and its corners, come in another order.
        mirrored: whether the plant is its own mirror image.
        solid: whether pipes and bodies have no bore.
        fittings: ``own`` or ``long``, see ``ModelingStyle``.
        devices: ``own``, ``one`` (valves, gauges and pumps are one mesh) or ``primitives``, see ``ModelingStyle``.
    """

    duplicates: float = 0.0
    hidden: float = 0.0
    flipped: float = 0.0
    soup: float = 0.0
    degenerate: float = 0.0
    gaps: float = 0.0
    gap: tuple[float, float] = (-0.001, 0.004)
    colors: Literal["own", "gray", "random"] = "own"
    joints: Span | None = None
    faces: Span | None = None
    setback: Span | None = None
    screwed: Span | None = None
    doubled: float = 0.0
    insulation: float = 0.0
    cut: float = 0.0
    incomplete: float = 0.0
    split: int = 0
    shuffled: bool = False
    mirrored: bool = False
    solid: bool = False
    fittings: Literal["own", "long"] = "own"
    devices: Literal["own", "one", "primitives"] = "own"

    def of_style(self, style: ModelingStyle) -> ModelingStyle:
        """The style with those defects that are a matter of how somebody models."""
        changes: dict[str, Any] = {}
        if self.solid:
            changes["hollow"] = False
        if self.fittings == "long":
            changes["fittings"] = "long"
        if self.devices == "one":
            changes |= {"valve": "one", "gauge": "one", "pump": "one"}
        elif self.devices == "primitives":
            changes |= {"devices": "primitives", "hollow": False, "flange": "ring", "holes": False}
            changes |= {"fasteners": "none", "gaskets": False, "spool": "segments"}
        return replace(style, **changes) if changes else style


DEFECTS: dict[str, Defects] = {
    "gaps": Defects(joints=(0.0005, 0.005)),
    "overlaps": Defects(joints=(-0.003, -0.0005)),
    "setback": Defects(setback=(0.003, 0.008)),
    "clearance": Defects(screwed=(0.0001, 0.0006)),
    "gauges": Defects(screwed=(0.0005, 0.0005)),
    "gaskets": Defects(faces=(0.0015, 0.0045)),
    "doubled": Defects(doubled=0.3),
    "insulation": Defects(insulation=0.5),
    "cut": Defects(cut=0.6),
    "incomplete": Defects(incomplete=0.3),
    "solid": Defects(solid=True),
    "long": Defects(fittings="long"),
    "one": Defects(devices="one"),
    "primitives": Defects(devices="primitives", faces=(0.0015, 0.0045)),
    "split": Defects(split=1),
    "shuffled": Defects(shuffled=True),
    "mirrored": Defects(mirrored=True),
    "all": Defects(
        joints=(0.0005, 0.003),
        setback=(0.003, 0.008),
        screwed=(0.0001, 0.0006),
        doubled=0.1,
        insulation=0.3,
        cut=0.4,
        incomplete=0.2,
        shuffled=True,
        fittings="long",
    ),
}
"""The defects of plants that others drew, each by its name, and ``all`` that a single plant can have."""


def draw_defects(seed: int, most: float = 0.1) -> Defects:
    """Defects at random, each with its own share up to ``most``, some of them none."""
    rng = np.random.default_rng([seed, 12])
    shares = [float(rng.uniform(0, most)) if rng.random() < 0.6 else 0.0 for _ in range(6)]
    paints: tuple[Literal["own", "gray", "random"], ...] = ("own", "own", "gray", "random")
    duplicates, hidden, flipped, soup, degenerate, gaps = shares
    return Defects(
        duplicates, hidden, flipped, soup, degenerate, 5 * gaps, colors=paints[int(rng.integers(len(paints)))]
    )


def degrade(plant: Plant, defects: Defects, seed: int = 0) -> Plant:
    """The plant with defects, all of them recorded in its truth.

    Args:
        plant: clean, or spoilt before: what is recorded of that stays.
        defects: how much of each.
        seed: which meshes.
    """
    plant = _redrawn(plant, defects, seed)
    rng = np.random.default_rng([seed, 9])
    n = len(plant.components)

    def some(share: float) -> list[int]:
        return [int(i) for i in np.sort(rng.permutation(n)[: round(share * n)])]

    if defects.gaps:
        plant = _parted(plant, some(defects.gaps), defects.gap, np.random.default_rng([seed, 13]))
    plant = _told_otherwise(plant, defects, seed)
    components = list(plant.components)
    flaws: tuple[tuple[str, float, Callable[[Solid], Solid]], ...] = (
        ("flipped", defects.flipped, _flipped),
        ("degenerate", defects.degenerate, _degenerate),
        ("soup", defects.soup, _soup),
    )
    for name, share, change in flaws:
        for i in some(share):
            one = components[i]
            components[i] = replace(one, solid=change(one.solid), flaws=(*one.flaws, name))
    duplicates, hidden = [], []
    for i in some(defects.duplicates):
        duplicates.append((i, len(components)))
        components.append(components[i])
    for i in some(defects.hidden):
        inside = _body_inside(plant.components[i])
        if inside is not None:
            hidden.append(len(components))
            components.append(inside)
    if defects.colors == "gray":
        components = [replace(c, color=(0.5, 0.5, 0.5)) for c in components]
    elif defects.colors == "random":
        drawn = np.random.default_rng([seed, 14]).random((len(components), 3)).round(3).tolist()
        components = [replace(c, color=(r, g, b)) for c, (r, g, b) in zip(components, drawn, strict=True)]
    return replace(
        plant,
        components=tuple(components),
        duplicates=(*plant.duplicates, *duplicates),
        hidden=(*plant.hidden, *hidden),
        colors=defects.colors if defects.colors != "own" else plant.colors,
    )


def _redrawn(plant: Plant, defects: Defects, seed: int) -> Plant:
    """The plant with its bodies and joints as others draw them, and what that does to its contacts."""
    drawn = plant
    if defects.incomplete:
        drawn = incomplete(drawn, defects.incomplete, np.random.default_rng([seed, 20]))
    if defects.cut:
        drawn = cut(drawn, defects.cut, np.random.default_rng([seed, 21]))
    if defects.joints or defects.faces or defects.setback or defects.screwed:
        rng = np.random.default_rng([seed, 22])
        drawn = open_joints(drawn, rng, defects.joints, defects.faces, defects.setback, defects.screwed)
    if defects.insulation:
        drawn = insulated(drawn, defects.insulation, np.random.default_rng([seed, 23]))
    if drawn is not plant:
        drawn = replace(drawn, contacts=(*drawn.contacts, *_met(drawn)))
        drawn = replace(drawn, looseness=max(drawn.looseness, _widest(drawn)))
    if not defects.mirrored:
        return drawn
    mirrored = drawn.placed(_MIRROR)
    return replace(drawn, components=mirrored.components, points=mirrored.points, lines=mirrored.lines)


_MIRROR = np.diag([-1.0, 1.0, 1.0, 1.0])


def _widest(plant: Plant) -> float:
    """The greatest distance of two components that are said to touch, rounded up to a micrometre [m]."""
    from cadgraph.geometry.contact.pairs import distances

    scene = Scene.from_meshes([(c.vertices, c.faces) for c in plant.components])
    found, _ = distances(scene, np.array(plant.contacts, np.int64).reshape(-1, 2))
    return float(np.ceil(found.max() * 1e6) / 1e6) if len(found) else 0.0


def _told_otherwise(plant: Plant, defects: Defects, seed: int) -> Plant:
    """The same shapes in other triangles."""
    components = list(plant.components)
    for _ in range(defects.split):
        components = quartered(components)
    if defects.shuffled:
        components = shuffled(components, np.random.default_rng([seed, 24]))
    if defects.doubled:
        components = doubled(components, defects.doubled, np.random.default_rng([seed, 25]))
    return replace(plant, components=tuple(components))


def _parted(plant: Plant, chosen: list[int], sizes: tuple[float, float], rng: np.random.Generator) -> Plant:
    """Leaves gaps round some meshes of a plant, and lets some run into their neighbours; the ground stays."""
    components = list(plant.components)
    for i in chosen:
        one, gap = components[i], round(float(rng.uniform(*sizes)), 6)
        if one.cluster:
            components[i] = replace(one, pose=one.pose @ _shrunk(one.solid, gap), gap=one.gap + gap)
    parted = replace(plant, components=tuple(components), looseness=plant.looseness + max(0.0, sizes[1]))
    return replace(parted, contacts=(*plant.contacts, *_met(parted)))


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
