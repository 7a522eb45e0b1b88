"""The devices of the presets as families: their parameters are drawn here, what is built lies with each of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import among, between, whole
from cadplants.model.family import UNIT, Family
from cadplants.model.plant import Assembly
from cadplants.model.plant import Device as InLine
from cadplants.model.standards import FACE_TO_FACE, SIZES
from cadplants.parts.access import platform, railing, stairs
from cadplants.parts.electrical import cabinet, cable_tray, lamp, sign
from cadplants.parts.enclosure import fence, pillar
from cadplants.parts.gauge import pressure_gauge
from cadplants.parts.meter import flow_meter
from cadplants.parts.piping import reducer, tee
from cadplants.parts.pump import pump
from cadplants.parts.strainer import strainer
from cadplants.parts.structure import column, post
from cadplants.parts.valve import VALVES
from cadplants.parts.vessel import Nozzle, tank
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["KNOWN"]


class _Finished(Device):
    """A device that is built as finished components, as the presets build it."""

    def made(self, style: ModelingStyle) -> InLine | Assembly:
        """The device in a style."""
        raise NotImplementedError(type(self).__name__)

    def model(self, style: ModelingStyle) -> Any:
        """Likewise; its components say what it was built from."""
        made, said = self.made(style), self.to_json()
        whole_of = made.assembly if isinstance(made, InLine) else made
        told = replace(whole_of, components=tuple(replace(one, params=said) for one in whole_of.components))
        return replace(made, assembly=told) if isinstance(made, InLine) else told


# --- in lines ---


class _Valve(_Finished, place="inline", group="Valve assembly", label="valve"):
    """A valve of the presets."""


class _Ball(_Valve, sizes=tuple(FACE_TO_FACE["ball"])):
    """A floating ball valve."""

    body: ClassVar[str]

    lever: str = among(("cranked", "straight", "cranked", "actuator"), "what turns its stem")
    turn: float = among((0.0, np.pi, np.pi / 2), "which way that looks", "rad")

    def made(self, style: ModelingStyle) -> InLine:
        return VALVES["ball"](UNIT, self.dn, style, turn=self.turn, lever=self.lever, build=self.body)


class TwoPiece(_Ball, name="ball valve/two-piece", weight=2):
    """A floating ball valve whose body has a bolted end piece."""

    body = "two-piece"


class Barrel(_Ball, name="ball valve/barrel"):
    """A floating ball valve with a body like a barrel."""

    body = "barrel"


class _Wheeled(_Valve):
    """A valve with a handwheel."""

    kind_of_valve: ClassVar[str] = "globe"
    body: ClassVar[str] = ""

    spokes: int = whole(3, 6, "spokes of its handwheel")
    turn: float = between(0, 6, "how far its handwheel is turned", "rad")
    wheel: str = among(("round", "round", "plate", "solid"), "rim and middle of its handwheel")

    def made(self, style: ModelingStyle) -> InLine:
        more = {"build": self.body} if self.body else {}
        build = VALVES[self.kind_of_valve]
        return build(UNIT, self.dn, style, spokes=self.spokes, turn=self.turn, wheel=self.wheel, **more)


class GlobeSphere(_Wheeled, name="globe valve/sphere", weight=2):
    """A globe valve with a round body."""

    body = "sphere"


class GlobeBarrel(_Wheeled, name="globe valve/barrel"):
    """A globe valve with a body like a barrel."""

    body = "barrel"


class RisingStem(_Wheeled, name="gate valve/rising stem", weight=2):
    """A gate valve with a rising stem in a yoke."""

    kind_of_valve = "gate"


class _Butterfly(_Valve, sizes=tuple(FACE_TO_FACE["butterfly"])):
    """A butterfly valve between flanges."""

    gearbox: ClassVar[bool] = False

    spokes: int = whole(3, 4, "spokes of its handwheel")

    def made(self, style: ModelingStyle) -> InLine:
        return VALVES["butterfly"](UNIT, self.dn, style, gearbox=self.gearbox, spokes=self.spokes)


class WaferLever(_Butterfly, name="butterfly valve/wafer lever"):
    """A butterfly valve between flanges with a lever."""


class WaferGear(_Butterfly, name="butterfly valve/wafer gear"):
    """A butterfly valve between flanges with a gearbox and a handwheel."""

    gearbox = True


class SwingCheck(_Valve, name="check valve/swing", weight=2):
    """A check valve with a swinging disc."""

    def made(self, style: ModelingStyle) -> InLine:
        return VALVES["check"](UNIT, self.dn, style)


class MagneticMeter(_Finished, name="flow meter/magnetic", place="inline", group="Gauge assembly", label="gauge"):
    """A magnetic flow meter."""

    def made(self, style: ModelingStyle) -> InLine:
        return flow_meter(UNIT, self.dn, style)


class _Fitting(_Finished, place="inline", group="Pipe assembly"):
    """A fitting of the presets."""


class Basket(_Fitting, name="strainer/basket", label="strainer"):
    """A basket strainer."""

    def made(self, style: ModelingStyle) -> InLine:
        return strainer(self.dn, style)


class Tee(_Fitting, name="tee/butt weld", label="tee", weight=3, welded=True):
    """A tee to be welded in (EN 10253-2)."""

    branch: int = among(lambda p: [size for size in SIZES if size <= p.dn][-4:], "nominal size of its branch", "mm")

    def made(self, style: ModelingStyle) -> InLine:
        return tee(self.dn, self.branch, style)


class Reducer(_Fitting, name="reducer/concentric", label="reducer", sizes=SIZES[2:], weight=2, welded=True):
    """A concentric reducer to be welded in (EN 10253-2)."""

    small: int = among(lambda p: [size for size in SIZES if size < p.dn][-3:], "nominal size of its small end", "mm")

    def made(self, style: ModelingStyle) -> InLine:
        return reducer(self.dn, self.small, style)


# --- on outlets, on the floor ---


class Gauge(_Finished, name="gauge/stem", place="tap", group="Gauge assembly", label="gauge", weight=3):
    """A pressure gauge on its stem (EN 837-1)."""

    size: int = among((63, 63, 100, 160), "nominal size of its case", "mm")
    stem: float = among((0.05, 0.075, 0.09, 0.12), "from the outlet to the case", "m")
    turn: float = between(0, 6, "which way its dial looks", "rad")
    reading: float = between(0.4, 2.8, "where its needle points", "rad")

    def made(self, style: ModelingStyle) -> Assembly:
        return pressure_gauge(UNIT, style, self.size, self.stem, self.turn, self.reading)


class EndSuction(_Finished, name="pump/end suction", group="Pump unit", label="pump", sizes=(50, 80, 100, 150)):
    """A centrifugal pump with its motor on a base."""

    def made(self, style: ModelingStyle) -> Assembly:
        return pump(UNIT, self.dn, max(size for size in SIZES if size < self.dn), style).assembly


class LeggedTank(_Finished, name="tank/dished on legs", group="Tank", label="tank"):
    """A tank with dished heads on legs."""

    top: int = among((25, 50, 80), "nominal size of the nozzle on top", "mm")
    side: int = among((25, 40), "of the nozzle at the side", "mm")
    around: float = between(0.2, 1.2, "where that nozzle is", "rad")
    radius: float = between(0.4, 0.9, "of the shell", "m")
    height: float = between(0.8, 2.2, "of the shell", "m")
    legs: int = among((3, 4), "legs")

    def made(self, style: ModelingStyle) -> Assembly:
        nozzles = (Nozzle(self.top, "top", (0.15, 0.1)), Nozzle(self.side, "side", (self.around, 0.4)))
        radius, height = round(self.radius, 3), round(self.height, 3)
        return tank(UNIT, style, radius, height, 0.3, nozzles, self.legs).assembly


class _Structure(_Finished, group="Structural element"):
    """A structure of the presets."""


class Platform(_Structure, name="platform/grating", label="platform"):
    """A platform of gratings on columns, with a railing that leaves an opening."""

    length: float = between(1.5, 2.5, "along the opening", "m")
    width: float = between(1.0, 1.6, "across", "m")
    floor: float = between(1.0, 2.2, "height of its floor", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return platform(self.length, self.width, self.floor, style, 0.3)


class Stairs(_Structure, name="stairs/straight", label="stair tread"):
    """A straight flight of stairs."""

    rise: float = between(0.9, 2.0, "height of the flight", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return stairs(self.rise, style)


class Railing(_Structure, name="railing/tube", label="railing"):
    """A railing of tubes with a toe plate."""

    length: float = between(1.0, 3.0, "length", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return railing(np.zeros(3), np.array([self.length, 0.0, 0.0]), style)


class _Bars(_Structure):
    """A fence of bars, or a gate in one."""

    gate: ClassVar[bool] = False

    length: float = between(1.2, 2.5, "over the posts", "m")
    height: float = between(0.9, 1.6, "of the posts", "m")
    pitch: float = between(0.1, 0.3, "least distance of the bars", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return fence(self.length, style, self.height, self.pitch, self.gate)


class Fence(_Bars, name="fence/bars", label="fence"):
    """A fence of upright bars between posts."""


class Gate(_Bars, name="gate/bars", label="gate"):
    """A gate of upright bars between posts."""

    gate = True


class Pillar(_Structure, name="pillar/concrete", label="column"):
    """A square pillar of concrete with a slab on it."""

    side: float = between(0.25, 0.5, "of its section", "m")
    height: float = between(1.0, 2.0, "of its shaft", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return pillar(style, self.side, self.height)


class _Safety(_Finished, group="Electrical and safety"):
    """An electrical device of the presets."""


class Cabinet(_Safety, name="control panel/cabinet", label="control panel"):
    """A control cabinet on a plinth."""

    width: float = between(0.5, 1.2, "of its front", "m")
    depth: float = between(0.25, 0.6, "depth", "m")
    height: float = between(1.2, 2.1, "height", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return cabinet(style, self.width, self.depth, self.height)


class Tray(_Safety, name="cable tray/sheet", label="cable tray"):
    """A cable tray of sheet metal with cables in it."""

    width: float = among((0.1, 0.2, 0.3, 0.4), "width", "m")
    length: float = between(1.5, 4.0, "length", "m")
    cables: int = whole(0, 3, "cables in it")
    pieces: int = whole(1, 2, "pieces end to end")

    def made(self, style: ModelingStyle) -> Assembly:
        return cable_tray(self.length, style, self.width, self.cables, self.pieces)


class Lamp(_Safety, name="lamp/pole", label="lamp"):
    """A lamp on a pole."""

    height: float = between(2.5, 5.0, "of its pole", "m")

    def made(self, style: ModelingStyle) -> Assembly:
        return lamp(style, self.height)


class Sign(_Safety, name="sign/post", label="sign"):
    """A sign on a post."""

    def made(self, style: ModelingStyle) -> Assembly:
        return sign(style)


class Column(_Structure, name="column/rolled", label="column"):
    """A rolled section upright on a base plate (EN 10365)."""

    height: float = between(1.5, 4.0, "height", "m")
    section: str = among(
        ("HEA 100", "HEA 120", "HEA 160", "HEA 200", "IPE 100", "IPE 160", "IPE 200"), "its rolled section"
    )

    def made(self, style: ModelingStyle) -> Assembly:
        return column(self.height, style, self.section)


class Post(_Structure, name="post/square", label="post"):
    """A square post on a base plate."""

    height: float = between(0.5, 2.0, "height", "m")
    side: float = among((0.04, 0.05, 0.06, 0.08), "of its section", "m")
    capped: bool = among((False, True), "a plate closes its top")

    def made(self, style: ModelingStyle) -> Assembly:
        return post(self.height, style, self.side, capped=self.capped)


KNOWN: tuple[Family, ...] = families_of(
    TwoPiece,
    Barrel,
    GlobeSphere,
    GlobeBarrel,
    RisingStem,
    WaferLever,
    WaferGear,
    SwingCheck,
    MagneticMeter,
    Basket,
    Tee,
    Reducer,
    Gauge,
    EndSuction,
    LeggedTank,
    Platform,
    Stairs,
    Railing,
    Fence,
    Gate,
    Pillar,
    Cabinet,
    Tray,
    Lamp,
    Sign,
    Column,
    Post,
)
