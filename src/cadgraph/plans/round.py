"""A round: the order of its goals, and what is done step by step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from cadgraph.errors import AskError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Point, Unit
from cadgraph.plans.changes import Change, assumptions_of, changes_of
from cadgraph.plans.goals import Goal
from cadgraph.plans.stops import Spot, Stop, Terrain, worked_at
from cadgraph.plans.tour import EXACT, shortest_order
from cadgraph.plans.walks import Leg, Walk, Walks, anywhere
from cadgraph.query.network import Network

__all__ = ["Round", "Step", "Survey", "make_round", "survey"]

Doing = Literal["walk", "climb", "set up", "read", "close", "open", "stop", "start"]


_NOTHING = Change()


@dataclass(frozen=True)
class Step:
    """One thing done on a round.

    Args:
        do: ``walk`` on a level, ``climb`` stairs or a ladder, ``set up`` a ladder or lift, or what the goal says.
        target: id of the unit or way that it is done at, or that one walks to.
        level: id of the level that one stands on after it.
        point: where one stands after it [m]; None where that isn't known.
        length: of the walk, or height of the climb [m]; 0 for all else.
        estimated: whether the length is that of a straight line.
        goal: that it fulfils, if any.
        needs: what it takes, in words.
        unsure: what isn't known about it, in words.
        change: what it changes in the network.
        eye: from where a face is seen [m], where such a point was found.
    """

    do: Doing
    target: str
    level: str
    point: Point | None
    length: float = 0.0
    estimated: bool = False
    goal: Goal | None = None
    needs: tuple[str, ...] = ()
    unsure: tuple[str, ...] = ()
    change: Change = _NOTHING
    eye: Point | None = None


@dataclass(frozen=True)
class Round:
    """A way through a plant on which all goals are reached.

    Args:
        goals: as they were asked.
        start: id of the unit where it begins and ends; None for anywhere on the ground.
        steps: in order.
        shortest: whether no other order is shorter, by the lengths that it was made from.
        assumptions: what it supposes, a sentence each.
    """

    goals: tuple[Goal, ...]
    start: str | None
    steps: tuple[Step, ...]
    shortest: bool
    assumptions: tuple[str, ...]

    @property
    def length(self) -> float:
        """Of all walks and climbs [m]."""
        return sum(step.length for step in self.steps)

    @property
    def climbed(self) -> float:
        """Height of all climbs, up and down [m]."""
        return sum(step.length for step in self.steps if step.do == "climb")

    @property
    def estimated(self) -> bool:
        """Whether a walk is estimated as a straight line."""
        return any(step.estimated for step in self.steps)


@dataclass(frozen=True)
class Survey:
    """What a round is made from, and checked by.

    Args:
        network: of the graph.
        terrain: levels and ways.
        walks: the lengths between them.
        stops: where one works at each unit, by its id.
        start: where the round begins and ends.
    """

    network: Network
    terrain: Terrain
    walks: Walks
    stops: Mapping[str, Stop]
    start: Spot


def survey(
    graph: SceneGraph | Network, goals: Sequence[Goal], start: str | None = None, walk: Walk | None = None
) -> Survey:
    """Looks up where the goals are worked at, and how far it is.

    Args:
        graph: the finished graph, or its network.
        goals: what the round is for.
        start: id of the unit where it begins and ends; None for anywhere on the ground.
        walk: lengths of walks on a level; None estimates all as straight lines.

    Raises:
        AskError: the start is no unit.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    terrain = Terrain(network.graph)
    units = [goal.unit for goal in goals] + ([start] if start is not None else [])
    stops = {}
    for name in dict.fromkeys(units):
        node = network.graph.nodes.get(name)
        if not isinstance(node, Unit):
            raise AskError(f"{name!r} is no unit; a round begins at a unit, or anywhere on the ground")
        stops[name] = terrain.stop(node)
    first = stops[start].spot if start is not None else anywhere(terrain)
    return Survey(network, terrain, Walks(terrain, walk), stops, first)


