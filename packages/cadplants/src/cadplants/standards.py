"""Dimensions of piping components, in metres, from the standards named beside each table."""

from __future__ import annotations

from dataclasses import dataclass

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


# ASME B36.10M, outside diameter and schedule 40 wall (STD for DN300), by nominal size DN.
PIPES: dict[int, Pipe] = {
    dn: Pipe(outer / 1000, wall / 1000)
    for dn, outer, wall in (
        (15, 21.3, 2.77), (20, 26.7, 2.87), (25, 33.4, 3.38), (32, 42.2, 3.56), (40, 48.3, 3.68), (50, 60.3, 3.91),
        (65, 73.0, 5.16), (80, 88.9, 5.49), (100, 114.3, 6.02), (125, 141.3, 6.55), (150, 168.3, 7.11),
        (200, 219.1, 8.18), (250, 273.0, 9.27), (300, 323.8, 9.53),
    )
}  # fmt: skip

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


def _mm(length: float) -> float:
    return round(length / 1000, 7)


RAISED_FACE = 0.002  # m, ASME B16.5 section 6.4.1, class 150 and 300

# ASME B16.5, class 150: table 8 (dimensions) and table 7 (drilling).
FLANGES: dict[int, Flange] = {
    dn: Flange(
        _mm(outer), _mm(thick), _mm(raised), _mm(hub), _mm(neck), _mm(slip), _mm(circle), _mm(hole), n_bolts, _mm(bolt)
    )
    for dn, outer, thick, raised, hub, neck, slip, circle, hole, n_bolts, bolt in (
        (15, 90, 9.6, 34.9, 30, 46, 14, 60.3, 15.9, 4, 12.7),
        (20, 100, 11.2, 42.9, 38, 51, 14, 69.9, 15.9, 4, 12.7),
        (25, 110, 12.7, 50.8, 49, 54, 16, 79.4, 15.9, 4, 12.7),
        (32, 115, 14.3, 63.5, 59, 56, 19, 88.9, 15.9, 4, 12.7),
        (40, 125, 15.9, 73.0, 65, 60, 21, 98.4, 15.9, 4, 12.7),
        (50, 150, 17.5, 92.1, 78, 62, 24, 120.7, 19.1, 4, 15.9),
        (65, 180, 20.7, 104.8, 90, 68, 27, 139.7, 19.1, 4, 15.9),
        (80, 190, 22.3, 127.0, 108, 68, 29, 152.4, 19.1, 4, 15.9),
        (100, 230, 22.3, 157.2, 135, 75, 32, 190.5, 19.1, 8, 15.9),
        (125, 255, 22.3, 185.7, 164, 87, 35, 215.9, 22.2, 8, 19.1),
        (150, 280, 23.9, 215.9, 192, 87, 38, 241.3, 22.2, 8, 19.1),
        (200, 345, 27.0, 269.9, 246, 100, 43, 298.5, 22.2, 8, 19.1),
        (250, 405, 28.6, 323.8, 305, 100, 48, 362.0, 25.4, 12, 22.2),
        (300, 485, 30.2, 381.0, 365, 113, 54, 431.8, 25.4, 12, 22.2),
    )
}  # fmt: skip

# ASME B18.2.2 heavy hex nuts: bolt diameter -> width across flats, thickness [m].
HEX_NUTS: dict[float, tuple[float, float]] = {
    0.0127: (0.0222, 0.0123),
    0.0159: (0.0270, 0.0155),
    0.0191: (0.0318, 0.0187),
    0.0222: (0.0365, 0.0218),
}

# ASTM F436 / ASME B18.21.1 hardened washers: bolt diameter -> outside diameter, thickness [m].
WASHERS: dict[float, tuple[float, float]] = {
    0.0127: (0.0270, 0.0030),
    0.0159: (0.0333, 0.0034),
    0.0191: (0.0373, 0.0034),
    0.0222: (0.0445, 0.0039),
}

