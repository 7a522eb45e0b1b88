"""What closing and opening valves, stopping and starting pumps changes in the network, step by step."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from cadgraph.model.records import Terminal
from cadgraph.plans.goals import Goal
from cadgraph.query.network import Network
from cadgraph.query.what_if import ALL_RUN, Consequence, WhatIf, what_if, would_run_dry

__all__ = ["Change", "assumptions_of", "changes_of", "off_before"]


@dataclass(frozen=True)
class Change:
    """What a step changes, as far as the network says so.

    Args:
        cut_off: tags of what loses all that feeds it, by tag.
        fed_again: tags of what is fed again.
        unknown: tags of what may lose or get it, or not.
        notes: what should be known about it, a sentence each.
        harm: those of them that tell what may break a pump, or where fluid leaves the plant.
    """

    cut_off: tuple[str, ...] = ()
    fed_again: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    harm: tuple[str, ...] = ()


def off_before(goals: Iterable[Goal]) -> frozenset[str]:
    """Ids of the valves that must be shut before a round and the pumps that must stand, as it opens or starts them
    first; of all others nobody knows.
    """
    first: dict[str, Goal] = {}
    for goal in sorted(goals, key=lambda goal: goal.stage):
        if goal.turns:
            first.setdefault(goal.unit, goal)
    return frozenset(unit for unit, goal in first.items() if not goal.verb.off)


def changes_of(network: Network, goals: Sequence[Goal]) -> tuple[Change, ...]:
    """What each goal changes.

    Args:
        network: of the finished graph.
        goals: in the order that they are done in.

    Returns:
        A change for each goal, in that order.
    """
    off = set(off_before(goals))
    now = _asked(network, off)
    found: list[Change] = []
    for goal in goals:
        if not goal.turns:
            found.append(_reading(network, goal, now))
            continue
        if not network.arcs(goal.unit):
            unsaid = f"no line was found at {goal.name}: what turning it changes is not known"
            found.append(Change(notes=(unsaid,)))
            continue
        (off.add if goal.verb.off else off.discard)(goal.unit)
        after = _asked(network, off)
        if goal.verb.unit_type == "pump":
            found.append(_pumping(goal, now, after))
        else:
            found.append(_closing(goal, now, after) if goal.verb.off else _opening(network, goal, now, after))
        now = after
    return tuple(found)


def assumptions_of(network: Network, goals: Sequence[Goal]) -> tuple[str, ...]:
    """What the changes of a round suppose, a sentence each."""
    before = off_before(goals)
    turned = {goal.unit: goal for goal in goals if goal.turns}
    told = []
    for action, state in (("open", "shut"), ("start", "stopped")):
        off = {goal.name: None for goal in goals if goal.action == action and goal.unit in before}
        if off:
            told.append(f"{_and(off)} {'is' if len(off) == 1 else 'are'} {state} before the round")
    pumps = {goal.name: None for goal in turned.values() if goal.verb.unit_type == "pump"}
    if pumps:
        told.append(
            f"what is told is what has a supply, not what flows: what stands still while {_and(pumps)} "
            f"{'is' if len(pumps) == 1 else 'are'} stopped, 'cadgraph simulate' works out"
        )
    answer = _asked(network, list(turned))
    supposed = answer.assumptions if answer is not None else ()
    return (*told, *(_all_others(text) if pumps else text for text in supposed))


def _all_others(text: str) -> str:
    return "all other valves are open and all other pumps run" if text == ALL_RUN else text


def _asked(network: Network, off: Iterable[str]) -> WhatIf | None:
    """The consequences of valves being shut, but for pumps that stand; None where none is that a line was found at."""
    valves = sorted(place for place in off if network.arcs(place) and network.is_valve(place))
    if not valves:
        return None
    answer = what_if(network, valves)
    dry = {one.place for one in answer.run_dry}.intersection(off)
    told = {would_run_dry(one) for one in answer.run_dry if one.place in dry}
    return replace(
        answer,
        run_dry=tuple(one for one in answer.run_dry if one.place not in dry),
        dead_headed=tuple(one for one in answer.dead_headed if one.place not in off),
        remarks=tuple(text for text in answer.remarks if text not in told),
    )


def _pumping(goal: Goal, before: WhatIf | None, after: WhatIf | None) -> Change:
    """What stopping a pump ends, and what starting it into closed valves would do."""
    if goal.action == "stop":
        return Change(notes=("what it alone drives stands still",))
    known = set(_harm(before)) if before else set()
    harm = tuple(text for text in (_harm(after) if after else ()) if text not in known)
    return Change(notes=harm, harm=harm)


def _closing(goal: Goal, before: WhatIf | None, after: WhatIf | None) -> Change:
    lost = _names(after.cut_off if after else ()) - _names(before.cut_off if before else ())
    open_now = _names(after.unknown if after else ()) - _names(before.unknown if before else ())
    notes = _notes(goal, before, after, lost)
    return Change(
        cut_off=_in_order(after.cut_off if after else (), lost),
        unknown=_in_order(after.unknown if after else (), open_now),
        notes=notes,
        harm=tuple(text for text in _harm(after) if text in notes) if after else (),
    )


def _opening(network: Network, goal: Goal, before: WhatIf | None, after: WhatIf | None) -> Change:
    cut, open_before = (before.cut_off, before.unknown) if before else ((), ())
    open_after = _names(after.unknown if after else ())
    freed = _names(cut) - _names(after.cut_off if after else ())
    maybe = (freed & open_after) | (_names(open_before) - open_after - {goal.name})
    fed = freed - open_after - {goal.name}
    ends = {one.name for one in cut if one.name in fed | maybe and _is_open_end(network, one.place)}
    spilt = tuple(f"it flows out at {name}, an open end" for name in _in_order(cut, ends))
    # That it cut something off or harmed a pump before is no news any more; what nobody knows of the valve itself is.
    ended = set(_harm(before)) if before else set()
    told = (text for text in _notes(goal, after, before, freed) if goal.name in text and text not in ended)
    return Change(
        fed_again=_in_order(cut, fed),
        unknown=_in_order((*cut, *open_before), maybe),
        notes=(*spilt, *told),
        harm=spilt,
    )


def _is_open_end(network: Network, place: str) -> bool:
    node = network.places[place]
    return isinstance(node, Terminal) and node.kind == "open"


def _reading(network: Network, goal: Goal, now: WhatIf | None) -> Change:
    if not network.arcs(goal.unit):
        return Change(notes=(f"no line was found at {goal.name}: what it measures is not known",))
    if now is None:
        return Change()
    closed = _and(now.closed)
    if goal.unit in {one.place for one in now.cut_off}:
        return Change(notes=(f"cut off with {closed} closed: it shows what is shut in, not the running plant",))
    if goal.unit in {one.place for one in now.unknown}:
        return Change(notes=(f"with {closed} closed it may be cut off or not",))
    return Change()


def _notes(goal: Goal, without: WhatIf | None, shut: WhatIf | None, told: set[str]) -> tuple[str, ...]:
    """What the consequences say of this valve alone: what they say with it shut and not without."""
    if shut is None:
        return ()
    known = set(_sentences(without)) if without else set()
    said = [f"cut off {one.why}" for one in shut.cut_off if one.why and one.name in told]
    return tuple(dict.fromkeys(text for text in (*_sentences(shut), *said) if text not in known))


def _sentences(answer: WhatIf) -> list[str]:
    return [
        *answer.remarks,
        *_dead_headed(answer),
        *(f"{one.name} is not refilled{one.condition}" for one in answer.not_refilled),
        *(f"{doubt.name}: {doubt.text}" for doubt in answer.doubts),
    ]


def _harm(answer: WhatIf) -> list[str]:
    """What may break a pump."""
    return [*map(would_run_dry, answer.run_dry), *_dead_headed(answer)]


def _dead_headed(answer: WhatIf) -> list[str]:
    return [f"{one.name} would pump against closed valves{one.condition}" for one in answer.dead_headed]


def _names(listed: Iterable[Consequence]) -> set[str]:
    return {one.name for one in listed}


def _in_order(listed: Iterable[Consequence], chosen: set[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(one.name for one in listed if one.name in chosen))


def _and(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last
