"""Contacts by the geometry itself, for devices and plants whose builders don't say all that touches."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.scene import Scene
from cadplants.model.plant import Assembly, Component, Plant, free_name

__all__ = ["APART", "measured", "met", "on_ground", "whole"]

APART = 0.01
"""Clusters are further apart than this [m]: the contact distance (paper, section III-B: DBSCAN's eps)."""

_TOUCH = 1e-6
"""What is at most this far apart touches [m] (ours: rounding of coordinates that were meant to be equal)."""

_SURELY = 1e-5
"""What is nearer than this in a plant counts as touching, since it may do so in a file of float32 [m] (ours)."""

_Pair = tuple[int, int]


def met(assembly: Assembly) -> Assembly:
    """The assembly with exactly those contacts that its surfaces have."""
    from cadgraph.geometry.contact.pairs import touching

    scene = Scene.from_meshes([(c.vertices, c.faces) for c in assembly.components])
    pairs = tuple((int(a), int(b)) for a, b in touching(scene, _TOUCH).tolist())
    return replace(assembly, contacts=pairs)


def whole(draw: Callable[[int], Assembly], tries: int = 20) -> Assembly:
    """The first drawn assembly that hangs together, with its exact contacts.

    Args:
        draw: makes one by number.
        tries: how many are drawn before the last is taken as it is.
    """
    made = met(draw(0))
    for number in range(1, tries):
        if _hangs(made):
            break
        made = met(draw(number))
    return made


def _hangs(assembly: Assembly) -> bool:
    """Whether one can go from any component to any other by contacts."""
    beside: dict[int, set[int]] = {i: set() for i in range(len(assembly.components))}
    for a, b in assembly.contacts:
        beside[a].add(b)
        beside[b].add(a)
    seen, front = {0}, [0]
    while front:
        new = beside[front.pop()] - seen
        seen |= new
        front += new
    return len(seen) == len(beside)


def on_ground(plant: Plant, ground: Component) -> Plant:
    """The plant on its ground, with all else that touches.

    Args:
        plant: whose builders say what touches in it.
        ground: what it stands on; what stands on it is found by the surfaces, within the plant's looseness.
    """
    standing = replace(plant, components=(*plant.components, ground))
    last = plant.n_meshes
    said = {(min(pair), max(pair)) for pair in plant.contacts}
    near = sorted((pair, gap) for pair, gap in _near(standing).items() if pair not in said)
    limit = max(plant.looseness, _TOUCH)
    more = tuple(pair for pair, gap in near if gap <= (limit if last in pair else 0.0))
    return replace(standing, contacts=(*plant.contacts, *more))


def measured(plant: Plant) -> Plant:
    """The plant with those contacts and clusters that its surfaces have.

    Pairs that are said to touch stay as far as they come within the plant's looseness, and all others that touch are
    added. What comes within the contact distance is one cluster, and what is further apart is several; so is what a
    device has of its unit, drums on the floor, say. Where pieces of a unit or of a cluster come near each other without
    touching, their nearest pair is a contact as well, and the looseness grows to its gap. Copies keep to what they were
    made from, and hidden bodies to what hides them.

    Args:
        plant: finished; its clusters give the new ones their names.
    """
    gaps = _near(plant)
    said = {(min(pair), max(pair)) for pair in plant.contacts}
    within = plant.looseness + _TOUCH
    contacts = {pair for pair, gap in gaps.items() if gap <= _SURELY or (pair in said and gap <= within)}
    names = {i: cluster for i in _own(plant) if (cluster := plant.components[i].cluster)}
    units: dict[str, list[int]] = defaultdict(list)
    for i in names:
        units[plant.components[i].unit].append(i)
    units.pop("", None)
    for some in (*units.values(), list(names)):
        contacts |= _bridges(some, contacts, gaps)
    looseness = max([plant.looseness, *(float(np.ceil(gaps[pair] * 1e6) / 1e6) for pair in contacts)])
    clusters = _clusters(names, gaps)
    clusters |= {copy: clusters[first] for first, copy in plant.duplicates if first in clusters}
    components = tuple(replace(one, cluster=clusters.get(i, one.cluster)) for i, one in enumerate(plant.components))
    whole = replace(plant, components=components, contacts=tuple(sorted(contacts)), looseness=looseness)
    return _units_apart(whole, units)


def _own(plant: Plant) -> list[int]:
    """The components that are neither copies nor hidden."""
    apart = {copy for _, copy in plant.duplicates} | set(plant.hidden)
    return [i for i in range(plant.n_meshes) if i not in apart]


def _near(plant: Plant) -> dict[_Pair, float]:
    """The distances of all components that come within the contact distance [m]; of neither copies nor hidden ones."""
    from cadgraph.geometry.contact.pairs import find_contacts

    own = _own(plant)
    scene = Scene.from_meshes([(plant.components[i].vertices, plant.components[i].faces) for i in own])
    near = find_contacts(scene, APART)
    pairs = [(own[a], own[b]) for a, b in near.pairs.tolist()]
    return dict(zip(pairs, near.distance.tolist(), strict=True))


def _units_apart(plant: Plant, units: Mapping[str, Sequence[int]]) -> Plant:
    """The plant with a unit for each piece of a unit that nothing of its device joins; the largest keeps its name."""
    components, made = list(plant.components), list(plant.units)
    taken = {unit.id for unit in plant.units}
    for unit in plant.units:
        own = set(units.get(unit.id, ()))
        records = {id(components[i].params) for i in own if components[i].params is not None}
        device = [i for i, one in enumerate(components) if i in own or id(one.params) in records]
        pieces = [own.intersection(piece) for piece in connected_sets(device, plant.contacts)]
        for piece in sorted((piece for piece in pieces if piece), key=lambda piece: (-len(piece), min(piece)))[1:]:
            name = free_name(unit.id, taken)
            taken.add(name)
            made.append(replace(unit, id=name))
            for i in piece:
                components[i] = replace(components[i], unit=name)
    return replace(plant, components=tuple(components), units=tuple(made)) if len(made) > len(plant.units) else plant


def _bridges(some: Sequence[int], contacts: Iterable[_Pair], gaps: Mapping[_Pair, float]) -> set[_Pair]:
    """The nearest pairs that join the pieces into which some meshes fall, as far as these come near each other."""
    among = set(some)
    pieces = connected_sets(some, [pair for pair in contacts if among.issuperset(pair)])
    if len(pieces) == 1:
        return set()
    piece_of = {i: k for k, piece in enumerate(pieces) for i in piece}
    found: set[_Pair] = set()
    for pair in sorted((pair for pair in gaps if among.issuperset(pair)), key=lambda pair: (gaps[pair], pair)):
        one, other = (piece_of[i] for i in pair)
        if one != other:
            found.add(pair)
            piece_of = {i: one if k == other else k for i, k in piece_of.items()}
    return found


def _clusters(names: Mapping[int, str], near: Iterable[_Pair]) -> dict[int, str]:
    """A name for the cluster of each mesh: that of most of its meshes, with a number where several would have it."""
    pieces = connected_sets(list(names), [(a, b) for a, b in near if a in names and b in names])
    taken: set[str] = set()
    found: dict[int, str] = {}
    for piece in sorted(pieces, key=lambda piece: (-len(piece), piece[0])):
        own = [names[i] for i in piece]
        name = free_name(max(dict.fromkeys(own), key=own.count), taken)
        taken.add(name)
        found |= dict.fromkeys(piece, name)
    return found
