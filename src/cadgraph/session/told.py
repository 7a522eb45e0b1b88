"""What came of a correction, in words: parts that follow it, units that come, go or are renamed, flow that turns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence

from cadgraph._io.text import natural_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import CorrectedEvidence
from cadgraph.model.records import Connected, Junction, Node, Part, Terminal, Unit
from cadgraph.query.lines import find_lines

__all__ = ["tell_flow", "tell_followers", "tell_lines", "tell_renamed", "tell_units"]

_MOST_RUNS = 3  # runs of tags that are told one by one
_MOST_TURNED = 3  # connections that are told one by one
_MOST_LINES = 3  # lines that are told one by one
_Key = frozenset[object]


def tell_followers(named: Sequence[Part], changed: Sequence[Part]) -> str:
    """Which parts have another label although nobody named them; empty where none has.

    Args:
        named: that were corrected, as they are now.
        changed: all parts with another label than before, as they are now.
    """
    known = {part.id for part in named}
    others = [part.label for part in changed if part.id not in known]
    matches = [
        label.evidence.match if label is not None and isinstance(label.evidence, CorrectedEvidence) else None
        for label in others
    ]
    exact = matches.count("exact")
    alike = len(matches) - exact - matches.count(None)
    whose, like = ("its", "it") if len(known) == 1 else ("their", "them")
    told = [f"{exact:,} of {whose} shape{'s' * (len(known) != 1)}"] if exact else []
    told += [f"{alike:,} that look{'s' * (alike == 1)} much like {like}"] if alike else []
    follow = f"{' and '.join(told)} follow{'s' * (exact + alike == 1)}" if told else ""
    rest = matches.count(None)
    more = f"{rest:,} other label{'s' * (rest != 1)} change{'s' * (rest == 1)} with it" if rest else ""
    return "; ".join(filter(None, (follow, more)))


def tell_renamed(before: SceneGraph, now: SceneGraph, given: Collection[str] = ()) -> str:
    """Which units of the same parts have another tag than before; empty where none has.

    Args:
        before: a graph.
        now: one of the same scene.
        given: tags that somebody just gave, of which nothing need be told.
    """
    renamed = [(was, tag) for was, tag in _renamed(before, now) if tag not in given]
    runs: list[list[tuple[str, str]]] = []
    for was, tag in sorted(renamed, key=lambda pair: natural_key(pair[0])):
        if runs and _next(runs[-1][-1][0], was) and _next(runs[-1][-1][1], tag):
            runs[-1].append((was, tag))
        else:
            runs.append([(was, tag)])
    told = [_tell_run(run) for run in runs[:_MOST_RUNS]]
    rest = sum(map(len, runs[_MOST_RUNS:]))
    return "; ".join([*told, *([f"{rest} more tags change"] if rest else [])])


def tell_lines(before: SceneGraph, now: SceneGraph) -> str:
    """Which lines have another number than before: it is made from the tags of what they join; empty where none has.

    Args:
        before: a graph.
        now: one of the same scene; lines that only one of both has are passed over.
    """
    if not _renamed(before, now):
        return ""
    old, new = _lines(before), _lines(now)
    moved = [(old[key], number) for key, number in new.items() if old.get(key, number) != number]
    told = [f"line {was} is now {number}" for was, number in moved[:_MOST_LINES]]
    rest = len(moved) - len(told)
    return "; ".join([*told, *([f"{rest:,} more lines have another number"] if rest else [])])


def tell_units(before: SceneGraph, now: SceneGraph) -> str:
    """Of which types of unit there are more or fewer than before; empty where there are as many.

    Args:
        before: a graph.
        now: one of the same scene.
    """
    old, new = (Counter(unit.unit_type for unit in graph.units()) for graph in (before, now))
    told = [f"{old[kind]:,} {kind}{'s' * (old[kind] != 1)} before, {new[kind]:,} now" for kind in sorted(old | new)
            if old[kind] != new[kind]]  # fmt: skip
    return "; ".join(told)


def tell_flow(before: SceneGraph, now: SceneGraph) -> str:
    """Where the flow goes the other way than before, or isn't known any more; empty where it doesn't.

    Args:
        before: a graph.
        now: one of the same scene; connections that only one of both has are passed over.
    """
    ends = _ends(now)
    old, new = _flows(before, _ends(before)), _flows(now, ends)
    known = [key for key in new if key in old and old[key] is not None]
    turned = [new[key] for key in known if new[key] is not None and new[key] != old[key]]
    names = {key: _name(now.nodes[place]) for place, key in ends.items()} if turned else {}
    shown = [f"{names[source]} -> {names[target]}" for source, target in filter(None, turned[:_MOST_TURNED])]
    more = ", ..." if len(turned) > _MOST_TURNED else ""
    told = [f"the flow turns in {_counted(len(turned))} ({', '.join(shown)}{more})"] if turned else []
    lost = sum(new[key] is None for key in known)
    told += [f"which way it flows isn't known any more in {_counted(lost)}"] if lost else []
    return "; ".join(told)


def _renamed(before: SceneGraph, now: SceneGraph) -> list[tuple[str, str]]:
    """Both tags of each unit of the same parts that has another one than before."""
    old = {_meshes(before, unit.parts): unit.tag for unit in before.units()}
    pairs = [(old.get(_meshes(now, unit.parts)), unit.tag) for unit in now.units()]
    return [(was, tag) for was, tag in pairs if was is not None and was != tag]


def _counted(count: int) -> str:
    return f"{count:,} connection{'s' * (count != 1)}"


def _flows(graph: SceneGraph, ends: Mapping[str, _Key]) -> Mapping[_Key, tuple[_Key, _Key] | None]:
    """By what a connection joins and leads through: from where to where it flows, None where nobody knows."""
    found: dict[_Key, tuple[_Key, _Key] | None] = {}
    for edge in graph.of_kind(Connected):
        way = ends[edge.source], ends[edge.target]
        key = frozenset((frozenset(way), _meshes(graph, edge.via)))
        turned = way if edge.direction == "forward" else way[::-1]
        found[key] = None if edge.direction == "unknown" else turned
    return found


def _lines(graph: SceneGraph) -> Mapping[_Key, str]:
    """The number of each line, by what it joins, where, and what it leads through."""
    ends = _ends(graph)
    return {
        frozenset(
            (
                (ends[line.start], line.start_port),
                (ends[line.end], line.end_port),
                *(ends[place] for place in line.through),
            )
        ): line.tag
        for line in find_lines(graph)
    }


def _ends(graph: SceneGraph) -> dict[str, _Key]:
    """What each node that lines run between is in any graph of the scene: its parts, and where an end or branch is."""
    ends: dict[str, _Key] = {}
    nodes: list[Unit | Junction | Terminal] = [*graph.units(), *graph.of_layer(Junction), *graph.of_layer(Terminal)]
    for node in nodes:
        point = tuple(round(c, 2) for c in node.point) if isinstance(node, Junction | Terminal) else None
        ends[node.id] = frozenset((_meshes(graph, node.parts), point))
    return ends


def _name(node: Node) -> str:
    return node.tag if isinstance(node, Unit) else node.id


def _meshes(graph: SceneGraph, parts: Sequence[str]) -> frozenset[str]:
    """A unit by what the file calls its parts, as ids may be others in another graph."""
    return frozenset(graph.part(part).meshes[0] for part in parts)


def _next(tag: str, other: str) -> bool:
    """Whether a tag has the number after another one's, and else looks the same."""
    lead, other_lead = tag.rstrip("0123456789"), other.rstrip("0123456789")
    number, other_number = tag[len(lead) :], other[len(other_lead) :]
    return lead == other_lead and bool(number and other_number) and int(other_number) == int(number) + 1


def _tell_run(run: Sequence[tuple[str, str]]) -> str:
    (was, tag), (last_was, last_tag) = run[0], run[-1]
    return f"{was} is now {tag}" if len(run) == 1 else f"{was} to {last_was} are now {tag} to {last_tag}"
