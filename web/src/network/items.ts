// What may have a label in the picture, and how much each of them matters.

import type { Marks, Shown } from "../store.ts";
import type { Point } from "../types.ts";
import { lineSizeText } from "./flow.ts";
import type { Focus } from "./focus.ts";
import { distance, pointAt, wayOf } from "./path.ts";
import type { Place, Plan } from "./plan.ts";
import type { NetworkWarning } from "./warnings.ts";

export interface Item {
  key: string;
  kind: "place" | "line" | "warning";
  /** Id of the place, row of the line, key of the warning. */
  id: string;
  text: string;
  title: string;
  /** Of the group that its unit belongs to. */
  color: string | null;
  point: Point;
  /** About how large the thing is [m]; labels of what appears tiny are left out. */
  reach: number;
  /** The thing's own parts reach so far from its point [m]: what stands nearer doesn't hide it. */
  body: number;
  base: number;
}

const RANKS: Record<string, number> = { pump: 60, tank: 60, equipment: 55, valve: 45, gauge: 25 };

export function itemsOf(plan: Plan, warnings: readonly NetworkWarning[]): Item[] {
  const items: Item[] = [];
  for (const place of plan.places.values()) if (place.type !== "junction") items.push(placeItem(plan, place));
  plan.content.network.lines.forEach((line, row) => {
    const item = lineItem(plan, row);
    if (item) items.push({ ...item, text: `${clipped(line.tag)}  ${lineSizeText(line.size)}` });
  });
  for (const warning of warnings) {
    items.push({
      key: `warning ${warning.key}`, kind: "warning", id: warning.key, text: warning.kind === "open" ? "" : "!",
      title: warning.title, color: null, point: warning.point, reach: warning.kind === "open" ? 0.3 : 3,
      body: bodyOf(plan, warning), base: warning.kind === "open" ? 35 : 70,
    });
  }
  return items;
}

const LONGEST = 32; // characters of a tag

/** A name in one line that leaves room for others. */
function clipped(name: string): string {
  const text = name.replace(/\s+/g, " ").trim();
  return text.length <= LONGEST ? text : `${text.slice(0, LONGEST - 1)}…`;
}

function placeItem(plan: Plan, place: Place): Item {
  const { size } = place;
  const diagonal = size ? Math.hypot(...size) : 0.1;
  const group = plan.content.groups.find((candidate) => candidate.unit === place.type);
  return {
    key: `place ${place.id}`, kind: "place", id: place.id, text: clipped(place.name), title: `${place.name}: ${place.what}`,
    color: group?.color ?? null, point: place.point, reach: diagonal, body: 0.5 * diagonal,
    base: place.unit ? RANKS[place.type] ?? 50 : 5,
  };
}

function lineItem(plan: Plan, row: number): Item | null {
  const line = plan.content.network.lines[row];
  const ways = line.connections.map((connection) => wayOf(plan.content.network.connections[connection].path));
  const longest = ways.reduce((a, b) => (b.length > a.length ? b : a), { points: [], along: [], length: 0 });
  if (longest.points.length < 2) return null;
  // In the middle of its longest straight piece.
  let best = 1;
  for (let i = 1; i < longest.points.length; i++) {
    if (stretch(longest.points, i) > stretch(longest.points, best)) best = i;
  }
  const { point } = pointAt(longest, (longest.along[best - 1] + longest.along[best]) / 2);
  return {
    key: `line ${line.tag}`, kind: "line", id: String(row), text: line.tag, title: `Line ${line.tag}`, color: null, point,
    // Shown from about 140 px on: below that a line's tag only crowds out those of units.
    reach: longest.length / 20, body: 0.2, base: 15,
  };
}

function stretch(points: Point[], i: number): number {
  return distance(points[i - 1], points[i]);
}

function bodyOf(plan: Plan, warning: NetworkWarning): number {
  const size = warning.place === null ? null : plan.places.get(warning.place)?.size;
  return size ? 0.5 * Math.hypot(...size) : 0.15;
}

/** What changes the rank of an item now. */
export interface Attention {
  shown: Shown;
  focus: Focus;
  place: string | null;
  hoveredPlace: string | null;
  marks: Marks | null;
}

/** The rank of an item; below 0 it has no label. Special ones (500 and more) have one however small they appear. */
export function rankOf(item: Item, plan: Plan, attention: Attention): number {
  const { focus, marks } = attention;
  if (item.kind === "warning") return warningRank(item, plan, attention);
  if (item.kind === "line") {
    const row = Number(item.id);
    if (focus.selectedLine === row) return 850;
    if (focus.hovered === row) return 800;
    if (!attention.shown.tags || marks) return -1;
    return plan.content.network.lines[row].connections.some(focus.isConnectionShown) ? item.base : -1;
  }
  const place = plan.places.get(item.id)!;
  // A tag in the air, of something hidden or cut away, is only in the way, whoever looks at it.
  if (!marks && !focus.isPlaceShown(place)) return -1;
  if (attention.place === item.id) return 1000;
  if (attention.hoveredPlace === item.id) return 900;
  if (marks?.close.has(item.id)) return 700;
  if (marks?.places.has(item.id)) return place.unit ? 600 : 500;
  if (!attention.shown.tags || marks || !place.unit || !focus.isPlaceShown(place)) return -1;
  return item.base;
}

function warningRank(item: Item, plan: Plan, { focus, marks, shown }: Attention): number {
  if (focus.warning === item.id) return 2000;
  if (!focus.warnings || !shown.network || marks) return -1;
  const place = plan.places.get(item.id.slice(item.id.indexOf(":") + 1));
  return place && !focus.isPlaceShown(place) ? -1 : item.base;
}
