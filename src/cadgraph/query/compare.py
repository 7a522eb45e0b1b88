"""A plant's graph beside its piping and instrumentation diagram: what agrees, what is missing, what differs."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal, Unit
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.matching import Match, kind_words, match_units
from cadgraph.query.network import DRAWN_FROM_DOUBT, Network
from cadgraph.query.regions import Region, find_regions

__all__ = [
    "Comparison",
    "Difference",
    "Found",
    "Missing",
    "OtherDirection",
    "OtherOrder",
    "compare",
    "read_mapping",
]

_MOST_SHOWN = 100  # characters of a tag in a message


@dataclass(frozen=True)
class Found:
    """A unit that is in both.

    Args:
        plant: its tag in the plant.
        plan: its tag in the plan.
        what: it is, in the plant's words.
        by: how it was found: ``tag``, ``given`` or ``network``.
        sure: share of its neighbours that are the same in both, 0..1.
    """

    plant: str
    plan: str
    what: str
    by: str
    sure: float


@dataclass(frozen=True)
class Missing:
    """A unit that is in one of both only.

    Args:
        tag: as it is called there.
        what: its kind, else its type.
        near: tags, there, of the units around it that are in both.
    """

    tag: str
    what: str
    near: tuple[str, ...]


@dataclass(frozen=True)
class Difference:
    """A property of a unit, or of a connection, that differs.

    Args:
        where: tags in the plant.
        plant: what it is in the plant.
        plan: what it is in the plan.
    """

    where: tuple[str, ...]
    plant: str
    plan: str


@dataclass(frozen=True)
class OtherOrder:
    """A line on which the same units follow each other in another order.

    Args:
        line: tag of the line in the plant.
        plant: tags of the units that are on it in both, in the plant's order.
        plan: the same tags in the plan's order.
    """

    line: str
    plant: tuple[str, ...]
    plan: tuple[str, ...]


@dataclass(frozen=True)
class OtherDirection:
    """A piece of pipe through which the flow goes one way in the plant and another in the plan.

    Args:
        at: tag of the unit.
        to: tags of the other units that it is joined to there.
        plant: ``out`` of the unit, or ``in``.
        plan: the opposite.
    """

    at: str
    to: tuple[str, ...]
    plant: str
    plan: str


@dataclass(frozen=True)
class Comparison:
    """What a plant and its plan have in common, and what not; tags are those of the plant unless said otherwise.

    Args:
        found: units that are in both.
        only_plant: units that are only in the plant, as far as anybody can say.
        only_plan: units that are only in the plan.
        alike: units of the same place, so that nobody can say which is which: tags in the plant, and in the plan.
        agreeing: pairs of units that are joined in both, without another unit in between.
        extra: pairs that are joined only in the plant.
        missing: pairs that are joined only in the plan.
        lines: tags of the plant's lines on which the units follow each other as in the plan.
        orders: lines on which they don't.
        directions: where the flow goes the other way.
        kinds: units of another kind; of units that nobody can tell apart all together, where no way to pair them fits.
        ends: where another number of pipes ends at the same units, or others of them are open.
        skipped: what was not read of the plan.
    """

    found: tuple[Found, ...]
    only_plant: tuple[Missing, ...]
    only_plan: tuple[Missing, ...]
    alike: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...]
    agreeing: tuple[tuple[str, str], ...]
    extra: tuple[tuple[str, str], ...]
    missing: tuple[tuple[str, str], ...]
    lines: tuple[str, ...]
    orders: tuple[OtherOrder, ...]
    directions: tuple[OtherDirection, ...]
    kinds: tuple[Difference, ...]
    ends: tuple[Difference, ...]
    skipped: tuple[str, ...]

    @property
    def agrees(self) -> bool:
        """Whether nothing differs, as far as both can be compared."""
        differing = (
            self.only_plant, self.only_plan, self.extra, self.missing, self.orders, self.directions, self.kinds,
            self.ends,
        )  # fmt: skip
        return not any(differing)

    @property
    def complete(self) -> bool:
        """Whether all units were compared; those of which nobody can say which is which were not, but for kinds."""
        return not self.alike

    @property
    def verdict(self) -> str:
        """What came of it, in a sentence."""
        if not self.agrees:
            return "the plant and the plan differ"
        if self.complete:
            return "the plant and the plan agree (nominal sizes and nozzles are not compared)"
        open_ones = sum(len(plant) for plant, _ in self.alike)
        of = len(self.found) + open_ones + len(self.only_plant)
        return (
            f"the plant and the plan agree as far as they were compared: {open_ones} of {of} units can't be told apart "
            "from others, and neither they nor what joins them was; --map FILE says which is which"
        )


def compare(
    plant: SceneGraph, plan: SceneGraph, given: Mapping[str, str] | None = None, *, by_tag: bool = True
) -> Comparison:
    """Compares the functional graph of a plant with that of its plan.

    Units that are in both are found by what is given, by tag, and by the network (see
    :func:`~cadgraph.query.matching.match_units`). What is in one of them only is listed, and passed through when
    connections are compared, so that a valve that is missing doesn't count as connections that are.

    Args:
        plant: what was built.
        plan: what was drawn, as ``cadgraph.export.dexpi.read_dexpi`` gives it.
        given: tags in the plan and the tags in the plant that they stand for.
        by_tag: whether equal tags are the same unit; False for a plan that counts in another way.

    Raises:
        ValueError: a given tag is not in its graph, or two stand for one.
    """
    networks = Network(plant), Network(plan)
    matching = match_units(*networks, _given_ids(networks, given or {}), by_tag=by_tag)
    names = _Names(networks, matching.pairs)
    regions = names.regions(0), names.regions(1)
    agreeing, extra, missing = _connections(names, regions)
    same, orders = _orders(names)
    at_units = _by_ends(names, regions[0], 0), _by_ends(names, regions[1], 1)
    return Comparison(
        found=tuple(
            Found(networks[0].name(m.plant), networks[1].name(m.plan), networks[0].what(m.plant), m.by, m.sure)
            for m in matching.pairs
        ),
        only_plant=names.unmatched(0, regions[0], {name for each, _ in matching.alike for name in each}),
        only_plan=names.unmatched(1, regions[1], {name for _, each in matching.alike for name in each}),
        alike=tuple(
            (tuple(map(networks[0].name, plant_ids)), tuple(map(networks[1].name, plan_ids)))
            for plant_ids, plan_ids in matching.alike
        ),
        agreeing=agreeing,
        extra=extra,
        missing=missing,
        lines=same,
        orders=orders,
        directions=_directions(names, *at_units),
        kinds=(*_kinds(networks, matching.pairs), *_kinds_of_alike(networks, matching.alike)),
        ends=_ends(names, *at_units),
        skipped=tuple(finding.message for finding in plan.diagnostics if finding.code != DRAWN_FROM_DOUBT),
    )


def read_mapping(text: str, where: str) -> dict[str, str]:
    """Tags of a plan and the tags of the plant that they stand for, from CSV.

    Args:
        text: two columns, the plan's tag first; a line ``plan,plant`` at the start, empty lines and what follows ``#``
            are passed over.
        where: name of the file, for messages.

    Raises:
        ValueError: a line has other than two values, or a tag of the plan is there twice.
    """
    found: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), 1):
        try:
            row = [cell.strip() for cell in next(csv.reader([line.partition("#")[0]]), [])]
        except csv.Error as error:
            raise ValueError(f"{where}: line {number}: not CSV ({error}); give a pair of tags in each line") from None
        if not any(row) or (number == 1 and [cell.casefold() for cell in row] == ["plan", "plant"]):
            continue
        if len(row) != 2 or not all(row):
            raise ValueError(f"{where}: line {number}: give the plan's tag and the plant's tag with a comma in between")
        if row[0] in found:
            raise ValueError(f"{where}: line {number}: {row[0][:_MOST_SHOWN]!r} is there twice; keep one line")
        found[row[0]] = row[1]
    return found


def _given_ids(networks: tuple[Network, Network], given: Mapping[str, str]) -> dict[str, str]:
    found: dict[str, str] = {}
    for plan_tag, plant_tag in given.items():
        plan_id, plant_id = networks[1].find(plan_tag), networks[0].find(plant_tag)
        for network, name, tag in ((networks[1], plan_id, plan_tag), (networks[0], plant_id, plant_tag)):
            if not isinstance(network.places[name], Unit):
                raise ValueError(f"{tag!r} is no unit but a {network.what(name)}, which has no tag")
        if plan_id in found or plant_id in found.values():
            raise ValueError(f"the pair {plan_tag!r}, {plant_tag!r} names what another pair names already")
        found[plan_id] = plant_id
    return found


class _Names:
    """The units that are in both, by one name: their tag in the plant."""

    def __init__(self, networks: tuple[Network, Network], pairs: Sequence[Match]) -> None:
        self.networks = networks
        self.of: tuple[dict[str, str], dict[str, str]] = (
            {match.plant: networks[0].name(match.plant) for match in pairs},
            {match.plan: networks[0].name(match.plant) for match in pairs},
        )

    def regions(self, side: int) -> list[Region]:
        """The regions between the units that are in both."""
        network = self.networks[side]
        return find_regions(network, {name for name in self.of[side] if not network.is_gauge(name)})

    def members(self, region: Region, side: int) -> tuple[list[str], list[str]]:
        """The dividing units and the gauges of a region that are in both, each in order."""
        of = self.of[side]
        ends = sorted((of[name] for name in region.ends), key=tag_key)
        return ends, sorted((of[name] for name in region.inside if name in of), key=tag_key)

    def unmatched(self, side: int, regions: Sequence[Region], alike: Collection[str]) -> tuple[Missing, ...]:
        """The units that are only on this side, with what is around them; without those that are alike in both."""
        network, around = self.networks[side], {}
        for region in regions:
            near = tuple(sorted((network.name(name) for name in region.ends), key=tag_key))
            around.update(dict.fromkeys(region.inside, near))
        units = (
            Missing(network.name(name), network.what(name), around.get(name, ()))
            for name, node in network.places.items()
            if isinstance(node, Unit) and name not in self.of[side] and name not in alike
        )
        return tuple(sorted(units, key=lambda unit: tag_key(unit.tag)))


_Pairs = tuple[tuple[str, str], ...]


def _connections(names: _Names, regions: tuple[list[Region], list[Region]]) -> tuple[_Pairs, _Pairs, _Pairs]:
    """Pairs of units joined in both, only in the plant, only in the plan; twice where two pipes join them."""
    counts: list[Counter[tuple[str, str]]] = []
    for side, found in enumerate(regions):
        joined: Counter[tuple[str, str]] = Counter()
        for region in found:
            ends, gauges = names.members(region, side)
            joined.update((a, b) for i, a in enumerate(ends) for b in ends[i + 1 :])
            joined.update((a, b) for a in gauges for b in ends)
        counts.append(joined)

    def listed(pairs: Counter[tuple[str, str]]) -> _Pairs:
        return tuple(sorted(pairs.elements(), key=lambda pair: (tag_key(pair[0]), tag_key(pair[1]))))

    return listed(counts[0] & counts[1]), listed(counts[0] - counts[1]), listed(counts[1] - counts[0])


def _orders(names: _Names) -> tuple[tuple[str, ...], tuple[OtherOrder, ...]]:
    """The plant's lines with the order of the plan, and those with another one."""
    drawn = [(line, _row(names, line, 1)) for line in find_lines(names.networks[1])]
    same: list[str] = []
    others: list[OtherOrder] = []
    for line in find_lines(names.networks[0]):
        row = _row(names, line, 0)
        for other, plan_row in drawn:
            common = set(row) & set(plan_row)
            built, planned = ([name for name in each if name in common] for each in (row, plan_row))
            # What is there twice, as the unit of a ring, tells no order.
            if len(built) == len(planned) == len(common):
                follows = _follows(built, planned, line.flow == "forward" == other.flow)
                if follows:
                    same.append(line.tag)
                elif follows is False:
                    others.append(OtherOrder(line.tag, tuple(built), tuple(planned)))
    return tuple(dict.fromkeys(same)), tuple(others)


