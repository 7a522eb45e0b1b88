"""Questions along the pipes: neighbours, what lies downstream, ways, what isolates, what closing does, the lines."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, Any, Literal

from cadgraph.agents.answer import Answer, AskError, cell, page_of, row
from cadgraph.agents.plant import Plant
from cadgraph.agents.simulating import simulated_rows, simulated_values, simulation_of
from cadgraph.errors import Unconnected
from cadgraph.model.pipework import Arc
from cadgraph.model.records import Junction, Part, System, Terminal, Unit
from cadgraph.query.doubt import Doubt
from cadgraph.query.isolate import find_isolation
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.text import gap_lines, isolation_values, line_values, trace_values
from cadgraph.query.trace import Step, find_way
from cadgraph.query.trace import trace as follow
from cadgraph.query.what_if import Consequence, WhatIf
from cadgraph.query.what_if import what_if as find_consequences

__all__ = ["isolate", "lines", "neighbors", "route", "trace", "what_if"]

_TEXT = 400  # characters of a text that is more than a name
_LINE = 240  # characters of a row of names; a longer list goes on in another row
_FLOWS = {"forward": "->", "backward": "<-", "none": "--", "unknown": "?", "contradictory": "><"}


def neighbors(
    plant: Plant,
    id: str,
    by: Literal["pipe", "touch"] = "pipe",
    page: int = 1,
) -> Answer:
    """What is next to something.

    Args:
        plant: that holds it.
        id: of a unit, a junction or an end; of a part as well where parts that touch are asked for.
        by: over pipes the next units and ends, junctions walked through; or the parts that touch it.
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
        Unconnected: no line was found at the unit: that doesn't say that there is none.
    """
    if by == "touch":
        return _touching(plant, id, page)
    start = plant.place(id)
    network = plant.network
    if not network.arcs(start):
        raise network.unconnected(start, "what is next to it along the pipes")
    distances, ways = network.shortest(start, lambda arc: arc.start == start or _is_passed(plant, arc.start))
    found = [place for place in distances if place != start and not _is_passed(plant, place)]
    found.sort(key=lambda place: (distances[place], network.name(place)))
    values: list[dict[str, Any]] = [
        {
            "tag": network.name(place),
            "what": network.what(place),
            "distance_m": distances[place],
            "distance_complete": all(arc.length is not None for arc in ways[place]),
            "port": ways[place][0].start_port,
            "flow": _flow_of(plant, ways[place]),
            "line": plant.line_of.get(ways[place][0].index),
        }
        for place in found
    ]
    head = [f"next to {_told(plant, start)} along pipes: {len(values)}", row("what", "", "distance", "port", "flow")]
    rows = [
        row(v["tag"], v["what"], _metres(v["distance_m"], v["distance_complete"]), v["port"], v["flow"]) for v in values
    ]
    return Answer(page_of(head, rows, [], page), {"of": network.name(start), "by": by, "neighbors": values})


def _is_passed(plant: Plant, place: str) -> bool:
    return isinstance(plant.network.places[place], Junction)


def _flow_of(plant: Plant, way: Sequence[Arc]) -> str:
    """Where something lies that is reached by a way over junctions."""
    if plant.network.is_tap(way[-1]):
        return "instrument"
    flows = {arc.flow for arc in way}
    if "unknown" in flows:
        return "unknown"
    if flows == {"along"}:
        return "downstream"
    return "upstream" if flows == {"against"} else "beside"


def _touching(plant: Plant, which: str, page: int) -> Answer:
    node = plant.find(which)
    if not isinstance(node, Part | Unit | Junction | Terminal):
        raise AskError(f"{cell(which)} is a {node.layer}; give a unit or a part, whose parts touch others")
    own = [node.id] if isinstance(node, Part) else list(node.parts)
    others = {
        other.id: (part, other) for part in own for other in plant.graph.neighbors(plant.graph.part(part))
        if isinstance(other, Part) and other.id not in own
    }  # fmt: skip
    values = []
    for part, other in others.values():
        owner = plant.graph.unit_of(other)
        label = other.label.name or other.label.group if other.label else None
        values.append({"part": other.id, "label": label, "of": plant.called(owner.id) if owner else None, "by": part})
    head = [f"parts that touch {plant.called(node.id)}: {len(values)}", row("part", "label", "of", "touches")]
    rows = [row(v["part"], v["label"] or "unlabelled", v["of"], v["by"]) for v in values]
    return Answer(page_of(head, rows, [], page), {"of": plant.called(node.id), "by": "touch", "neighbors": values})


def trace(
    plant: Plant,
    start: str,
    direction: Literal["downstream", "upstream"] = "downstream",
    unknown: Annotated[bool, "also go where the flow's direction is unknown"] = False,
    page: int = 1,
) -> Answer:
    """All that lies downstream or upstream, in order of distance.

    Args:
        plant: that holds it.
        start: tag or id of where it begins.
        direction: with the flow or against it.
        unknown: whether connections of unknown direction are followed, both ways.
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
        Unconnected: no line was found at the start: that is no answer.
    """
    first = plant.place(start)
    found = follow(plant.network, first, direction, through_unknown=unknown)
    steps = [step for step in found.steps[1:] if not isinstance(plant.network.places[step.place], Junction)]
    head = [f"{direction} of {_told(plant, first)}: {len(steps)} units and ends"]
    if found.halts:
        head.append(f"MAY NOT BE ALL: {_count(len(found.halts), 'halt')} where the direction is unknown (listed last)")
    if found.doubts:
        head.append(f"MAY NOT BE ALL: {_count(len(found.doubts), 'doubt')} (listed last)")
    head.append(row("distance", "tag", "", "after", "line"))
    rows = [_step_row(step) for step in found.steps[1:]]
    rows += [
        row("halt", f"{_metres(halt.distance)} at {halt.after}, not followed towards {halt.towards}", halt.line)
        for halt in found.halts
    ]
    rows += [row("loop" if r.loop else "meets", f"{r.after} comes back to {r.to}") for r in found.returns]
    return Answer(page_of(head, [*rows, *_doubt_rows(found.doubts)], [], page), trace_values(found))


def route(plant: Plant, start: str, end: str, page: int = 1) -> Answer:
    """The shortest way along the pipes from one unit to another, whichever way they flow.

    Args:
        plant: that holds both.
        start: tag or id.
        end: tag or id.
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
        Unconnected: no line was found at one of the two: that is no answer.
    """
    first, last = plant.place(start), plant.place(end)
    found = find_way(plant.network, first, last)
    between = f"from {_told(plant, first)} to {_told(plant, last)}"
    if not found.steps:
        head = [f"no way along pipes {between} was found"]
        if found.doubts:
            head.append("there may be one all the same:")
        text = page_of(head, _doubt_rows(found.doubts), [], page)
        return Answer(text, trace_values(found) | {"length_m": None, "length_complete": False})
    step = found.steps[-1]
    head = [f"{between}: {_metres(step.distance, not step.at_least)}", row("distance", "tag", "", "after", "line", "")]
    words = {"along": "with the flow", "against": "against the flow", "unknown": "direction unknown"}
    rows = [f"{_step_row(step)}\t{'' if step.tap or not step.after else words[step.flow]}" for step in found.steps]
    values = trace_values(found) | {"length_m": step.distance, "length_complete": not step.at_least}
    return Answer(page_of(head, rows, [], page), values)


def isolate(
    plant: Plant,
    target: str,
    fewest: Annotated[bool, "fewest valves, though more is shut off"] = False,
    check_valves: Annotated[bool, "count check valves that hold back"] = False,
    assume_shutoff: Annotated[bool, "count valves of unknown kind"] = False,
    page: int = 1,
) -> Answer:
    """The valves that isolate a unit on every one of its ports, what stays open and what makes that doubtful.

    Args:
        plant: that holds it.
        target: tag or id.
        fewest: rather the smallest set of valves than the nearest ones.
        check_valves: whether a check valve counts that the flow leaves the unit through.
        assume_shutoff: whether valves of unknown kind count, each of them a doubt.
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
        Unconnected: no line was found at the unit: that doesn't say that nothing feeds it.
    """
    place = plant.place(target)
    found = find_isolation(
        plant.network, place, check_valves=check_valves, fewest=fewest, assume_shutoff=assume_shutoff
    )
    n_valves = sum(not valve.automatic for valve in found.valves)
    close = f"{_count(n_valves, 'valve')} to close"
    if found.openings:
        verdict = f"CAN'T BE ISOLATED WHOLLY: {_ways(len(found.openings))} open; {close}"
    elif found.doubts:
        verdict = f"NOT SURE: {_count(len(found.doubts), 'doubt')}; {close}"
    else:
        verdict = close if n_valves else "no valve has to be closed: nothing that could flow to it was found"
    rows = []
    for o in found.openings:
        ports = ", ".join(o.ports) or "-"
        rows.append(f"{row('stays open', o.name, o.what, ports, _metres(o.distance))}\t{cell(o.why, _TEXT)}")
    rows += _doubt_rows(found.doubts)
    rows += [f"note\t{cell(remark, _TEXT)}" for remark in found.remarks]
    rows += [
        f"{row('not relied on', v.name, v.what, v.port or '-', _metres(v.distance))}\t{cell(v.why, _TEXT)}"
        for v in found.passed
    ]
    rows += [
        row(
            "close",
            v.name,
            f"{v.what} ({v.likely})" if v.likely else v.what,
            v.port,
            _metres(v.distance),
            v.line,
            "closes by itself" if v.automatic else "",
        )
        for v in found.valves
    ]
    # While ways stay open, what hangs together with it is as little shut off as it is itself.
    what = "same section, NOT shut off" if found.openings else "shut off too"
    rows += _listed(what, "", found.shut_off_names) or [row(what, "", "nothing else")]
    rows += _listed("lines", "", found.lines)
    return Answer(page_of([f"isolate {_told(plant, place)}: {verdict}"], rows, [], page), isolation_values(found))


def what_if(
    plant: Plant,
    close: Annotated[list[str] | str, "tags of valves"],
    sources: Annotated[list[str] | str | None, "what feeds; else tanks and ends"] = None,
    page: int = 1,
) -> Answer:
    """What loses what feeds it when valves are closed; where a scenario lies beside the graph, what gauges then show.

    Args:
        plant: that holds them.
        close: tags or ids of the valves.
        sources: tags or ids of what feeds the network; by default tanks, and ends that aren't known to be outlets.
        page: counted from 1.

    Raises:
        AskError: nothing is called so, or what is to be closed is no valve.
        Unconnected: no line was found at one of them: that is no answer.
    """
    places = [plant.place(name) for name in _names(close)]
    feeding = [plant.place(name) for name in _names(sources)] if sources else None
    try:
        found = find_consequences(plant.network, places, feeding)
    except Unconnected:
        raise
    except ValueError as error:
        raise AskError(cell(error, _TEXT)) from None
    simulated = simulation_of(plant, places, found, asked=feeding is None)
    rows = [*_consequence_rows(found), *simulated_rows(simulated)]
    return Answer(page_of(_verdict(found), rows, [], page), _what_if_values(found) | simulated_values(simulated))


def _names(given: Sequence[str] | str | None) -> list[str]:
    """Names as a model may give them: a list, one name, or a list as JSON or with commas."""
    if not isinstance(given, str):
        return list(given or ())
    if given.lstrip().startswith("["):
        try:
            listed = json.loads(given)
        except ValueError:
            listed = None
        if isinstance(listed, list) and all(isinstance(name, str) for name in listed):
            return listed
    return [name.strip() for name in given.split(",") if name.strip()]


def _verdict(found: WhatIf) -> list[str]:
    surely = sum(not one.why for one in found.cut_off)
    counts = [f"{surely} cut off"]
    counts += [f"{len(found.cut_off) - surely} cut off only on a condition"] if surely < len(found.cut_off) else []
    counts += [f"{len(found.unknown)} UNKNOWN"] if found.unknown else []
    counts += [_count(len(found.doubts), "DOUBT")] if found.doubts else []
    return [f"closing {cell(', '.join(found.closed), 200)}: {', '.join(counts)}"]


def _consequence_rows(found: WhatIf) -> Iterator[str]:
    """What is open first, then what is known."""
    yield from (f"mind\t{cell(remark, _TEXT)}" for remark in found.remarks)
    yield from _grouped("pumps against shut valves", found.dead_headed)
    yield from _doubt_rows(found.doubts)
    yield from _grouped("unknown", found.unknown)
    yield from _grouped("cut off", found.cut_off)
    yield from _grouped("nothing refills", found.not_refilled)
    yield from _grouped("another way leads to", found.still_fed)
    yield from (f"supposed\t{cell(text, _TEXT)}" for text in found.assumptions)
    yield from _listed("sources", "", found.sources)


def _what_if_values(found: WhatIf) -> dict[str, Any]:
    def told(those: Iterable[Consequence]) -> list[dict[str, Any]]:
        return [{"tag": one.name, "what": one.what, "why": one.why or None} for one in those]

    return {
        "closed": list(found.closed),
        "sources": list(found.sources),
        "known": found.known,
        "cut_off": told(found.cut_off),
        "unknown": told(found.unknown),
        "still_fed": told(found.still_fed),
        "not_refilled": told(found.not_refilled),
        "dead_headed": told(found.dead_headed),
        "run_dry": told(found.run_dry),
        "doubts": [{"at": doubt.name, "text": doubt.text} for doubt in found.doubts],
        "assumptions": list(found.assumptions),
        "remarks": list(found.remarks),
    }


def lines(
    plant: Plant,
    system: str = "",
    through: Annotated[str, "unit in them, or at an end"] = "",
    page: int = 1,
) -> Answer:
    """The line list: from, to, length, nominal size, flow, and what stands in each line in order.

    Args:
        plant: that holds them.
        system: id of a system; all if empty.
        through: tag or id of a unit that the lines begin at, end at or run through.
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
        Unconnected: no line was found at that unit: that is no answer.
    """
    found: Sequence[Line] = find_lines(plant.network, plant.place(through)) if through else plant.lines
    if system:
        wanted = plant.find(system, System).id
        found = [line for line in found if line.system == wanted]
    known = sum(line.length or 0.0 for line in found)
    head = [
        f"{_count(len(found), 'line')}, {_metres(known, all(line.whole for line in found))}; flow: "
        "-> known, ? unknown, -- to a blind end, >< contradictory; in brackets: valves beside the line, on a tap",
        row("line", "from", "flow", "to", "length", "DN", "system", "through"),
    ]
    foot = [] if through or system else [f"note: {cell(text, 300)}" for text in gap_lines(plant.network)[:-1]]
    rows = [piece for line in found for piece in _line_rows(line)]
    return Answer(page_of(head, rows, foot, page), {"lines": [line_values(line) for line in found]})


def _line_rows(line: Line) -> Iterator[str]:
    length = "?" if line.length is None else _metres(line.length, line.whole)
    ends = [
        f"{cell(name)}:{cell(port, 20)}" if port else name
        for name, port in ((line.start_name, line.start_port), (line.end_name, line.end_port))
    ]
    first, *more = list(_joined(line.through_words)) or [""]
    cells = [line.tag, cell(ends[0], 120), _FLOWS[line.flow], cell(ends[1], 120), length, line.size or "?"]
    yield "\t".join((*cells, cell(line.system), first)).rstrip("\t")
    yield from (f"{line.tag} goes on through\t{piece}" for piece in more)


# How things are told


def _told(plant: Plant, place: str) -> str:
    return f"{plant.network.name(place)} ({plant.network.what(place)})"


def _count(n: int, noun: str) -> str:
    return f"{n} {noun}{'s' * (n != 1)}"


def _metres(value: float, whole: bool = True) -> str:
    return f"{'' if whole else '>= '}{value + 0.0:.2f} m"


def _step_row(step: Step) -> str:
    marks = ["on the side"] * step.aside + ["instrument"] * step.tap + ["end"] * (step.ends and not step.tap)
    marks += ["direction unknown"] * (step.flow == "unknown" and not step.tap and step.after is not None)
    what = ", ".join((step.what, *marks))
    return row(_metres(step.distance, not step.at_least), step.name, what, step.after, step.line)


def _doubt_rows(doubts: Iterable[Doubt]) -> list[str]:
    return [row("doubt", doubt.name) + "\t" + cell(doubt.text, _TEXT) for doubt in doubts]


def _grouped(word: str, those: Sequence[Consequence]) -> Iterator[str]:
    """Names by why and by what they are."""
    groups: dict[str, dict[str, list[str]]] = {}
    for one in those:
        groups.setdefault(one.why, {}).setdefault(one.what, []).append(one.name)
    for why, kinds in groups.items():
        if why:
            yield f"{word}, {cell(why, _TEXT)}:"
        for what, names in kinds.items():
            yield from _listed(word, what, names)


def _listed(word: str, what: str, names: Sequence[str]) -> list[str]:
    """Names in rows of one length, each with what they are."""
    return [f"{row(word, what)}\t{piece}" for piece in _joined(names)]


def _joined(names: Sequence[str]) -> Iterator[str]:
    """Names with commas, in pieces of one length."""
    piece = ""
    for name in map(cell, names):
        if piece and len(piece) + len(name) > _LINE:
            yield piece
            piece = ""
        piece = f"{piece}, {name}" if piece else name
    if piece:
        yield piece


def _ways(n: int) -> str:
    return f"{n} way stays" if n == 1 else f"{n} ways stay"
