"""Which unit of one graph is which of another: by tag, by a list of pairs, or by its place in the network."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from cadgraph.model.names import loose_tag
from cadgraph.model.records import Unit
from cadgraph.query.network import Network
from cadgraph.query.regions import find_regions

__all__ = ["Match", "Matching", "kind_words", "match_units"]

# Ours: below half of the neighbours in common, that two units are one is no more than a guess.
_LEAST_SURE = 0.5

# Words that tell kinds apart; a kind without one of them, as "valve", contradicts none.
_KINDS = (
    ("ball",), ("butterfly",), ("gate",), ("globe",), ("plug", "cock"), ("needle",), ("diaphragm",), ("pinch",),
    ("check", "non-return", "nonreturn"), ("relief", "safety"), ("control",), ("pressure", "manometer"),
    ("temperature", "thermometer"), ("level",), ("flow",), ("centrifugal",), ("gear", "screw", "reciprocating"),
)  # fmt: skip


By = Literal["tag", "given", "network"]
_Found = dict[str, tuple[str, By]]  # plant id: plan id, and how it was found


@dataclass(frozen=True)
class Match:
    """One unit in both graphs.

    Args:
        plant: id in the plant's graph.
        plan: id in the plan's graph.
        by: ``tag``, ``given`` or ``network``.
        sure: share of their neighbours that are the same in both, 0..1; 1 where neither has any.
    """

    plant: str
    plan: str
    by: By
    sure: float


@dataclass(frozen=True)
class Matching:
    """All units that are in both graphs, and those that can't be told apart.

    Args:
        pairs: in the order of the plant's graph.
        alike: groups of units that have the same place in their networks: ids in the plant and in the plan.
    """

    pairs: tuple[Match, ...]
    alike: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...] = ()


def match_units(plant: Network, plan: Network, given: Mapping[str, str], *, by_tag: bool = True) -> Matching:
    """Finds the units that are in both graphs.

    First come pairs that are given, then equal tags of one type of unit. What is left is matched by the network: units
    get colours by their type and, again and again, by the colours of what they are joined to; a colour that one unit
    has in each graph is a match (colour refinement; Weisfeiler and Leman 1968), and so are two units that have the
    same matched neighbours and no rival. A match whose neighbours are for the most part others is dropped again. Units
    of the same place, as those of two equal branches, stay unmatched.

    Args:
        plant: the network of the plant.
        plan: that of the plan.
        given: plan ids and the plant ids that they are.
        by_tag: whether equal tags count.
    """
    sides = _Side(plant), _Side(plan)
    found: _Found = {}
    for plan_id, plant_id in given.items():
        found[plant_id] = plan_id, "given"
    if by_tag:
        for plant_id, plan_id in _same_tags(plant, plan, found):
            found[plant_id] = plan_id, "tag"
    alike: list[tuple[tuple[str, ...], tuple[str, ...]]] = []
    # Kinds tell branches apart that are else alike; where they differ, the types have to do.
    for kinds in (True, False):
        alike = _refine(sides, found, kinds)
    agreement = _Agreement(sides, found)
    kept = {a: (b, by) for a, (b, by) in found.items() if by != "network" or agreement(a, b) >= _LEAST_SURE}
    agreement = _Agreement(sides, kept)
    order = {unit: i for i, unit in enumerate(plant.places)}
    pairs = [Match(a, b, by, agreement(a, b)) for a, (b, by) in kept.items()]
    return Matching(tuple(sorted(pairs, key=lambda match: order[match.plant])), tuple(alike))


def kind_words(kind: str | None) -> frozenset[int]:
    """Numbers of the kinds that a kind in words is one of; none where it tells nothing."""
    text = (kind or "").casefold()
    return frozenset(i for i, words in enumerate(_KINDS) if any(word in text for word in words))


class _Side:
    """One graph: its units, and the pieces of pipe that join them, gauges and junctions contracted."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.units = {name: node for name, node in network.places.items() if isinstance(node, Unit)}
        dividing = {name for name in self.units if not network.is_gauge(name)}
        # Per piece its units, and per unit the pieces that it is at, and the other units there.
        self.regions = [sorted((r.ends | r.inside) & self.units.keys()) for r in find_regions(network, dividing)]
        self.at: dict[str, list[int]] = {name: [] for name in self.units}
        self.near: dict[str, set[str]] = {name: set() for name in self.units}
        for number, members in enumerate(self.regions):
            for name in members:
                self.at[name].append(number)
                self.near[name].update(members)
                self.near[name].discard(name)


def _same_tags(plant: Network, plan: Network, found: _Found) -> list[tuple[str, str]]:
    """Pairs of ids with the same tag and type, spelling apart; tags that two units share are left out."""
    own, other = _by_tag(plant, found), _by_tag(plan, {plan_id for plan_id, _ in found.values()})
    return [(a, other[key]) for key, a in own.items() if key in other]


def _by_tag(network: Network, without: Collection[str]) -> dict[tuple[str, str], str]:
    found: dict[tuple[str, str], list[str]] = {}
    for name, node in network.places.items():
        if isinstance(node, Unit) and name not in without:
            found.setdefault((loose_tag(node.tag), node.unit_type), []).append(name)
    return {key: names[0] for key, names in found.items() if len(names) == 1}


