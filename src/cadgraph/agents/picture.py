"""A picture of one thing in a plant: itself in red, what it hangs together with tagged, all else grey.

What is to be seen follows from the graph and is worked out here; the scene is looked at only where it is drawn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cadgraph.agents.answer import AskError, cell
from cadgraph.agents.drawing.order import Order, Picture, Tagged
from cadgraph.agents.plant import Plant
from cadgraph.model.grid import Grid, from_runs
from cadgraph.model.records import Cluster, Contains, Junction, Node, Part, Place, Point, System, Terminal, Unit

__all__ = ["order_of", "picture"]

_MOST_SPOTS = 400


def order_of(plant: Plant, target: str) -> Order:
    """What a picture of one thing is to show.

    Args:
        plant: that holds it.
        target: tag or id of a unit, part, junction, end, structure, system or level, or the source path of a mesh.

    Raises:
        AskError: nothing is called so, or it is no one thing to be drawn.
    """
    node = plant.find(target)
    around = [(other, point) for other in _neighbors(plant, node) if (point := _point_of(other)) is not None]
    return Order(
        plant.called(node.id),
        _point_of(node),
        _meshes_of(_parts_of(plant, node)),
        _meshes_of([part for other, _ in around for part in _parts_of(plant, other)]),
        tuple(Tagged(plant.called(other.id), point) for other, point in around),
        _spots_of(node) if isinstance(node, Place) and not node.parts else (),
    )


def picture(plant: Plant, target: str) -> Picture:
    """Draws one thing of a plant, in this process.

    Args:
        plant: that holds it; its scene is read.
        target: tag or id, or the source path of a mesh.

    Raises:
        AskError: nothing is called so, or there is no scene to draw it from.
        LoadError: the scene can't be read.
    """
    from cadgraph.agents.drawing.drawer import Drawer, read_scene

    order = order_of(plant, target)
    return Drawer(read_scene(plant.graph.source, plant.graph.config, plant.folder)).draw(order)


def _meshes_of(parts: Sequence[Part]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(path for part in parts for path in part.meshes))


def _parts_of(plant: Plant, node: Node) -> list[Part]:
    """The parts that make up a node."""
    if isinstance(node, Part):
        return [node]
    if isinstance(node, Cluster):
        return plant.graph.parts(cluster=node.id)
    if isinstance(node, System):
        inner = (plant.graph.nodes[one] for one in (*node.units, *node.junctions, *node.terminals))
        return [part for one in inner for part in _parts_of(plant, one)]
    if isinstance(node, Unit | Junction | Terminal | Place):
        return [plant.graph.part(part) for part in node.parts]
    raise AskError(f"{cell(node.id)} is a {node.layer}, which is no one thing to be drawn; give a unit or a part")


def _neighbors(plant: Plant, node: Node) -> list[Node]:
    """What a target hangs together with: along the pipes, or, of a part, its unit and what touches it; the next first.

    Of a structure or a system these are the units in it, of a level those that are reached from there.
    """
    if isinstance(node, Part):
        owner = plant.graph.unit_of(node)
        return [*([owner] if owner is not None else []), *plant.graph.neighbors(node)]
    if isinstance(node, System):
        return [plant.graph.nodes[one] for one in node.units]
    if isinstance(node, Cluster):
        inside = {part.id for part in plant.graph.parts(cluster=node.id)}
        return [unit for unit in plant.graph.units() if inside.intersection(unit.parts)]
    if isinstance(node, Place):
        served = (edge.target for edge in plant.graph.of_kind(Contains) if edge.source == node.id)
        return [plant.graph.nodes[one] for one in served]
    if node.id not in plant.network.places:
        return []
    ends = dict.fromkeys(arc.end for arc in plant.network.arcs(node.id) if arc.end != node.id)
    return [plant.graph.nodes[end] for end in ends]


def _spots_of(level: Place) -> tuple[Point, ...]:
    """Points all over the squares of a level that one can stand on, few enough to be told apart in a picture."""
    floor = level.floor
    if floor is None:
        return ()
    grid, free = Grid(floor.origin, floor.step, floor.size), from_runs(floor.runs, floor.size)
    every = max(1, math.ceil(math.sqrt(np.count_nonzero(free) / _MOST_SPOTS)))
    xs, ys = grid.centers()
    rows, columns = np.nonzero(free[::every, ::every])
    return tuple((float(xs[c * every]), float(ys[r * every]), level.height) for r, c in zip(rows, columns, strict=True))


def _point_of(node: Node) -> Point | None:
    """Where a node is [m]; None where it has no one place."""
    if isinstance(node, Junction | Terminal):
        return node.point
    if isinstance(node, Unit | Part | Cluster):
        return node.centroid
    if isinstance(node, Place):
        x, y, z = (float(c) for c in np.mean(node.aabb, axis=0))
        return x, y, z
    return None
