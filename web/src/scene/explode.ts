// How the parts of a unit move apart: along its axes in the order in which they are put together, else outwards.

import { Vector3 } from "three";
import type { Content, Unit } from "../types.ts";

/** As shares of the unit's radius (half the diagonal of its box). */
const GAP = 0.25; // between parts that follow one another on an axis
const ON_AXIS = 0.12; // so near to an axis a part lies on it
const CORE = 0.06; // so near to the centre a part stays
const OUTWARDS = 0.75; // what lies on no axis moves at least this far
const MOST = 3; // nothing moves farther

const MOST_CENTERS = 40;

const FASTENER = /\b(bolt|stud|screw|nut|washer|u-bolt)s?\b/i;

interface Piece {
  row: number;
  /** From the unit's centre: at first the middle of its box, then of the part that the others stand around [m]. */
  at: Vector3;
  /** Half the sides of its axis-aligned box [m]. */
  half: Vector3;
  shape: number;
  /** The axis of a bolt or what sits on one. */
  axis: Vector3 | null;
}

/** Parts that move as one, as the bolts around a flange. */
interface Level {
  near: number;
  far: number;
  pieces: Piece[];
}

/**
 * The way of each part of a unit when it is drawn wholly apart [m]; parts that stay have none.
 *
 * Parts on an axis of the unit move along it so far that none covers the next; bolts go with them along their
 * own axis; what lies on no axis goes outwards from the centre.
 */
export function fullOffsets(content: Content, unit: Unit): Map<number, Vector3> {
  const pieces = piecesOf(content, unit);
  const radius = radiusOf(pieces);
  const offsets = new Map<number, Vector3>();
  if (pieces.length < 2 || !(radius > 0)) return offsets;
  const axes = axesOf(unit);
  const center = centerOf(pieces, axes, radius);
  for (const { at } of pieces) at.sub(center);
  const stacks = new Map<string, { way: Vector3; pieces: Piece[] }>();
  const core: Piece[] = [];
  for (const piece of pieces) {
    if (piece.at.length() < CORE * radius && !piece.axis) {
      core.push(piece);
      continue;
    }
    const way = wayOf(piece, axes, radius);
    if (way) {
      const key = way.toArray().map((value) => value.toFixed(3)).join();
      const stack = stacks.get(key);
      if (stack) stack.pieces.push(piece);
      else stacks.set(key, { way, pieces: [piece] });
    } else {
      const far = piece.at.length();
      offsets.set(piece.row, piece.at.clone().setLength(Math.max(far, OUTWARDS * radius)));
    }
  }
  for (const { way, pieces: members } of stacks.values()) stack(members, way, core, radius, offsets);
  return offsets;
}

/** The ways at a share of 0 (together) to 1 (wholly apart). */
export function offsetsAt(full: ReadonlyMap<number, Vector3>, share: number): Map<number, Vector3> {
  const offsets = new Map<number, Vector3>();
  if (share > 0) for (const [row, way] of full) offsets.set(row, way.clone().multiplyScalar(Math.min(1, share)));
  return offsets;
}

function piecesOf(content: Content, unit: Unit): Piece[] {
  const { parts } = content;
  const pieces = unit.parts.map((row): Piece => ({
    row, at: new Vector3().fromArray(parts.center, 3 * row), half: new Vector3().fromArray(parts.size, 3 * row).multiplyScalar(0.5),
    shape: parts.shape[row], axis: fastenerAxis(content, row),
  }));
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  for (const { at, half } of pieces) {
    low.min(at.clone().sub(half));
    high.max(at.clone().add(half));
  }
  const middle = low.add(high).multiplyScalar(0.5);
  for (const { at } of pieces) at.sub(middle);
  return pieces;
}

/** The point through which the axes pass: the middle of the part that most others stand in line with, as the body of a valve. */
function centerOf(pieces: Piece[], axes: Vector3[], radius: number): Vector3 {
  const solid = pieces.filter((piece) => !piece.axis);
  const bulk = ({ half }: Piece) => half.x * half.y * half.z;
  let best = new Vector3();
  let most = 0;
  for (const { at } of [...solid].sort((a, b) => bulk(b) - bulk(a) || a.row - b.row).slice(0, MOST_CENTERS)) {
    const inLine = solid.filter((piece) => {
      const way = piece.at.clone().sub(at);
      return axes.some((axis) => way.clone().addScaledVector(axis, -way.dot(axis)).length() < ON_AXIS * radius);
    });
    if (inLine.length <= most) continue;
    most = inLine.length;
    best = at.clone();
  }
  return best;
}