def _refine(sides: tuple[_Side, _Side], found: _Found, kinds: bool) -> list[tuple[tuple[str, ...], tuple[str, ...]]]:
    """Adds matches by the network until there are no more; returns what is alike."""
    while True:
        rounds = _colored(sides, found, kinds)
        new = next(filter(None, (_singles(sides, colors, found) for colors in reversed(rounds))), [])
        new = new or _beside(sides, found)
        if not new:
            classes = _classes(sides, rounds[-1], found)
            return [(tuple(a), tuple(b)) for a, b in classes if len(a) == len(b) > 1]
        for plant_id, plan_id in new:
            found[plant_id] = plan_id, "network"


def _singles(sides: tuple[_Side, _Side], colors: Sequence[Mapping[str, int]], found: _Found) -> list[tuple[str, str]]:
    """Units whose colour is that of one unit in each graph."""
    return [(a[0], b[0]) for a, b in _classes(sides, colors, found) if len(a) == len(b) == 1]


def _colored(sides: tuple[_Side, _Side], found: _Found, kinds: bool) -> list[tuple[dict[str, int], dict[str, int]]]:
    """Colours of the units of both graphs after each round, equal for units that can't be told apart so far."""
    numbers: dict[object, int] = {}

    def color(key: object) -> int:
        return numbers.setdefault(key, len(numbers))

    anchors = ({a: i for i, a in enumerate(found)}, {b: i for i, (b, _) in enumerate(found.values())})
    colors: tuple[dict[str, int], dict[str, int]] = ({}, {})
    for side, own, anchor in zip(sides, colors, anchors, strict=True):
        for name, node in side.units.items():
            kind = kind_words(node.kind) if kinds else None
            own[name] = color(("anchor", anchor[name]) if name in anchor else ("type", node.unit_type, kind))
    rounds = [colors]
    while True:
        colors = _next(sides[0], colors[0], color), _next(sides[1], colors[1], color)
        if len({*colors[0].values(), *colors[1].values()}) == len({*rounds[-1][0].values(), *rounds[-1][1].values()}):
            return rounds
        rounds.append(colors)


def _next(side: _Side, colors: Mapping[str, int], color: Callable[[object], int]) -> dict[str, int]:
    """The colours of the units, told apart by those of what they are joined to."""
    regions = [color(("region", tuple(sorted(colors[name] for name in members)))) for members in side.regions]
    return {
        name: color(("unit", own, tuple(sorted(regions[number] for number in side.at[name]))))
        for name, own in colors.items()
    }


def _classes(
    sides: tuple[_Side, _Side], colors: Sequence[Mapping[str, int]], found: _Found
) -> list[tuple[list[str], list[str]]]:
    """Units that aren't matched yet by their colour, for colours that both graphs have."""
    matched = {*found}, {plan_id for plan_id, _ in found.values()}
    classes: dict[int, tuple[list[str], list[str]]] = {}
    for k, (own, done) in enumerate(zip(colors, matched, strict=True)):
        for name, number in own.items():
            if name not in done:
                classes.setdefault(number, ([], []))[k].append(name)
    return [pair for pair in classes.values() if pair[0] and pair[1]]


def _beside(sides: tuple[_Side, _Side], found: _Found) -> list[tuple[str, str]]:
    """Units of one type that are each other's only best match by the matched units that they are joined to."""
    plan_of = {plant_id: plan_id for plant_id, (plan_id, _) in found.items()}
    scores = _scores(sides, plan_of)
    rivals: dict[tuple[str, str], list[float]] = {}
    for (a, b), score in scores.items():
        for name in (("plant", a), ("plan", b)):
            rivals.setdefault(name, []).append(score)

    def wins(name: tuple[str, str], score: float) -> bool:
        return score == max(rivals[name]) and rivals[name].count(score) == 1

    return [
        (a, b)
        for (a, b), score in sorted(scores.items())
        if score >= _LEAST_SURE and wins(("plant", a), score) and wins(("plan", b), score)
    ]


def _scores(sides: tuple[_Side, _Side], plan_of: Mapping[str, str]) -> dict[tuple[str, str], float]:
    """Share of matched neighbours in common, for units of one type that aren't matched and have some in common."""
    plant, plan = sides
    done = set(plan_of.values())
    scores: dict[tuple[str, str], float] = {}
    for a in plant.units.keys() - plan_of.keys():
        own = {plan_of[name] for name in plant.near[a] if name in plan_of}
        for b in {name for each in own for name in plan.near[each]} - done:
            if plan.units[b].unit_type == plant.units[a].unit_type:
                other = plan.near[b] & done
                scores[a, b] = len(own & other) / len(own | other)
    return scores


class _Agreement:
    """How much of what they are joined to matched units have in common; what isn't matched is passed through."""

    def __init__(self, sides: tuple[_Side, _Side], found: _Found) -> None:
        self._plan_of = {plant_id: plan_id for plant_id, (plan_id, _) in found.items()}
        matched = set(self._plan_of), set(self._plan_of.values())
        self._near = tuple(_near(side, own) for side, own in zip(sides, matched, strict=True))

    def __call__(self, plant_id: str, plan_id: str) -> float:
        """The share of the neighbours of two units that are the same, 0..1."""
        own = {self._plan_of[name] for name in self._near[0][plant_id]}
        other = self._near[1][plan_id]
        return len(own & other) / len(own | other) if own | other else 1.0


def _near(side: _Side, matched: Collection[str]) -> dict[str, set[str]]:
    near: dict[str, set[str]] = {name: set() for name in matched}
    dividing = {name for name in matched if not side.network.is_gauge(name)}
    for region in find_regions(side.network, dividing):
        members = {name for name in region.ends | region.inside if name in near}
        for name in members:
            near[name] |= members - {name}
    return near
