"""A tank with a level gauge between two cocks on its shell, which reads its level without any pipe."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.families.preset_devices import CockGauge
from cadplants.families.vessels.vessel import LevelGauge
from cadplants.model.contacts import met
from cadplants.model.plant import Assembly, Connection, gather
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["with_level_gauge"]

_COCK = 15  # nominal size


def with_level_gauge(
    vessel: Assembly, tank: str, gauge: str, radius: float, angle: float, span: tuple[float, float],
    style: ModelingStyle, rng: np.random.Generator,
) -> Assembly:  # fmt: skip
    """A tank with a gauge, the gauge's components behind those of the tank.

    Args:
        vessel: the tank alone, upright about the z axis.
        tank: its unit.
        gauge: that of the gauge.
        radius: of the shell [m].
        angle: round it, where the gauge hangs [rad].
        span: heights of the two cocks [m].
        style: how it is modelled.
        rng: draws the gauge.
    """
    low, high = span
    beside = CockGauge(shell=radius, around=angle, low=low, high=high, gauge=LevelGauge.draw(rng))
    hangs = Connection(tank, gauge, "", 0.0, _COCK / 1000)
    both = met(gather([vessel, replace(beside.as_assembly(style, gauge), connections=(hangs,))]))
    # The builder of the tank says what touches within it; the gauge's are those that its surfaces have.
    mine = tuple(pair for pair in both.contacts if pair[1] >= len(vessel.components))
    return replace(both, contacts=(*vessel.contacts, *mine))
