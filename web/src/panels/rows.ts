// The rows of the table: what a column holds, in which order, and which rows are listed.

import type { Section, Shown } from "../store.ts";
import type { Content } from "../types.ts";
import type { Cell } from "./csv.ts";
import { count, howSure, meshesOf } from "./words.ts";

export type Kind = "parts" | "units" | "lines";
export type Scope = "all" | "seen" | "selected";

export interface Column {
  key: string;
  title: string;
  /** Share of the width. */
  width: number;
  /** Numbers stand to the right. */
  number?: boolean;
  of: (row: number) => Cell;
}

const round = (value: number, digits: number) => Number(value.toFixed(digits));

export function columns(content: Content, kind: Kind): Column[] {
  return { parts: partColumns, units: unitColumns, lines: lineColumns }[kind](content);
}

function partColumns(content: Content): Column[] {
  const { parts, groups, network } = content;
  const repeats = new Map<number, number>();
  for (const shape of parts.shape) repeats.set(shape, (repeats.get(shape) ?? 0) + 1);
  const system = systemOf(content);
  return [
    { key: "name", title: "Label", width: 13, of: (row) => parts.name[row] ?? "" },
    { key: "group", title: "Group", width: 13, of: (row) => groups[parts.group[row]]?.name ?? "no label" },
    { key: "sure", title: "How sure", width: 10, of: (row) => howSure(parts.state[row]).split(",")[0] },
    {
      key: "confidence", title: "Conf. %", width: 7, number: true,
      of: (row) => (parts.confidence[row] === null ? null : round(100 * parts.confidence[row]!, 1))
    },
    { key: "source", title: "Said by", width: 9, of: (row) => parts.source[row] ?? "" },
    { key: "unit", title: "Unit", width: 9, of: (row) => network.units[parts.unit[row]]?.tag ?? "" },
    { key: "system", title: "System", width: 11, of: (row) => network.systems[system(row)]?.id ?? "" },
    { key: "length", title: "Length m", width: 8, number: true, of: (row) => round(parts.extents[3 * row], 4) },
    { key: "repeats", title: "Alike", width: 6, number: true, of: (row) => repeats.get(parts.shape[row]) ?? 1 },
    { key: "triangles", title: "Triangles", width: 8, number: true, of: (row) => parts.n_triangles[row] },
    { key: "id", title: "Part", width: 10, of: (row) => parts.id[row] },
    {
      key: "path", title: "Path in the file", width: 26,
      of: (row) => meshesOf(content, row).map((mesh) => content.meshes.path[mesh]).join(" ")
    },
  ];
}

function unitColumns(content: Content): Column[] {
  const { units, systems } = content.network;
  return [
    { key: "tag", title: "Tag", width: 12, of: (row) => units[row].tag },
    { key: "type", title: "Type", width: 10, of: (row) => units[row].type },
    { key: "kind", title: "Kind", width: 15, of: (row) => units[row].kind ?? "not known" },
    { key: "system", title: "System", width: 11, of: (row) => systems[units[row].system]?.id ?? "" },
    { key: "ports", title: "Ports", width: 7, number: true, of: (row) => units[row].ports.length },
    { key: "missing", title: "Missing lines", width: 10, number: true, of: (row) => units[row].missing },
    { key: "parts", title: "Parts", width: 7, number: true, of: (row) => units[row].parts.length },
    { key: "x", title: "x m", width: 8, number: true, of: (row) => round(units[row].point[0] + content.origin[0], 3) },
    { key: "y", title: "y m", width: 8, number: true, of: (row) => round(units[row].point[1] + content.origin[1], 3) },
    { key: "z", title: "z m", width: 8, number: true, of: (row) => round(units[row].point[2] + content.origin[2], 3) },
  ];
}

function lineColumns(content: Content): Column[] {
  const { lines, systems } = content.network;
  const name = namesOf(content);
  return [
    { key: "tag", title: "Line", width: 12, of: (row) => lines[row].tag },
    { key: "size", title: "DN", width: 8, of: (row) => lines[row].size },
    {
      key: "length", title: "Length m", width: 9, number: true,
      of: (row) => (lines[row].length === null ? null : round(lines[row].length!, 3))
    },
    { key: "start", title: "From", width: 13, of: (row) => name(lines[row].start) },
    { key: "end", title: "To", width: 13, of: (row) => name(lines[row].end) },
    { key: "flow", title: "Flow", width: 9, of: (row) => (lines[row].flow === "none" ? "not known" : lines[row].flow) },
    { key: "system", title: "System", width: 11, of: (row) => systems[lines[row].system]?.id ?? "" },
  ];
}

