"""What came of a correction, in words: which parts follow it, and which units are called otherwise."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from cadgraph._io.text import natural_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import CorrectedEvidence
from cadgraph.model.records import Part

__all__ = ["tell_followers", "tell_renamed"]

_MOST_RUNS = 3  # runs of tags that are told one by one


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
    old = {_meshes(before, unit.parts): unit.tag for unit in before.units()}
    pairs = [(old.get(_meshes(now, unit.parts)), unit.tag) for unit in now.units()]
    renamed = [(was, tag) for was, tag in pairs if was is not None and was != tag and tag not in given]
    runs: list[list[tuple[str, str]]] = []
    for was, tag in sorted(renamed, key=lambda pair: natural_key(pair[0])):
        if runs and _next(runs[-1][-1][0], was) and _next(runs[-1][-1][1], tag):
            runs[-1].append((was, tag))
        else:
            runs.append([(was, tag)])
    told = [_tell_run(run) for run in runs[:_MOST_RUNS]]
    rest = sum(map(len, runs[_MOST_RUNS:]))
    return "; ".join([*told, *([f"{rest} more tags change"] if rest else [])])


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