def _follows(built: list[str], planned: list[str], oriented: bool) -> bool | None:
    """Whether units follow each other as planned, from whichever end; None where nobody can say.

    Args:
        built: units in the plant's order.
        planned: the same units in the plan's order.
        oriented: whether both orders go with the flow, without which two units have none.
    """
    if len(built) < 2 or (len(built) == 2 and not oriented):
        return None
    return built == planned or (len(built) > 2 and built == planned[::-1])


def _row(names: _Names, line: Line, side: int) -> list[str]:
    """The units along a line that are in both, its ends among them."""
    of = names.of[side]
    return [of[name] for name in (line.start, *line.through, line.end) if name in of]


_AtUnits = Mapping[tuple[str, ...], Sequence[Region]]


def _directions(names: _Names, built: _AtUnits, drawn: _AtUnits) -> tuple[OtherDirection, ...]:
    """Where the flow goes the other way, in the pieces of pipe that join the same units in both."""
    skipped = []
    for ends, own in built.items():
        others = drawn.get(ends, [])
        # Of two pipes between the same two units nobody knows which is which.
        if len(own) == len(others) == 1:
            skipped += _against(ends, _flows(names, own[0], 0), _flows(names, others[0], 1))
    return tuple(skipped)


def _by_ends(names: _Names, regions: Iterable[Region], side: int) -> dict[tuple[str, ...], list[Region]]:
    found: dict[tuple[str, ...], list[Region]] = {}
    for region in regions:
        found.setdefault(tuple(names.members(region, side)[0]), []).append(region)
    return found


