"""The primitives of a file as columns: kind, sizes, placement, owner."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from cadgraph.load.packing import Notes
from cadgraph.load.rvm.chunks import PARAMETERS, Chunks, Words
from cadgraph.model.scene import Floats, Ints

__all__ = ["FACETS", "Primitives", "read_primitives"]

FACETS = 11
LINE = 10
_LENGTHS = np.array([PARAMETERS.get(kind, 0) for kind in range(12)])
_BLOCK = 1 << 16  # primitives looked at together
_HEAD = 2 + 12 + 6  # words of a primitive before its numbers: version, kind, matrix, box
_UNIT = 1000.0  # matrices hold metres per millimetre
_BROKEN = "broken-primitive"
_SMALL = 1e-12


@dataclass(frozen=True)
class Primitives:
    """All primitives with a surface that will be loaded, in the order of the file.

    Args:
        chunk: ``(n,)`` number of the chunk of each.
        node: ``(n,)`` number of the node that owns it; -1: none.
        kind: ``(n,)`` as in the file.
        sizes: ``(n, 9)`` float32, its numbers [mm, rad]; NaN beyond the last.
        turn: ``(n, 3, 3)`` rotation for row vectors, without scale.
        shift: ``(n, 3)`` [m].
        stretch: ``(n,)`` row of ``stretches``.
        stretches: ``(m, 3, 3)`` symmetric, what is applied before the rotation; the first one is the identity.
        content: ``(n,)`` of facet groups: a number that those with the same bytes share; -1: no facet group.
        groups: ``(g, 2)`` of each such number: where its words begin and end.
    """

    chunk: Ints
    node: Ints
    kind: Ints
    sizes: npt.NDArray[np.float32]
    turn: Floats
    shift: Floats
    stretch: Ints
    stretches: Floats
    content: Ints
    groups: Ints

    def without(self, nodes: npt.NDArray[np.bool_]) -> Primitives:
        """Those that are not in one of these nodes; ``nodes``: ``(n_nodes,)``."""
        out = np.zeros(len(self.node), bool)
        inside = self.node >= 0
        out[inside] = nodes[self.node[inside]]
        columns = ("chunk", "node", "kind", "sizes", "turn", "shift", "stretch", "content")
        return replace(self, **{name: getattr(self, name)[~out] for name in columns}) if out.any() else self


def read_primitives(
    words: Words, chunks: Chunks, name_of: Callable[[int], str], notes: Notes, insulation: bool, skew: float
) -> Primitives:
    """Reads all primitives.

    Those that can't be placed or whose numbers make no sense are left out, each with a note.

    Args:
        words: of the file.
        chunks: of the file.
        name_of: the path of a node, for notes.
        notes: gets what was left out.
        insulation: also read insulation and obstruction volumes.
        skew: so far a placement may be from a rotation and still count as one that is written coarsely.
    """
    at, no_ints = chunks.of("PRIM"), np.zeros(0, np.int64)
    extra = np.concatenate([chunks.of("OBST"), chunks.of("INSU")])
    if len(extra) and insulation:
        at = np.concatenate([at, extra])
    elif len(extra):
        for name, kind in (("OBST", "obstruction"), ("INSU", "insulation")):
            if n := len(chunks.of(name)):
                notes.add("left-out-volume", f"left out: {n} {kind} volumes; --set load.insulation=true loads them")
    order = np.argsort(at, kind="stable")
    at = at[order]
    tilt = np.isin(at, extra).astype(np.int64)  # they have one word more
    parts = [
        _block(words, chunks, at[i : i + _BLOCK], tilt[i : i + _BLOCK], name_of, notes)
        for i in range(0, len(at), _BLOCK)
    ]
    kept, kinds = (np.concatenate([no_ints, *(part[i] for part in parts)]) for i in (0, 1))
    sizes = np.concatenate([np.zeros((0, 9), np.float32), *(part[2] for part in parts)])
    matrix = np.concatenate([np.zeros((0, 12), np.float32), *(part[3] for part in parts)])
    turn, stretch, stretches, good = _rigid(matrix[:, :9].reshape(-1, 3, 3), skew)
    for chunk in kept[~good].tolist():
        notes.add(_BROKEN, "left out: its placement makes nothing of it", name_of(int(chunks.node[chunk])))
    kept, kinds, sizes, stretch = kept[good], kinds[good], sizes[good], stretch[good]
    content, groups = _contents(words, chunks, kept, kinds, np.isin(kept, extra))
    return Primitives(
        chunk=kept,
        node=chunks.node[kept],
        kind=kinds,
        sizes=sizes,
        turn=turn[good],
        shift=matrix[good, 9:].astype(np.float64),
        stretch=stretch,
        stretches=stretches,
        content=content,
        groups=groups,
    )


def _block(
    words: Words, chunks: Chunks, at: Ints, tilt: Ints, name_of: Callable[[int], str], notes: Notes
) -> tuple[Ints, Ints, npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Numbers of the chunks that are sound, their kinds, sizes and matrices."""
    start, end = chunks.start[at], chunks.end[at]

    def leave_out(bad: npt.NDArray[np.bool_], code: str, why: str) -> None:
        for chunk in at[bad].tolist():
            notes.add(code, why, name_of(int(chunks.node[chunk])))

    room = end - start >= _HEAD + tilt + 1
    leave_out(~room, _BROKEN, "left out: the part of the file that holds it is too short")
    at, start, end, tilt = at[room], start[room], end[room], tilt[room]
    kind = words[start + 1].astype(np.int64)
    known = (kind >= 1) & (kind <= FACETS)
    leave_out(~known, _BROKEN, "left out: its kind is not one of the eleven that are known")
    room = end - start >= _HEAD + tilt + _LENGTHS[np.where(known, kind, 0)]
    leave_out(known & ~room, _BROKEN, "left out: the part of the file that holds it is too short")
    lines = known & room & (kind == LINE)
    if lines.any():
        notes.add("left-out-lines", f"left out: {int(lines.sum())} lines, which have no surface")
    good = known & room & ~lines
    at, start, end, tilt, kind = at[good], start[good], end[good], tilt[good], kind[good]
    matrix = _numbers(words, start + 2, 12)
    late = (tilt > 0) & ~_is_turn(matrix)
    if late.any():
        # Readers disagree on where the extra word stands: the one that leaves a rotation is right.
        matrix[late] = _numbers(words, start[late] + 3, 12)
    beyond = _LENGTHS[kind][:, None] <= np.arange(9)
    where = np.minimum((start + _HEAD + tilt)[:, None] + np.arange(9), len(words) - 1)
    sizes = words[where].view(">f4").astype(np.float32)
    sizes[beyond] = np.nan
    sizes[sizes == 0] = 0  # -0 becomes 0
    placed = np.asarray(np.isfinite(matrix).all(axis=1))
    leave_out(~placed, "invalid-transform", "left out: its placement is not finite")
    sized = (beyond | (np.abs(sizes) < 1e12)).all(axis=1)
    leave_out(placed & ~sized, _BROKEN, "left out: a size is not finite")
    good = placed & sized
    return at[good], kind[good], sizes[good], matrix[good]


