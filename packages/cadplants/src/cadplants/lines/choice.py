"""What the presets hang into their runs: valves of one manufacturer, gauges with as many marks as somebody modelled."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cadplants.builder.params import Apart
from cadplants.families import FAMILIES
from cadplants.lines.instrument import valve_at
from cadplants.lines.run import Inline, Tap
from cadplants.model.contacts import whole
from cadplants.model.family import as_assembly, as_device
from cadplants.model.plant import Assembly, Device
from cadplants.parts.brand import Brand
from cadplants.parts.detail import Marks, marked_gauge
from cadplants.parts.gauge import pressure_gauge, side_gauge
from cadplants.parts.primitive_devices import in_primitives
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Choice"]

_AGAINST = np.diag([-1.0, -1.0, 1.0, 1.0])
_FINE = 0.0003  # m; a style whose circles are coarser than this models no marks


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
        item = valve_at(s, kind, unit, dn, roll, reverse, self.make, turn, actuated)
        return replace(item, family=self.make.design(kind))

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
                return in_primitives(draw(0), dn, style)
            made = whole(lambda number: draw(number).assembly)
            return replace(draw(0), assembly=made)

        return Inline(s, build, unit, roll, family=family.name)

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
        rise = height or (0.075 if size < 100 else 0.09)

        def build(style: ModelingStyle) -> Assembly:
            gauge = pressure_gauge(unit, style, size, rise, turn, needle)
            return marked_gauge(gauge, size, self._marks(style), style)

        return Tap(s, build, unit)

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

        def build(style: ModelingStyle) -> Assembly:
            # The dial looks away from its pipe, whichever way the run goes.
            gauge = side_gauge(unit, style, size, 0.09 if size < 100 else 0.11, 0.06, -np.pi / 2, needle)
            gauge = marked_gauge(gauge, size, self._marks(style), style)
            # On a run that goes down, up is against it.
            return gauge.placed(_AGAINST) if down else gauge

        return Tap(s, build, unit, roll)

    def _marks(self, style: ModelingStyle) -> Marks:
        fine = style.sag <= _FINE and not style.wobble and style.devices == "built"
        return self.marks if fine else "none"
