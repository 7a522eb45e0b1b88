"""A plant as it grows: what has been put up so far, and what touches what."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Generic, TypeVar

import numpy as np

from cadplants.families.preset_devices import PipeSupport, Post
from cadplants.faults.defects import loosen
from cadplants.lines.choice import Choice
from cadplants.lines.layout import Laid, Run, lay
from cadplants.model.plant import Assembly, Plant, gather
from cadplants.model.standards import PIPES
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Placed", "Site", "Work"]


@dataclass(frozen=True)
class Placed:
    """A run that stands on a site.

    Args:
        laid: the run.
        start: index of its first component on the site.
    """

    laid: Laid
    start: int

    def at(self, s: float) -> int:
        """Index on the site of the pipe at a chainage."""
        return self.start + self.laid.at(s)

    def device(self, node: str) -> int:
        """Index on the site of the first component of an inline device."""
        return self.start + self.laid.devices[node]


@dataclass
class Site:
    """Collects assemblies for one plant.

    Args:
        cluster: name of the connected structure that new components belong to.
    """

    cluster: str = ""
    count: int = 0
    _parts: list[Assembly] = field(default_factory=list)
    _joints: list[tuple[int, int]] = field(default_factory=list)

    def add(self, assembly: Assembly, on: int | None = None, foot: int = 0) -> int:
        """Puts up an assembly and returns the index of its first component.

        Args:
            assembly: in the site's coordinates.
            on: component that it touches.
            foot: which of its own components touches that.
        """
        first = self.count
        self._parts.append(assembly.marked(cluster=self.cluster))
        self.count += len(assembly.components)
        if on is not None:
            self.join(on, first + foot)
        return first

    def join(self, a: int, b: int) -> None:
        """Records that two components touch."""
        self._joints.append((a, b))

    def lay(self, run: Run, style: ModelingStyle, first: Sequence[int] = (), last: Sequence[int] = ()) -> Placed:
        """Lays a run between components that it touches at its ends."""
        laid = lay(run, style)
        start = self.add(laid.assembly)
        for outside, inside in ((first, laid.first), (last, laid.last)):
            for a in outside:
                for b in inside:
                    self.join(a, start + b)
        return Placed(laid, start)

    def support(self, placed: Placed, s: float, carrier: int, style: ModelingStyle, roll: float = 0.0) -> int:
        """Holds a run by a U-bolt on a bracket.

        Args:
            placed: the run.
            s: chainage, on a pipe.
            carrier: component that the bracket is welded to.
            style: that models it.
            roll: of the carrier about the run [rad]; 0 below it (-z of the run's frame).

        Returns:
            Index of the bracket; the U-bolt follows it.
        """
        run = placed.laid.run
        # The bracket looks for its carrier at +y; a quarter turn brings that to -z.
        pose = run.route.frame(s, roll) @ spun("x", -np.pi / 2)
        first = self.add(PipeSupport(dn=run.dn_at(s)).as_assembly(style).placed(pose), carrier)
        self.join(placed.at(s), first)
        self.join(placed.at(s), first + 1)
        return first

    def stand(self, placed: Placed, s: float, style: ModelingStyle, side: float = 0.05, floor: float = 0.0) -> int:
        """Holds a run by a U-bolt on a post.

        Args:
            placed: the run.
            s: chainage, on a level pipe.
            style: that models it.
            side: of the post's section [m].
            floor: height of what it stands on [m].

        Returns:
            Index of the post's base plate.
        """
        run = placed.laid.run
        x, y, z = (float(v) for v in run.route.point(s))
        height = z - floor - PIPES[run.dn_at(s)].radius - SUPPORT_REACH
        base = self.add(Post(height=height, side=side, capped=True).as_assembly(style).placed(at(x, y, floor)))
        self.support(placed, s, base + 2, style)
        return base

    def plant(self, name: str, seed: int, style: ModelingStyle) -> Plant:
        """The finished plant, with the gaps and unevenness of its style."""
        whole = loosen(gather(self._parts, self._joints), style, seed).marked(style=style.name)
        return Plant.of(whole, name, seed, [style])


P = TypeVar("P")


@dataclass(frozen=True)
class Work(Generic[P]):
    """What every piece of a plant is built with.

    Args:
        site: where it goes.
        style: how it is modelled.
        choice: of the looks of valves and gauges.
        plan: of the proportions.
        rng: of what varies besides.
    """

    site: Site
    style: ModelingStyle
    choice: Choice
    plan: P
    rng: np.random.Generator

    def needle(self) -> float:
        """Where the needle of a gauge points [rad]."""
        return float(self.rng.uniform(0.6, 2.6))