def make_round(
    graph: SceneGraph | Network | Survey,
    goals: Sequence[Goal],
    start: str | None = None,
    walk: Walk | None = None,
) -> Round:
    """The shortest round on which all goals are reached.

    Goals of a stage come before those of the next, in whichever order is shortest. Up to 12 goals no order is shorter;
    above that it is nearly the shortest. The way back to the start is a part of it.

    Args:
        graph: the finished graph, its network, or what was looked up for these goals already.
        goals: what the round is for, at least one.
        start: id of the unit where it begins and ends; None for anywhere on the ground.
        walk: lengths of walks on a level; None estimates all as straight lines.

    Raises:
        AskError: there is no goal, or the start is no unit.
    """
    if not goals:
        raise AskError("a round needs a goal: something to read, turn, stop or start")
    known = graph if isinstance(graph, Survey) else survey(graph, goals, start, walk)
    spots = [known.stops[goal.unit].spot for goal in goals]
    table = known.walks.table([known.start, *spots])
    order = [goals[number - 1] for number in shortest_order(table, [goal.stage for goal in goals])]
    return Round(
        goals=tuple(goals),
        start=start,
        steps=tuple(_steps(known, order)),
        shortest=len(goals) <= EXACT,
        assumptions=(*_supposed(known, order), *assumptions_of(known.network, order)),
    )


def _steps(known: Survey, order: Sequence[Goal]) -> Iterator[Step]:
    here = known.start
    lifted: set[str] = set()
    for goal, change in zip(order, changes_of(known.network, order), strict=True):
        stop = known.stops[goal.unit]
        yield from _on_the_way(known, here, stop.spot)
        here = stop.spot
        standing = Step("set up", goal.unit, here.level, _known_point(here))
        if stop.aid is not None and goal.unit not in lifted:
            lifted.add(goal.unit)
            yield replace(standing, needs=(f"a ladder, lift or other access: {stop.aid}",))
        access = stop.unit.access
        yield replace(
            standing,
            do=goal.action,
            goal=goal,
            needs=_needs(known, goal, stop),
            unsure=(*stop.unsure, *_unsure(goal, stop)),
            change=change,
            eye=access.viewpoint if access is not None and goal.action == "read" else None,
        )
    yield from _on_the_way(known, here, known.start)


def _on_the_way(known: Survey, start: Spot, end: Spot) -> Iterator[Step]:
    """The walks and climbs from one spot to another; a walk of nothing at the end of the round is left out."""
    for leg in known.walks.legs(start, end) or ():
        if leg.end.point is not None:
            yield _step(leg)


def _step(leg: Leg) -> Step:
    unsure = ("no free way was found: the length is that of a straight line",) if leg.blocked else ()
    end = leg.end
    doing: Doing = "climb" if leg.climb else "walk"
    return Step(doing, end.name, end.level, _known_point(end), leg.length, leg.estimated, unsure=unsure)


def _known_point(spot: Spot) -> Point | None:
    return spot.point if spot.sure else None


def _needs(known: Survey, goal: Goal, stop: Stop) -> tuple[str, ...]:
    access = stop.unit.access
    told = []
    if access is not None and stop.aid is None:
        level = known.terrain.name(stop.spot.level)
        told.append(f"its {worked_at(stop.unit)} is {access.height:.1f} m above the {level}")
    if goal.turns and "control" in (stop.unit.kind or "").casefold():
        told.append("a control valve moves by its actuator: turn it from the control room or by its handwheel")
    return tuple(told)


def _unsure(goal: Goal, stop: Stop) -> Iterator[str]:
    unit, access = stop.unit, stop.unit.access
    if goal.verb.unit_type == "valve" and unit.kind is None:
        yield "its kind is not known: it may be a check valve, which nobody turns by hand"
    if goal.action == "read" and access is not None and access.viewpoint is None:
        yield "no point was found from which its face is seen"


def _supposed(known: Survey, order: Sequence[Goal]) -> Iterator[str]:
    if any(goal.verb.unit_type == "pump" for goal in order):
        yield "pumps are stopped and started where they stand; one that is switched elsewhere takes no walk"
    if not known.terrain.known:
        yield (
            "this graph was built without places: levels, ways up and reach are not known, all stops are taken to be "
            "on the ground; build it again"
        )
    elif any(known.stops[goal.unit].unit.access is None for goal in order):
        yield "stops of which the level is not known are taken to be on the ground"
    if any(known.stops[goal.unit].aid is not None for goal in order):
        yield "a ladder, lift or other access can be set up where it is needed; the way with it is not planned"
