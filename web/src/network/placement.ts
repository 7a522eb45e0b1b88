// Labels on a picture: the most important ones first, none over another.

export interface Wish {
  key: string;
  /** Where its point appears [px]. */
  x: number;
  y: number;
  width: number;
  height: number;
  /** More important ones come first. */
  rank: number;
  /** Where it was last time; -1 where it was not shown. It stays there if it can. */
  slot: number;
  /** Stands on its point and nowhere else, like a warning sign. */
  fixed?: boolean;
}

export interface Placed {
  wish: Wish;
  /** Left upper corner [px]. */
  left: number;
  top: number;
  slot: number;
}

export interface Frame {
  width: number;
  height: number;
  /** Boxes that are taken: buttons and the like over the picture [left, top, right, bottom]. */
  taken: readonly (readonly [number, number, number, number])[];
}

const CELL = 64; // px, of the grid that finds neighbours
const GAP = 2; // px between labels
// Where a label may stand, seen from its point: beside it first, then farther off, where its leader shows whose it is.
const SLOTS = [14, 30, 52].flatMap((reach) =>
  [[0.8, -0.8], [-0.8, -0.8], [0.8, 0.8], [-0.8, 0.8], [0, -1], [1, 0], [-1, 0], [0, 1]].map(
    ([x, y]): [number, number] => [x * reach, y * reach],
  ),
);

/** Places at most `limit` labels; those that find no room are left out. */
export function placeLabels(wishes: readonly Wish[], frame: Frame, limit: number): Placed[] {
  const grid = new Map<number, [number, number, number, number][]>();
  for (const [left, top, right, bottom] of frame.taken) take(grid, [left, top, right, bottom]);
  const placed: Placed[] = [];
  const sorted = [...wishes].sort((a, b) => b.rank - a.rank || (a.key < b.key ? -1 : 1));
  for (const wish of sorted) {
    if (placed.length >= limit) break;
    const found = wish.fixed ? fixedPlace(wish, frame, grid) : freePlace(wish, frame, grid);
    if (!found) continue;
    take(grid, [found.left, found.top, found.left + wish.width, found.top + wish.height]);
    placed.push(found);
  }
  return placed;
}

type Grid = Map<number, [number, number, number, number][]>;

function fixedPlace(wish: Wish, frame: Frame, grid: Grid): Placed | null {
  const left = wish.x - wish.width / 2;
  const top = wish.y - wish.height / 2;
  return fits(left, top, wish, frame, grid) ? { wish, left, top, slot: 0 } : null;
}

function freePlace(wish: Wish, frame: Frame, grid: Grid): Placed | null {
  const first = wish.slot >= 0 && wish.slot < SLOTS.length ? wish.slot : 0;
  for (let i = -1; i < SLOTS.length; i++) {
    const slot = i < 0 ? first : i;
    if (i === first) continue;
    const [dx, dy] = SLOTS[slot];
    const left = wish.x + dx + (dx > 0 ? 0 : dx < 0 ? -wish.width : -wish.width / 2);
    const top = wish.y + dy + (dy > 0 ? 0 : dy < 0 ? -wish.height : -wish.height / 2);
    if (fits(left, top, wish, frame, grid)) return { wish, left, top, slot };
  }
  return null;
}

function fits(left: number, top: number, wish: Wish, frame: Frame, grid: Grid): boolean {
  const right = left + wish.width;
  const bottom = top + wish.height;
  if (left < 2 || top < 2 || right > frame.width - 2 || bottom > frame.height - 2) return false;
  let free = true;
  eachCell(left, top, right, bottom, (cell) => {
    for (const other of grid.get(cell) ?? []) {
      if (left < other[2] + GAP && other[0] < right + GAP && top < other[3] + GAP && other[1] < bottom + GAP) free = false;
    }
  });
  return free;
}

function take(grid: Grid, box: [number, number, number, number]): void {
  eachCell(box[0], box[1], box[2], box[3], (cell) => {
    const boxes = grid.get(cell);
    if (boxes) boxes.push(box);
    else grid.set(cell, [box]);
  });
}

function eachCell(left: number, top: number, right: number, bottom: number, visit: (cell: number) => void): void {
  // One gap wider, so that neighbours across a border of cells are seen, too.
  for (let i = Math.floor((left - GAP) / CELL); i <= (right + GAP) / CELL; i++) {
    for (let j = Math.floor((top - GAP) / CELL); j <= (bottom + GAP) / CELL; j++) visit(i * 4096 + j);
  }
}

/** The point of a label's edge that its leader ends at. */
export function leaderEnd(placed: Placed): { x: number; y: number } {
  const { wish, left, top } = placed;
  return {
    x: Math.min(Math.max(wish.x, left), left + wish.width),
    y: Math.min(Math.max(wish.y, top), top + wish.height),
  };
}
