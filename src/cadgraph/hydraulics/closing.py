"""What closing valves does by the simulation, beside what it does by the graph alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.text import Standing, assumptions, standing
from cadgraph.model.graph import SceneGraph
from cadgraph.query.what_if import WhatIf

__all__ = ["Simulated", "simulate_closing"]

_FLOWS = 1e-5  # m3/s; less counts as none


@dataclass(frozen=True)
class Simulated:
    """What a simulation says of closing valves.

    Args:
        before: what gauges showed, pumps moved, tanks held and ends let through.
        after: the same, in the same order, when everything has come to rest but the levels of tanks.
        remarks: on what is then.
        disagreements: where the simulation and the graph say different things, a sentence each.
        n_assumed: how many values of the scenario are assumed.
    """

    before: tuple[Standing, ...]
    after: tuple[Standing, ...]
    remarks: tuple[str, ...]
    disagreements: tuple[str, ...]
    n_assumed: int

    @property
    def changed(self) -> tuple[tuple[Standing, Standing], ...]:
        """What is different, before and after; figures that read the same are not."""
        pairs = zip(self.before, self.after, strict=True)
        return tuple((old, new) for old, new in pairs if old.text != new.text)


def simulate_closing(graph: SceneGraph, scenario: str | Path, close: Sequence[str], found: WhatIf) -> Simulated:
    """What closing valves does, by a scenario.

    Args:
        graph: the finished graph.
        scenario: the file that says what is supposed.
        close: ids of the valves.
        found: what the graph alone says of it.

    Raises:
        ScenarioError: the scenario can't be used.
        ValueError: one of them is no valve that somebody moves.
    """
    process = Process(graph, scenario)
    before = standing(process)
    flowed = _flowing(process)
    process.steady(dict.fromkeys(close, 0.0))
    return Simulated(
        before=before,
        after=standing(process),
        remarks=process.state.remarks,
        disagreements=tuple(_disagreements(found, flowed, _flowing(process))),
        n_assumed=sum(assumptions(process).values()),
    )


def _flowing(process: Process) -> dict[str, float]:
    """The greatest flow at each node of the graph [m3/s], by id."""
    flows = process.state.flow
    network = process.network
    return {place: max((abs(flows[arc.index]) for arc in network.arcs(place)), default=0.0) for place in network.places}


def _disagreements(found: WhatIf, before: dict[str, float], after: dict[str, float]) -> Iterator[str]:
    for said, those in (("is cut off", found.cut_off), ("pumps against shut valves", found.dead_headed)):
        for one in those:
            if not one.why and after[one.place] > _FLOWS:
                flow = after[one.place] * 3600
                yield f"the graph says that {one.name} {said}, but {flow:.2f} m3/h flow there in the simulation"
    for one in found.still_fed:
        if before[one.place] > _FLOWS >= after[one.place]:
            yield (
                f"the graph says that another way leads to {one.name}, but nothing flows there any more in the "
                "simulation"
            )
