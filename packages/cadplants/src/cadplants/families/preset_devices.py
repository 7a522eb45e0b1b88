"""The devices of the presets as families: their parameters are drawn here, what is built lies with each of them.

A preset says what its devices are to be, ``TwoPiece(dn=50, lever="straight", turn=0.0)``; assortments draw those of
``PRESET_DEVICES`` at random, those of ``LAID_DEVICES`` never.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, each, given, nested, whole
from cadplants.families.vessels.vessel import LevelGauge
from cadplants.model.family import UNIT, Family, placed
from cadplants.model.plant import Assembly, Component, Unit
from cadplants.model.plant import Device as InLine
from cadplants.model.standards import FACE_TO_FACE, PIPES, SECTIONS, SIZES
from cadplants.parts.access import ladder, platform, platform_with_stairs, railing, stairs
from cadplants.parts.detail import Marks, marked_gauge, plate
from cadplants.parts.drum import drum
from cadplants.parts.electrical import cabinet, cable_tray, lamp, sign
from cadplants.parts.enclosure import fence, pillar
from cadplants.parts.fastener import pipe_support
from cadplants.parts.gauge import pressure_gauge, side_gauge
from cadplants.parts.meter import flow_meter
from cadplants.parts.piping import eccentric_reducer, reducer, tee
from cadplants.parts.primitive_devices import valve_of_primitives
from cadplants.parts.pump import Pump, pump
from cadplants.parts.strainer import strainer
from cadplants.parts.structure import beam, caster, column, deck, post
from cadplants.parts.valve import VALVES
from cadplants.parts.vessel import Nozzle, Tank, skin, tank
from cadplants.solids.transforms import looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "LAID_DEVICES",
    "PRESET_DEVICES",
    "Barrel",
    "Basket",
    "Beam",
    "Cabinet",
    "Caster",
    "CockGauge",
    "Column",
    "Deck",
    "Drum",
    "EccentricReducer",
    "EndSuction",
    "Fence",
    "Gate",
    "Gauge",
    "GlobeBarrel",
    "GlobeSphere",
    "Ladder",
    "Lamp",
    "MagneticMeter",
    "ManwayTank",
    "NamePlate",
    "Opening",
    "OutsideYoke",
    "Pillar",
    "PipeSupport",
    "PlainValve",
    "Platform",
    "PlatformWithStairs",
    "Post",
    "Reducer",
    "SideGauge",
    "Sign",
    "SwingCheck",
    "Tee",
    "Tray",
    "TwoPiece",
    "WaferGear",
    "WaferLever",
    "beam_between",
]

_FINE = 0.0003  # m; a style whose circles are coarser than this models no marks
_MANWAY = 300  # nominal size


class _Finished(Device):
    """A device that is built as finished components, as the presets build it."""

    def _made(self, style: ModelingStyle) -> InLine | Assembly:
        """The device in a style."""
        raise NotImplementedError(type(self).__name__)

    def model(self, style: ModelingStyle) -> Any:
        """Likewise; its components say what it was built from."""
        made, said = self._made(style), self.to_json()
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

    def _made(self, style: ModelingStyle) -> InLine:
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

    def _made(self, style: ModelingStyle) -> InLine:
        more = {"build": self.body} if self.body else {}
        build = VALVES[self.kind_of_valve]
        return build(UNIT, self.dn, style, spokes=self.spokes, turn=self.turn, wheel=self.wheel, **more)


class GlobeSphere(_Wheeled, name="globe valve/sphere", weight=2):
    """A globe valve with a round body."""

    body = "sphere"


class GlobeBarrel(_Wheeled, name="globe valve/barrel"):
    """A globe valve with a body like a barrel."""

    body = "barrel"


class OutsideYoke(_Wheeled, name="gate valve/os&y", weight=2):
    """A gate valve with outside screw and yoke: its stem rises through the handwheel."""

    kind_of_valve = "gate"


class _Butterfly(_Valve, sizes=tuple(FACE_TO_FACE["butterfly"])):
    """A butterfly valve between flanges."""

    gearbox: ClassVar[bool] = False

    spokes: int = whole(3, 4, "spokes of its handwheel")

    def _made(self, style: ModelingStyle) -> InLine:
        return VALVES["butterfly"](UNIT, self.dn, style, gearbox=self.gearbox, spokes=self.spokes)


class WaferLever(_Butterfly, name="butterfly valve/wafer lever"):
    """A butterfly valve between flanges with a lever."""


class WaferGear(_Butterfly, name="butterfly valve/wafer gear"):
    """A butterfly valve between flanges with a gearbox and a handwheel."""

    gearbox = True


class SwingCheck(_Valve, name="check valve/swing", weight=2):
    """A check valve with a swinging disc."""

    def _made(self, style: ModelingStyle) -> InLine:
        return VALVES["check"](UNIT, self.dn, style)


class PlainValve(_Valve, name="valve/cones or cylinder"):
    """A valve as plant-design systems draw it: two cones or one cylinder between its faces, a rod for its spindle."""

    stands_for: str = among(
        ("ball valve", "butterfly valve", "check valve", "gate valve", "globe valve"),
        "kind of valve that it stands for",
    )
    length: float = between(lambda p: 1.5 * PIPES[p.dn].outer, lambda p: 0.1 + 2.5 * PIPES[p.dn].outer, "overall", "m")
    wafer: bool = chance(0.1, "it has no flanges and is held between those of the line")
    form: int = whole(
        0, 3, "0 cones and rod in one mesh, 1 in three meshes, 2 a cylinder alone, 3 cones with flanges in one mesh"
    )

    def _made(self, style: ModelingStyle) -> InLine:
        return valve_of_primitives(UNIT, self.stands_for, self.dn, self.length, self.wafer, self.form, style)


class MagneticMeter(_Finished, name="flow meter/magnetic", place="inline", group="Gauge assembly", label="gauge"):
    """A magnetic flow meter."""

    def _made(self, style: ModelingStyle) -> InLine:
        return flow_meter(UNIT, self.dn, style)


class _Fitting(_Finished, place="inline", group="Pipe assembly"):
    """A fitting of the presets."""


class Basket(_Fitting, name="strainer/basket", label="strainer"):
    """A basket strainer."""

    def _made(self, style: ModelingStyle) -> InLine:
        return strainer(self.dn, style)


class Tee(_Fitting, name="tee/butt weld", label="tee", weight=3, welded=True):
    """A tee to be welded in (EN 10253-2)."""

    branch: int = among(lambda p: [size for size in SIZES if size <= p.dn][-4:], "nominal size of its branch", "mm")

    def _made(self, style: ModelingStyle) -> InLine:
        return tee(self.dn, self.branch, style)


class Reducer(_Fitting, name="reducer/concentric", label="reducer", sizes=SIZES[2:], weight=2, welded=True):
    """A concentric reducer to be welded in (EN 10253-2)."""

    small: int = among(lambda p: [size for size in SIZES if size < p.dn][-3:], "nominal size of its small end", "mm")

    def _made(self, style: ModelingStyle) -> InLine:
        return reducer(self.dn, self.small, style)


class EccentricReducer(Reducer, name="reducer/flat top", label="reducer", sizes=SIZES[2:], welded=True):
    """An eccentric reducer to be welded in, flat on top (EN 10253-2)."""

    def _made(self, style: ModelingStyle) -> InLine:
        return eccentric_reducer(self.dn, self.small, style)


# --- on outlets, on the floor ---


class _Gauge(_Finished, place="tap", group="Gauge assembly", label="gauge"):
    """A pressure gauge (EN 837-1)."""

    size: int = among((63, 63, 100, 160), "nominal size of its case", "mm")
    marks: Marks = given("none", "marks on its dial, where a style is fine enough", choices=("none", "few", "all"))

    def _bare(self, style: ModelingStyle) -> Assembly:
        """The gauge without marks."""
        raise NotImplementedError(type(self).__name__)

    def _made(self, style: ModelingStyle) -> Assembly:
        fine = style.sag <= _FINE and not style.wobble and style.devices == "built"
        return marked_gauge(self._bare(style), self.size, self.marks if fine else "none", style)


class Gauge(_Gauge, name="gauge/stem", weight=3):
    """A pressure gauge upright on its stem."""

    stem: float = among((0.05, 0.075, 0.09, 0.12), "from the outlet to the case", "m")
    turn: float = between(0, 6, "which way its dial looks", "rad")
    reading: float = between(0.4, 2.8, "where its needle points", "rad")

    def _bare(self, style: ModelingStyle) -> Assembly:
        return pressure_gauge(UNIT, style, self.size, self.stem, self.turn, self.reading)


class SideGauge(_Gauge, name="gauge/siphon beside pipe"):
    """A pressure gauge beside an upright pipe: its siphon goes out along z and up along x."""

    out: float = among((0.09, 0.11, 0.13), "from the outlet to the upright of its siphon", "m")
    rise: float = among((0.05, 0.06, 0.08), "from the level of its siphon to the gauge's stem", "m")
    turn: float = among((-np.pi / 2, 0.0), "which way its dial looks", "rad")
    reading: float = between(0.4, 2.8, "where its needle points", "rad")

    def _bare(self, style: ModelingStyle) -> Assembly:
        return side_gauge(UNIT, style, self.size, self.out, self.rise, self.turn, self.reading)


class CockGauge(_Finished, name="level gauge/between cocks", group="Gauge assembly", label="level gauge"):
    """A level gauge between two cocks on the shell of an upright tank about z, the tank not with it."""

    shell: float = between(0.5, 0.9, "radius of the tank's shell", "m", digits=3)
    around: float = given(0.0, "where it hangs round the shell", "rad", low=-6.3, high=6.3)
    low: float = between(0.6, 0.9, "height of the lower cock", "m")
    high: float = between(1.4, 2.4, "height of the upper cock", "m")
    gauge: LevelGauge = nested(LevelGauge, "level gauge")

    def _made(self, style: ModelingStyle) -> Assembly:
        pieces = self.gauge.parts(skin(self.shell, self.around, style), self.low, self.high, style)
        components = tuple(
            Component(p.solid, p.group, p.name, style.color(p.color), unit=UNIT, granularity="pieces")
            for p in placed(pieces, spun("z", self.around))
        )
        return Assembly(components, (), (Unit(UNIT, "gauge", "level gauge"),))


class EndSuction(_Finished, name="pump/end suction", group="Pump unit", label="pump", sizes=(50, 80, 100, 150)):
    """A centrifugal pump with its motor on a base."""

    out: int = given(0, "nominal size of its discharge; 0: the next below its suction", "mm", choices=(0, *SIZES))

    def _made(self, style: ModelingStyle) -> Assembly:
        return self._whole(style).assembly

    def pump(self, unit: str, style: ModelingStyle) -> Pump:
        """The pump with the frames of its faces, for a preset that joins lines to it."""
        return replace(self._whole(style), assembly=self.as_assembly(style, unit))

    def _whole(self, style: ModelingStyle) -> Pump:
        return pump(UNIT, self.dn, self.out or max(size for size in SIZES if size < self.dn), style)


class LeggedTank(_Finished, name="tank/dished on legs", group="Tank", label="tank"):
    """A tank with dished heads on legs."""

    top: int = among((25, 50, 80), "nominal size of the nozzle on top", "mm")
    side: int = among((25, 40), "of the nozzle at the side", "mm")
    around: float = between(0.2, 1.2, "where that nozzle is", "rad")
    radius: float = between(0.4, 0.9, "of the shell", "m", digits=3)
    height: float = between(0.8, 2.2, "of the shell", "m", digits=3)
    legs: int = among((3, 4), "legs")

    def _made(self, style: ModelingStyle) -> Assembly:
        nozzles = (Nozzle(self.top, "top", (0.15, 0.1)), Nozzle(self.side, "side", (self.around, 0.4)))
        return tank(UNIT, style, self.radius, self.height, 0.3, nozzles, self.legs).assembly


class Opening(Params):
    """A nozzle or manway of a tank."""

    size: int = given(50, "nominal size", "mm", choices=SIZES)
    on: str = given("top", "where it is", choices=("top", "side", "left", "right"))
    first: float = given(
        0.0,
        "x on an upper head, angle round an upright shell [rad], x on top of or y along a lying one",
        low=-6.3,
        high=6.3,
    )
    second: float = given(
        0.0,
        "y on an upper head, height over an upright shell's rim, y on top of or height over a lying axis",
        "m",
        low=-6.3,
        high=6.3,
    )
    length: float = given(0.15, "from the shell to the face of its flange", "m", low=0.1, high=1.0)
    manway: bool = given(False, "a bolted lid closes it")

    @classmethod
    def of(cls, nozzle: Nozzle) -> Opening:
        """A nozzle as parameters."""
        (first, second), length, lid = nozzle.place, nozzle.length, nozzle.manway
        return cls(size=nozzle.dn, on=nozzle.kind, first=first, second=second, length=length, manway=lid)

    @property
    def nozzle(self) -> Nozzle:
        """As tanks are built with it."""
        return Nozzle(self.size, self.on, (self.first, self.second), self.length, self.manway)


def _upright_opening(rng: np.random.Generator, tank: Any, before: tuple[Opening, ...]) -> Opening:
    """One after the other: the main nozzle on top, one at the side, a manway."""
    if not before:
        return Opening.of(Nozzle((50, 80, 100)[int(rng.integers(3))], "top", (0.0, 0.0)))
    if len(before) == 1:
        return Opening.of(Nozzle((25, 40)[int(rng.integers(2))], "side", (float(rng.uniform(-0.5, 0.5)), 0.16)))
    return Opening.of(Nozzle(_MANWAY, "side", (float(rng.uniform(1.8, 2.4)), 0.6), 0.2, manway=True))


def _lying_opening(rng: np.random.Generator, tank: Any, before: tuple[Opening, ...]) -> Opening:
    """One after the other: two nozzles on top, a manway at the left."""
    if len(before) < 2:
        y = (-0.25, 0.25)[len(before)] * tank.length
        return Opening.of(Nozzle((50, 80)[int(rng.integers(2))], "top", (0.0, y)))
    return Opening.of(Nozzle(_MANWAY, "left", (float(rng.uniform(-0.1, 0.1)), 0.0), 0.2, manway=True))


class _Vessel(_Finished, group="Tank", label="tank"):
    """A tank to whose nozzles a preset joins its lines."""

    def _whole(self, style: ModelingStyle) -> Tank:
        """The tank with the frames of its faces."""
        raise NotImplementedError(type(self).__name__)

    def _made(self, style: ModelingStyle) -> Assembly:
        return self._whole(style).assembly

    def tank(self, unit: str, style: ModelingStyle) -> Tank:
        """The tank with the frames of its faces, for a preset that joins lines to it."""
        return replace(self._whole(style), assembly=self.as_assembly(style, unit))


def _fitting(
    openings: Sequence[Opening], radius: float, aside: Mapping[str, Callable[[Opening], float]]
) -> list[Nozzle]:
    """Nozzles that lie on a shell, where ``aside`` says how far from its axis they are, by where they can be."""
    for k, one in enumerate(openings):
        if one.on not in aside:
            raise ValueError(f"nozzles.{k}.on={one.on}: give {', '.join(aside)}")
        if aside[one.on](one) + PIPES[one.size].radius >= radius:
            raise ValueError(f"nozzles.{k}: of DN {one.size}, it reaches beyond the shell")
    return [one.nozzle for one in openings]


class ManwayTank(_Vessel, name="tank/dished with manway"):
    """A tank with dished heads on legs, with nozzles and a manway."""

    radius: float = between(0.6, 0.9, "of the shell", "m")
    height: float = between(1.2, 2.2, "of the shell", "m")
    clearance: float = between(0.3, 0.4, "from the ground to the lower head", "m")
    legs: int = among((3, 4), "legs")
    nozzles: tuple[Opening, ...] = each(_upright_opening, 3, "nozzles and manways")

    def _whole(self, style: ModelingStyle) -> Tank:
        aside = {"top": lambda one: float(np.hypot(one.first, one.second)), "side": lambda _: 0.0}
        nozzles = _fitting(self.nozzles, self.radius, aside)
        return tank(UNIT, style, self.radius, self.height, self.clearance, nozzles, self.legs)


class Drum(_Vessel, name="tank/drum"):
    """A lying tank with dished heads on saddles, with nozzles and a manway."""

    radius: float = between(0.45, 0.75, "of the shell", "m")
    length: float = between(1.4, 2.4, "of the shell", "m")
    clearance: float = between(0.3, 0.4, "from the ground to the shell", "m")
    nozzles: tuple[Opening, ...] = each(_lying_opening, 3, "nozzles and manways")

    def _whole(self, style: ModelingStyle) -> Tank:
        aside: dict[str, Callable[[Opening], float]] = {"top": lambda one: abs(one.first)}
        aside |= dict.fromkeys(("left", "right"), lambda one: abs(one.second))
        nozzles = _fitting(self.nozzles, self.radius, aside)
        return drum(UNIT, style, self.radius, self.length, self.clearance, nozzles)


class _Structure(_Finished, group="Structural element"):
    """A structure of the presets."""


class Platform(_Structure, name="platform/grating", label="platform"):
    """A platform of gratings on columns, with a railing that leaves an opening."""

    length: float = between(1.5, 2.5, "along the opening", "m")
    width: float = between(1.0, 1.6, "across", "m")
    floor: float = between(1.0, 2.2, "height of its floor", "m")
    opened: bool = given(True, "its railing leaves an opening")
    opening: float = given(
        0.3,
        "x of the middle of that",
        "m",
        low=lambda p: 0.55 - p.length / 2,
        high=lambda p: p.length / 2 - 0.55,
    )

    def _made(self, style: ModelingStyle) -> Assembly:
        return platform(self.length, self.width, self.floor, style, self.opening if self.opened else None)


class PlatformWithStairs(_Structure, name="platform/with stairs", label="platform"):
    """A platform of gratings on columns, with stairs up to an opening in its railing."""

    length: float = between(3.0, 4.5, "along the opening", "m")
    width: float = between(1.0, 1.6, "across", "m")
    floor: float = between(1.6, 2.6, "height of its floor", "m")
    opening: float = between(0.4, 0.9, "x of the middle of the opening", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return platform_with_stairs(self.length, self.width, self.floor, style, self.opening)


class Ladder(_Structure, name="ladder/flat stiles", label="ladder"):
    """A fixed ladder of rungs between two flat bars (EN ISO 14122-4)."""

    floor: float = between(1.6, 3.5, "height of the floor that it leads to", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return ladder(self.floor, style)


class Deck(_Structure, name="skid frame/plate on channels", label="skid frame"):
    """The plate of a wheeled skid on a frame of channels, its top at z = 0."""

    length: float = between(1.2, 3.2, "of the plate", "m")
    width: float = between(0.7, 1.2, "of the plate", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return deck(self.length, self.width, style)


class Caster(_Structure, name="caster/swivel below plate", label="caster"):
    """A swivel caster that hangs below z = 0 (EN 12532)."""

    turn: float = between(0, 2 * np.pi, "which way it runs", "rad")

    def _made(self, style: ModelingStyle) -> Assembly:
        return caster(style, self.turn)


class Beam(_Structure, name="beam/one section", label="beam"):
    """A rolled section along x from 0, its web upright (EN 10365)."""

    length: float = between(1.0, 4.0, "length", "m")
    section: str = among(tuple(SECTIONS), "its rolled section")

    def _made(self, style: ModelingStyle) -> Assembly:
        return beam(np.zeros(3), np.array([self.length, 0.0, 0.0]), style, self.section)


class Stairs(_Structure, name="stairs/straight", label="stair tread"):
    """A straight flight of stairs."""

    rise: float = between(0.9, 2.0, "height of the flight", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return stairs(self.rise, style)


class Railing(_Structure, name="railing/tube", label="railing"):
    """A railing of tubes with a toe plate."""

    length: float = between(1.0, 3.0, "length", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return railing(np.zeros(3), np.array([self.length, 0.0, 0.0]), style)


class _Bars(_Structure):
    """A fence of bars, or a gate in one."""

    gate: ClassVar[bool] = False

    length: float = between(1.2, 2.5, "over the posts", "m")
    height: float = between(0.9, 1.6, "of the posts", "m")
    pitch: float = between(0.1, 0.3, "least distance of the bars", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
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

    def _made(self, style: ModelingStyle) -> Assembly:
        return pillar(style, self.side, self.height)


def beam_between(start: Sequence[float], end: Sequence[float], section: str, style: ModelingStyle) -> Assembly:
    """A rolled section between two points of its axis [m], its web upright."""
    way = np.subtract(end, start)
    return Beam(length=float(np.linalg.norm(way)), section=section).as_assembly(style).placed(looking(start, way))


class PipeSupport(_Finished, name="pipe support/u-bolt on bracket", group="Connection assembly", label="bracket"):
    """A U-bolt on a bracket; the pipe lies along x through the origin, what carries it towards +y."""

    def _made(self, style: ModelingStyle) -> Assembly:
        return pipe_support(self.dn, style)


class _Safety(_Finished, group="Electrical and safety"):
    """An electrical device of the presets."""


class Cabinet(_Safety, name="control panel/cabinet", label="control panel"):
    """A control cabinet on a plinth."""

    width: float = between(0.5, 1.2, "of its front", "m")
    depth: float = between(0.25, 0.6, "depth", "m")
    height: float = between(1.2, 2.1, "height", "m")
    text: str = given("", "what plates on its door say; line ends in it are |, the next plate begins behind ||")

    def _made(self, style: ModelingStyle) -> Assembly:
        plates = tuple(tuple(one.split("|")) for one in self.text.split("||")) if self.text else ()
        return cabinet(style, self.width, self.depth, self.height, plates)


class Tray(_Safety, name="cable tray/sheet", label="cable tray"):
    """A cable tray of sheet metal with cables in it."""

    width: float = among((0.1, 0.2, 0.3, 0.4), "width", "m")
    length: float = between(1.5, 4.0, "length", "m")
    cables: int = whole(0, 3, "cables in it")
    pieces: int = whole(1, 2, "pieces end to end")

    def _made(self, style: ModelingStyle) -> Assembly:
        return cable_tray(self.length, style, self.width, self.cables, self.pieces)


class Lamp(_Safety, name="lamp/pole", label="lamp"):
    """A lamp on a pole."""

    height: float = between(2.5, 5.0, "of its pole", "m")

    def _made(self, style: ModelingStyle) -> Assembly:
        return lamp(style, self.height)


class Sign(_Safety, name="sign/post", label="sign"):
    """A sign on a post."""

    text: str = given("", "what it says; line ends in it are |")

    def _made(self, style: ModelingStyle) -> Assembly:
        return sign(style, tuple(self.text.split("|")) if self.text else ())


class NamePlate(_Safety, name="sign/name plate", label="sign"):
    """A riveted sheet with raised letters, in the plane z = 0."""

    text: str = given("PUMP P-1|5.5 KW 2900", "what it says; line ends in it are |")
    letter: float = between(0.005, 0.014, "height of its letters", "m")
    rivets: int = among((0, 2, 4), "rivets")

    def _made(self, style: ModelingStyle) -> Assembly:
        return plate(tuple(self.text.split("|")), style, self.letter, self.rivets)


class Column(_Structure, name="column/rolled", label="column"):
    """A rolled section upright on a base plate (EN 10365)."""

    height: float = between(1.5, 4.0, "height", "m")
    section: str = among(
        ("HEA 100", "HEA 120", "HEA 160", "HEA 200", "IPE 100", "IPE 160", "IPE 200"), "its rolled section"
    )

    def _made(self, style: ModelingStyle) -> Assembly:
        return column(self.height, style, self.section)


class Post(_Structure, name="post/square", label="post"):
    """A square post on a base plate."""

    height: float = between(0.5, 2.0, "height", "m")
    side: float = among((0.04, 0.05, 0.06, 0.08), "of its section", "m")
    capped: bool = among((False, True), "a plate closes its top")

    def _made(self, style: ModelingStyle) -> Assembly:
        return post(self.height, style, self.side, capped=self.capped)


PRESET_DEVICES: tuple[Family, ...] = families_of(
    TwoPiece,
    Barrel,
    GlobeSphere,
    GlobeBarrel,
    OutsideYoke,
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
"""Of the presets and of assortments."""

LAID_DEVICES: tuple[Family, ...] = families_of(
    PlainValve,
    EccentricReducer,
    SideGauge,
    CockGauge,
    ManwayTank,
    Drum,
    PlatformWithStairs,
    Ladder,
    Deck,
    Caster,
    Beam,
    PipeSupport,
    NamePlate,
)
"""Of the presets alone; assortments have others of their kind."""