# ASME B16.9, long-radius elbow, centre to end: 1.5 x NPS (1.5 in at least).
ELBOW_LONG_RADIUS: dict[int, float] = {
    dn: length / 1000
    for dn, length in (
        (15, 38), (20, 38), (25, 38), (32, 48), (40, 57), (50, 76), (65, 95), (80, 114), (100, 152), (125, 190),
        (150, 229), (200, 305), (250, 381), (300, 457),
    )
}  # fmt: skip

# ASME B16.9, straight tee, centre to end of run and branch.
TEE_CENTER_TO_END: dict[int, float] = {
    dn: length / 1000
    for dn, length in (
        (15, 25), (20, 29), (25, 38), (32, 48), (40, 57), (50, 64), (65, 76), (80, 86), (100, 105), (125, 124),
        (150, 143), (200, 178), (250, 216), (300, 254),
    )
}  # fmt: skip

# ASME B16.9, reducer, end to end, by the larger size.
REDUCER_LENGTH: dict[int, float] = {
    dn: length / 1000
    for dn, length in (
        (20, 38), (25, 51), (32, 51), (40, 64), (50, 76), (65, 89), (80, 89), (100, 102), (125, 127), (150, 140),
        (200, 152), (250, 178), (300, 203),
    )
}  # fmt: skip


def _lengths(*rows: tuple[int, float]) -> dict[int, float]:
    return {dn: length / 1000 for dn, length in rows}


# ASME B16.10, class 150, raised face ends, face to face; wafer butterfly valves after API 609 category A. Sizes that a
# table of the standard leaves out (marked *) are taken between their neighbours.
FACE_TO_FACE: dict[str, dict[int, float]] = {
    "ball": _lengths(
        (15, 108), (20, 117), (25, 127), (32, 140), (40, 165), (50, 178), (65, 190), (80, 203), (100, 229), (125, 312),
        (150, 394), (200, 457), (250, 533), (300, 610),
    ),  # * DN125
    "gate": _lengths(
        (15, 108), (20, 117), (25, 127), (32, 140), (40, 165), (50, 178), (65, 190), (80, 203), (100, 229), (125, 254),
        (150, 267), (200, 292), (250, 330), (300, 356),
    ),
    "globe": _lengths(
        (15, 108), (20, 117), (25, 127), (32, 140), (40, 165), (50, 203), (65, 216), (80, 241), (100, 292), (125, 356),
        (150, 406), (200, 495), (250, 622), (300, 698),
    ),
    "check": _lengths(
        (15, 108), (20, 117), (25, 127), (32, 140), (40, 165), (50, 203), (65, 216), (80, 241), (100, 292), (125, 330),
        (150, 356), (200, 495), (250, 622), (300, 698),
    ),
    "butterfly": _lengths(
        (40, 33), (50, 43), (65, 46), (80, 46), (100, 52), (125, 56), (150, 56), (200, 60), (250, 68), (300, 78),
    ),  # * DN40
}  # fmt: skip


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


# EN 837-1 nominal sizes (case diameter) and threads (G 1/4 B, G 1/2 B); depth and reach as makers commonly build them.
GAUGES: dict[int, Gauge] = {
    63: Gauge(0.063, 0.032, 0.068, 0.014, 0.0132, 0.054),
    100: Gauge(0.100, 0.049, 0.107, 0.022, 0.0210, 0.087),
    160: Gauge(0.160, 0.050, 0.167, 0.022, 0.0210, 0.118),
}

# EN 10365 wide-flange sections: height, flange width, web, flange thickness [m].
SECTIONS: dict[str, tuple[float, float, float, float]] = {
    "HEA 100": (0.096, 0.100, 0.005, 0.008),
    "HEA 120": (0.114, 0.120, 0.005, 0.008),
    "HEA 160": (0.152, 0.160, 0.006, 0.009),
    "HEA 200": (0.190, 0.200, 0.0065, 0.010),
    "IPE 100": (0.100, 0.055, 0.0041, 0.0057),
    "IPE 160": (0.160, 0.082, 0.0050, 0.0074),
    "IPE 200": (0.200, 0.100, 0.0056, 0.0085),
}


def smaller(dn: int, steps: int = 1) -> int:
    """The nominal size some steps down, the least at most."""
    return SIZES[max(0, SIZES.index(dn) - steps)]
