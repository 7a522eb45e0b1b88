// Geometry of the ways along the pipes.

import type { Flow, Point } from "../types.ts";

/** A way as points, and how far along it each of them is [m]. */
export interface Way {
  points: Point[];
  along: number[];
  length: number;
}

const STRAIGHT = 0.0005; // m, a point nearer than this to the straight between its neighbours says nothing

/** The way of a connection's flat list of coordinates, without points that say nothing. */
export function wayOf(path: readonly number[]): Way {
  const all: Point[] = [];
  for (let i = 0; i + 2 < path.length; i += 3) all.push([path[i], path[i + 1], path[i + 2]]);
  const points: Point[] = [];
  for (const [i, point] of all.entries()) {
    const last = points[points.length - 1];
    const next = all[i + 1];
    if (last && next && (distance(last, point) < STRAIGHT || offLine(last, next, point) < STRAIGHT)) continue;
    if (last && !next && points.length > 1 && distance(last, point) < STRAIGHT) points.pop();
    points.push(point);
  }
  const along = [0];
  for (let i = 1; i < points.length; i++) along.push(along[i - 1] + distance(points[i - 1], points[i]));
  return { points, along: points.length ? along : [], length: along[along.length - 1] };
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

function offLine(a: Point, b: Point, point: Point): number {
  const ab: Point = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const squared = ab[0] ** 2 + ab[1] ** 2 + ab[2] ** 2;
  if (squared === 0) return distance(a, point);
  const ap: Point = [point[0] - a[0], point[1] - a[1], point[2] - a[2]];
  const t = (ap[0] * ab[0] + ap[1] * ab[1] + ap[2] * ab[2]) / squared;
  // A way that turns back on itself is no straight.
  if (t < 0 || t > 1) return Infinity;
  return Math.hypot(ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]);
}

/** Where one is after so many metres, and which way it goes on there. */
export function pointAt(way: Way, at: number): { point: Point; direction: Point } {
  const { points, along } = way;
  let i = 1;
  while (i < points.length - 1 && along[i] < at) i++;
  const a = points[i - 1];
  const b = points[i] ?? a;
  const length = along[i] - along[i - 1] || 1;
  const t = Math.min(1, Math.max(0, (at - along[i - 1]) / length));
  const direction: Point = [(b[0] - a[0]) / length, (b[1] - a[1]) / length, (b[2] - a[2]) / length];
  return { point: [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])], direction };
}

export interface Arrow {
  point: Point;
  /** The way of the flow, of length 1. */
  direction: Point;
  /** How much of the way it has to itself [m]: it is drawn where that is wide enough on the screen. */
  room: number;
}

/**
 * Arrows along a way: one in its middle, then one in the middle of each half, and so on down to `spacing`. From afar only
 * the first ones are drawn, so that they are never crowded and never move as one comes nearer.
 */
export function arrowsAlong(way: Way, flow: Flow, spacing: number): Arrow[] {
  if (flow === "unknown" || way.points.length < 2 || way.length === 0) return [];
  const arrows: Arrow[] = [];
  const sign = flow === "forward" ? 1 : -1;
  for (let pieces = 1, level = 0; level === 0 || way.length / pieces >= spacing; pieces *= 2, level++) {
    const step = way.length / pieces;
    for (let k = 0; k < pieces; k++) {
      const { point, direction } = pointAt(way, (k + 0.5) * step);
      // From the second level on the next arrow, of a level before, is half a step away.
      const room = level ? step / 2 : step;
      arrows.push({ point, direction: [sign * direction[0], sign * direction[1], sign * direction[2]], room });
    }
    if (level >= 6) break;
  }
  return arrows;
}

/** A way as pieces for drawing: `from` and `to` with the distance of both, running on from piece to piece. */
export function piecesOf(way: Way): { from: Point; to: Point; start: number; end: number }[] {
  const pieces = [];
  for (let i = 1; i < way.points.length; i++) {
    pieces.push({ from: way.points[i - 1], to: way.points[i], start: way.along[i - 1], end: way.along[i] });
  }
  return pieces;
}
