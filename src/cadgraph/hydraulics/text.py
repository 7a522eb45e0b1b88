"""What a simulation tells, as people read it: aligned columns of text, and as plain values for JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cadgraph._io.text import printable
from cadgraph.hydraulics.network import LinkKind
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.remarks import TRICKLE
from cadgraph.hydraulics.settings import Scenario
from cadgraph.model.pipework import Arc
from cadgraph.query.text import aligned

__all__ = [
    "Standing",
    "assumed_values",
    "assumption_lines",
    "assumptions",
    "change_lines",
    "standing",
    "standing_lines",
    "state_values",
]

_FEW = 0.005  # what differs by less shows as the same figure, in bar, m3/h, m

_RANK = ("ends", "tanks", "pumps", "valves", "network", "pipes", "fluid", "gauges")  # what matters most first


@dataclasses.dataclass(frozen=True)
class Standing:
    """What is told of one thing at one moment.

    Args:
        tag: of a gauge, pump or tank, or the id of an end.
        what: ``gauge``, ``pump``, ``tank``, ``source`` or ``sink``.
        value: what it shows, moves or holds; None where nobody knows.
        unit: of the value.
        note: what else is to be said.
    """

    tag: str
    what: str
    value: float | None
    unit: str
    note: str = ""

    @property
    def text(self) -> str:
        """The value as people read it."""
        if self.value is None:
            return "not known"
        return f"{self.value + 0.0:.2f} {self.unit}".replace("-0.00 ", "0.00 ")


def standing(process: Process) -> tuple[Standing, ...]:
    """What gauges show, pumps move, tanks hold and ends let through.

    Args:
        process: at the moment that is asked for.
    """
    return (*_gauges(process), *_pumps(process), *_tanks(process), *_ends(process))


def _gauges(process: Process) -> Iterator[Standing]:
    state, circuit = process.state, process.balance.circuit
    for tag, gauge in process.scenario.gauges.items():
        node = circuit.node_of_gauge(tag)
        if gauge.measures == "nothing":
            continue
        notes = [f"of {gauge.span:g}"] if gauge.span else []
        pressure = state.pressure.get(node)
        reading = state.reading[tag]
        if gauge.measures == "pressure" and pressure is not None and pressure < -_FEW:
            notes.append(f"below its scale: {pressure:.2f} bar")
        elif gauge.span and reading is not None and reading >= gauge.span:
            beyond = gauge.measures == "pressure" and pressure is not None and pressure > gauge.span + _FEW
            notes.append(f"beyond its scale: {pressure:.2f} bar" if beyond else "at the end of its scale")
        if node in state.shut_in:
            notes.append("shut in" if pressure is not None else "nothing of known pressure reaches it")
        yield Standing(tag, "gauge", reading, gauge.unit or "", ", ".join(notes))


def _pumps(process: Process) -> Iterator[Standing]:
    for tag in process.scenario.pumps:
        if tag not in process.balance.circuit.tags:
            yield Standing(tag, "pump", 0.0, "m3/h", "has a line on one side only")
            continue
        lift = process.balance.difference(tag)
        notes = [] if process.state.speed[tag] > 0 else ["stands still"]
        # A pump that nothing reaches gives nothing: what stands behind it is what was shut in there.
        starved = tag in process.state.cavitating and process.balance.through(tag) < TRICKLE
        notes += [] if lift is None or notes or starved else [f"{-lift:+.2f} bar"]
        notes += ["cavitates"] if tag in process.state.cavitating else []
        yield Standing(tag, "pump", process.balance.through(tag) * 3600, "m3/h", ", ".join(notes))


def _tanks(process: Process) -> Iterator[Standing]:
    inflow = process.balance.places.inflow(process.solution.flow)
    for tag, tank in process.scenario.tanks.items():
        note = f"of {tank.height:g}, {inflow.get(tag, 0.0) * 3600 + 0.0:+.2f} m3/h"
        yield Standing(tag, "tank", process.state.level[tag], "m", note)


def _ends(process: Process) -> Iterator[Standing]:
    network = process.network
    for place, end in process.scenario.ends.items():
        if end.role == "blind":
            continue
        flow = sum(_leaving(process, arc) for arc in network.arcs(place)) * 3600
        pressure = process.state.pressure.get(place)
        note = "" if pressure is None else f"at {pressure:.2f} bar"
        yield Standing(place, end.role, flow if end.role == "source" else -flow, "m3/h", note)


def _leaving(process: Process, arc: Arc) -> float:
    """What flows away from the start of a connection [m3/s]."""
    flow = process.state.flow[arc.index]
    return flow if arc.forward else -flow


def standing_lines(process: Process) -> list[str]:
    """The moment that a process has come to: a row for each thing, then what is to be said.

    Args:
        process: at the moment that is asked for.
    """
    rows = [(one.tag, one.what, one.text, one.note) for one in standing(process)]
    if not rows:
        return ["nothing to simulate: no gauge, pump, tank or open end has a line"]
    return [*_table([("", "", "", ""), *rows], (2,))[1:], *_remark_lines(process)]


def change_lines(process: Process, before: tuple[Standing, ...]) -> list[str]:
    """What is different at the moment that a process has come to.

    Args:
        process: after the change.
        before: what was told before it.
    """
    rows = [("", "", "before", "after", "change", "")]
    for old, new in zip(before, standing(process), strict=True):
        rows.append((new.tag, new.what, old.text, new.text, _changed(old, new), new.note))
    return [*_table(rows, (2, 3, 4)), *_remark_lines(process)]


def _changed(old: Standing, new: Standing) -> str:
    if old.value is None or new.value is None:
        return "" if old.value is new.value else "known no longer" if new.value is None else "known now"
    return "-" if abs(new.value - old.value) < _FEW else f"{new.value - old.value:+.2f}"


def _table(rows: Sequence[Sequence[str]], right: Sequence[int]) -> list[str]:
    """Straight columns; names from a plant may hold what moves the cursor or colours a terminal."""
    return aligned([[printable(cell) for cell in row] for row in rows], right)


def _remark_lines(process: Process) -> list[str]:
    return [f"mind: {printable(remark)}" for remark in process.state.remarks]


def assumption_lines(process: Process) -> list[str]:
    """How many values are assumed, by what and why, the most first.

    Args:
        process: that they are supposed in.
    """
    counts = assumptions(process)
    total = sum(counts.values())
    if not total:
        return ["nothing is assumed but what the network leaves out"]
    rows = [(str(n), what, why) for (what, why), n in counts.items()]
    return [f"{total} values are assumed, as nobody has said otherwise:", *aligned(rows, right=(0,))]


def assumptions(process: Process) -> dict[tuple[str, str], int]:
    """How many values are assumed, by what they are of and why; what drives the flow first, then the most.

    Args:
        process: that they are supposed in.
    """
    counts: dict[tuple[str, str], int] = {}
    for section, _, setting in process.scenario.sections():
        for name, reason in setting.why.items():
            if reason.startswith("assumed"):
                key = f"{section}, {name}", reason.removeprefix("assumed").lstrip(": ")
                counts[key] = counts.get(key, 0) + 1
    for text, n in process.balance.circuit.assumed.items():
        counts["network", text] = n
    return dict(sorted(counts.items(), key=lambda item: (_RANK.index(item[0][0].split(",")[0]), -item[1], item[0])))


def state_values(process: Process) -> dict[str, Any]:
    """The moment that a process has come to, as plain values.

    Args:
        process: at the moment that is asked for.
    """
    state, name = process.state, process.network.name
    edges = process.network.edges
    kinds = {tag: LinkKind(int(process.balance.circuit.kind[links[0]])) for tag, links in _tags(process).items()}
    return {
        "time_s": state.time,
        "gauges": {tag: _gauge_values(process, tag) for tag in process.scenario.gauges},
        "pumps": {
            tag: {"flow_m3h": process.balance.through(tag) * 3600, "speed": state.speed[tag]}
            for tag, kind in kinds.items()
            if kind is LinkKind.PUMP
        },
        "valves": {
            tag: {"flow_m3h": process.balance.through(tag) * 3600, "opening": state.opening[tag]}
            for tag, kind in kinds.items()
            if kind is not LinkKind.PUMP
        },
        "tanks": {tag: {"level_m": level} for tag, level in state.level.items()},
        "ends": {one.tag: {one.what: one.value} for one in _ends(process)},
        "flows_m3h": [
            {"from": name(edges[index].source), "to": name(edges[index].target), "flow": flow * 3600}
            for index, flow in state.flow.items()
        ],
        "cavitating": list(state.cavitating),
        "joints_deg": dict(state.joints),
        "remarks": list(state.remarks),
    }


def _tags(process: Process) -> Mapping[str, tuple[int, ...]]:
    return process.balance.circuit.tags


def _gauge_values(process: Process, tag: str) -> dict[str, Any]:
    state, circuit = process.state, process.balance.circuit
    node = circuit.node_of_gauge(tag)
    gauge = process.scenario.gauges[tag]
    return {
        "reading": state.reading[tag],
        "unit": gauge.unit,
        "span": gauge.span,
        "pressure_bar": state.pressure.get(node),
        "shut_in": node in state.shut_in,
    }


def assumed_values(scenario: Scenario) -> list[dict[str, Any]]:
    """Every value that is assumed, with its reason, as plain values.

    Args:
        scenario: that holds them.
    """
    return [
        {"of": tag or section, "value": name, "is": getattr(setting, name), "why": reason}
        for section, tag, setting in scenario.sections()
        for name, reason in setting.why.items()
        if reason.startswith("assumed")
    ]
