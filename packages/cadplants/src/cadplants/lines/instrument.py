"""Devices put into a run: valves, gauges and fittings with their parameters, ready for ``Inline`` and ``Tap``."""

from __future__ import annotations

from functools import partial
from zlib import crc32

from cadplants.builder.device import Device
from cadplants.families.preset_devices import (
    Barrel,
    Basket,
    EccentricReducer,
    GlobeBarrel,
    GlobeSphere,
    MagneticMeter,
    OutsideYoke,
    PlainValve,
    Reducer,
    SwingCheck,
    Tee,
    TwoPiece,
    WaferGear,
    WaferLever,
)
from cadplants.lines.layout import Inline, Tap
from cadplants.model.plant import Device as InLine
from cadplants.parts.brand import Brand
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "eccentric_at",
    "in_style",
    "inline_at",
    "meter_at",
    "reducer_at",
    "strainer_at",
    "tap_at",
    "tee_at",
    "valve_at",
]

_GEARED = 200  # nominal size from which butterfly valves have a gearbox where their make doesn't say


def inline_at(
    s: float, device: Device, unit: str = "", roll: float = 0.0, reverse: bool = False, junction: str = "", dn: int = 0
) -> Inline:
    """A device with its middle at a chainage [m]; the rest as of ``Inline``."""
    return Inline(s, partial(_built, device, unit), unit, roll, reverse, device.welded, junction, dn)


def tap_at(s: float, device: Device, unit: str, roll: float = 0.0) -> Tap:
    """An instrument on a branch outlet at a chainage [m]; ``roll`` of the outlet about the run [rad]."""
    return Tap(s, partial(device.as_assembly, unit=unit), unit, roll)


def _built(device: Device, unit: str, style: ModelingStyle) -> InLine:
    return in_style(device.as_device(style, unit), device.dn, style)


def in_style(built: InLine, dn: int, style: ModelingStyle) -> InLine:
    """A device for a line; a valve as primitives in a style that has those. Its id decides of which."""
    units = built.assembly.units
    if style.devices != "primitives" or not units or units[0].type != "valve":
        return built
    form = crc32(units[0].id.encode()) % 4
    plain = PlainValve(dn=dn, stands_for=units[0].kind, length=built.length, wafer=built.wafer, form=form)
    return plain.as_device(style, units[0].id)


def valve_at(
    s: float,
    kind: str,
    unit: str,
    dn: int,
    roll: float = 0.0,
    reverse: bool = False,
    make: Brand | None = None,
    turn: float = 0.0,
    actuated: bool = False,
) -> Inline:
    """A valve with its middle at a chainage [m].

    Args:
        s: chainage.
        kind: ``ball``, ``butterfly``, ``check``, ``gate`` or ``globe``.
        unit: its id.
        dn: nominal size.
        roll: of its stem about the run [rad]; 0 is upright.
        reverse: whether it is built against the run.
        make: what its manufacturer builds.
        turn: of its wheel or lever [rad].
        actuated: whether a ball valve has an actuator in place of its lever.
    """
    return inline_at(s, _valve(make or Brand(), kind, dn, turn, actuated), unit, roll, reverse)


def _valve(make: Brand, kind: str, dn: int, turn: float, actuated: bool) -> Device:
    if kind == "ball":
        body = TwoPiece if make.ball == "two-piece" else Barrel
        return body(dn=dn, lever="actuator" if actuated else make.lever, turn=turn)
    if kind == "globe":
        globe = GlobeSphere if make.globe == "sphere" else GlobeBarrel
        return globe(dn=dn, spokes=make.spokes, turn=turn, wheel=make.wheel)
    if kind == "gate":
        return OutsideYoke(dn=dn, spokes=make.spokes, turn=turn, wheel=make.wheel)
    if kind == "butterfly":
        geared = dn >= _GEARED if make.gearbox is None else make.gearbox
        return (WaferGear if geared else WaferLever)(dn=dn, spokes=min(make.spokes, 4))
    return SwingCheck(dn=dn)


def meter_at(s: float, unit: str, dn: int) -> Inline:
    """A flow meter with its middle at a chainage [m]."""
    return inline_at(s, MagneticMeter(dn=dn), unit)


def strainer_at(s: float, dn: int) -> Inline:
    """A basket strainer with its middle at a chainage [m], its lid on top; no unit of its own."""
    return inline_at(s, Basket(dn=dn))


def tee_at(s: float, junction: str, dn: int, branch: int, roll: float = 0.0) -> Inline:
    """A tee with its middle at a chainage [m], its branch at ``roll`` from the run's z."""
    return inline_at(s, Tee(dn=dn, branch=branch), roll=roll, junction=junction)


def reducer_at(s: float, dn: int, other: int) -> Inline:
    """A reducer with its middle at a chainage [m]; the run goes on in the other size."""
    return inline_at(s, Reducer(dn=dn, small=other), dn=other)


def eccentric_at(s: float, dn: int, other: int) -> Inline:
    """A reducer with a flat top, its middle at a chainage [m]; the run's route goes on higher, see ``Route.jog``."""
    return inline_at(s, EccentricReducer(dn=dn, small=other), dn=other)
