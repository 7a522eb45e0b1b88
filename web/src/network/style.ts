// How the connections are drawn: by what is known of their flow, or by line, system or size; what is marked stands out.

import type { Marks } from "../store.ts";
import { flowState } from "./flow.ts";
import type { Plan } from "./plan.ts";

export type LinesBy = "flow" | "line" | "system" | "size";
export type Rgb = [number, number, number];

export interface Palette {
  known: Rgb;
  unknown: Rgb;
  selected: Rgb;
  mark: Rgb;
  faint: Rgb;
  casing: Rgb;
  /** For what has no order: lines, systems. */
  several: Rgb[];
  /** From small to large. */
  ramp: [Rgb, Rgb];
}

/** One connection as it is drawn. */
export interface Stroke {
  color: Rgb;
  /** Of the coloured core [CSS px]. */
  width: number;
  dashed: boolean;
  arrows: boolean;
  shown: boolean;
  /** Marked or selected: drawn through the plant, too. */
  strong: boolean;
  /** Beside what is marked: no rim, and not through the plant. */
  dim: boolean;
}

export interface Looks {
  by: LinesBy;
  marks: Marks | null;
  selected: ReadonlySet<number>;
  hovered: ReadonlySet<number>;
  /** Whether the parts that a connection leads through are to be seen. */
  isShown: (row: number) => boolean;
}

export function strokesOf(plan: Plan, looks: Looks, palette: Palette): Stroke[] {
  const sizes = sizesOf(plan);
  return plan.content.network.connections.map((connection, row) => {
    const state = flowState(connection);
    const stroke: Stroke = {
      color: colorOf(plan, row, looks.by, palette, sizes), width: 3, dashed: state !== "known",
      arrows: state !== "unknown", shown: looks.isShown(row), strong: false, dim: false,
    };
    const marked = looks.marks?.connections.has(row) ?? false;
    if (looks.marks && !marked) Object.assign(stroke, { color: palette.faint, width: 1.5, arrows: false, dim: true });
    if (marked) Object.assign(stroke, { color: palette.mark, width: 4.5, shown: true, strong: true });
    if (looks.hovered.has(row)) stroke.width += 2;
    if (looks.selected.has(row)) Object.assign(stroke, { color: palette.selected, width: 5, shown: true, strong: true, dim: false });
    return stroke;
  });
}

/** The colour of a line, as that of its first connection, for lists beside the view. */
export function lineColor(plan: Plan, row: number, by: LinesBy, palette: Palette): string {
  const [first] = plan.content.network.lines[row].connections;
  const color = first === undefined ? palette.faint : colorOf(plan, first, by, palette, sizesOf(plan));
  return `rgb(${color.map((share) => Math.round(255 * share)).join(" ")})`;
}

function sizesOf(plan: Plan): number[] {
  return [...new Set(plan.content.network.connections.map((c) => c.size ?? 0))].sort((a, b) => a - b);
}

function colorOf(plan: Plan, row: number, by: LinesBy, palette: Palette, sizes: number[]): Rgb {
  const connection = plan.content.network.connections[row];
  if (by === "flow") return connection.flow === "unknown" ? palette.unknown : palette.known;
  if (by === "size") return mix(palette.ramp, sizes.indexOf(connection.size ?? 0) / Math.max(1, sizes.length - 1));
  const line = plan.content.network.lines[connection.line];
  const system = line?.system ?? plan.places.get(connection.source)?.system ?? -1;
  const which = by === "line" ? connection.line : system;
  return which < 0 ? palette.faint : palette.several[which % palette.several.length];
}

function mix([low, high]: [Rgb, Rgb], share: number): Rgb {
  return [0, 1, 2].map((k) => low[k] + share * (high[k] - low[k])) as Rgb;
}

/** "#rrggbb" as three shares of 1; black where it is none. */
export function rgbOf(text: string): Rgb {
  const digits = /^#([0-9a-f]{6})$/i.exec(text.trim())?.[1] ?? "000000";
  return [0, 2, 4].map((k) => parseInt(digits.slice(k, k + 2), 16) / 255) as Rgb;
}

/** The colours of the page's theme as they are now. */
export function readPalette(element: HTMLElement): Palette {
  const styles = getComputedStyle(element);
  const read = (name: string) => rgbOf(styles.getPropertyValue(name));
  return {
    known: read("--net-known"), unknown: read("--net-unknown"), selected: read("--net-selected"),
    mark: read("--net-mark"), faint: read("--net-faint"), casing: read("--net-casing"),
    several: [1, 2, 3, 4, 5, 6, 7, 8].map((k) => read(`--net-${k}`)), ramp: [read("--net-small"), read("--net-large")],
  };
}
