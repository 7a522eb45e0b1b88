// What of one content is the same thing in the next one. Ids and rows are no help: after a correction they may be another's.

import type { Connection, Content, End, Line, Point, Unit } from "./types.ts";

/** Ends of pipes don't move by corrections: what is farther away [m] is another one. */
const SAME_POINT = 0.01;

/** Leads from a row of parts to the row of the same part in another content; -1 where there is none. */
export function rowsFrom(before: Content, now: Content): (row: number) => number {
  if (before.meshes === now.meshes) return (row) => row;
  const found = new Map(now.meshes.path.map((path, mesh) => [path, now.meshes.part[mesh]]));
  const next = new Map<number, number>();
  before.meshes.part.forEach((row, mesh) => {
    const other = found.get(before.meshes.path[mesh]) ?? -1;
    if (row >= 0 && other >= 0 && !next.has(row)) next.set(row, other);
  });
  return (row) => next.get(row) ?? -1;
}

/** The unit, junction or end that was called so before; null where it is gone. */
export function placeAgain(before: Content, id: string, now: Content): Unit | End | null {
  const rows = rowsFrom(before, now);
  const unit = before.network.units.find((unit) => unit.id === id);
  if (unit) return unitAgain(unit, rows, now.network.units);
  const end = before.network.ends.find((end) => end.id === id);
  return end ? endAgain(end, rows, now.network.ends) : null;
}

/** The unit of the same parts; where it has others now, the one that most of them are in. */
function unitAgain(former: Unit, rows: (row: number) => number, units: readonly Unit[]): Unit | null {
  const parts = new Set(former.parts.map(rows));
  const shared = (unit: Unit) => unit.parts.filter((row) => parts.has(row)).length;
  const rank = (unit: Unit) => {
    const n = shared(unit);
    const equal = n === parts.size && n === unit.parts.length;
    return n === 0 ? -1 : 4 * n + (equal ? 2 : 0) + (unit.id === former.id ? 1 : 0);
  };
  const best = units.reduce<Unit | null>((a, b) => (rank(b) > (a ? rank(a) : 0) ? b : a), null);
  return best && 2 * shared(best) >= parts.size ? best : null;
}

/** The end in the same place, of the same parts before others: two ends of one pipe have the same parts. */
function endAgain(former: End, rows: (row: number) => number, ends: readonly End[]): End | null {
  const parts = sorted(former.parts.map(rows));
  const same = ends.filter((end) => (end.kind === "junction") === (former.kind === "junction"));
  const equal = parts ? same.filter((end) => sorted(end.parts) === parts) : [];
  // The middle of a junction may move with what leads there.
  if (former.kind === "junction" && equal.length === 1) return equal[0];
  for (const candidates of [equal, same]) {
    const near = nearest(candidates, former.point);
    if (near && apart(near.point, former.point) <= SAME_POINT) return near;
  }
  return null;
}

function nearest(ends: readonly End[], point: Point): End | null {
  return ends.reduce<End | null>((a, b) => (a && apart(a.point, point) <= apart(b.point, point) ? a : b), null);
}

const apart = (a: Point, b: Point) => Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
const sorted = (rows: readonly number[]) => [...rows].sort((a, b) => a - b).join(",");

/** Row of the line that was at this row before: of the same connections, else of most of the same pipes; -1 where it is gone. */
export function lineAgain(before: Content, row: number, now: Content): number {
  const former = before.network.lines[row];
  if (!former) return -1;
  const rows = rowsFrom(before, now);
  const key = keyOf(before, former, placesOf(before), rows);
  const places = placesOf(now);
  const equal = now.network.lines.findIndex(
    (line) => line.connections.length === former.connections.length && keyOf(now, line, places) === key
  );
  if (equal >= 0) return equal;
  const pipes = pipesOf(before, former, rows);
  return now.network.lines.findIndex((line) => {
    const own = pipesOf(now, line);
    const shared = [...own].filter((part) => pipes.has(part)).length;
    // More than half of both together: no second line can have that.
    return 2 * shared > own.size + pipes.size - shared;
  });
}

const itself = (row: number) => row;

function pipesOf(content: Content, line: Line, rows = itself): Set<number> {
  return new Set(line.connections.flatMap((row) => content.network.connections[row].via.map(rows)));
}

type Places = Map<string, Unit | End>;

function placesOf({ network: { units, ends } }: Content): Places {
  return new Map([...ends, ...units].map((place) => [place.id, place]));
}

function keyOf(content: Content, line: Line, places: Places, rows = itself): string {
  return line.connections.map((row) => keyOfConnection(content.network.connections[row], places, rows)).sort().join(" ");
}

/** A connection either way round: the parts that it leads through, and what it ends at. */
function keyOfConnection(connection: Connection, places: Places, rows: (row: number) => number): string {
  const ends = [connection.source, connection.target].map((id) => keyOfPlace(id, places, rows)).sort();
  return `${sorted(connection.via.map(rows))}|${ends.join("|")}`;
}

function keyOfPlace(id: string, places: Places, rows: (row: number) => number): string {
  const place = places.get(id);
  if (!place) return id;
  return place.parts.length ? sorted(place.parts.map(rows)) : place.point.map((at) => Math.round(at / SAME_POINT)).join(",");
}
