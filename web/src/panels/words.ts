// Numbers, states and codes in words.

import type { Content, Parts } from "../types.ts";

/** "1 part", "24 parts", "1,204 parts". */
export function count(n: number, one: string, many = `${one}s`): string {
  return `${whole(n)} ${n === 1 ? one : many}`;
}

/** Thousands apart, by commas wherever the browser stands: tables and tests read the same. */
export function whole(n: number): string {
  return String(Math.round(n)).replace(/\B(?=(\d{3})+(?!\d))/g, ",");
}

export function percent(share: number | null): string {
  if (share === null || !Number.isFinite(share)) return "not known";
  const hundred = share * 100;
  if (hundred > 99 && share < 1) return "over 99 %";
  if (hundred < 1 && share > 0) return "below 1 %";
  return `${Math.round(hundred)} %`;
}

/** A length as an engineer says it: millimetres below a metre. */
export function length(metres: number | null): string {
  if (metres === null || !Number.isFinite(metres)) return "not known";
  const size = Math.abs(metres);
  if (size < 1e-5) return "0 mm";
  if (size < 0.01) return `${(metres * 1000).toFixed(1)} mm`;
  if (size < 1) return `${Math.round(metres * 1000)} mm`;
  return `${metres.toFixed(size < 10 ? 2 : 1)} m`;
}

export function lengths(sides: ArrayLike<number>): string {
  const all = Array.from(sides);
  const inMetres = Math.max(...all.map(Math.abs)) >= 1;
  const told = all.map((side) => (inMetres ? side.toFixed(2) : String(Math.round(side * 1000))));
  return `${told.join(" × ")} ${inMetres ? "m" : "mm"}`;
}

export function area(value: number | null): string {
  if (value === null || !Number.isFinite(value)) return "not known";
  return value < 0.01 ? `${(value * 1e4).toFixed(value < 1e-3 ? 2 : 1)} cm²` : `${value.toFixed(value < 1 ? 3 : 2)} m²`;
}

export function volume(value: number | null): string {
  if (value === null || !Number.isFinite(value)) return "not known (its surface is open)";
  if (value < 1e-3) return `${(value * 1e6).toFixed(value < 1e-5 ? 2 : 0)} cm³`;
  return value < 1 ? `${(value * 1e3).toFixed(1)} l` : `${value.toFixed(2)} m³`;
}

const STAGES: Record<string, string> = {
  read: "Reading the file",
  draw: "Making the picture",
  measure: "Measuring the parts",
  contacts: "Finding which parts touch",
  group: "Putting meshes together to parts",
  cluster: "Finding what stands together",
  label: "Telling what each part is",
  relate: "Following the pipes",
  assemble: "Writing the graph",
};

/** What is done at a stage of building. */
export function stageWords(stage: string): string {
  return STAGES[stage] ?? (stage ? upper(stage) : "Starting");
}

const SURE: Record<string, string> = { sure: "Sure", likely: "Likely, not sure", open: "Not known" };

export function howSure(state: string): string {
  return SURE[state] ?? state;
}

const SOURCES: Record<string, string> = {
  geometry: "Told from its shape, by the built-in network.",
  embedded: "Told from its shape, by the built-in network.",
  network: "Told from the pipes around it.",
  catalog: "Found in a catalogue of shapes.",
  author: "Given by the names in the file.",
  file: "Given by the file.",
  lvlm: "Told from its picture, by a language model.",
  human: "Corrected by hand.",
  repeat: "It has the shape of a part corrected by hand.",
  kin: "It is much like a part corrected by hand.",
};

/** Where a label comes from, as a sentence. */
export function fromWhere(source: string | null): string {
  return source === null ? "Nobody has said what it is." : (SOURCES[source] ?? `Said by ${source}.`);
}

