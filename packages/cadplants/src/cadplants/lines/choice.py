"""What the presets hang into their runs: valves of one manufacturer, gauges with as many marks as somebody modelled."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from cadplants.builder.params import Apart
from cadplants.families import FAMILIES
from cadplants.families.preset_devices import Gauge, SideGauge
from cadplants.lines.instrument import in_style, tap_at, valve_at
from cadplants.lines.run import Inline, Tap
from cadplants.model.contacts import whole
from cadplants.model.family import as_assembly, as_device
from cadplants.model.plant import Assembly, Device
from cadplants.parts.brand import Brand, draw_brand
from cadplants.parts.detail import Marks
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Choice", "draw_choice"]

_AGAINST = np.diag([-1.0, -1.0, 1.0, 1.0])


@dataclass(frozen=True)
class Choice:
    """What a preset's devices look like.

    Args:
        make: of the valves.
        marks: of the gauges' dials.
    """

    make: Brand
    marks: Marks

    def valve(
        self,
        s: float,
        kind: str,
        unit: str,
        dn: int,
        roll: float = 0.0,
        reverse: bool = False,
        turn: float = 0.0,
        actuated: bool = False,
    ) -> Inline:
        """A valve with its middle at a chainage; arguments as of ``valve_at``."""
        return valve_at(s, kind, unit, dn, roll, reverse, self.make, turn, actuated)

    def control_valve(self, s: float, unit: str, dn: int, seed: int, roll: float = 0.0) -> Inline:
        """A control valve with a diaphragm or an electric actuator, its middle at a chainage.

        Args:
            s: chainage.
            unit: its id.
            dn: nominal size.
            seed: of its details.
            roll: of its stem about the run [rad].
        """
        return self.of_family(("control valve/diaphragm", "control valve/electric")[seed % 2], s, unit, dn, seed, roll)

    def of_family(self, name: str, s: float, unit: str, dn: int, seed: int, roll: float = 0.0) -> Inline:
        """A device of a family, its middle at a chainage.

        Args:
            name: of the family, all of whose builds must have one length for one size.
            s: chainage.
            unit: its id.
            dn: nominal size.
            seed: of its details.
            roll: of its stem about the run [rad].
        """
        family = FAMILIES[name]

        def build(style: ModelingStyle) -> Device:
            def draw(number: int) -> Device:
                return as_device(family, family.build(dn, style, Apart(seed, number)), style, unit)

            if style.devices == "primitives":
                return in_style(draw(0), dn, style)
            made = whole(lambda number: draw(number).assembly)
            return replace(draw(0), assembly=made)

        return Inline(s, build, unit, roll)

    def relief_valve(self, s: float, unit: str, seed: int) -> Tap:
        """A small relief valve on a branch outlet on top of a level pipe.

        Args:
            s: chainage.
            unit: its id.
            seed: of its details.
        """
        family = FAMILIES["relief valve/threaded"]

        def build(style: ModelingStyle) -> Assembly:
            return whole(lambda number: as_assembly(family, family.build(15, style, Apart(seed, number)), style, unit))

        return Tap(s, build, unit)

    def gauge(self, s: float, unit: str, size: int, needle: float, turn: float = 0.0, height: float = 0.0) -> Tap:
        """A pressure gauge upright on a level pipe.

        Args:
            s: chainage.
            unit: its id.
            size: nominal size of its case.
            needle: angle of its needle [rad].
            turn: of its dial [rad].
            height: of its stem [m]; as its size usually has where 0.
        """
        stem = height or (0.075 if size < 100 else 0.09)
        return tap_at(s, Gauge(size=size, marks=self.marks, stem=stem, turn=turn, reading=needle), unit)

    def side_gauge(
        self, s: float, unit: str, size: int, needle: float, down: bool = False, roll: float = np.pi / 2
    ) -> Tap:
        """A pressure gauge beside an upright pipe.

        Args:
            s: chainage.
            unit: its id.
            size: nominal size of its case.
            needle: angle of its needle [rad].
            down: whether the run goes down there.
            roll: of the outlet about the run [rad].
        """
        # The dial looks away from its pipe, whichever way the run goes.
        out, turn = 0.09 if size < 100 else 0.11, -np.pi / 2
        gauge = SideGauge(size=size, marks=self.marks, out=out, rise=0.06, turn=turn, reading=needle)
        return Tap(s, partial(_standing, gauge, unit, down), unit, roll)


def draw_choice(rng: np.random.Generator, seed: int, marks: Marks | None = None, usual: Marks = "few") -> Choice:
    """What one plant's devices look like, at random.

    Args:
        rng: of the make and of the marks.
        seed: 0 takes the usual make and marks.
        marks: asked for, or None.
        usual: marks of the plant of seed 0.
    """
    make = draw_brand(rng)
    drawn: Marks = marks or ("few", "none", "few", "all")[int(rng.integers(4))]
    return Choice(make if seed else Brand(), drawn if seed or marks else usual)


def _standing(gauge: SideGauge, unit: str, down: bool, style: ModelingStyle) -> Assembly:
    made = gauge.as_assembly(style, unit)
    # On a run that goes down, up is against it.
    return made.placed(_AGAINST) if down else made
