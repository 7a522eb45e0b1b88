// The network of a content, looked up by id, by name and by part.

import type { Connection, Content, End, Line, Point, Unit } from "../types.ts";

/** A unit, a junction or an end of a pipe. */
export interface Place {
  id: string;
  /** Its tag, or the name of an end. */
  name: string;
  /** Type of a unit (valve, pump...), else "junction", "open", "blind" or "unknown". */
  type: string;
  /** What it is in words: "gate valve", "open end". */
  what: string;
  point: Point;
  /** Sides of the box of a unit; null for a point of the pipes. */
  size: Point | null;
  parts: readonly number[];
  system: number;
  unit: Unit | null;
  /** Rows of the connections that begin or end here. */
  connections: number[];
}

export interface Plan {
  content: Content;
  places: Map<string, Place>;
  /** Ids by tag; only tags that one place alone has. */
  named: Map<string, string>;
  /** Id of the place that a part belongs to. */
  placeOfPart: Map<number, string>;
  /** Rows of the connections that lead through a part. */
  connectionsOfPart: Map<number, number[]>;
}

const END_WORDS: Record<End["kind"], string> = {
  junction: "junction", open: "open end", blind: "closed end", unknown: "end of a pipe",
};

export function planOf(content: Content): Plan {
  const plan: Plan = {
    content, places: new Map(), named: new Map(), placeOfPart: new Map(), connectionsOfPart: new Map(),
  };
  for (const unit of content.network.units) addPlace(plan, placeOfUnit(unit));
  for (const end of content.network.ends) addPlace(plan, placeOfEnd(end));
  content.network.connections.forEach((connection, row) => {
    for (const id of new Set([connection.source, connection.target])) plan.places.get(id)?.connections.push(row);
    for (const part of connection.via) push(plan.connectionsOfPart, part, row);
  });
  return plan;
}

function placeOfUnit(unit: Unit): Place {
  return {
    id: unit.id, name: unit.tag, type: unit.type, what: unit.kind ?? unit.type, point: unit.point, size: unit.size,
    parts: unit.parts, system: unit.system, unit, connections: [],
  };
}

function placeOfEnd(end: End): Place {
  return {
    id: end.id, name: end.name, type: end.kind, what: END_WORDS[end.kind], point: end.point, size: null,
    parts: end.parts, system: end.system, unit: null, connections: [],
  };
}

function addPlace(plan: Plan, place: Place): void {
  plan.places.set(place.id, place);
  if (plan.named.has(place.name)) plan.named.set(place.name, "");
  else plan.named.set(place.name, place.id);
  // A part of a unit that is a junction, too, is the unit's: units are added first.
  for (const part of place.parts) if (!plan.placeOfPart.has(part)) plan.placeOfPart.set(part, place.id);
}

function push<K>(map: Map<K, number[]>, key: K, row: number): void {
  const rows = map.get(key);
  if (rows) rows.push(row);
  else map.set(key, [row]);
}

/** The parts of a line: what its connections lead through, and the units that stand in it. */
export function partsOfLine(plan: Plan, line: Line): number[] {
  const parts = new Set<number>();
  for (const row of line.connections) {
    const connection = plan.content.network.connections[row];
    for (const part of connection.via) parts.add(part);
    for (const id of [connection.source, connection.target]) {
      if (id !== line.start && id !== line.end) plan.places.get(id)?.parts.forEach((part) => parts.add(part));
    }
  }
  return [...parts];
}

/** All parts of some places and connections. */
export function partsOf(plan: Plan, places: Iterable<string>, connections: Iterable<number>): Set<number> {
  const parts = new Set<number>();
  for (const id of places) plan.places.get(id)?.parts.forEach((part) => parts.add(part));
  for (const row of connections) plan.content.network.connections[row]?.via.forEach((part) => parts.add(part));
  return parts;
}

/** The name of the other side of a connection. */
export function otherSide(connection: Connection, id: string): { id: string; name: string } {
  return connection.source === id
    ? { id: connection.target, name: connection.target_name }
    : { id: connection.source, name: connection.source_name };
}

/** The connections of a line with whether each is walked from its source to its target, from the line's start on. */
export function walk(plan: Plan, line: Line): { row: number; along: boolean }[] {
  let at = line.start;
  return line.connections.map((row) => {
    const connection = plan.content.network.connections[row];
    const along = connection.source === at;
    at = along ? connection.target : connection.source;
    return { row, along };
  });
}
