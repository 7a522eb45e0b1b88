// From where to look at something so that nothing large stands before it.

import type { Point } from "../types.ts";

/** Boxes of all parts: centres and sides, three numbers each. */
export interface Boxes {
  center: ArrayLike<number>;
  size: ArrayLike<number>;
}

/** Directions from which plants are looked at: all around, from slightly to well above, and from below last. */
export const WAYS: Point[] = [0.5, 0.2, 0.9, -0.35].flatMap((up) =>
  Array.from({ length: 12 }, (_, k): Point => {
    const angle = (k / 12) * 2 * Math.PI;
    const flat = Math.sqrt(1 - up * up);
    return [flat * Math.cos(angle), flat * Math.sin(angle), up];
  }),
);

/**
 * The direction, from the target to the eye, with the least before the target; the one that is used now where it is as
 * good as any.
 *
 * `own`: rows that don't count; `reach`: how far the eye is away [m]; `hidden`: rows that are not drawn.
 */
export function clearWay(
  target: Point, reach: number, now: Point, boxes: Boxes, own: ReadonlySet<number>, isShown: (row: number) => boolean,
): Point {
  const near = rowsNear(target, reach, boxes, own, isShown);
  let best = now;
  let least = blocked(target, reach, now, boxes, near);
  if (least === 0) return now;
  for (const way of WAYS) {
    const turned = 1 - (way[0] * now[0] + way[1] * now[1] + way[2] * now[2]);
    // A view from the other side needs a reason: half a thing less before it.
    const cost = blocked(target, reach, way, boxes, near) + 0.2 * turned + (way[2] < 0 ? 0.3 : 0);
    if (cost < least) [best, least] = [way, cost];
  }
  return best;
}

function rowsNear(
  target: Point, reach: number, boxes: Boxes, own: ReadonlySet<number>, isShown: (row: number) => boolean,
): number[] {
  const found: number[] = [];
  for (let row = 0; row * 3 < boxes.center.length; row++) {
    let away = 0;
    for (let k = 0; k < 3; k++) {
      const gap = Math.abs(boxes.center[3 * row + k] - target[k]) - boxes.size[3 * row + k] / 2;
      away += Math.max(gap, 0) ** 2;
    }
    if (away <= reach * reach && !own.has(row) && isShown(row)) found.push(row);
  }
  return found;
}

/** How many boxes a line of sight goes through; those around the target itself count little. */
function blocked(target: Point, reach: number, way: Point, boxes: Boxes, rows: number[]): number {
  let sum = 0;
  for (const row of rows) {
    let from = 0;
    let to = reach;
    for (let k = 0; k < 3 && from <= to; k++) {
      const half = boxes.size[3 * row + k] / 2;
      const offset = boxes.center[3 * row + k] - target[k];
      if (Math.abs(way[k]) < 1e-9) {
        if (Math.abs(offset) > half) from = Infinity;
        continue;
      }
      const [a, b] = [(offset - half) / way[k], (offset + half) / way[k]];
      from = Math.max(from, Math.min(a, b));
      to = Math.min(to, Math.max(a, b));
    }
    if (from <= to) sum += from > 0 ? 1 : 0.25;
  }
  return sum;
}
