// What each element of the schematic stands for, and how much of that is marked.

import type { Plan } from "./plan.ts";

export interface Attributes {
  getAttribute(name: string): string | null;
}

/** Rows of the connections that an element of the schematic stands for; a line's name stands for all of the line. */
export function connectionsOf(element: Attributes, plan: Plan): readonly number[] {
  const rows = element.getAttribute("data-connection");
  if (rows !== null) return rows.split(" ").map(Number);
  const tag = element.getAttribute("data-line");
  return tag === null ? [] : plan.content.network.lines.find((line) => line.tag === tag)?.connections ?? [];
}

/**
 * Whether all of an element is marked, or only some: a valve's far side that is live must never look shut off, so that what
 * the drawing can't show apart is marked as neither.
 */
export function markOf(rows: readonly number[], marked: ReadonlySet<number>): "all" | "partly" | "none" {
  const n = rows.filter((row) => marked.has(row)).length;
  return n === 0 ? "none" : n === rows.length ? "all" : "partly";
}