def _flows(names: _Names, region: Region, side: int) -> dict[str, str]:
    return {names.of[side][name]: flow for name, flow in region.flows.items()}


def _against(ends: tuple[str, ...], built: Mapping[str, str], planned: Mapping[str, str]) -> list[OtherDirection]:
    """The units of a piece of pipe at which the flow goes the other way; one where it joins only two."""
    known = [name for name in ends if name in built and name in planned]
    turned = [name for name in known if built[name] != planned[name]]
    return [
        OtherDirection(name, tuple(other for other in ends if other != name), built[name], planned[name])
        for name in turned[: 1 if len(ends) == 2 else None]
    ]


def _ends(names: _Names, built: _AtUnits, drawn: _AtUnits) -> tuple[Difference, ...]:
    """Where what pipes end in differs between the two, in the pieces of pipe at the same units.

    A piece that joins units and is in one of both only is told as a connection. What nobody knows of an end
    contradicts nothing.
    """
    found = []
    for units in sorted(built.keys() | drawn.keys(), key=lambda units: [tag_key(unit) for unit in units]):
        if not units or (len(units) > 1 and (units not in built or units not in drawn)):
            continue
        counts: list[Counter[str]] = [
            Counter(
                str(node.kind)
                for region in side.get(units, ())
                for name in region.inside
                if isinstance(node := network.places[name], Terminal)
            )
            for network, side in zip(names.networks, (built, drawn), strict=True)
        ]
        if _contradict_in_ends(*counts):
            found.append(Difference(units, *map(_ends_in_words, counts)))
    return tuple(found)


