"""What is to be said of a plant at rest, in sentences: pumps, relief valves, tanks, and what nobody knows."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from cadgraph.hydraulics.balance import SHUT, Balance

__all__ = ["TRICKLE", "remarks_of"]

TRICKLE = 1e-6
"""A flow at and below which a reader is told of none [m3/s]; ours."""
_SAME = 1e-3  # m; heads that differ by less are the same
_FAR_OUT = 1.5  # times its flow that a pump moves and nothing is said; a curve is rarely known further (ours)


def remarks_of(balance: Balance, cavitating: Collection[str], unknown: int) -> Iterator[str]:
    """Says what a reader of the figures has to know, a sentence each.

    Args:
        balance: the plant at rest, solved.
        cavitating: tags of pumps that get less than they draw.
        unknown: how many gauges of pressure nothing of known pressure reaches.
    """
    if not balance.solution.settled:
        yield "the valves that move by themselves did not come to rest: the figures are not to be relied on"
    yield from _of_pumps(balance, cavitating)
    yield from _of_relief_valves(balance)
    yield from _of_tanks(balance)
    yield from _of_sources(balance)
    boiling = 0 if cavitating else _n_boiling(balance)
    if boiling:
        yield f"the column parts at {boiling} places, as the pressure falls to that at which the fluid boils"
    if unknown:
        yield (
            f"nothing of known pressure reaches {unknown} gauges, so that nobody knows what they show: let an end "
            "of their pipes be a source in the scenario"
        )
    yield from balance.circuit.remarks


def _of_pumps(balance: Balance, cavitating: Collection[str]) -> Iterator[str]:
    tags = balance.circuit.tags
    for tag in cavitating:
        none = balance.through(tag) < TRICKLE
        told = "nothing flows to it" if none else "it draws more than flows to it"
        yield f"{tag} cavitates: {told}" + (", nor can anything leave it" if none and _is_shut_in(balance, tag) else "")
    for tag, speed in balance.speed.items():
        if speed > SHUT and tag in tags and tag not in cavitating and balance.through(tag) < TRICKLE:
            lift = balance.difference(tag)
            gives = "" if lift is None else f" than the {-lift:.2f} bar that it gives"
            yield f"{tag} runs, and nothing flows through it: valves are shut, or more stands against it{gives}"
        if speed <= SHUT and tag in tags and abs(balance.through(tag)) > TRICKLE:
            back = " back" if balance.through(tag) < 0 else ""
            yield f"{tag} stands still, and {abs(balance.through(tag)) * 3600:.2f} m3/h flow{back} through it"
    for tag, pump in balance.scenario.pumps.items():
        flow = balance.through(tag) * 3600 if tag in tags else 0.0
        if flow > _FAR_OUT * pump.flow:
            yield f"{tag} moves {flow:.1f} m3/h and is for {pump.flow:g}: nothing holds it back as it is supposed"


def _is_shut_in(balance: Balance, pump: str) -> bool:
    """Whether what a pump delivers reaches nothing of known pressure."""
    end = balance.circuit.end[balance.circuit.tags[pump][0]]
    return bool(balance.solution.shut_in[end])


def _of_relief_valves(balance: Balance) -> Iterator[str]:
    for tag, valve in balance.scenario.valves.items():
        if valve.duty == "relief" and tag in balance.circuit.tags and balance.through(tag) > TRICKLE:
            yield f"{tag} blows off {balance.through(tag) * 3600:.2f} m3/h"


def _of_tanks(balance: Balance) -> Iterator[str]:
    inflow = balance.places.inflow(balance.solution.flow)
    for tag, tank in balance.scenario.tanks.items():
        if tag not in inflow:
            continue
        level = balance.level[tag]
        lowest = min(nozzle.height for nozzle in balance.circuit.nozzles if nozzle.tag == tag)
        if level >= tank.height and inflow[tag] > TRICKLE:
            yield f"{tag} overflows: {inflow[tag] * 3600:.2f} m3/h run over"
        elif level <= 0:
            yield f"{tag} is empty"
        elif tank.bottom + level <= lowest:
            yield f"{tag} is down to its lowest nozzle: nothing leaves it"
        else:
            dry = [nozzle.port for nozzle in balance.outlets(tag) if nozzle.height >= tank.bottom + level]
            if dry:
                yield f"{tag} is down to its outlet {', '.join(dry)}: nothing leaves it there"


def _of_sources(balance: Balance) -> Iterator[str]:
    circuit, flow = balance.circuit, balance.solution.flow
    for place, end in balance.scenario.ends.items():
        node = balance.places.told.get(place)
        if end.role == "source" and node is not None:
            into = float(flow[circuit.end == node].sum() - flow[circuit.start == node].sum())
            if into > TRICKLE:
                yield f"{place} is a source, and {into * 3600:.2f} m3/h flow into it: more stands against it"


def _n_boiling(balance: Balance) -> int:
    """How many places have the pressure at which the fluid boils."""
    scenario, height, head = balance.scenario, balance.circuit.height, balance.solution.head
    vapour = scenario.head(scenario.fluid.vapour)
    return sum(bool(head[node] < height[node] + vapour - _SAME) for node in balance.places.told.values())