const CODES: Record<string, string> = {
  "ground": "Taken for the ground",
  "unit-short-of-lines": "Units with missing lines",
  "unlabelled": "Parts without a label",
  "likely": "Labels that are likely, not sure",
  "network-in-pieces": "Networks that nothing joins",
  "end-before-part": "Pipes that end just before a part",
  "units-touch-unjoined": "Units that touch and are not joined",
  "line-untraced": "Lines that could not be traced",
  "file-disagrees": "The file says otherwise",
  "file-unknown-label": "Labels of the file that the vocabulary lacks",
  "label-doubted": "Labels that the network doubts",
  "label-outvoted": "Labels that their repeats outvoted",
  "correction-lost": "Corrections that no longer fit",
  "duplicate-mesh": "Meshes that are there twice",
  "near-duplicate-mesh": "Meshes that are nearly there twice",
  "empty-mesh": "Empty meshes",
  "open-mesh": "Meshes with an open surface",
  "one-surface": "Several parts in one surface",
  "split-mesh": "Meshes that were split",
  "nonfinite-vertices": "Meshes with broken points",
  "missing-joint": "Joints that the file names and that are missing",
  "missing-units": "The file does not say its unit of length",
  "missing-up-axis": "The file does not say which way is up",
  "no-centreline": "Pipes without a centre line",
  "no-part": "Meshes that belong to no part",
  "no-component": "Components that were not found",
  "bridged-gap": "Gaps that were bridged",
  "weak-bridge": "Weak joints between clusters",
  "stated-gap": "Gaps between parts that the file joins",
  "stated-unplaced": "Connections of the file without a place",
  "tag-twice": "Tags that are there twice",
  "tag-unusable": "Tags that can't be used",
  "unit-doubt": "Units in doubt",
  "loose-operator": "Operators without a valve",
  "loose-fitting": "Lugs and legs without a vessel",
  "loose-dial": "Dials without a gauge",
  "valve-not-movable": "Valves without a wheel or lever",
  "damaged-source": "The file is damaged",
  "damaged-entity": "Damaged entries of the file",
  "hidden-mesh": "Meshes that nobody can see",
  "inside-out-mesh": "Meshes turned inside out",
  "degenerate-mesh": "Meshes without area",
  "degenerate-faces": "Faces without area",
  "flow-contradiction": "Directions that contradict each other",
  "flow-disagrees": "Directions that the file states otherwise",
  "no-ground": "No ground was found",
  "not-ground": "Not taken for the ground",
  "outside-asset": "References out of the folder",
  "several-bodies": "Meshes of several bodies",
  "unknown-label": "Labels outside the vocabulary",
  "changed-path": "Meshes with another path than before",
  "excluded": "Left out as asked",
  "unmatched-mesh": "Meshes that match nothing",
};

/** What a code of a diagnostic says to a plant engineer. */
export function finding(code: string): string {
  return CODES[code] ?? code.charAt(0).toUpperCase() + code.slice(1).replaceAll("-", " ");
}

/** Name and group of a part: "flange", "Pipe assembly"; a part without a label has none. */
export function labelOf(content: Content, row: number): { name: string; group: string; color: string | null } {
  const parts = content.parts;
  const group = content.groups[parts.group[row]];
  if (!group) return { name: "No label", group: "", color: null };
  const name = parts.name[row];
  return { name: name ? upper(name) : group.name, group: name ? group.name : "", color: group.color };
}

export function upper(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** A message of the server as a sentence; ids at its beginning stay as they are. */
export function sentence(text: string): string {
  return /^[a-z]+\b(?!-)/.test(text) ? upper(text) : text;
}

/** A part in one short line. */
export function partTitle(content: Content, row: number): string {
  const unit = content.network.units[content.parts.unit[row]];
  return unit ? `${labelOf(content, row).name} of ${unit.tag}` : labelOf(content, row).name;
}

/** Mesh paths by part, made once for a content's meshes. */
const meshes = new WeakMap<object, number[][]>();

export function meshesOf(content: Content, row: number): number[] {
  let table = meshes.get(content.meshes);
  if (!table) {
    table = Array.from({ length: content.parts.id.length }, () => []);
    content.meshes.part.forEach((part, mesh) => table![part]?.push(mesh));
    meshes.set(content.meshes, table);
  }
  return table[row] ?? [];
}

/** What the file calls a part: the last name of its first mesh's path. */
export function meshName(content: Content, row: number): string {
  return (content.meshes.path[meshesOf(content, row)[0]] ?? "").split("/").at(-1) ?? "";
}

/** Rows of all parts of one shape, this one among them. */
export function repeatsOf(parts: Parts, row: number): number[] {
  const shape = parts.shape[row];
  const found: number[] = [];
  for (let i = 0; i < parts.shape.length; i++) if (parts.shape[i] === shape) found.push(i);
  return found;
}

/** "just now", "12 min ago", "14:05", "3 Nov, 14:05", in the time of the person's place. */
export function moment(iso: string, now = new Date()): string {
  const when = new Date(iso);
  if (!iso || Number.isNaN(when.getTime())) return "earlier";
  const minutes = (now.getTime() - when.getTime()) / 60000;
  if (minutes >= -1 && minutes < 1) return "just now";
  if (minutes >= 0 && minutes < 60) return `${Math.floor(minutes)} min ago`;
  const clock = `${String(when.getHours()).padStart(2, "0")}:${String(when.getMinutes()).padStart(2, "0")}`;
  if (when.toDateString() === now.toDateString()) return clock;
  const months = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];
  const year = when.getFullYear() === now.getFullYear() ? "" : ` ${when.getFullYear()}`;
  return `${when.getDate()} ${months[when.getMonth()]}${year}, ${clock}`;
}

/** "8 s", "2 min 05 s". */
export function elapsed(seconds: number): string {
  const all = Math.max(0, Math.floor(seconds));
  return all < 60 ? `${all} s` : `${Math.floor(all / 60)} min ${String(all % 60).padStart(2, "0")} s`;
}
