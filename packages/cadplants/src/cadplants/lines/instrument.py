"""Builders that a run calls with its style: valves, gauges and tees by name, ready for ``Inline`` and ``Tap``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from cadplants.lines.layout import Inline, Tap
from cadplants.model.plant import Assembly, Device
from cadplants.parts.brand import Brand
from cadplants.parts.gauge import pressure_gauge
from cadplants.parts.meter import flow_meter
from cadplants.parts.piping import eccentric_reducer, reducer, tee
from cadplants.parts.primitive_devices import in_primitives
from cadplants.parts.strainer import strainer
from cadplants.parts.valve import VALVES
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["eccentric_at", "gauge_tap", "meter_at", "reducer_at", "strainer_at", "tee_at", "valve_at"]


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
    """A valve of a kind of ``VALVES`` with its middle at a chainage [m].

    Args:
        s: chainage.
        kind: of valve.
        unit: its id.
        dn: nominal size.
        roll: of its stem about the run [rad]; 0 is upright.
        reverse: whether it is built against the run.
        make: what its manufacturer builds.
        turn: of its wheel or lever [rad].
        actuated: whether a ball valve has an actuator in place of its lever.
    """
    options = dict((make or Brand()).options(kind, turn))
    if actuated and kind == "ball":
        options["lever"] = "actuator"
    build: Callable[[ModelingStyle], Device] = partial(_valve, kind=kind, unit=unit, dn=dn, options=options)
    return Inline(s, build, unit, roll, reverse)


def meter_at(s: float, unit: str, dn: int) -> Inline:
    """A flow meter with its middle at a chainage [m]."""
    return Inline(s, partial(_meter, unit=unit, dn=dn), unit)


def strainer_at(s: float, dn: int) -> Inline:
    """A basket strainer with its middle at a chainage [m], its lid on top; no unit of its own."""
    return Inline(s, partial(_strainer, dn=dn))


def tee_at(s: float, junction: str, dn: int, branch: int, roll: float = 0.0) -> Inline:
    """A tee with its middle at a chainage [m], its branch at ``roll`` from the run's z."""
    return Inline(s, partial(_tee, dn=dn, branch=branch), roll=roll, welded=True, junction=junction)


def reducer_at(s: float, dn: int, other: int) -> Inline:
    """A reducer with its middle at a chainage [m]; the run goes on in the other size."""
    return Inline(s, partial(_reducer, dn=dn, other=other), welded=True, dn=other)


def eccentric_at(s: float, dn: int, other: int) -> Inline:
    """A reducer with a flat top, its middle at a chainage [m]; the run's route goes on higher, see ``Route.jog``."""
    return Inline(s, partial(_eccentric, dn=dn, other=other), welded=True, dn=other)


def gauge_tap(s: float, unit: str, rng: np.random.Generator, size: int = 63, turn: float = 0.0) -> Tap:
    """A pressure gauge upright on a level pipe; ``turn`` of its dial [rad]."""
    build: Callable[[ModelingStyle], Assembly] = partial(
        _gauge,
        unit=unit,
        size=size,
        turn=turn,
        needle=float(rng.uniform(0.6, 2.6)),
        height=0.075 if size < 100 else 0.09,
    )
    return Tap(s, build, unit)


def _valve(style: ModelingStyle, kind: str, unit: str, dn: int, options: Mapping[str, Any]) -> Device:
    built = VALVES[kind](unit, dn, style, **options)
    return in_primitives(built, dn, style) if style.devices == "primitives" else built


def _meter(style: ModelingStyle, unit: str, dn: int) -> Device:
    return flow_meter(unit, dn, style)


def _strainer(style: ModelingStyle, dn: int) -> Device:
    return strainer(dn, style)


def _tee(style: ModelingStyle, dn: int, branch: int) -> Device:
    return tee(dn, branch, style)


def _reducer(style: ModelingStyle, dn: int, other: int) -> Device:
    return reducer(dn, other, style)


def _eccentric(style: ModelingStyle, dn: int, other: int) -> Device:
    return eccentric_reducer(dn, other, style)


def _gauge(style: ModelingStyle, unit: str, size: int, turn: float, needle: float, height: float) -> Assembly:
    return pressure_gauge(unit, style, size, height, turn, needle)
