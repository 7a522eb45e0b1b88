"""Contacts by the geometry itself, for devices whose builders don't say what touches what."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from cadgraph.model.scene import Scene
from cadplants.model.plant import Assembly

__all__ = ["met", "whole"]

_TOUCH = 1e-6
"""What is at most this far apart touches [m] (ours: rounding of coordinates that were meant to be equal)."""


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
