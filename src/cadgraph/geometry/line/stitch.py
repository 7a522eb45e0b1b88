"""Puts the swept runs of a tube together to one centreline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline, End, Junction
from cadgraph.geometry.line.meeting import (
    common_point,
    find_crossings,
    find_tap,
    group_meeting_ends,
    point_on_middle,
)
from cadgraph.geometry.line.piece import Piece
from cadgraph.geometry.line.sweep import essential_nodes
from cadgraph.model.scene import Floats

__all__ = ["stitch"]

# Joints this close, as share of the lesser radius, are one.
_SAME_JOINT = 0.25
# Nodes this close to the line between their neighbours, as share of the radius, say nothing.
_STRAIGHT = 1e-3


@dataclass
class _Joints:
    """Where pieces join.

    Args:
        pieces: as swept.
        targets: for each end (piece, 0 or 1) that joins something the point where it does [m].
        cuts: pieces that others join between their ends, and where [m].
        known: every joint so far [m].
    """

    pieces: list[Piece]
    targets: dict[tuple[int, int], Floats]
    cuts: list[tuple[int, Floats]]
    known: list[Floats]

    def snap(self, point: Floats, radius: float) -> Floats:
        """The joint that is already there, or a new one: tubes that reach one place do so with rounding."""
        for joint in self.known:
            if np.linalg.norm(joint - point) <= _SAME_JOINT * radius:
                return joint
        # -0.0 would make another key.
        self.known.append(point + 0.0)
        return self.known[-1]


@dataclass
class _Runs:
    """Pieces cut at their joints.

    Args:
        nodes: of each run.
        at_joint: the runs that begin or end at each joint, by the bytes of its position.
        free: ends that join nothing: piece, end of it, run.
    """

    nodes: list[Floats]
    at_joint: dict[bytes, list[int]]
    free: list[tuple[int, int, int]]


def stitch(pieces: list[Piece], share: float) -> Centreline:
    """Puts pieces together where their axes meet, and cuts them where others branch off.

    Args:
        pieces: at least one.
        share: of the surface that they cover.
    """
    open_ends = [(p, e) for p, piece in enumerate(pieces) if not piece.closed for e in (0, 1)]
    # A loop is cut where it was begun, so whatever comes near there joins there.
    joints = _Joints(pieces, {}, [], [piece.nodes[0, :3] + 0.0 for piece in pieces if piece.closed])
    _join_ends(joints, open_ends)
    _join_taps(joints, open_ends)
    _join_crossings(joints)
    return _assemble(pieces, _cut_runs(joints), share)


def _join_ends(joints: _Joints, open_ends: list[tuple[int, int]]) -> None:
    """Ends whose axes run into each other meet in one point."""
    pieces = joints.pieces
    for group in group_meeting_ends(pieces, open_ends):
        tips = [pieces[p].tip(e) for p, e in group]
        where = common_point([tip[:3] for tip in tips], [pieces[p].outward[e] for p, e in group])
        through = _pieces_through(pieces, where, {p for p, _ in group})
        # Two branches that face each other across a run do not make one: all meet in its middle.
        where = joints.snap(through[0][1] if through else where, min(float(tip[3]) for tip in tips))
        joints.cuts += [(q, where) for q, _ in through]
        joints.targets.update(dict.fromkeys(group, where))


def _pieces_through(pieces: list[Piece], where: Floats, own: set[int]) -> list[tuple[int, Floats]]:
    """Pieces, other than some, that run through a point, and the nearest point of each."""
    nearest = [(q, point_on_middle(piece, where)) for q, piece in enumerate(pieces) if q not in own]
    return [(q, point) for q, point in nearest if point is not None]


def _join_taps(joints: _Joints, open_ends: list[tuple[int, int]]) -> None:
    """Ends that run into the middle of another piece join it there."""
    for p, e in open_ends:
        tap = None if (p, e) in joints.targets else find_tap(joints.pieces, p, e)
        if tap is not None:
            joints.targets[p, e] = joints.snap(tap[1], float(joints.pieces[p].tip(e)[3]))
            joints.cuts.append((tap[0], joints.targets[p, e]))


def _join_crossings(joints: _Joints) -> None:
    """Pieces that run through each other join there."""
    for q, r, where in find_crossings(joints.pieces):
        point = joints.snap(where, min(float(joints.pieces[k].tip(0)[3]) for k in (q, r)))
        joints.cuts += [(q, point), (r, point)]


def _cut_runs(joints: _Joints) -> _Runs:
    runs = _Runs([], {}, [])
    for p, piece in enumerate(joints.pieces):
        nodes = piece.nodes[:, :6] + 0.0
        for e, row in ((0, 0), (1, -1)):
            if (p, e) in joints.targets:
                nodes = _retarget(nodes, row, joints.targets[p, e])
        cuts = list({where.tobytes(): where for q, where in joints.cuts if q == p}.values())
        parts = _split(nodes, cuts)
        if piece.closed:
            ends: tuple[int, ...] = ()
            joined = bool(cuts)
        else:
            ends, joined = tuple(e for e in (0, 1) if (p, e) not in joints.targets), True
        _add_runs(runs, p, parts, ends, joined)
    return runs


def _add_runs(runs: _Runs, p: int, parts: list[Floats], free: tuple[int, ...], joined: bool) -> None:
    """Adds the parts of one piece, of which some ends join nothing; a whole loop joins nothing at all."""
    for k, part in enumerate(parts):
        for e, row, outermost in ((0, 0, k == 0), (1, -1, k == len(parts) - 1)):
            if outermost and e in free:
                runs.free.append((p, e, len(runs.nodes)))
            elif joined:
                runs.at_joint.setdefault(part[row, :3].tobytes(), []).append(len(runs.nodes))
        runs.nodes.append(part)


def _retarget(nodes: Floats, row: int, target: Floats) -> Floats:
    """Lets a run end in a point: its nodes beyond that point go, and the point comes."""
    inner = nodes if row == 0 else nodes[::-1]
    heading = inner[0, :3] - inner[min(2, len(inner) - 1), :3]
    keep = (inner[:, :3] - target) @ heading < 0
    first = int(np.argmax(keep)) if keep.any() else len(inner) - 1
    tip = inner[first].copy()
    tip[:3] = target
    inner = np.concatenate([tip[None], inner[first:]])
    return inner if row == 0 else inner[::-1]


def _split(nodes: Floats, cuts: list[Floats]) -> list[Floats]:
    """Cuts a run at points on it."""
    if not cuts:
        return [nodes]
    steps = np.linalg.norm(np.diff(nodes[:, :3], axis=0), axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    places = []
    for where in cuts:
        offset = where - nodes[:-1, :3]
        u = np.clip((offset * np.diff(nodes[:, :3], axis=0)).sum(axis=1) / np.maximum(steps**2, 1e-300), 0, 1)
        gaps = np.linalg.norm(offset - u[:, None] * np.diff(nodes[:, :3], axis=0), axis=1)
        k = int(np.argmin(gaps))
        places.append((float(walked[k] + u[k] * steps[k]), k, tuple(where)))
    parts, begin = [], nodes[:1]
    at = 1
    for place_on, k, place in sorted(places):
        if place_on <= 0.0 or place_on >= walked[-1]:
            continue
        joint = nodes[k].copy()
        joint[:3] = place
        parts.append(np.concatenate([begin, nodes[at : k + 1], joint[None]]))
        begin, at = joint[None], max(at, k + 1)
    parts.append(np.concatenate([begin, nodes[at:]]))
    return parts


def _assemble(pieces: list[Piece], runs: _Runs, share: float) -> Centreline:
    """Joins runs that meet two and two into branches, and makes junctions of the rest."""
    nodes = list(runs.nodes)
    closed = [False] * len(nodes)
    for p, piece in enumerate(pieces):
        if piece.closed and len(pieces) == len(nodes):
            closed[p] = True
    final, meetings = _join_pairs(nodes, closed, runs.at_joint)
    kept = sorted(set(final))
    number = {run: k for k, run in enumerate(kept)}
    branches = tuple(_branch(nodes[k], closed[k]) for k in kept)
    ends = tuple(
        End(tip[:3].copy(), pieces[p].outward[e], float(tip[3]), float(tip[4]), number[final[run]])
        for p, e, run in runs.free
        for tip in [pieces[p].tip(e)]
    )
    junctions = tuple(
        Junction(point, tuple(sorted(number[final[run]] for run in members))) for point, members in meetings
    )
    return Centreline(branches, tuple(sorted(ends, key=lambda end: end.branch)), junctions, float(share))


def _join_pairs(
    nodes: list[Floats], closed: list[bool], at_joint: dict[bytes, list[int]]
) -> tuple[list[int], list[tuple[Floats, list[int]]]]:
    """Joins runs where just two meet.

    Args:
        nodes: of each run; those of the first of two that meet become those of both.
        closed: whether each run is a loop; set where one meets itself.
        at_joint: the runs at each joint.

    Returns:
        For each run the one that it became part of; and the joints of more than two with their runs.
    """
    final = list(range(len(nodes)))
    meetings: list[tuple[Floats, list[int]]] = []
    for key, members in at_joint.items():
        point = np.frombuffer(key)
        if len(members) > 2:
            meetings.append((point.copy(), members))
        if len(members) != 2:
            continue
        a, b = final[members[0]], final[members[1]]
        if a == b:
            closed[a] = True
            continue
        first = nodes[a] if np.array_equal(nodes[a][-1, :3], point) else nodes[a][::-1]
        second = nodes[b] if np.array_equal(nodes[b][0, :3], point) else nodes[b][::-1]
        nodes[a] = np.concatenate([first, second[1:]])
        final = [a if f == b else f for f in final]
    return final, meetings


def _branch(nodes: Floats, closed: bool) -> Branch:
    nodes = nodes[essential_nodes(np.ascontiguousarray(nodes[:, :5]), _STRAIGHT)]
    return Branch(nodes[:, :3].copy(), nodes[:, 3].copy(), nodes[:, 4].copy(), closed)
