"""Small networks of units and places for tests of flow, written as words."""

import numpy as np

from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.parts import Link, Network, Opening, Parts, Place, UnitParts
from cadgraph.model.scene import Scene

TYPES = {"V": "valve", "G": "gauge", "P": "pump", "T": "tank", "E": "equipment"}
ENDS = {"J": "junction", "X": "open", "B": "blind"}


def network(*runs, sizes=None, openings=None, kinds=None, parts=None, places=None):
    """Runs such as ``"T1 V1 J1"`` as links; a letter says what a node is (``ENDS`` are no units).

    Args:
        runs: names one after the other, each with the next one a link of 1 m.
        sizes: nominal diameter [m] of links, by ``"V1 J1"``; 0.1 without.
        openings: of units, by name; each link then takes the next one.
        kinds: of units, by name.
        parts: of units, by name.
        places: of nodes, by name, for the paths of links.
    """
    words = [run.split() for run in runs]
    names = sorted({name for run in words for name in run})
    units = [name for name in names if name[0] in TYPES]
    others = [name for name in names if name[0] in ENDS]
    number = {name: k for k, name in enumerate([*units, *others])}
    given, where = openings or {}, places or {}
    used = dict.fromkeys(units, -1)

    def port(name):
        if name not in used or name not in given:
            return -1
        used[name] += 1
        return min(used[name], len(given[name]) - 1)

    links = []
    for run in words:
        for a, b in zip(run[:-1], run[1:], strict=True):
            links.append(
                Link(
                    number[a], number[b], (), (where.get(a, (0.0, 0.0, 0.0)), where.get(b, (1.0, 0.0, 0.0))), 1.0,
                    diameter=(sizes or {}).get(f"{a} {b}", 0.1), source_port=port(a), target_port=port(b),
                )
            )  # fmt: skip
    made = tuple(
        UnitParts(
            TYPES[name[0]], name, (parts or {}).get(name, ()), (kinds or {}).get(name), tuple(given.get(name, ()))
        )
        for name in units
    )
    return Network(made, tuple(Place(ENDS[name[0]], (0.0, 0.0, 0.0), ()) for name in others), tuple(links))


def opening(point, direction, diameter=0.1):
    return Opening(point, direction, diameter)


def name_of(found, node):
    units = len(found.units)
    if node < units:
        return found.units[node].tag
    kind = found.places[node - units].kind
    same = [k for k, place in enumerate(found.places) if place.kind == kind]
    letter = next(letter for letter, other in ENDS.items() if other == kind)
    return f"{letter}{same.index(node - units) + 1}"


def link_between(found, first, last):
    """The number of the link between two nodes, and whether it goes from the first to the last."""
    for number, link in enumerate(found.links):
        ends = name_of(found, link.source), name_of(found, link.target)
        if ends == (first, last):
            return number, True
        if ends == (last, first):
            return number, False
    raise KeyError((first, last))


def parts_of(*meshes):
    """Parts of meshes, each one of its own."""
    scene = Scene.from_meshes(list(meshes), [f"/m{k}" for k in range(len(meshes))])
    numbers = np.arange(len(meshes))
    return Parts(
        scene, tuple((k,) for k in range(len(meshes))), numbers, measure(scene), numbers, np.zeros(len(meshes), bool)
    )
