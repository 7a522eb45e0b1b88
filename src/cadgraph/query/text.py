"""The answers as people read them: aligned columns of text, and as plain values for JSON and CSV."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Sequence
from typing import Any

from cadgraph.query.compare import Comparison, Difference, Missing
from cadgraph.query.doubt import Doubt, bare_nozzles, few_ports, likely_joints, mounted_words, unconnected
from cadgraph.query.isolate import PASSED_OVER, Isolation
from cadgraph.query.lines import Line
from cadgraph.query.network import Network
from cadgraph.query.trace import Halt, Step, Trace

__all__ = [
    "LINE_COLUMNS",
    "aligned",
    "comparison_lines",
    "comparison_values",
    "gap_lines",
    "isolation_lines",
    "isolation_values",
    "line_rows",
    "line_table",
    "line_values",
    "trace_lines",
    "trace_values",
    "way_lines",
]

LINE_COLUMNS = (
    "line", "from", "from_port", "to", "to_port", "through", "length_m", "length_complete", "dn", "flow", "reason",
    "confidence", "system",
)  # fmt: skip
_MOST_NAMES = 12
_FLOWS = {"forward": "->", "backward": "<-", "none": "--", "unknown": "?", "contradictory": "><"}
_FLOW_WORDS = {"along": "with the flow", "against": "against the flow", "unknown": "direction unknown"}


def aligned(rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> list[str]:
    """Rows of cells as lines of text with straight columns; the columns in ``right`` are flush right."""
    if not rows:
        return []
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return [
        "  ".join(
            cell.rjust(width) if i in right else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def line_table(lines: Sequence[Line]) -> list[str]:
    """The line list: a header, a row for each line, the sum."""
    if not lines:
        return ["no lines: the graph has no connections along pipes"]
    rows = [("line", "from", "", "to", "length", "DN", "through")]
    for line in lines:
        start = f"{line.start_name}:{line.start_port}" if line.start_port else line.start_name
        end = f"{line.end_name}:{line.end_port}" if line.end_port else line.end_name
        length = _metres(line.length, not line.whole) if line.length is not None else "?"
        rows.append((line.tag, start, _FLOWS[line.flow], end, length, line.size or "?", " ".join(line.through_words)))
    total = sum(line.length or 0.0 for line in lines)
    some = any(not line.whole for line in lines)
    unknown = sum(line.flow == "unknown" for line in lines)
    contradictory = sum(line.flow == "contradictory" for line in lines)
    told = [f"{len(lines)} line{'s' * (len(lines) != 1)}, {_metres(total, some)}"]
    told += [f"direction unknown (?) in {unknown}"] * bool(unknown)
    told += [f"contradictory (><) in {contradictory}"] * bool(contradictory)
    told += ["in brackets: valves beside the line, on a tap"] * any(line.beside for line in lines)
    return [*aligned(rows, right=(4, 5)), "", ", ".join(told)]


def gap_lines(network: Network) -> list[str]:
    """What a line list may lack: units without a line or with too few, and joints that were not made."""
    without = mounted_words(unconnected(network))
    short = [
        f"{network.name(place)} ({few[0]} of {few[1]})"
        for place in network.places
        if network.arcs(place) and (few := few_ports(network, place)) is not None
    ]
    bare = [network.name(place) for place in network.places if network.arcs(place) and bare_nozzles(network, place)]
    n_joints = len(likely_joints(network))
    told = []
    if without:
        told.append(f"no line was found at {_some(without)}")
    if short:
        told.append(f"fewer lines than its kind needs has {_some(short)}")
    if bare:
        told.append(f"a nozzle without a line has {_some(bare)}")
    if n_joints:
        are, they = ("joint was", "it") if n_joints == 1 else ("joints were", "they")
        told.append(f"{n_joints} {are} not made although {they} may be there")
    return [*told, "'cadgraph explain FOLDER TAG' says what is near a unit or an end"] if told else []


def line_values(line: Line) -> dict[str, Any]:
    """A line as plain values, by the names of :data:`LINE_COLUMNS`, ``through`` and ``dn`` as lists."""
    return {
        "line": line.tag,
        "from": line.start_name,
        "from_port": line.start_port,
        "to": line.end_name,
        "to_port": line.end_port,
        "through": list(line.through_names),
        "beside": [name for place, name in zip(line.through, line.through_names, strict=True) if place in line.beside],
        "length_m": None if line.length is None else round(line.length, 6),
        "length_complete": line.whole,
        "dn": list(line.sizes),
        "flow": line.flow,
        "reason": "; ".join(line.reasons) or None,
        "confidence": line.confidence,
        "system": line.system,
    }


def line_rows(lines: Sequence[Line]) -> list[tuple[Any, ...]]:
    """The line list as a table: the header and a row for each line, lists joined by blanks."""
    rows: list[tuple[Any, ...]] = [LINE_COLUMNS]
    for line in lines:
        values = line_values(line)
        joined = {"through": " ".join(values["through"]), "dn": line.size, "length_complete": _yes(line.whole)}
        rows.append(tuple({**values, **joined}[column] for column in LINE_COLUMNS))
    return rows


def trace_lines(found: Trace, *, hints: bool = True) -> list[str]:
    """A trace: each node with its distance and what it comes after, then where the way halts and where it returns.

    Args:
        found: the trace.
        hints: whether to name options of the command line.
    """
    start = found.steps[0].name
    rows: list[tuple[str, ...]] = [("distance", "", "", "after", "line", "")]
    rows += [_step_row(step) for step in found.steps[1:]]
    told = [f"{found.direction} of {start} ({found.steps[0].what}):"]
    if len(rows) == 1:
        told.append(f"nothing: no known flow {'leaves' if found.direction == 'downstream' else 'comes to'} {start}")
    else:
        told += aligned(rows, right=(0,))
    if found.halts:
        hint = " (--unknown follows it both ways)" if hints else ""
        told += ["", f"not followed, as the direction of flow is unknown{hint}:"]
        told += _halt_rows(found.halts)
    loops = [f"{r.after} -> {r.to}" for r in found.returns if r.loop]
    meets = [f"{r.after} -> {r.to}" for r in found.returns if not r.loop]
    told += ["", f"comes round in a loop: {', '.join(loops)}"] if loops else []
    told += ["", f"branches meet again: {', '.join(meets)}"] if meets else []
    return told + (["", *_doubt_lines("this may not be all:", found.doubts)] if found.doubts else [])


def _halt_rows(halts: Sequence[Halt]) -> list[str]:
    return aligned([(f"{h.distance:.2f} m", f"{h.after} - {h.towards}", h.line or "") for h in halts], (0,))


def way_lines(found: Trace, start: str, end: str) -> list[str]:
    """A way from one node to another in order, or that there is none."""
    manner = f" {found.direction}" if found.direction else ""
    if not found.steps:
        known = " that is known to flow so" if found.halts else ""
        told = [f"no way{manner} along the pipes from {start} to {end}{known} was found"]
        if found.halts:
            told += ["", "there is one if it flows so here, where the direction is unknown:", *_halt_rows(found.halts)]
        return told + (_doubt_lines("there may be one all the same:", found.doubts) if found.doubts else [])
    rows = [("distance", "", "", "line", "")]
    for step in found.steps:
        flow = _FLOW_WORDS[step.flow] if step.after and not step.tap else ""
        what = f"{step.what}, on the side" if step.aside else step.what
        rows.append((_metres(step.distance, step.at_least), step.name, what, step.line or "", flow))
    last = found.steps[-1]
    return [
        f"from {found.steps[0].name} to {last.name}{manner}: {_metres(last.distance, last.at_least)}",
        *aligned(rows, right=(0,)),
        *(["", *_doubt_lines("this may not be so:", found.doubts)] if found.doubts else []),
    ]


def trace_values(found: Trace) -> dict[str, Any]:
    """A trace as plain values; distances in metres."""
    return {
        "start": found.steps[0].name if found.steps else None,
        "direction": found.direction,
        "steps": [
            {
                "tag": step.name,
                "what": step.what,
                "distance_m": round(step.distance, 6),
                "distance_complete": not step.at_least,
                "after": step.after,
                "line": step.line,
                "flow": step.flow,
                "reason": step.reason,
                "tap": step.tap,
                "aside": step.aside,
                "ends": step.ends,
            }
            for step in found.steps
        ],
        "halts": [
            {"after": halt.after, "towards": halt.towards, "line": halt.line, "distance": round(halt.distance, 6)}
            for halt in found.halts
        ],
        "returns": [dataclasses.asdict(back) for back in found.returns],
        "doubts": [_doubt_values(doubt) for doubt in found.doubts],
    }


def isolation_lines(found: Isolation, *, hints: bool = True) -> list[str]:
    """What can't be isolated, what makes that doubtful, what to close, what else is shut off.

    Args:
        found: the isolation.
        hints: whether to name options of the command line.
    """
    told = []
    if found.openings:
        told.append(f"{found.name} can't be isolated wholly:")
        open_rows = [(f"{o.name} ({o.what})", _by(*o.ports), _metres(o.distance), o.why) for o in found.openings]
        told += [f"  {row}" for row in aligned(open_rows, right=(2,))]
    if found.doubts:
        heading = "these valves may not isolate" if found.valves else "nobody can tell what isolates"
        told += _doubt_lines(f"{heading} {found.name} wholly:", found.doubts)
    if found.isolated and not found.valves:
        told.append(f"no valve has to be closed to isolate {found.name}: nothing that could flow to it was found")
    shut = ", ".join(found.shut_off_names) or "nothing else"
    lines = f" (lines {', '.join(found.lines)})" if found.lines else ""
    more = " (--check-valves counts it)" if hints else ""
    notes = (f"note: {r}{more if r.endswith(PASSED_OVER) else ''}" for r in found.remarks)
    # While ways stay open, what hangs together with it is as little shut off as it is itself.
    what = "in one section with it, not shut off while ways stay open" if found.openings else "shut off with it"
    return [*told, *_closing_lines(found), *_passed_lines(found), f"{what}: {shut}{lines}", *notes]


def _closing_lines(found: Isolation) -> list[str]:
    """The valves to close, if any."""
    if not found.valves:
        return []
    count = sum(not valve.automatic for valve in found.valves)
    rows = [
        (
            v.name,
            f"{v.what} ({v.likely})" if v.likely else v.what,
            _by(v.port),
            _metres(v.distance),
            v.line or "",
            "closes by itself" if v.automatic else "",
        )
        for v in found.valves
    ]
    heading = f"to isolate {found.name}, close {count} valve{'s' * (count != 1)}:"
    return [heading, *(f"  {row}" for row in aligned(rows, right=(3,)))]


def _passed_lines(found: Isolation) -> list[str]:
    """The valves that are not relied on, if any."""
    if not found.passed:
        return []
    rows = [(v.name, v.what, _by(v.port), _metres(v.distance), v.line or "", v.why) for v in found.passed]
    return ["not relied on, as nobody knows whether they shut off:", *(f"  {row}" for row in aligned(rows, right=(3,)))]


def isolation_values(found: Isolation) -> dict[str, Any]:
    """An isolation as plain values; distances in metres."""
    return {
        "target": found.name,
        "isolated": found.isolated,
        "valves": [
            {
                "tag": v.name,
                "what": v.what,
                "port": v.port,
                "distance_m": round(v.distance, 6),
                "line": v.line,
                "automatic": v.automatic,
                "likely": v.likely or None,
            }
            for v in found.valves
        ],
        "passed": [
            {
                "tag": v.name,
                "what": v.what,
                "port": v.port,
                "distance_m": round(v.distance, 6),
                "line": v.line,
                "why": v.why,
            }
            for v in found.passed
        ],
        "openings": [
            {
                "to": o.name,
                "what": o.what,
                "port": o.port,
                "other_ports": list(o.other_ports),
                "distance_m": round(o.distance, 6),
                "why": o.why,
            }
            for o in found.openings
        ],
        "doubts": [_doubt_values(doubt) for doubt in found.doubts],
        "shut_off": list(found.shut_off_names),
        "lines": list(found.lines),
        "remarks": list(found.remarks),
    }


def comparison_lines(found: Comparison, *, most: int = 20) -> list[str]:
    """A comparison of a plant with its plan: a line of counts for each matter, and what differs below it.

    Args:
        found: the comparison.
        most: rows that are shown of each matter; how many more there are is said.
    """
    return [
        *_unit_lines(found, most),
        *_connection_lines(found, most),
        *_order_lines(found, most),
        f"directions     {len(found.directions)} contradict",
        *_listed([_way(way.at, way.to, way.plant, way.plan) for way in found.directions], most),
        *_difference_lines("kinds", found.kinds, most),
        *_difference_lines("ends of pipes", found.ends, most),
        *(f"note: {remark}" for remark in found.skipped),
        "",
        found.verdict,
    ]


def _difference_lines(what: str, found: Sequence[Difference], most: int) -> list[str]:
    rows = [(", ".join(one.where), f"{one.plant} in the plant,", f"{one.plan} in the plan") for one in found]
    return [f"{what:<15}{len(found)} differ", *_listed(aligned(rows), most)]


def _unit_lines(found: Comparison, most: int) -> list[str]:
    by = Counter(unit.by for unit in found.found)
    ways = ", ".join(f"{by[way]} {words}" for way, words in _WAYS.items() if by[way])
    told = [f"units          {len(found.found)} in both{f' ({ways})' if ways else ''}"]
    guessed = [unit for unit in found.found if unit.by == "network"]
    rows = [(u.plant, "=", u.plan, u.what, f"{u.sure:.0%} of the neighbours agree") for u in guessed]
    told += _listed(aligned(rows), most)
    told += _listed([f"nobody can say which is which: {_either(*each)}" for each in found.alike], most)
    for where, units in (("plant", found.only_plant), ("plan", found.only_plan)):
        told += [f"only in {where:<7}{len(units)}"]
        told += _listed(aligned([(unit.tag, unit.what, _around(unit)) for unit in units]), most)
    if {unit.what for unit in found.only_plant} & {unit.what for unit in found.only_plan}:
        told.append("               some of these may be the same; --map FILE says which is which")
    return told


def _connection_lines(found: Comparison, most: int) -> list[str]:
    counts = f"{len(found.missing)} only in the plan, {len(found.extra)} only in the plant"
    return [
        f"connections    {len(found.agreeing)} agree, {counts}",
        *_listed([f"only in the plan: {a} - {b}" for a, b in found.missing], most),
        *_listed([f"only in the plant: {a} - {b}" for a, b in found.extra], most),
    ]


def _order_lines(found: Comparison, most: int) -> list[str]:
    told = [f"orders         {len(found.lines)} lines agree, {len(found.orders)} differ"]
    for order in found.orders[:most]:
        told.append(f"  {order.line} in the plant: {' '.join(order.plant)}")
        told.append(f"  {'':<{len(order.line)}} in the plan:  {' '.join(order.plan)}")
    return told + _more(len(found.orders) - most)


_WAYS = {"tag": "by tag", "given": "as given", "network": "by the network"}


def comparison_values(found: Comparison) -> dict[str, Any]:
    """A comparison as plain values; tags are those of the plant unless the key says otherwise."""
    return {
        "agrees": found.agrees,
        "complete": found.complete,
        "verdict": found.verdict,
        "units": [{**dataclasses.asdict(unit), "sure": round(unit.sure, 6)} for unit in found.found],
        "only_in_plant": [dataclasses.asdict(unit) for unit in found.only_plant],
        "only_in_plan": [dataclasses.asdict(unit) for unit in found.only_plan],
        "alike": [{"plant": list(plant), "plan": list(plan)} for plant, plan in found.alike],
        "connections": {
            "agree": [list(pair) for pair in found.agreeing],
            "only_in_plan": [list(pair) for pair in found.missing],
            "only_in_plant": [list(pair) for pair in found.extra],
        },
        "orders": {"agree": list(found.lines), "differ": [dataclasses.asdict(order) for order in found.orders]},
        "directions": [dataclasses.asdict(way) for way in found.directions],
        "kinds": [dataclasses.asdict(kind) for kind in found.kinds],
        "ends": [dataclasses.asdict(end) for end in found.ends],
        "notes": list(found.skipped),
    }


def _doubt_lines(heading: str, doubts: Sequence[Doubt]) -> list[str]:
    return [heading, *(f"  {doubt.name}: {doubt.text}" for doubt in doubts)]


def _doubt_values(doubt: Doubt) -> dict[str, Any]:
    values = {"at": doubt.name, "text": doubt.text}
    return {**values, "parts": list(doubt.parts), "gap_m": doubt.gap, "score": doubt.score}


def _listed(rows: Sequence[str], most: int) -> list[str]:
    return [f"  {row}" for row in rows[:most]] + _more(len(rows) - most)


def _more(count: int) -> list[str]:
    return [f"  and {count} more; --json has them all"] if count > 0 else []


def _some(names: Sequence[str]) -> str:
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "")


def _either(plant: Sequence[str], plan: Sequence[str]) -> str:
    return f"{', '.join(plant)} in the plant, {', '.join(plan)} in the plan"


def _around(unit: Missing) -> str:
    return f"beside {', '.join(unit.near)}" if unit.near else ""


def _way(at: str, to: Sequence[str], plant: str, plan: str) -> str:
    others = ", ".join(to) or "an end"
    words = {"out": f"from {at} to {others}", "in": f"from {others} to {at}"}
    return f"{words[plant]} in the plant, {words[plan]} in the plan"


def _step_row(step: Step) -> tuple[str, ...]:
    marks = ["on the side"] * step.aside + ["instrument"] * step.tap + ["end"] * (step.ends and not step.tap)
    marks += ["direction unknown"] * (step.flow == "unknown" and not step.tap)
    return (
        _metres(step.distance, step.at_least),
        step.name,
        step.what,
        step.after or "",
        step.line or "",
        ", ".join(marks),
    )


def _by(*ports: str | None) -> str:
    named = ", ".join(filter(None, ports))
    return f"by {named}" if named else ""


def _metres(value: float, at_least: bool = False) -> str:
    return f"{'>= ' if at_least else ''}{value + 0.0:.2f} m"


def _yes(value: bool) -> str:
    return "yes" if value else "no"
