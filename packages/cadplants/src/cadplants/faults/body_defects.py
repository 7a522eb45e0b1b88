"""Bodies that others draw besides, in pieces, or not at all: insulation, cut pipes, devices that lack a piece."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.contact.pairs import distances
from cadgraph.model.scene import Scene
from cadplants.faults.tubes import Tube, find_tubes
from cadplants.model.plant import Component, Plant
from cadplants.solids.mesh_ops import tube
from cadplants.solids.transforms import at

__all__ = ["cut", "incomplete", "insulated"]

_THICK = (0.03, 0.05)  # m; mineral wool on pipes of DN 50 to 100 at 100 to 250 degrees C
_BARE = 0.045  # m; insulation ends this far from a pipe's ends, so that the bolts of a flange can be drawn
_LEAST = 0.15  # m; a shorter pipe is not covered, and not cut
_SIDES = 16
_PIECES = (2, 6)  # into how many pieces a pipe is cut


def insulated(plant: Plant, share: float, rng: np.random.Generator) -> Plant:
    """The plant with insulation round the pipes of some lines: a hollow body with a meaning that the vocabulary lacks.

    Args:
        plant: as it was; its network stays.
        share: of the lines, at least one of them.
        rng: of the lines and of the thickness on each.
    """
    lines = [line.id for line in plant.lines]
    count = max(1, round(share * len(lines)))
    thick = {lines[i]: float(rng.uniform(*_THICK)) for i in np.sort(rng.permutation(len(lines))[:count])}
    components, contacts = list(plant.components), list(plant.contacts)
    for i, pipe in find_tubes(plant).items():
        line = plant.components[i].line
        if line in thick and pipe.length > _LEAST + 2 * _BARE:
            contacts.append((i, len(components)))
            components.append(_covering(plant.components[i], pipe, thick[line]))
    return replace(plant, components=tuple(components), contacts=tuple(contacts))


def _covering(component: Component, pipe: Tube, thick: float) -> Component:
    path = pipe.axis.between(pipe.low + _BARE, pipe.high - _BARE)
    # Its flats, not its corners, lie on the pipe.
    inner = pipe.radius / np.cos(np.pi / _SIDES)
    solid = tube(path - path[0], inner + thick, inner, _SIDES)
    return Component(
        solid,
        "",
        "",
        (0.72, 0.72, 0.70),
        at(*path[0]),
        cluster=component.cluster,
        family="insulation",
        style=component.style,
    )


def cut(plant: Plant, share: float, rng: np.random.Generator) -> Plant:
    """The plant with some straight pipes in several pieces, end to end.

    Args:
        plant: as it was.
        share: of the pipes that are long enough.
        rng: of the pipes and of their pieces.
    """
    straight = [i for i, pipe in find_tubes(plant).items() if pipe.length > _LEAST and _straight(pipe)]
    chosen = [straight[i] for i in np.sort(rng.permutation(len(straight))[: round(share * len(straight))])]
    components = list(plant.components)
    pieces: dict[int, list[int]] = {}
    for i in chosen:
        ends = np.linspace(0.0, 1.0, int(rng.integers(_PIECES[0], _PIECES[1] + 1)) + 1)
        ends[1:-1] += rng.uniform(-0.3, 0.3, len(ends) - 2) / (len(ends) - 1)
        some = [_piece(plant.components[i], low, high) for low, high in zip(ends[:-1], ends[1:], strict=True)]
        components[i] = some[0]
        pieces[i] = [i, *range(len(components), len(components) + len(some) - 1)]
        components += some[1:]
    shared = [pair for some in pieces.values() for pair in zip(some[:-1], some[1:], strict=True)]
    whole = replace(plant, components=tuple(components))
    return replace(whole, contacts=(*_shared_out(whole, plant.contacts, pieces), *shared))


def _straight(pipe: Tube) -> bool:
    chord = np.linalg.norm(pipe.axis.point(pipe.high) - pipe.axis.point(pipe.low))
    return bool(pipe.length - chord < 1e-6)


def _piece(component: Component, low: float, high: float) -> Component:
    """What lies between two shares of a pipe along its own x axis."""
    x = component.solid.vertices[:, 0]
    start, length = float(x.min()), float(np.ptp(x))
    squeezed = np.diag([high - low, 1.0, 1.0, 1.0])
    squeezed[0, 3] = start + low * length - (high - low) * start
    return replace(component, pose=component.pose @ squeezed)


def _shared_out(
    plant: Plant, contacts: tuple[tuple[int, int], ...], pieces: dict[int, list[int]]
) -> list[tuple[int, int]]:
    """The contacts of cut pipes, each with the piece that is nearest, and with any other that is as near."""
    offers = [(a, b, x, y) for a, b in contacts for x in pieces.get(a, [a]) for y in pieces.get(b, [b])]
    scene = Scene.from_meshes([(c.vertices, c.faces) for c in plant.components])
    found, _ = distances(scene, [(x, y) for _, _, x, y in offers])
    near: dict[tuple[int, int], list[tuple[float, tuple[int, int]]]] = defaultdict(list)
    for (a, b, x, y), distance in zip(offers, found.tolist(), strict=True):
        near[a, b].append((distance, (x, y)))
    return [pair for some in near.values() for distance, pair in some if distance <= min(some)[0] + 1e-9]


def incomplete(plant: Plant, share: float, rng: np.random.Generator) -> Plant:
    """The plant with some devices of several pieces that lack one; what a line runs through is never left out.

    Args:
        plant: as it was; its units and its network stay.
        share: of the units of at least two pieces.
        rng: of the units and the pieces.
    """
    own: dict[str, list[int]] = defaultdict(list)
    for i, component in enumerate(plant.components):
        if component.unit:
            own[component.unit].append(i)
    several = [some for some in own.values() if len(some) > 1]
    gone: set[int] = set()
    for k in np.sort(rng.permutation(len(several))[: round(share * len(several))]):
        spare = [i for i in several[k] if _spare(plant, i)]
        if spare:
            gone.add(spare[int(rng.integers(len(spare)))])
    return plant.without(gone, bridged=False)


def _spare(plant: Plant, piece: int) -> bool:
    """Whether the rest hangs together without this piece, which touches nothing but its own device."""
    own = plant.components[piece].unit
    beside = {b if a == piece else a for a, b in plant.contacts if piece in (a, b)}
    if any(plant.components[i].unit != own for i in beside):
        return False
    rest = [i for i, component in enumerate(plant.components) if component.unit == own and i != piece]
    return len(connected_sets(rest, plant.contacts)) == len(connected_sets([*rest, piece], plant.contacts))
