"""What the presets hang into their runs: valves of one manufacturer, gauges with as many marks as somebody modelled."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cadgraph.environment.detail import Marks, marked_gauge
from cadgraph.environment.gauge import pressure_gauge, side_gauge
from cadgraph.environment.hand import Hand
from cadgraph.environment.instrument import valve_at
from cadgraph.environment.make import Make
from cadgraph.environment.plant import Assembly
from cadgraph.environment.run import Inline, Tap

__all__ = ["Choice"]

_AGAINST = np.diag([-1.0, -1.0, 1.0, 1.0])
_FINE = 0.0003  # m; a hand whose circles are coarser than this models no marks


@dataclass(frozen=True)
class Choice:
    """What a preset's devices look like.

    Args:
        make: of the valves.
        marks: of the gauges' dials.
    """

    make: Make
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

        def build(hand: Hand) -> Assembly:
            gauge = pressure_gauge(unit, hand, size, rise, turn, needle)
            return marked_gauge(gauge, size, self._marks(hand), hand)

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

        def build(hand: Hand) -> Assembly:
            turn = -np.pi / 2 if down else np.pi / 2
            gauge = side_gauge(unit, hand, size, 0.09 if size < 100 else 0.11, 0.06, turn, needle)
            gauge = marked_gauge(gauge, size, self._marks(hand), hand)
            # On a run that goes down, up is against it.
            return gauge.placed(_AGAINST) if down else gauge

        return Tap(s, build, unit, roll)

    def _marks(self, hand: Hand) -> Marks:
        return self.marks if hand.sag <= _FINE and not hand.wobble else "none"
