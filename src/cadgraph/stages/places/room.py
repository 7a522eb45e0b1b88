"""Where on a level a person can stand: nothing in the way from ankle to head, within the reach of the shoulders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_dilation, label

from cadgraph.geometry.occupancy import occupied
from cadgraph.model.derived import store_of
from cadgraph.model.grid import Grid
from cadgraph.model.parts import Bools, Parts
from cadgraph.model.scene import Floats, Ints

__all__ = ["Room", "ground_room", "level_room", "nearest_square"]

_STEP = 0.1  # m; side of a square
_MOST = 4_000_000  # squares of a floor; beyond it the squares are made larger
_ANKLE, _HEAD = 0.1, 1.8  # m over the floor; what lies between is in the way
_HALF_WIDTH = 0.2  # m; half of 0.4 m: the shoulders of a person who passes sideways (EN 547-1 has 0.5 m for walking)
_MARGIN = 1.0  # m of ground round everything that stands on it
_BAND = 0.06  # m below its surface in which a floor's own material lies
_AROUND = np.ones((3, 3), np.int64)  # squares that share a corner hang together


@dataclass(frozen=True, eq=False)
class Room:
    """The squares of a level.

    Args:
        grid: in plan.
        height: of the floor [m].
        clear: ``(rows, columns)`` floor on which nothing stands.
        open: those of them on which a person can stand.
        piece: the number of the connected piece that each open square is of, from 1; 0 elsewhere.
        n_pieces: how many there are.
    """

    grid: Grid
    height: float
    clear: Bools
    open: Bools
    piece: Ints
    n_pieces: int

    @property
    def area(self) -> float:
        """Of the floor on which nothing stands [m2]."""
        return float(self.clear.sum()) * self.grid.step**2

    def largest(self) -> Bools:
        """The squares of the largest piece."""
        if not self.n_pieces:
            return self.open
        sizes = np.bincount(self.piece.ravel(), minlength=self.n_pieces + 1)
        sizes[0] = 0
        return self.of_piece(int(np.argmax(sizes)))

    def of_piece(self, number: int) -> Bools:
        """The squares of a piece."""
        found: Bools = self.piece == number
        return found


def ground_room(parts: Parts, height: float, low: Floats, high: Floats) -> Room:
    """The ground round and between everything that stands on it.

    Args:
        parts: of the scene.
        height: of the ground [m].
        low: least corner of what stands on it [m].
        high: the greatest one.
    """
    kept = store_of(parts, "room on the ground", height)
    if 0 not in kept:
        grid = Grid.over(low - _MARGIN, high + _MARGIN, _STEP, _MOST)
        kept[0] = _room(parts, grid, height, np.ones(grid.size[::-1], np.bool_))
    room: Room = kept[0]
    return room


def level_room(parts: Parts, height: float, members: tuple[int, ...]) -> Room:
    """The room on a level.

    Args:
        parts: of the scene.
        height: of its floor [m].
        members: the parts that it is made of.
    """
    kept = store_of(parts, "room on a level")
    key = height, members
    if key not in kept:
        kept[key] = _level_room(parts, height, members)
    room: Room = kept[key]
    return room


def _level_room(parts: Parts, height: float, members: tuple[int, ...]) -> Room:
    boxes = parts.properties.aabb[list(members)]
    grid = Grid.over(boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0), _STEP, _MOST)
    surface = occupied(parts.scene, np.array(members, np.int64), height - _BAND, height + 1e-3, grid)
    # A square that the floor only just comes under is none to stand on: its middle must lie over some part's box.
    xs, ys = grid.centers()
    over = np.zeros_like(surface)
    for low, high in boxes[:, :, :2]:
        over[np.ix_((ys >= low[1]) & (ys <= high[1]), (xs >= low[0]) & (xs <= high[0]))] = True
    return _room(parts, grid, height, surface & over)


def _room(parts: Parts, grid: Grid, height: float, surface: Bools) -> Room:
    boxes = parts.properties.aabb
    low = np.array(grid.origin) - _HALF_WIDTH
    high = low + np.array(grid.size) * grid.step + 2 * _HALF_WIDTH
    near = ((boxes[:, 0, :2] <= high) & (boxes[:, 1, :2] >= low)).all(axis=1)
    near &= (boxes[:, 0, 2] <= height + _HEAD) & (boxes[:, 1, 2] >= height + _ANKLE) & ~parts.ground
    # What stands just beside the floor is in the way too.
    rim = int(np.ceil(_HALF_WIDTH / grid.step))
    wider = Grid(
        (grid.origin[0] - rim * grid.step, grid.origin[1] - rim * grid.step),
        grid.step,
        (grid.size[0] + 2 * rim, grid.size[1] + 2 * rim),
    )
    blocked = occupied(parts.scene, np.flatnonzero(near), height + _ANKLE, height + _HEAD, wider)
    spread = binary_dilation(blocked, _disc(_HALF_WIDTH / grid.step))
    inner = (slice(rim, rim + grid.size[1]), slice(rim, rim + grid.size[0]))
    free: Bools = surface & ~spread[inner]
    piece, n_pieces = label(free, _AROUND)
    return Room(grid, height, surface & ~blocked[inner], free, piece.astype(np.int64), int(n_pieces))


def _disc(radius: float) -> Bools:
    """The squares round one whose middles are within a radius [squares]."""
    reach = int(radius + 1e-9)
    x, y = np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1))
    disc: Bools = x * x + y * y <= radius * radius + 1e-9
    return disc


def nearest_square(room: Room, allowed: Bools, low: Floats, high: Floats, most: float) -> tuple[int, int] | None:
    """The row and column of the allowed square that is nearest to a box in plan.

    Args:
        room: of the level.
        allowed: ``(rows, columns)`` the squares that count.
        low: ``(2,)`` least corner of the box [m].
        high: ``(2,)`` the greatest one.
        most: its middle may be this far away [m].

    Returns:
        None where none is near enough; of several the one with the least row, then column.
    """
    grid = room.grid
    first = np.maximum(grid.square_of(low - most)[0], 0)
    last = np.minimum(grid.square_of(high + most)[0], np.array(grid.size) - 1)
    if (last < first).any():
        return None
    rows, columns = slice(first[1], last[1] + 1), slice(first[0], last[0] + 1)
    xs, ys = grid.centers()
    dx = np.maximum(np.maximum(low[0] - xs[columns], xs[columns] - high[0]), 0.0)
    dy = np.maximum(np.maximum(low[1] - ys[rows], ys[rows] - high[1]), 0.0)
    # Rounded, so that rounding noise does not choose between squares that are equally near.
    away = np.round(np.hypot(dx[None, :], dy[:, None]), 6)
    away[~allowed[rows, columns] | (away > most)] = np.inf
    best = int(np.argmin(away))
    if not np.isfinite(away.flat[best]):
        return None
    row, column = divmod(best, away.shape[1])
    return int(first[1]) + row, int(first[0]) + column
