"""The devices of the presets as families."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadplants.access import platform, railing, stairs
from cadplants.electrical import cabinet, cable_tray, lamp, sign
from cadplants.enclosure import fence, pillar
from cadplants.family import UNIT, Family
from cadplants.gauge import pressure_gauge
from cadplants.meter import flow_meter, strainer
from cadplants.modeling_style import ModelingStyle
from cadplants.piping import reducer, tee
from cadplants.plant import Assembly, Device
from cadplants.pump import pump
from cadplants.standards import FACE_TO_FACE, SIZES
from cadplants.structure import column, post
from cadplants.valve import VALVES
from cadplants.vessel import Nozzle, tank

__all__ = ["KNOWN"]

_WHEELS = ("round", "round", "plate", "solid")


def _ball(dn: int, style: ModelingStyle, rng: np.random.Generator, build: str) -> Device:
    lever = str(rng.choice(["cranked", "straight", "cranked", "actuator"]))
    turn = float(rng.choice([0.0, np.pi, np.pi / 2]))
    return VALVES["ball"](UNIT, dn, style, turn=turn, lever=lever, build=build)


def _wheeled(dn: int, style: ModelingStyle, rng: np.random.Generator, kind: str, **more: str) -> Device:
    options = {"spokes": int(rng.integers(3, 7)), "turn": float(rng.uniform(0, 6)), "wheel": str(rng.choice(_WHEELS))}
    return VALVES[kind](UNIT, dn, style, **options, **more)


def _butterfly(dn: int, style: ModelingStyle, rng: np.random.Generator, gearbox: bool) -> Device:
    return VALVES["butterfly"](UNIT, dn, style, gearbox=gearbox, spokes=int(rng.integers(3, 5)))


def _check(dn: int, style: ModelingStyle, _: np.random.Generator) -> Device:
    return VALVES["check"](UNIT, dn, style)


def _meter(dn: int, style: ModelingStyle, _: np.random.Generator) -> Device:
    return flow_meter(UNIT, dn, style)


def _strainer(dn: int, style: ModelingStyle, _: np.random.Generator) -> Device:
    return strainer(dn, style)


def _tee(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Device:
    smaller = [size for size in SIZES if size <= dn]
    return tee(dn, int(rng.choice(smaller[-4:])), style)


def _reducer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Device:
    return reducer(dn, int(rng.choice([size for size in SIZES if size < dn][-3:])), style)


def _gauge(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    size = int(rng.choice([63, 63, 100, 160]))
    height = float(rng.choice([0.05, 0.075, 0.09, 0.12]))
    return pressure_gauge(UNIT, style, size, height, float(rng.uniform(0, 6)), float(rng.uniform(0.4, 2.8)))


def _pump(dn: int, style: ModelingStyle, _: np.random.Generator) -> Assembly:
    smaller = [size for size in SIZES if size < dn]
    return pump(UNIT, dn, smaller[-1], style).assembly


def _tank(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    nozzles = (
        Nozzle(int(rng.choice([25, 50, 80])), "top", (0.15, 0.1)),
        Nozzle(int(rng.choice([25, 40])), "side", (float(rng.uniform(0.2, 1.2)), 0.4)),
    )
    radius, height = float(rng.uniform(0.4, 0.9)), float(rng.uniform(0.8, 2.2))
    return tank(UNIT, style, round(radius, 3), round(height, 3), 0.3, nozzles, int(rng.choice([3, 4]))).assembly


def _platform(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return platform(
        float(rng.uniform(1.5, 2.5)), float(rng.uniform(1.0, 1.6)), float(rng.uniform(1.0, 2.2)), style, 0.3
    )


def _stairs(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return stairs(float(rng.uniform(0.9, 2.0)), style)


def _railing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return railing(np.zeros(3), np.array([float(rng.uniform(1.0, 3.0)), 0.0, 0.0]), style)


def _fence(_: int, style: ModelingStyle, rng: np.random.Generator, gate: bool) -> Assembly:
    return fence(float(rng.uniform(1.2, 2.5)), style, float(rng.uniform(0.9, 1.6)), float(rng.uniform(0.1, 0.3)), gate)


def _pillar(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return pillar(style, float(rng.uniform(0.25, 0.5)), float(rng.uniform(1.0, 2.0)))


def _cabinet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return cabinet(style, float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.25, 0.6)), float(rng.uniform(1.2, 2.1)))


def _tray(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    width = float(rng.choice([0.1, 0.2, 0.3, 0.4]))
    return cable_tray(float(rng.uniform(1.5, 4.0)), style, width, int(rng.integers(0, 4)), int(rng.integers(1, 3)))


def _lamp(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return lamp(style, float(rng.uniform(2.5, 5.0)))


def _sign(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return sign(style)


def _column(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    sizes = ("HEA 100", "HEA 120", "HEA 160", "HEA 200", "IPE 100", "IPE 160", "IPE 200")
    return column(float(rng.uniform(1.5, 4.0)), style, str(rng.choice(sizes)))


def _post(_: int, style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    return post(
        float(rng.uniform(0.5, 2.0)), style, float(rng.choice([0.04, 0.05, 0.06, 0.08])), capped=bool(rng.integers(2))
    )


def _sizes(kind: str) -> tuple[int, ...]:
    return tuple(FACE_TO_FACE[kind])


_VALVE, _GAUGE, _PIPE = "Valve assembly", "Gauge assembly", "Pipe assembly"
_FRAME, _SAFETY = "Structural element", "Electrical and safety"

KNOWN: tuple[Family, ...] = (
    Family(
        "ball valve/two-piece", "inline", _VALVE, "valve", partial(_ball, build="two-piece"), _sizes("ball"), weight=2
    ),
    Family("ball valve/barrel", "inline", _VALVE, "valve", partial(_ball, build="barrel"), _sizes("ball")),
    Family("globe valve/sphere", "inline", _VALVE, "valve", partial(_wheeled, kind="globe", build="sphere"), weight=2),
    Family("globe valve/barrel", "inline", _VALVE, "valve", partial(_wheeled, kind="globe", build="barrel")),
    Family("gate valve/rising stem", "inline", _VALVE, "valve", partial(_wheeled, kind="gate"), weight=2),
    Family(
        "butterfly valve/wafer lever",
        "inline",
        _VALVE,
        "valve",
        partial(_butterfly, gearbox=False),
        _sizes("butterfly"),
    ),
    Family(
        "butterfly valve/wafer gear", "inline", _VALVE, "valve", partial(_butterfly, gearbox=True), _sizes("butterfly")
    ),
    Family("check valve/swing", "inline", _VALVE, "valve", _check, weight=2),
    Family("flow meter/magnetic", "inline", _GAUGE, "gauge", _meter),
    Family("strainer/basket", "inline", _PIPE, "strainer", _strainer),
    Family("tee/butt weld", "inline", _PIPE, "tee", _tee, weight=3, welded=True),
    Family("reducer/concentric", "inline", _PIPE, "reducer", _reducer, SIZES[2:], weight=2, welded=True),
    Family("gauge/stem", "tap", _GAUGE, "gauge", _gauge, weight=3),
    Family("pump/end suction", "floor", "Pump unit", "pump", _pump, (50, 80, 100, 150)),
    Family("tank/dished on legs", "floor", "Tank", "tank", _tank),
    Family("platform/grating", "floor", _FRAME, "platform", _platform),
    Family("stairs/straight", "floor", _FRAME, "stair tread", _stairs),
    Family("railing/tube", "floor", _FRAME, "railing", _railing),
    Family("fence/bars", "floor", _FRAME, "fence", partial(_fence, gate=False)),
    Family("gate/bars", "floor", _FRAME, "gate", partial(_fence, gate=True)),
    Family("pillar/concrete", "floor", _FRAME, "column", _pillar),
    Family("control panel/cabinet", "floor", _SAFETY, "control panel", _cabinet),
    Family("cable tray/sheet", "floor", _SAFETY, "cable tray", _tray),
    Family("lamp/pole", "floor", _SAFETY, "lamp", _lamp),
    Family("sign/post", "floor", _SAFETY, "sign", _sign),
    Family("column/rolled", "floor", _FRAME, "column", _column),
    Family("post/square", "floor", _FRAME, "post", _post),
)
