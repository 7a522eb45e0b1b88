"""A plant that can be played: a ball valve, a pump and a gauge; and a process that does as it is told."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import graphs
import shapes
from cadgraph.model.records import Connected, Mechanism, Terminal
from cadgraph.model.scene import Scene

PLACES = {"V-001": (0.0, 0.0, 0.0), "P-001": (1.5, 0.0, 0.0), "G-001": (0.0, 0.0, 0.6)}
LEVER = Mechanism(
    kind="lever",
    meshes=("/lever",),
    axis=(0.0, 0.0, 1.0),
    pivot=(0.0, 0.0, 0.3),
    radius=0.3,
    limits=(-90.0, 0.0),
    open=0.0,
    shut=-90.0,
)
NEEDLE = Mechanism(
    kind="needle",
    meshes=("/needle",),
    axis=(0.0, -1.0, 0.0),
    pivot=(0.0, -0.06, 0.6),
    radius=0.05,
    limits=(-270.0, 0.0),
)


def scene():
    turned = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    meshes = {
        "/body": shapes.moved(shapes.cylinder(0.15, 0.4), turned),
        "/dial": shapes.moved(shapes.cylinder(0.08, 0.1), turned, (0.0, 0.0, 0.6)),
        "/lever": shapes.box((0.3, 0.04, 0.02), (0.15, 0.0, 0.3)),
        "/needle": shapes.box((0.05, 0.004, 0.01), (0.025, -0.06, 0.6)),
        "/pipe": shapes.box((1.2, 0.1, 0.1), (0.7, 0.0, 0.0)),
        "/pump": shapes.box((0.5, 0.4, 0.4), (1.5, 0.0, 0.0)),
    }
    return Scene.from_meshes(list(meshes.values()), list(meshes))


def graph():
    parts = [graphs.part(number, path, size=0.3) for number, path in enumerate(scene().paths)]
    members = {"V-001": ("part-0", "part-2"), "P-001": ("part-5",), "G-001": ("part-1", "part-3")}
    kinds = {"V": "valve", "P": "pump", "G": "gauge"}
    units = []
    for tag, at in PLACES.items():
        low, high = tuple(c - 0.15 for c in at), tuple(c + 0.15 for c in at)
        unit = graphs.unit(tag, *members[tag], unit_type=kinds[tag[0]])
        moving = {"V-001": LEVER, "G-001": NEEDLE}.get(tag)
        units.append(unit.model_copy(update={"centroid": at, "aabb": (low, high), "mechanism": moving}))
    end = Terminal(id="terminal-000", kind="open", point=(-0.5, 0.0, 0.0), parts=())
    edges = [
        Connected(source="unit-P-001", target="unit-V-001", via=("part-4",)),
        Connected(source="unit-V-001", target="terminal-000"),
    ]
    return graphs.graph([*parts, *units, end], edges)


@dataclass(frozen=True)
class State:
    time: float = 0.0
    opening: dict[str, float] = field(default_factory=dict)
    flow: dict[int, float] = field(default_factory=dict)
    reading: dict[str, float] = field(default_factory=dict)
    speed: dict[str, float] = field(default_factory=dict)
    joints: dict[str, float] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()


class Told:
    """Flow and reading follow the opening of the valve; the needle stands at -30 degrees where it is open."""

    def __init__(self):
        self.asked = {"V-001": 1.0, "P-001": 1.0}
        self.time = 0.0

    @property
    def state(self):
        opening, runs = self.asked["V-001"], self.asked["P-001"]
        flow = 0.01 * opening * runs
        return State(
            self.time,
            {"V-001": opening},
            {0: flow, 1: flow},
            {"G-001": 4.0 - 3.0 * opening},
            {"P-001": runs},
            {"V_001": -90.0 * (1 - opening), "G_001": -30.0 * (4.0 - 3.0 * opening)},
        )

    def step(self, commands, dt):
        self.time += dt
        self.asked |= commands
        return self.state
