"""A round in words and as plain values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from cadgraph.model.records import Place, Point, Unit
from cadgraph.plans.goals import goals_text, shown
from cadgraph.plans.round import Round, Step, Survey
from cadgraph.plans.rules import Fault

__all__ = ["doubt_lines", "fault_lines", "head_lines", "round_values", "step_lines", "supposed_lines"]


def head_lines(known: Survey, planned: Round, faults: Sequence[Fault]) -> list[str]:
    """What a round is, in a line or two."""
    goals = len(planned.goals)
    where = "from and back to the ground"
    if planned.start is not None:
        where = f"from {_name(known, planned.start)} and back"
    climbed = f", {planned.climbed:.1f} m of it climbed" if planned.climbed else ""
    best = "no order is shorter" if planned.shortest else "nearly the shortest order"
    lines = [f"round of {goals} {'goal' if goals == 1 else 'goals'} {where}: {planned.length:.1f} m{climbed}; {best}"]
    if planned.estimated:
        walks = [step for step in planned.steps if step.do == "walk" and step.length]
        straight = sum(step.estimated for step in walks)
        some = "walks" if straight == len(walks) else f"{straight} of {len(walks)} walks"
        lines[0] += f" ({some} estimated as straight lines)"
    return lines + (fault_lines(faults) if faults else [])


def doubt_lines(known: Survey, planned: Round) -> list[str]:
    """What isn't known, which goals take more than a walk and which may break a pump, as what matters most."""
    aids: dict[str, str] = {}
    unsure: dict[str, list[str]] = {}
    for step in planned.steps:
        name = _name(known, step.target)
        if step.do == "set up":
            aids[name] = "; ".join(step.needs)
        for text in step.unsure:
            unsure.setdefault(text, []).append(name)
    told = [f"! {name} takes {need}" for name, need in aids.items()]
    told += [
        f"! {step.do} {_name(known, step.target)}: {shown(text, 500)}"
        for step in planned.steps
        for text in step.change.harm
    ]
    return told + [f"? {', '.join(dict.fromkeys(names))}: {text}" for text, names in unsure.items()]


def step_lines(known: Survey, planned: Round) -> list[str]:
    """One line for each step."""
    levels = [known.start.level, *(step.level for step in planned.steps)]
    return [
        f"{number}. {_told(known, step, levels[number - 1], number == 1)}"
        for number, step in enumerate(planned.steps, start=1)
    ]


def supposed_lines(planned: Round) -> list[str]:
    """What the round supposes."""
    return [f"supposed: {text}" for text in planned.assumptions]


def fault_lines(faults: Iterable[Fault]) -> list[str]:
    """Broken rules, a line each."""
    return [f"{'the round' if fault.step is None else f'step {fault.step}'}: {fault.text}" for fault in faults]


def round_values(known: Survey, planned: Round, faults: Sequence[Fault]) -> dict[str, Any]:
    """A round as plain JSON values, as ``cadgraph plan --check`` reads them; lengths in metres."""
    return {
        "goals": goals_text(planned.goals),
        "start": planned.start,
        "length_m": planned.length,
        "climbed_m": planned.climbed,
        "shortest": planned.shortest,
        "estimated": planned.estimated,
        "steps": [_values(known, step) for step in planned.steps],
        "needs_ladder_or_lift": [_name(known, step.target) for step in planned.steps if step.do == "set up"],
        "unsure": doubt_lines(known, planned),
        "assumptions": list(planned.assumptions),
        "faults": fault_lines(faults),
    }


def _values(known: Survey, step: Step) -> dict[str, Any]:
    change = step.change
    return {
        "do": step.do,
        "at": step.target,
        "name": _name(known, step.target),
        "level": step.level,
        "point": list(step.point) if step.point is not None else None,
        "length_m": step.length,
        "estimated": step.estimated,
        "needs": list(step.needs),
        "unsure": list(step.unsure),
        "seen_from": list(step.eye) if step.eye is not None else None,
        "cut_off": list(map(shown, change.cut_off)),
        "fed_again": list(map(shown, change.fed_again)),
        "unknown": list(map(shown, change.unknown)),
        "notes": [shown(note, 500) for note in change.notes],
        "harm": [shown(text, 500) for text in change.harm],
    }


def _told(known: Survey, step: Step, before: str, first: bool) -> str:
    """A step in words, after one that ended on a level."""
    name = _name(known, step.target)
    level = shown(known.terrain.name(step.level))
    if step.do == "walk":
        stand = f", stand at {_at(step.point)}" if step.point is not None else ""
        if first and known.start.point is None:
            return f"begin at {name} on the {level}{stand}"
        length = f"{'about ' * step.estimated}{step.length:.1f} m"
        return f"walk {length} to {name} on the {level}{stand}{' ?' * bool(step.unsure)}"
    if step.do == "climb":
        ends = [end.level for end in known.terrain.ways[step.target].ends]
        way = "up" if ends.index(step.level) > ends.index(before) else "down"
        return f"climb {name} {way} {step.length:.1f} m to the {level}"
    if step.do == "set up":
        return f"set up {'; '.join(step.needs)}"
    told = [*step.needs, *_changed(step)]
    if step.eye is not None:
        told.insert(0, f"seen from {_at(step.eye)}")
    return (
        f"{step.do} {name} ({_what(known, step.target)}){' ?' * bool(step.unsure)}{': ' * bool(told)}{'; '.join(told)}"
    )


def _changed(step: Step) -> list[str]:
    change = step.change
    told = []
    if change.cut_off:
        told.append(f"cuts off {', '.join(map(shown, change.cut_off))}")
    if change.fed_again:
        told.append(f"feeds again {', '.join(map(shown, change.fed_again))}")
    if change.unknown:
        may = "may cut off" if step.do == "close" else "may feed again"
        told.append(f"{may}, nobody knows: {', '.join(map(shown, change.unknown))}")
    if step.do != "read" and not (change.cut_off or change.fed_again or change.unknown or change.notes):
        told.append("no unit or end is known to be cut off by it" if step.do == "close" else "feeds nothing again")
    return told + [shown(note, 500) for note in change.notes]


def _name(known: Survey, node: str) -> str:
    found = known.network.graph.nodes.get(node)
    if isinstance(found, Unit):
        return shown(found.tag)
    return f"{found.id} ({found.kind})" if isinstance(found, Place) else node


def _what(known: Survey, node: str) -> str:
    found = known.network.graph.nodes.get(node)
    return shown((found.kind or f"{found.unit_type} of unknown kind") if isinstance(found, Unit) else "")


def _at(point: Point) -> str:
    return " ".join(f"{value:.2f}" for value in point)