function radiusOf(pieces: Piece[]): number {
  const reach = new Vector3();
  for (const { at, half } of pieces) reach.max(new Vector3(Math.abs(at.x), Math.abs(at.y), Math.abs(at.z)).add(half));
  return reach.length();
}

/** Where a bolt points, as far as its box tells; null for other parts. */
function fastenerAxis(content: Content, row: number): Vector3 | null {
  const { name, size, extents } = content.parts;
  if (!FASTENER.test(name[row] ?? "")) return null;
  const sides = [0, 1, 2].map((k) => size[3 * row + k]);
  const [long, middle, short] = [0, 1, 2].map((k) => extents[3 * row + k]);
  // A rod is long in one direction, a washer or nut short in one.
  const target = long > 1.4 * middle ? long : short < 0.8 * middle ? short : null;
  if (target === null) return null;
  const k = sides.findIndex((side) => Math.abs(side - target) < 0.05 * target);
  return k < 0 ? null : new Vector3().setComponent(k, 1);
}

/** Three axes at right angles: the first port's direction, where it is askew to the world, else the world's. */
function axesOf(unit: Unit): Vector3[] {
  const direction = unit.ports.find((port) => port.direction)?.direction;
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  if (!direction) return axes;
  const main = new Vector3(...direction).normalize();
  if (!(main.lengthSq() > 0.5) || axes.some((axis) => Math.abs(axis.dot(main)) > 0.985)) return axes;
  const up = new Vector3(0, 0, 1).addScaledVector(main, -main.z).normalize();
  return [main, new Vector3().crossVectors(up, main), up];
}

/** Along which axis a part moves, out from the centre; null where it lies on none. */
function wayOf(piece: Piece, axes: Vector3[], radius: number): Vector3 | null {
  if (piece.axis) {
    const along = piece.at.dot(piece.axis);
    if (Math.abs(along) > CORE * radius) return piece.axis.clone().multiplyScalar(Math.sign(along));
    return null;
  }
  let best: Vector3 | null = null;
  let nearest = ON_AXIS * radius;
  for (const axis of axes) {
    const along = piece.at.dot(axis);
    const beside = piece.at.clone().addScaledVector(axis, -along).length();
    if (beside < nearest && Math.abs(along) > CORE * radius) {
      nearest = beside;
      best = axis.clone().multiplyScalar(Math.sign(along));
    }
  }
  return best;
}

/** Moves what lies on one side of an axis outwards, one after the other. */
function stack(pieces: Piece[], way: Vector3, core: Piece[], radius: number, offsets: Map<number, Vector3>): void {
  let end = Math.max(0, ...core.map((piece) => reach(piece, way)));
  let least = GAP * radius;
  for (const level of levelsOf(pieces, way, radius)) {
    // What follows on an axis is never behind what it is put on.
    const move = Math.min(MOST * radius, Math.max(least, end + GAP * radius - level.near));
    for (const piece of level.pieces) offsets.set(piece.row, way.clone().multiplyScalar(move));
    end = Math.max(end, level.far + move);
    least = move;
  }
}

function levelsOf(pieces: Piece[], way: Vector3, radius: number): Level[] {
  const levels: Level[] = [];
  for (const piece of [...pieces].sort((a, b) => a.at.dot(way) - b.at.dot(way) || a.row - b.row)) {
    const along = piece.at.dot(way);
    const half = reach(piece, way);
    const alike = levels.find((level) => level.pieces[0].shape === piece.shape
      && Math.abs(level.pieces[0].at.dot(way) - along) < 0.04 * radius);
    if (alike) {
      alike.pieces.push(piece);
      alike.near = Math.min(alike.near, along - half);
      alike.far = Math.max(alike.far, along + half);
    } else levels.push({ near: along - half, far: along + half, pieces: [piece] });
  }
  return levels;
}

/** Half the length of a part's box along a direction. */
function reach({ half }: Piece, way: Vector3): number {
  return Math.abs(half.x * way.x) + Math.abs(half.y * way.y) + Math.abs(half.z * way.z);
}
