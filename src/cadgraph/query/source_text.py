"""A comparison of a graph with its source as people read it, and as plain values for JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from cadgraph.query.compare_source import Claim, SourceComparison, Verdict, WayOfFlow

__all__ = ["source_lines", "source_values"]

_WORDS = {"forward": "->", "backward": "<-", "both": "both ways", "unknown": "?"}
_MOST_PATHS = 8
_VERDICTS: dict[str, Verdict] = {
    "agree": "agree",
    "differ": "differ",
    "only_in_graph": "ours",
    "only_in_source": "theirs",
    "in_neither": "open",
}


def source_lines(found: SourceComparison, *, most: int = 20) -> list[str]:
    """A comparison with the source: a line of counts for each matter, and what differs below it.

    Args:
        found: the comparison.
        most: rows that are shown of each matter; how many more there are is said.
    """
    if not found.links:
        return [
            "the source states nothing of what is joined: its format knows no such links, or it was read with "
            "load.metadata = 'off'"
        ]
    flows = {verdict: found.directions(verdict) for verdict in _VERDICTS.values()}
    within = f", {found.within} of them within one device" if found.within else ""
    told = [
        f"stated         {found.links} links{within}",
        f"connections    {len(found.agreeing)} agree, {len(found.only_ours)} only in the graph, "
        f"{len(found.only_theirs)} only in the source",
        *_listed([line for claim in found.only_ours for line in _ours(claim, found.silent)], most),
        *_listed([line for claim in found.only_theirs for line in _theirs(claim)], most),
        f"directions     {len(flows['agree'])} agree, {len(flows['differ'])} differ, {len(flows['ours'])} only in the "
        f"graph, {len(flows['theirs'])} only in the source, {len(flows['open'])} in neither",
        *_listed([_flow(way) for way in flows["differ"]], most),
        *_listed([f"several pipes join {a} and {b}: not compared" for a, b in found.unclear], most),
        f"not compared   {len(found.uncompared)} elements of the source",
        *_listed([f"{one.path}: {one.why}" for one in found.uncompared], most),
    ]
    if found.silent:
        told += [f"unmentioned    {len(found.silent)} units, of which the source states nothing"]
        told += _listed([", ".join(found.silent[at : at + 12]) for at in range(0, len(found.silent), 12)], most)
    if found.used:
        told.append("note: the graph was made with the source's links as evidence (relate.use_metadata)")
    return [*told, "", found.verdict]


def source_values(found: SourceComparison) -> dict[str, Any]:
    """A comparison with the source as plain values."""
    return {
        "links": found.links,
        "links_within_devices": found.within,
        "links_used_as_evidence": found.used,
        "agrees": found.agrees if found.links else None,
        "complete": found.complete if found.links else None,
        "connections": {
            "agree": [_claim(claim) for claim in found.agreeing],
            "only_in_graph": [_claim(claim) for claim in found.only_ours],
            "only_in_source": [_claim(claim) for claim in found.only_theirs],
        },
        "directions": {
            name: [dataclasses.asdict(way) for way in found.directions(verdict)] for name, verdict in _VERDICTS.items()
        },
        "directions_not_compared": [list(pair) for pair in found.unclear],
        "not_compared": [dataclasses.asdict(one) for one in found.uncompared],
        "unmentioned_units": list(found.silent),
    }


def _claim(claim: Claim) -> dict[str, Any]:
    return {
        "first": claim.first,
        "second": claim.second,
        "units": list(claim.ids),
        "via": list(claim.via),
        "paths": list(claim.paths),
        "gaps": [list(gap) for gap in claim.gaps],
        "not_in_graph": list(claim.lost),
    }


def _ours(claim: Claim, silent: Sequence[str]) -> list[str]:
    unsaid = [tag for tag in (claim.first, claim.second) if tag in silent]
    more = f"; the source states nothing of {' and '.join(unsaid)}" if unsaid else ""
    via = f" by {_some(claim.via)}" if claim.via else ""
    return [f"only in the graph: {claim.first} - {claim.second}{via}{more}"]


def _theirs(claim: Claim) -> list[str]:
    told = [f"only in the source: {claim.first} - {claim.second} by {_some(claim.paths)}"]
    told += [f"  no joint of the graph joins {a} and {b}" for a, b in claim.gaps[:_MOST_PATHS]]
    return told


def _flow(way: WayOfFlow) -> str:
    said = [f"{way.first} {_WORDS[each]} {way.second}" for each in (way.ours, way.theirs)]
    return f"{said[0]} in the graph, {said[1]} in the source"


def _some(names: Sequence[str]) -> str:
    more = len(names) - _MOST_PATHS
    return ", ".join(names[:_MOST_PATHS]) + (f" and {more} more" if more > 0 else "")


def _listed(rows: Sequence[str], most: int) -> list[str]:
    more = len(rows) - most
    return [f"  {row}" for row in rows[:most]] + ([f"  and {more} more; --json has them all"] if more > 0 else [])
