"""What the shape of a part alone would allow it to be, with the sizes and proportions behind it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.stages.label.facts import Facts

__all__ = ["BOLT", "CASE", "WHEEL", "Forms", "forms_of"]

# Absolute sizes [m]
MIN_PIPE = 0.0125  # outside diameter of DN8 is 13.7 mm (ASME B36.10M); thinner tubes are tubing, rods, rims
FLANGE = (0.06, 1.6)  # diameter: DN10 to DN1200 (EN 1092-1)
MAX_GASKET = 0.0065  # thickness: flat gaskets 1.5 to 3 mm (ASME B16.21), spiral wound 4.5 to 6.4 mm (B16.20)
CASE = (0.036, 0.275)  # diameter of a gauge with bezel: EN 837-1 sizes 40 to 250
WHEEL = (0.045, 1.2)  # diameter of a handwheel
LEVER = (0.05, 0.8)  # length of a lever
BOLT = (0.5, 0.06)  # greatest length and width over corners of a bolt: M36 heavy hex has 70 mm, M30 58 mm
MAX_WASHER = 0.075  # diameter of a washer: M39 (ISO 7089) has 72 mm
MIN_BEAM = 0.25  # shorter bars are as likely brackets or levers
FLANGE_RIM = (0.03, 0.36)  # thickness over diameter: EN 1092-1 0.05 (DN600 PN6) to 0.31 (DN15 PN100), with play
CASE_DEPTH = (0.18, 0.95)  # depth over diameter, as makers build gauges: 0.25 to 0.8


@dataclass(frozen=True)
class Forms:
    """What the shape of a part alone would allow it to be."""

    tube: bool
    bend: bool
    flange: bool
    gasket: bool
    wheel: bool
    lever: bool
    pin: bool
    nut: bool
    washer: bool
    case: bool
    bar: bool
    plate: bool


def forms_of(f: Facts) -> Forms:
    """The forms that a shape allows."""
    diameter, long, mid, thin = 2 * f.radius, *(float(x) for x in f.section)
    tube_width = 2 * f.ports[0].outer if f.tube else 0.0
    full = np.nonzero(f.outer > 0.93 * f.radius)[0]
    rim = (full[-1] - full[0] + 1) / len(f.outer) * f.length if len(full) else 0.0
    # The plate of a flange is at one end; its raised face, a slice or two, may stand before it.
    at_end = len(full) > 0 and len(full) == full[-1] - full[0] + 1 and min(full[0], len(f.outer) - 1 - full[-1]) <= 2
    holed = any(0.3 * p.outer < p.inner < p.outer for p in f.ports)
    holes = [p.inner / f.radius for p in f.ports]
    ring = f.round and f.length < min(MAX_GASKET, 0.08 * diameter) and holed
    return Forms(
        tube=f.tube > 0 and not f.bent and tube_width > MIN_PIPE and f.length > 0.25 * diameter,
        bend=f.bent and tube_width > MIN_PIPE,
        flange=f.round and FLANGE[0] < diameter < FLANGE[1] and at_end and not ring and f.length < 0.9 * diameter
        and FLANGE_RIM[0] * diameter < rim < FLANGE_RIM[1] * diameter,
        gasket=ring and diameter > 0.02,
        wheel=f.sides >= 8 and 3 <= f.spokes <= 8 and f.rim > 0.45 and WHEEL[0] < diameter < WHEEL[1]
        and f.length < 0.6 * diameter,
        lever=LEVER[0] < long < LEVER[1] and long > 3 * mid and thin < 0.3 * long and not f.round,
        pin=f.round and 1.2 * diameter < f.length < BOLT[0] and diameter < BOLT[1],
        nut=f.turned > 0.7 and f.sides == 6 and holed and 0.25 * diameter < f.length < 1.1 * diameter < BOLT[1],
        washer=f.round and len(holes) == 2 and min(holes) > 0.35 and max(holes) < 0.75 and diameter < MAX_WASHER
        and f.length < 0.2 * diameter,
        case=f.round and CASE[0] < diameter < CASE[1] and CASE_DEPTH[0] < f.length / diameter < CASE_DEPTH[1],
        bar=long > MIN_BEAM and long > 4 * mid and not f.round and not f.tube,
        plate=thin < 0.08 * mid and mid > 0.1 and f.fill > 0.7,
    )  # fmt: skip
