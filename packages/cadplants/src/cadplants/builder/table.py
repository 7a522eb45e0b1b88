"""A drafting table: parts are put where its frame is, with group, material and bundle from their names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import default_vocabulary
from cadplants.model.family import Model, Part, Port, placed
from cadplants.model.plant import Turning
from cadplants.model.standards import FLANGES, PIPES, Flange, Pipe
from cadplants.solids.mesh_ops import Solid, merge
from cadplants.solids.primitives import AXES
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Table", "outline"]

# What stays a mesh of its own where a device is modelled in a few.
_APART = frozenset({"handwheel", "lever"})
_FINE = frozenset({"bolt", "nut", "stud", "washer", "screw"})

# Kind of material of a part where nothing else is said.
_MATERIALS: Mapping[str, str] = {
    name: material
    for material, names in {
        "pipe": "pipe, elbow, tee, cross, reducer, branch outlet, nipple, pipe cap",
        "flange": "flange, blind flange",
        "gasket": "gasket",
        "fastener": "bolt, nut, stud, washer, screw",
        "valve": "valve body, valve bonnet, gearbox, strainer, yoke, transmitter",
        "trim": "valve, valve stem, valve disc, valve ball, gland, gauge stem, union, sight glass, thermowell, siphon, "
        "level gauge, expansion joint, shaft, impeller, position indicator",
        "handle": "handwheel, lever, coupling, fire extinguisher, hydrant, burner",
        "gauge": "gauge case, gauge, flow meter",
        "dial": "gauge face, gauge glass, filter, radiator, camera, lamp",
        "needle": "gauge needle",
        "steel": "base plate, beam, brace, bracket, column, gusset plate, plate, post, saddle, skid frame, "
        "stair tread, tank leg, pump base, grating",
        "clamp": "clamp, pipe hanger, u-bolt, conduit, platform, lifting lug",
        "rubber": "cable, hose, caster",
        "tank": "shell, dished head, nozzle, manway, skirt, tank, boiler, heat exchanger, separator",
        "motor": "motor, motor fan cover, terminal box, actuator",
        "pump": "pump casing, pump, compressor, blower",
        "safety": "ladder, railing, coupling guard, sign",
        "fence": "fence",
        "gate": "gate",
        "concrete": "foundation, wall",
        "electrical": "cable tray, control panel, junction box",
        "ground": "ground",
    }.items()
    for name in (one.strip() for one in names.split(","))
}


@cache
def group_of(name: str) -> str:
    """The group of the vocabulary that has a name.

    Raises:
        ValueError: no group has it.
    """
    for group, about in default_vocabulary().groups.items():
        if name in about.names:
            return group
    raise ValueError(f"{name!r} is no name of the vocabulary")


def outline(*numbers: float) -> list[tuple[float, float]]:
    """The points of an outline from their numbers one after the other: radius, height, radius, height..."""
    if len(numbers) % 2:
        raise ValueError(f"{len(numbers)} numbers make no points")
    return list(zip(numbers[::2], numbers[1::2], strict=True))


@dataclass(frozen=True)
class Table:
    """What a device is put together on.

    Args:
        style: that models it.
        group: of the device.
        bundle: name of the part that takes in the others where a style models in a few meshes; "": each by itself.
        dn: nominal size, where the device has one.
        frame: ``(4, 4)`` where the next parts go.
        parts: so far; tables that are moved share them.
    """

    style: ModelingStyle
    group: str
    bundle: str = ""
    dn: int = 0
    frame: Floats = field(default_factory=lambda: IDENTITY)
    parts: list[Part] = field(default_factory=list)

    @property
    def pipe(self) -> Pipe:
        """The pipe of its nominal size."""
        return PIPES[self.dn]

    @property
    def flange(self) -> Flange:
        """The flange of its nominal size."""
        return FLANGES[self.dn]

    def n(self, radius: float, least: int = 0, most: int = 10_000) -> int:
        """Sides of a circle of this radius [m] as the style has them, within bounds."""
        return max(least, min(most, self.style.round(radius)))

    # --- where ---

    def moved(self, pose: Floats) -> Table:
        """The same table with its frame moved by a ``(4, 4)`` pose in that frame."""
        return replace(self, frame=self.frame @ pose)

    def at(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Table:
        """With its frame shifted [m]."""
        return self.moved(at(x, y, z))

    def along(self, axis: str) -> Table:
        """With its z axis along an axis of the frame: ``"x"``, ``"-y"``..."""
        return self.moved(AXES[axis])

    def spun(self, axis: str, angle: float) -> Table:
        """With its frame turned about one of its axes [rad]."""
        return self.moved(spun(axis, angle))

    def bundled(self, bundle: str) -> Table:
        """Whose parts go into another bundle."""
        return replace(self, bundle=bundle)

    # --- what ---

    def add(
        self,
        name: str,
        *solids: Solid,
        of: str = "",
        own: bool | None = None,
        fine: bool | None = None,
        turns: Turning | None = None,
        front: tuple[float, float, float] | None = None,
    ) -> None:
        """Puts solids down as one part.

        Args:
            name: of the vocabulary, which says its group.
            solids: in the frame; none adds nothing.
            of: kind of material; the usual one of the name if "".
            own: whether it is of the device's own bundle; if None parts of the device's group are, but for wheels and
                levers, and small fasteners.
            fine: whether a style without fasteners leaves it out; fasteners if None.
            turns: what of it turns, in the frame.
            front: unit vector out of what is read on it, in the frame.
        """
        if not solids:
            return
        group, small = group_of(name), name in _FINE if fine is None else fine
        own = (small or (group == self.group and name not in _APART)) if own is None else own
        solid = merge(solids) if len(solids) > 1 else solids[0]
        part = Part(
            solid,
            name,
            of or _MATERIALS.get(name, "steel"),
            self.bundle if own else "",
            "" if group == self.group else group,
            small,
            front,
            turns,
        )
        self.extend([part])

    def add_each(self, name: str, solids: Iterable[Solid], *, joined: bool = False, **more: Any) -> None:
        """Puts solids down each as a part of its own, or joined as one.

        Args:
            name: as of ``add``.
            solids: in the frame.
            joined: whether they are one part.
            more: as of ``add``.
        """
        for some in [list(solids)] if joined else [[one] for one in solids]:
            self.add(name, *some, **more)

    def extend(self, parts: Sequence[Part]) -> None:
        """Puts finished parts down, in the frame."""
        self.parts.extend(parts if self.frame is IDENTITY else placed(parts, self.frame))

    def model(
        self, length: float = 0.0, joint: str = "flanged", kind: str = "", ports: Sequence[Port] = (), **more: Any
    ) -> Model:
        """What was put down, as a device."""
        return Model(self.parts, length, joint, kind, tuple(ports), **more)
