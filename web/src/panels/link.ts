// A view as the fragment of an address: what is looked at, from where, in which colours.

import type { Camera, ColorBy, LeftTab, Section, Shown } from "../store.ts";
import type { Content, Point } from "../types.ts";

/** Longest fragment: mail programs and chats break longer addresses. */
export const MOST = 2000;

export interface Encoded {
  fragment: string;
  /** What did not fit, in words; "" where everything did. */
  left: string;
}

const COLORS: ColorBy[] = ["group", "name", "unit", "system", "cluster", "confidence", "source", "original"];
const TABS: LeftTab[] = ["review", "find", "network", "warnings", "history"];

/** Rows, ascending, as steps in base 36: "3.1.1.f"; runs of neighbours as "3-12" (first and how many more). */
export function packRows(rows: Iterable<number>): string {
  const sorted = [...new Set(rows)].sort((a, b) => a - b);
  const told: string[] = [];
  let last = 0;
  for (let i = 0; i < sorted.length; ) {
    let end = i;
    while (end + 1 < sorted.length && sorted[end + 1] === sorted[end] + 1) end++;
    const run = end - i;
    told.push((sorted[i] - last).toString(36) + (run ? `-${run.toString(36)}` : ""));
    last = sorted[end];
    i = end + 1;
  }
  return told.join(".");
}

export function unpackRows(text: string, n: number): number[] {
  const rows: number[] = [];
  let last = 0;
  for (const step of text.split(".")) {
    const match = /^([0-9a-z]+)(?:-([0-9a-z]+))?$/.exec(step);
    if (!match) continue;
    const first = last + parseInt(match[1], 36);
    last = first + (match[2] ? parseInt(match[2], 36) : 0);
    if (last - first > n) break;
    for (let row = first; row <= last; row++) if (row < n) rows.push(row);
  }
  return rows;
}

const short = (value: number) => String(Math.round(value * 1000) / 1000);

function packCamera(camera: Camera): string {
  return [...camera.eye, ...camera.target].map(short).join(",") + (camera.orthographic ? ",o" : "");
}

function unpackCamera(text: string): Camera | null {
  const told = text.split(",");
  const numbers = told.slice(0, 6).map(Number);
  if (numbers.length < 6 || !numbers.every(Number.isFinite)) return null;
  return { eye: numbers.slice(0, 3) as Point, target: numbers.slice(3) as Point, orthographic: told[6] === "o" };
}

/** The fragment (without "#") of what is shown; rows of parts that don't fit are left out, and named. */
export function encode(shown: Shown, most = MOST): Encoded {
  const told = new URLSearchParams();
  if (shown.camera) told.set("at", packCamera(shown.camera));
  if (shown.place) told.set("place", shown.place);
  if (shown.colorBy !== "group") told.set("by", shown.colorBy);
  if (shown.section) told.set(
    "cut", `${shown.section.axis}${short(shown.section.at)}${shown.section.flipped ? "!" : ""}`
  );
  if (shown.leftTab !== "find") told.set("tab", shown.leftTab);
  if (!shown.ghost) told.set("ghost", "0");
  const left: string[] = [];
  const add = (key: string, rows: Iterable<number>, words: string) => {
    const packed = packRows(rows);
    if (!packed) return;
    told.set(key, packed);
    if (print(told).length <= most) return;
    told.delete(key);
    left.push(words);
  };
  if (!shown.place && shown.selection.length) add("part", shown.selection, "the selection");
  if (shown.isolated) add("only", shown.isolated, "which parts are isolated");
  if (shown.hidden.size) add("hide", shown.hidden, "which parts are hidden");
  return { fragment: print(told), left: left.join(" and ") };
}

/** Commas and colons may stand in a fragment as they are, and are easier on the eye. */
function print(told: URLSearchParams): string {
  return told.toString().replaceAll("%2C", ",").replaceAll("%21", "!").replaceAll("%3A", ":");
}

/** What a fragment asks for; what is unknown or broken in it is left out. */
export function decode(fragment: string, content: Content): Partial<Shown> {
  const told = new URLSearchParams(fragment.replace(/^#/, ""));
  const n = content.parts.id.length;
  const found: { -readonly [K in keyof Shown]?: Shown[K] } = {};
  const camera = unpackCamera(told.get("at") ?? "");
  if (camera) found.camera = camera;
  const by = told.get("by") as ColorBy | null;
  found.colorBy = by && COLORS.includes(by) ? by : "group";
  const tab = told.get("tab") as LeftTab | null;
  if (tab && TABS.includes(tab)) found.leftTab = tab;
  found.section = unpackSection(told.get("cut") ?? "");
  found.ghost = told.get("ghost") !== "0";
  found.hidden = new Set(unpackRows(told.get("hide") ?? "", n));
  const only = unpackRows(told.get("only") ?? "", n);
  found.isolated = only.length ? new Set(only) : null;
  const place = told.get("place");
  const node = [...content.network.units, ...content.network.ends].find((node) => node.id === place);
  found.place = node?.id ?? null;
  found.selection = node ? node.parts : unpackRows(told.get("part") ?? "", n);
  return found;
}

function unpackSection(text: string): Section | null {
  const match = /^([xyz])(-?[\d.]+)(!?)$/.exec(text);
  return match ? { axis: match[1] as Section["axis"], at: Number(match[2]), flipped: match[3] === "!" } : null;
}
