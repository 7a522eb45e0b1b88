"""A plant small enough for every library to read at once: a line with a valve of two meshes, a tank, and steel."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Component, Connection, Line, Plant, Point, Unit
from cadplants.solids.mesh_ops import merge, moved, tube
from cadplants.solids.primitives import along, ball, box, cylinder, dome, hexagon, ring, turned
from cadplants.solids.transforms import arc, at, spun

STEEL, BLUE, RED = (0.5, 0.5, 0.55), (0.1, 0.2, 0.6), (0.7, 0.1, 0.1)
SIDES = 12


def small_plant(seed=0):
    """Eleven meshes; the line goes from the tank along x through a valve and round a bend to y."""
    run = along("x", ring(0.024, 0.03, 0.0, 0.5, SIDES))
    solid_run = along("x", cylinder(0.03, 0.0, 0.3, SIDES))
    gasket = along("x", ring(0.024, 0.05, 0.0, 0.002, SIDES))
    bend = tube(arc((0, 0, 0), (0.12, 0, 0), (0.12, 0.12, 0), 4), 0.03, 0.0, SIDES)
    body = merge([along("x", turned([(0.04, 0.0), (0.06, 0.1), (0.04, 0.2)], SIDES)), ball(0.03, SIDES)])
    wheel = moved(ring(0.04, 0.05, 0.0, 0.01, SIDES), at(0.1, 0, 0.1))
    bolt = merge([hexagon(0.02, 0.0, 0.01), cylinder(0.006, -0.03, 0.0, SIDES)])
    wedge = turned([(0.05, 0.0), (0.02, 0.08)], SIDES)
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    stretched = np.diag([0.5, 0.2, 0.1, 1.0])
    valve = {"group": "Valve assembly", "unit": "V-1", "line": "L1", "family": "gate valve"}
    tank = {"group": "Tank", "unit": "T-1", "cluster": "all"}
    pipes = {"group": "Pipe assembly", "line": "L1", "cluster": "all"}
    components = (
        Component(moved(cylinder(0.4, 0.0, 1.0, SIDES), at()), name="shell", color=BLUE, pose=at(-0.4), **tank),
        Component(dome(0.4, 0.1, 1.0, SIDES), name="dished head", color=BLUE, pose=at(-0.4), **tank),
        Component(run, name="pipe", color=STEEL, pose=at(0, 0, 0.5), **pipes),
        Component(gasket, name="gasket", color=RED, pose=at(0.5, 0, 0.5), **pipes),
        Component(body, name="valve body", color=BLUE, pose=at(0.502, 0, 0.5), **valve),
        Component(wheel, name="handwheel", color=RED, pose=at(0.502, 0, 0.5), **valve),
        Component(gasket, name="gasket", color=RED, pose=at(0.704, 0, 0.5) @ mirror, **pipes),
        Component(solid_run, name="pipe", color=STEEL, pose=at(0.706, 0, 0.5), **pipes),
        Component(bend, name="elbow", color=STEEL, pose=at(1.006, 0, 0.5), **pipes),
        Component(bolt, "Connection assembly", "bolt", RED, at(0.2, 0.3, 0.3) @ spun("x", 0.3), cluster="all"),
        Component(box((1, 1, 1)), "Structural element", "beam", STEEL, at(0.5, 0, 0.2) @ stretched, cluster="all"),
        Component(wedge, "Structural element", "foundation", STEEL, at(0.5, 0.4, 0) @ mirror, cluster="all"),
    )
    points = np.array([[0.0, 0, 0.5], [1.006, 0, 0.5], [1.09, 0.036, 0.5], [1.126, 0.12, 0.5]])
    return Plant(
        components,
        contacts=((0, 1), (0, 2), (2, 3), (3, 4), (4, 5), (4, 6), (6, 7), (7, 8)),
        units=(Unit("V-1", "valve", "gate valve"), Unit("T-1", "tank", "storage tank")),
        points=(Point("L1/end", "terminal", (1.126, 0.12, 0.5), "open"),),
        connections=(
            Connection("T-1", "V-1", "L1", 0.602, 0.05, "forward", "a pump"),
            Connection("V-1", "L1/end", "L1", 0.6, 0.05, "forward", "a pump"),
        ),
        lines=(Line("L1", points, 0.06),),
        name="small",
        seed=seed,
        styles=("plant-design",),
    )
