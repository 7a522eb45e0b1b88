// Which colour a part has, and what the colours mean.

import type { ColorBy } from "../store.ts";
import type { Content } from "../types.ts";

export type Rgb = [number, number, number];

export interface LegendEntry {
  label: string;
  color: string;
  /** Drawn with stripes: nobody is sure. */
  hatched: boolean;
  parts: number[];
}

export interface Coloring {
  /** Row in `entries` of each part; -1: the colour of the source. */
  entryOf: Int32Array;
  entries: LegendEntry[];
  /** Parts drawn with stripes whatever their entry. */
  hatched: Uint8Array;
}

const NONE = "#c3cad3";
/** Cividis (Nuñez, Anderton and Renslow, 2018): a ramp that colour-blind eyes read, too. */
const RAMP = ["#00224e", "#35456c", "#666970", "#948e77", "#c8b866", "#fee838"];
const SOURCES: Record<string, [string, string]> = {
  embedded: ["Geometry", "#4477aa"], geometry: ["Geometry", "#4477aa"], lvlm: ["Vision-language model", "#aa3377"],
  author: ["Given with the scene", "#228833"], human: ["Corrected by a person", "#ee7733"],
  catalog: ["Catalogue", "#ccbb44"], file: ["The file's own data", "#66ccee"], graph: ["Neighbours", "#997700"],
  network: ["The pipes around it", "#997700"], repeat: ["Like a corrected part", "#f2b27a"],
};

/** The colours of all parts by one of their properties. */
export function colorParts(content: Content, by: ColorBy): Coloring {
  const { parts, groups, network } = content;
  const n = parts.id.length;
  // Nobody wonders what the ground is.
  const hatched = Uint8Array.from(parts.state, (state, row) => (state === "sure" || parts.ground[row] ? 0 : 1));
  if (by === "original") return { entryOf: new Int32Array(n).fill(-1), entries: [], hatched: new Uint8Array(n) };
  if (by === "confidence") return byConfidence(content, hatched);
  const systemOf = (row: number) => (parts.unit[row] >= 0 ? network.units[parts.unit[row]].system : -1);
  const viaSystem = by === "system" ? systemsOfParts(content) : null;
  const keyOf: Record<string, (row: number) => string | null> = {
    group: (row) => groups[parts.group[row]]?.name ?? null,
    name: (row) => parts.name[row],
    unit: (row) => network.units[parts.unit[row]]?.tag ?? null,
    system: (row) => network.systems[viaSystem![row] >= 0 ? viaSystem![row] : systemOf(row)]?.id ?? null,
    cluster: (row) => network.clusters[parts.cluster[row]]?.id ?? null,
    source: (row) => parts.source[row],
  };
  const found = new Map<string | null, number[]>();
  for (let row = 0; row < n; row++) {
    const key = keyOf[by](row);
    const members = found.get(key);
    if (members) members.push(row);
    else found.set(key, [row]);
  }
  const keys = [...found.keys()].sort((a, b) => (a === null ? 1 : b === null ? -1 : order(a, b, found)));
  const entries = keys.map((key, i): LegendEntry => ({
    label: key === null ? without(by) : by === "source" ? (SOURCES[key]?.[0] ?? key) : key,
    color: key === null ? NONE : colorOf(by, key, i, content),
    hatched: key === null,
    parts: found.get(key)!,
  }));
  const entryOf = new Int32Array(n);
  entries.forEach((entry, i) => entry.parts.forEach((row) => (entryOf[row] = i)));
  if (by !== "group" && by !== "name") hatched.fill(0);
  for (const entry of entries) if (entry.hatched) for (const row of entry.parts) hatched[row] = parts.ground[row] ? 0 : 1;
  return { entryOf, entries, hatched };
}

/** The entries of the legend alone. */
export function legend(content: Content, by: ColorBy): LegendEntry[] {
  return colorParts(content, by).entries;
}

function order(a: string, b: string, found: Map<string | null, number[]>): number {
  return found.get(b)!.length - found.get(a)!.length || (a < b ? -1 : 1);
}

function without(by: ColorBy): string {
  return { unit: "In no unit", system: "In no system", cluster: "In no structure" }[by as string] ?? "No label";
}

function colorOf(by: ColorBy, key: string, i: number, content: Content): string {
  if (by === "group") return content.groups.find((group) => group.name === key)?.color ?? NONE;
  if (by === "source") return SOURCES[key]?.[1] ?? distinct(i + 7);
  return distinct(i);
}

function byConfidence(content: Content, hatched: Uint8Array): Coloring {
  const { confidence, state } = content.parts;
  const bounds = [0.5, 0.7, 0.85, 0.95, 0.99];
  const entries: LegendEntry[] = RAMP.map((color, i) => ({
    label: i === 0 ? "below 50 %" : i === 5 ? "99 % and more" : `${Math.round(bounds[i - 1] * 100)} to ${Math.round(bounds[i] * 100)} %`,
    color, hatched: false, parts: [],
  }));
  entries.push({ label: "No label", color: NONE, hatched: true, parts: [] });
  const entryOf = Int32Array.from(confidence, (value, row) => {
    const i = value === null || state[row] === "open" ? 6 : bounds.filter((bound) => value >= bound).length;
    entries[i].parts.push(row);
    return i;
  });
  for (let row = 0; row < hatched.length; row++) hatched[row] = entryOf[row] === 6 && !content.parts.ground[row] ? 1 : 0;
  return { entryOf, entries, hatched };
}

/** The system that each part belongs to, along the connections and by its unit. */
function systemsOfParts(content: Content): Int32Array {
  const { parts, network } = content;
  const systemOf = new Int32Array(parts.id.length).fill(-1);
  for (const connection of network.connections) {
    const system = network.lines[connection.line]?.system ?? -1;
    for (const row of connection.via) systemOf[row] = system;
  }
  for (const unit of network.units) for (const row of unit.parts) systemOf[row] = unit.system;
  return systemOf;
}

/** Hues a golden angle apart at three lightnesses, so that any first few differ well. */
export function distinct(i: number): string {
  const hue = (210 + i * 137.508) % 360;
  const [saturation, lightness] = [[62, 52], [55, 66], [70, 40]][i % 3];
  return hex(fromHsl(hue, saturation / 100, lightness / 100));
}

function fromHsl(hue: number, s: number, l: number): Rgb {
  const channel = (n: number) => {
    const k = (n + hue / 30) % 12;
    return Math.round(255 * (l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  };
  return [channel(0), channel(8), channel(4)];
}

export function rgb(color: string): Rgb {
  const value = Number.parseInt(color.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

function hex([r, g, b]: Rgb): string {
  return `#${((1 << 24) | (r << 16) | (g << 8) | b).toString(16).slice(1)}`;
}