def _contradict_in_ends(built: Counter[str], drawn: Counter[str]) -> bool:
    """Whether there are more ends on one side, or more of a kind than may be of it on the other."""
    pairs = (built, drawn), (drawn, built)
    return built.total() != drawn.total() or any(
        one[kind] > other[kind] + other["unknown"] for kind in ("open", "blind") for one, other in pairs
    )


def _ends_in_words(ends: Counter[str]) -> str:
    known = [f"{ends[kind]} {kind} end{'s' * (ends[kind] != 1)}" for kind in ("open", "blind") if ends[kind]]
    rest = [f"{ends['unknown']} of which nobody knows"] if ends["unknown"] else []
    return ", ".join([*known, *rest]) or "no end"


def _kinds(networks: tuple[Network, Network], pairs: Iterable[Match]) -> tuple[Difference, ...]:
    """Units whose types differ, or whose kinds contradict each other."""
    found = []
    for match in pairs:
        names = match.plant, match.plan
        built, planned = (network.places[name] for network, name in zip(networks, names, strict=True))
        if not isinstance(built, Unit) or not isinstance(planned, Unit):
            continue
        if _contradict(built, planned):
            what = (network.what(name) for network, name in zip(networks, names, strict=True))
            found.append(Difference((built.tag,), *what))
    return tuple(found)


def _contradict(built: Unit, planned: Unit) -> bool:
    """Whether two units can't be one: of two types, or of kinds that exclude each other."""
    words = kind_words(built.kind), kind_words(planned.kind)
    return built.unit_type != planned.unit_type or (all(words) and not words[0] & words[1])


def _kinds_of_alike(
    networks: tuple[Network, Network], alike: Iterable[tuple[tuple[str, ...], tuple[str, ...]]]
) -> Iterator[Difference]:
    """Groups of units that nobody can tell apart, where their kinds contradict however they are paired."""
    from scipy.optimize import linear_sum_assignment

    for group in alike:
        built, planned = (
            [node for name in names if isinstance(node := network.places[name], Unit)]
            for network, names in zip(networks, group, strict=True)
        )
        against = np.array([[_contradict(a, b) for b in planned] for a in built], float)
        rows, columns = linear_sum_assignment(against)
        if against[rows, columns].any():
            what = (_counted(network, names) for network, names in zip(networks, group, strict=True))
            yield Difference(tuple(networks[0].name(name) for name in group[0]), *what)


def _counted(network: Network, names: Iterable[str]) -> str:
    counts = Counter(network.what(name) for name in names)
    return ", ".join(f"{n} {what}" for what, n in sorted(counts.items()))