def _numbers(words: Words, start: Ints, n: int) -> npt.NDArray[np.float32]:
    numbers: npt.NDArray[np.float32] = words[start[:, None] + np.arange(n)].view(">f4").astype(np.float32)
    return numbers


def _is_turn(matrix: npt.NDArray[np.float32]) -> npt.NDArray[np.bool_]:
    rows = matrix[:, :9].reshape(-1, 3, 3).astype(np.float64)
    with np.errstate(all="ignore"):
        square = np.einsum("nij,nkj->nik", rows, rows)
        size = np.trace(square, axis1=1, axis2=2)[:, None, None] / 3
        near: npt.NDArray[np.bool_] = (np.abs(square - size * np.eye(3)) < 0.05 * size).all(axis=(1, 2))
    return near


def _rigid(rows: npt.NDArray[np.float32], skew: float) -> tuple[Floats, Ints, Floats, npt.NDArray[np.bool_]]:
    """Rotations, and what is left of each matrix before its rotation; and which matrices have any volume."""
    turn = np.empty((len(rows), 3, 3))
    odd = np.zeros(len(rows), bool)
    for i in range(0, len(rows), _BLOCK):
        block = rows[i : i + _BLOCK].astype(np.float64) * _UNIT
        with np.errstate(over="ignore", invalid="ignore"):
            away = np.abs(block @ block.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
            odd[i : i + _BLOCK] = ~(away <= skew) | (np.linalg.det(block) <= 0)
            # Newton's way to the nearest rotation (Higham 1986); it starts near enough for its error to square.
            for _ in range(3):
                block = 1.5 * block - 0.5 * (block @ block.transpose(0, 2, 1) @ block)
        turn[i : i + _BLOCK] = block
    good = np.ones(len(rows), bool)
    stretch, stretches = np.zeros(len(rows), np.int64), np.eye(3)[None]
    if odd.any():
        own = np.flatnonzero(odd)
        left, size, right = np.linalg.svd(rows[own].astype(np.float64) * _UNIT)
        good[own] = size[:, 2] > _SMALL
        # row @ (left size left') @ (left right): first the stretch, then the rotation; a mirror goes with the stretch.
        mirror = np.where(np.linalg.det(left @ right) < 0, -1.0, 1.0)[:, None, None]
        turn[own] = left @ right * mirror
        pulls = np.round((left * size[:, None, :]) @ left.transpose(0, 2, 1) * mirror, 9) + 0.0
        different, which = np.unique(pulls.reshape(-1, 9), axis=0, return_inverse=True)
        stretches = np.concatenate([stretches, different.reshape(-1, 3, 3)])
        stretch[own] = 1 + which.reshape(-1)
    return turn, stretch, stretches, good


def _contents(words: Words, chunks: Chunks, at: Ints, kind: Ints, volume: npt.NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """A number for each different content of facet groups, and where the first with it stands."""
    content = np.full(len(at), -1, np.int64)
    groups: list[tuple[int, int]] = []
    seen: dict[bytes, int] = {}
    own = np.flatnonzero(kind == FACETS)
    starts, ends = (chunks.start[at[own]] + _HEAD + volume[own]).tolist(), chunks.end[at[own]].tolist()
    for i, start, end in zip(own.tolist(), starts, ends, strict=True):
        digest = hashlib.blake2b(words[start:end].tobytes(), digest_size=16).digest()
        number = seen.setdefault(digest, len(groups))
        if number == len(groups):
            groups.append((start, end))
        content[i] = number
    return content, np.array(groups, np.int64).reshape(-1, 2)