/** Tags and names of places by their id. */
export function namesOf(content: Content): (id: string) => string {
  const names = new Map<string, string>();
  for (const unit of content.network.units) names.set(unit.id, unit.tag);
  for (const end of content.network.ends) names.set(end.id, end.name);
  return (id) => names.get(id) ?? id;
}

/** Row of the system that a part is in: that of its unit, or of a line that runs through it. */
export function systemOf(content: Content): (row: number) => number {
  const { units, ends, connections, lines } = content.network;
  const system = new Map<number, number>();
  for (const line of lines) {
    for (const index of line.connections) for (const row of connections[index].via) system.set(row, line.system);
  }
  for (const node of [...ends, ...units]) if (node.system >= 0) for (const row of node.parts) system.set(row, node.system);
  return (row) => system.get(row) ?? -1;
}

/** All parts that a row of the table stands for. */
export function partsOf(content: Content, kind: Kind, row: number): number[] {
  if (kind === "parts") return [row];
  if (kind === "units") return content.network.units[row].parts;
  const { connections, lines } = content.network;
  return [...new Set(lines[row].connections.flatMap((index) => connections[index].via))];
}

/** Whether a part is drawn: neither hidden, nor left out by an isolation, nor cut away. */
export function isSeen(content: Content, shown: Shown): (row: number) => boolean {
  const cut = cutAway(content, shown.section);
  return (row) => !shown.hidden.has(row) && (!shown.isolated || shown.isolated.has(row)) && !cut(row);
}

/** A part is cut away where its whole box lies beyond the plane: above it, or below where it is flipped. */
function cutAway(content: Content, section: Section | null): (row: number) => boolean {
  if (!section) return () => false;
  const axis = "xyz".indexOf(section.axis);
  const { center, size } = content.parts;
  return (row) => {
    const middle = center[3 * row + axis];
    const half = size[3 * row + axis] / 2;
    return section.flipped ? middle + half < section.at : middle - half > section.at;
  };
}

export interface Wish {
  kind: Kind;
  scope: Scope;
  text: string;
  sort: string | null;
  descending: boolean;
}

/** The rows of a table that are listed, in their order. */
export function listed(content: Content, shown: Shown, wish: Wish, all = columns(content, wish.kind)): number[] {
  const n = { parts: content.parts.id, units: content.network.units, lines: content.network.lines }[wish.kind].length;
  const seen = isSeen(content, shown);
  const chosen = new Set(shown.selection);
  const words = wish.text.toLowerCase().split(/\s+/).filter(Boolean);
  let rows: number[] = [];
  for (let row = 0; row < n; row++) {
    if (wish.scope === "seen" && !partsOf(content, wish.kind, row).some(seen)) continue;
    if (wish.scope === "selected" && !partsOf(content, wish.kind, row).some((part) => chosen.has(part))) continue;
    if (words.length && !has(all, row, words)) continue;
    rows.push(row);
  }
  const by = all.find((column) => column.key === wish.sort);
  if (by) rows = sorted(rows, by, wish.descending);
  return rows;
}

function has(all: Column[], row: number, words: string[]): boolean {
  const text = all.map((column) => column.of(row) ?? "").join(" ").toLowerCase();
  return words.every((word) => text.includes(word));
}

const collator = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

/** What is empty stands last, either way. */
function sorted(rows: number[], by: Column, descending: boolean): number[] {
  const keys = new Map(rows.map((row) => [row, by.of(row)]));
  const sign = descending ? -1 : 1;
  const ranks = by.number ? null : ranksOf([...new Set(keys.values())] as (string | null)[]);
  const value = (row: number) => (ranks ? ranks.get(keys.get(row) as string)! : (keys.get(row) as number | null));
  return rows.sort((a, b) => {
    const [one, two] = [keys.get(a), keys.get(b)];
    const none = Number(one === null || one === "") - Number(two === null || two === "");
    return none || sign * ((value(a) ?? 0) - (value(b) ?? 0)) || a - b;
  });
}

/** Comparing words is slow; each different one is placed once. */
function ranksOf(values: (string | null)[]): Map<string | null, number> {
  return new Map(values.sort((a, b) => collator.compare(a ?? "", b ?? "")).map((value, i) => [value, i]));
}

export function countWords(kind: Kind, n: number): string {
  return count(n, { parts: "part", units: "unit", lines: "line" }[kind]);
}
