"""What a picture is to show, and the picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from cadgraph.agents.answer import Answer
from cadgraph.model.records import Point

__all__ = ["SIZE", "Order", "Picture", "Tagged"]

SIZE = (768, 576)
"""Width and height of a picture [px]: models look at no more than about that."""


@dataclass(frozen=True)
class Picture(Answer):
    """A drawn picture, and in words what it shows.

    Args:
        png: its bytes.
    """

    png: bytes = b""


class Tagged(NamedTuple):
    """A neighbour that is tagged in a picture.

    Args:
        name: as answers call it.
        point: where it is [m].
    """

    name: str
    point: Point


@dataclass(frozen=True)
class Order:
    """What a picture is to show.

    Args:
        name: of the target, as answers call it.
        point: where the target is [m], for what has no meshes; None where it has no one place.
        meshes: source paths of its meshes.
        near: source paths of the meshes of its neighbours.
        around: its neighbours, the next first.
        spots: where one can stand on it [m], of a level without meshes.
    """

    name: str
    point: Point | None
    meshes: tuple[str, ...]
    near: tuple[str, ...]
    around: tuple[Tagged, ...]
    spots: tuple[Point, ...] = ()
