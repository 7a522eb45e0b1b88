"""Dimensions of piping components, in metres, from the tables of standards that cadgraph keeps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from cadgraph.model.standards import by_size, read_table

__all__ = [
    "ELBOW_LONG_RADIUS",
    "FACE_TO_FACE",
    "FLANGES",
    "GAUGES",
    "HEX_NUTS",
    "PIPES",
    "RAISED_FACE",
    "REDUCER_LENGTH",
    "SECTIONS",
    "SIZES",
    "TEE_CENTER_TO_END",
    "WASHERS",
    "Flange",
    "Gauge",
    "Pipe",
    "sizes_between",
    "smaller",
]


@dataclass(frozen=True)
class Pipe:
    """A pipe size.

    Args:
        outer: outside diameter [m].
        wall: wall thickness, schedule 40 (standard weight above DN250) [m].
    """

    outer: float
    wall: float

    @property
    def radius(self) -> float:
        """Outside radius [m]."""
        return self.outer / 2

    @property
    def bore(self) -> float:
        """Inside radius [m]."""
        return self.outer / 2 - self.wall


def _mm(length: str) -> float:
    return round(float(length) / 1000, 7)


# Outside diameter and schedule 40 wall (STD for DN300), by nominal size DN.
PIPES: dict[int, Pipe] = {
    int(row["dn"]): Pipe(float(row["outer_mm"]) / 1000, float(row["wall_mm"]) / 1000)
    for row in read_table("pipes")
    if row["wall_mm"]
}

SIZES: tuple[int, ...] = tuple(PIPES)


@dataclass(frozen=True)
class Flange:
    """A flange of one size.

    Args:
        outer: outside diameter [m].
        thickness: least thickness without the raised face [m].
        raised: diameter of the raised face [m].
        hub: diameter of the hub at the flange [m].
        neck: length through the hub of a welding neck, without the raised face [m].
        slip: the same of a slip-on flange [m].
        circle: diameter of the bolt circle [m].
        hole: diameter of a bolt hole [m].
        n_bolts: how many.
        bolt: diameter of a bolt [m].
    """

    outer: float
    thickness: float
    raised: float
    hub: float
    neck: float
    slip: float
    circle: float
    hole: float
    n_bolts: int
    bolt: float


RAISED_FACE = 0.002  # m, ASME B16.5 section 6.4.1, class 150 and 300

FLANGES: dict[int, Flange] = {
    int(row["dn"]): Flange(
        outer=_mm(row["outer_mm"]),
        thickness=_mm(row["thickness_mm"]),
        raised=_mm(row["raised_face_mm"]),
        hub=_mm(row["hub_mm"]),
        neck=_mm(row["neck_mm"]),
        slip=_mm(row["slip_on_mm"]),
        circle=_mm(row["bolt_circle_mm"]),
        hole=_mm(row["hole_mm"]),
        n_bolts=int(row["n_bolts"]),
        bolt=_mm(row["bolt_mm"]),
    )
    for row in read_table("flanges")
}

# Bolt diameter -> width across flats, thickness [m].
HEX_NUTS: dict[float, tuple[float, float]] = {
    _mm(row["bolt_mm"]): (_mm(row["across_flats_mm"]), _mm(row["thickness_mm"])) for row in read_table("nuts")
}

# Bolt diameter -> outside diameter, thickness [m].
WASHERS: dict[float, tuple[float, float]] = {
    _mm(row["bolt_mm"]): (_mm(row["outer_mm"]), _mm(row["thickness_mm"])) for row in read_table("washers")
}

# Centre to end; end to end, by the larger size.
ELBOW_LONG_RADIUS = by_size("fittings", "fitting", "elbow")
TEE_CENTER_TO_END = by_size("fittings", "fitting", "tee")
REDUCER_LENGTH = by_size("fittings", "fitting", "reducer")

FACE_TO_FACE: dict[str, Mapping[int, float]] = {
    valve: by_size("face_to_face", "valve", valve) for valve in ("ball", "gate", "globe", "check", "butterfly")
}


@dataclass(frozen=True)
class Gauge:
    """A pressure gauge with a bottom connection.

    Args:
        case: diameter of the case [m].
        depth: of the case [m].
        bezel: diameter of the bezel ring [m].
        square: width across the wrench flats of the connection [m].
        thread: diameter of the connection's thread [m].
        reach: from the case's axis to the end of the thread [m].
    """

    case: float
    depth: float
    bezel: float
    square: float
    thread: float
    reach: float


# By the diameter of the case [mm].
GAUGES: dict[int, Gauge] = {
    int(row["case_mm"]): Gauge(
        case=_mm(row["case_mm"]),
        depth=_mm(row["depth_mm"]),
        bezel=_mm(row["bezel_mm"]),
        square=_mm(row["wrench_mm"]),
        thread=_mm(row["thread_mm"]),
        reach=_mm(row["reach_mm"]),
    )
    for row in read_table("gauges")
}

# Height, flange width, web, flange thickness [m].
SECTIONS: dict[str, tuple[float, float, float, float]] = {
    row["section"]: (_mm(row["height_mm"]), _mm(row["width_mm"]), _mm(row["web_mm"]), _mm(row["flange_mm"]))
    for row in read_table("sections")
}


def smaller(dn: int, steps: int = 1) -> int:
    """The nominal size some steps down, the least at most."""
    return SIZES[max(0, SIZES.index(dn) - steps)]


def sizes_between(least: int = 0, most: int = 10_000) -> tuple[int, ...]:
    """The nominal sizes from one to another, both among them [mm]."""
    return tuple(dn for dn in SIZES if least <= dn <= most)
