// Finding parts, units and lines by what a person types.

import type { Content } from "../types.ts";
import { meshesOf } from "./words.ts";

export type Found =
  | { kind: "unit"; index: number }
  | { kind: "line"; index: number }
  | { kind: "part"; index: number };

export interface Results {
  units: number[];
  lines: number[];
  parts: number[];
  /** How many there are, where only the best are listed. */
  totals: { units: number; lines: number; parts: number };
}

interface Wanted {
  words: string[];
  bores: number[];
  lengths: { low: number; high: number }[];
}

/** What is searched by: words, nominal sizes ("DN80", "dn 80"), lengths ("0.5 m", "120mm"). */
export function understand(query: string): Wanted {
  const wanted: Wanted = { words: [], bores: [], lengths: [] };
  const rest = query
    .toLowerCase()
    .replace(/\bdn\s*(\d+)\b/g, (_all, size: string) => {
      wanted.bores.push(Number(size));
      return " ";
    })
    .replace(/(^|\s)(\d+(?:[.,]\d+)?)\s*(mm|cm|m)(?=\s|$)/g, (_all, lead: string, told: string, unit: string) => {
      const value = Number(told.replace(",", ".")) * { mm: 0.001, cm: 0.01, m: 1 }[unit as "mm" | "cm" | "m"];
      const slack = Math.max(0.02 * value, 0.0006);
      wanted.lengths.push({ low: value - slack, high: value + slack });
      return lead;
    });
  wanted.words = rest.split(/\s+/).filter(Boolean);
  return wanted;
}

/** Texts of all parts, made once per content; paths once per plant, as only they are long. */
export class Index {
  private readonly content: Content;
  private readonly names: string[] = [];
  private readonly paths: string[];
  private readonly bores: Map<number, number[]> = new Map();
  /** Nominal sizes of the lines at each unit, by its id. */
  private readonly sizes: Map<string, Set<number>> = new Map();

  constructor(content: Content) {
    this.content = content;
    this.paths = pathsOf(content);
    const { parts, groups, network } = content;
    const texts = new Map<string, string>();
    for (let row = 0; row < parts.id.length; row++) {
      const key = `${parts.group[row]}|${parts.name[row] ?? ""}|${parts.unit[row]}`;
      let text = texts.get(key);
      if (text === undefined) {
        text = [parts.name[row], groups[parts.group[row]]?.name ?? "no label", network.units[parts.unit[row]]?.tag]
          .filter(Boolean).join(" ").toLowerCase();
        texts.set(key, text);
      }
      this.names.push(text);
    }
    for (const connection of network.connections) {
      if (connection.size === null) continue;
      for (const id of [connection.source, connection.target]) {
        this.sizes.set(id, (this.sizes.get(id) ?? new Set()).add(connection.size));
      }
      for (const row of connection.via) {
        const of = this.bores.get(row);
        if (!of) this.bores.set(row, [connection.size]);
        else if (!of.includes(connection.size)) of.push(connection.size);
      }
    }
  }

  /** The best `most` of each kind; nothing for an empty query. */
  find(query: string, most = 200): Results {
    const wanted = understand(query);
    const none = !wanted.words.length && !wanted.bores.length && !wanted.lengths.length;
    if (none) return { units: [], lines: [], parts: [], totals: { units: 0, lines: 0, parts: 0 } };
    const units = this.rank(this.content.network.units.length, (i) => this.unit(i, wanted), most);
    const lines = this.rank(this.content.network.lines.length, (i) => this.line(i, wanted), most);
    const parts = this.rank(this.content.parts.id.length, (i) => this.part(i, wanted), most);
    return {
      units: units.best, lines: lines.best, parts: parts.best,
      totals: { units: units.total, lines: lines.total, parts: parts.total },
    };
  }

  /** Rows by rank (0 best, -1 no hit), in their own order within a rank. */
  private rank(n: number, rankOf: (i: number) => number, most: number): { best: number[]; total: number } {
    const ranks: number[][] = [[], [], [], []];
    let total = 0;
    for (let i = 0; i < n; i++) {
      const rank = rankOf(i);
      if (rank < 0) continue;
      total++;
      if (ranks[rank].length < most) ranks[rank].push(i);
    }
    return { best: ranks.flat().slice(0, most), total };
  }

  private unit(i: number, wanted: Wanted): number {
    const unit = this.content.network.units[i];
    // A port is as wide as its pipe is outside; what tells the nominal size is the line at it.
    const sizes = this.sizes.get(unit.id);
    const has = (bore: number) => (sizes ? sizes.has(bore) : unit.ports.some((port) => near(port.diameter, bore)));
    if (!wanted.bores.every(has)) return -1;
    if (!wanted.lengths.every((span) => unit.size.some((side) => within(side, span)))) return -1;
    const tag = unit.tag.toLowerCase();
    const facts = unit.facts.map(([, value]) => value).join(" ");
    return rankOf(tag, `${tag} ${unit.type} ${unit.kind ?? ""} ${unit.id} ${facts}`.toLowerCase(), "", wanted.words);
  }

  private line(i: number, wanted: Wanted): number {
    const line = this.content.network.lines[i];
    const sizes = line.size.split(/[^\d.]+/).map(Number);
    if (!wanted.bores.every((bore) => sizes.includes(bore))) return -1;
    if (!wanted.lengths.every((span) => line.length !== null && within(line.length, span))) return -1;
    const tag = line.tag.toLowerCase();
    return rankOf(tag, `${tag} line`, "", wanted.words);
  }

  private part(row: number, wanted: Wanted): number {
    if (wanted.bores.length && !wanted.bores.every((bore) => this.bores.get(row)?.includes(bore))) return -1;
    const extents = this.content.parts.extents;
    for (const span of wanted.lengths) {
      if (
        !within(extents[3 * row], span) && !within(extents[3 * row + 1], span) && !within(extents[3 * row + 2], span)
      ) return -1;
    }
    return rankOf(this.names[row], this.names[row], `${this.content.parts.id[row]} ${this.paths[row]}`, wanted.words);
  }
}

/** 0: its first text begins with the words, 1: a word of its text begins with each, 2: they are in it, 3: in the long text. */
function rankOf(lead: string, text: string, long: string, words: string[]): number {
  if (!words.length) return 2;
  let inText = true;
  for (const word of words) {
    if (text.includes(word)) continue;
    inText = false;
    if (!long.includes(word)) return -1;
  }
  if (!inText) return 3;
  if (lead.startsWith(words.join(" "))) return 0;
  return words.every((word) => text.startsWith(word) || text.includes(` ${word}`)) ? 1 : 2;
}

const within = (value: number, span: { low: number; high: number }) => value >= span.low && value <= span.high;
const near = (diameter: number | null, bore: number) =>
  diameter !== null && Math.abs(diameter * 1000 - bore) <= 0.15 * bore;

const kept = new WeakMap<object, string[]>();

function pathsOf(content: Content): string[] {
  let paths = kept.get(content.meshes);
  if (!paths) {
    paths = content.parts.id.map(
      (_id, row) => meshesOf(content, row).map((mesh) => content.meshes.path[mesh]).join(" ").toLowerCase()
    );
    kept.set(content.meshes, paths);
  }
  return paths;
}
