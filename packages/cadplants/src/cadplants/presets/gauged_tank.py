"""A tank with a level gauge between two cocks on its shell, which reads its level without any pipe."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.families.vessels.vessel import level_gauge
from cadplants.model.contacts import met
from cadplants.model.plant import Assembly, Component, Connection, Unit, gather
from cadplants.parts.vessel import skin
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
    components = tuple(
        Component(
            p.solid, p.group, p.name, style.color(p.color), unit=gauge, family="level gauge", granularity="pieces"
        )
        for p in level_gauge(skin(radius, angle, style), *span, angle, style, rng)
    )
    hangs = Connection(tank, gauge, "", 0.0, _COCK / 1000)
    both = met(
        gather([vessel, Assembly(components, units=(Unit(gauge, "gauge", "level gauge"),), connections=(hangs,))])
    )
    # The builder of the tank says what touches within it; the gauge's are those that its surfaces have.
    mine = tuple(pair for pair in both.contacts if pair[1] >= len(vessel.components))
    return replace(both, contacts=(*vessel.contacts, *mine))
