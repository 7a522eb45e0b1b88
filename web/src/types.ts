// What the server, or the file itself, gives: see docs/viewer.md. Metres, Z up; points are relative to `origin`.

export type Point = [number, number, number];

export interface Group {
  name: string;
  color: string;
  unit: string | null;
  names: string[];
}

/** Columns: all arrays have one entry per part (three where a point or a size is meant). -1 stands for none. */
export interface Parts {
  id: string[];
  group: number[];
  name: (string | null)[];
  confidence: (number | null)[];
  state: ("sure" | "likely" | "open")[];
  source: (string | null)[];
  unit: number[];
  cluster: number[];
  shape: number[];
  ground: boolean[];
  inside: number[];
  center: number[];
  size: number[];
  extents: number[];
  n_triangles: number[];
  area: number[];
  volume: (number | null)[];
  guesses: [number, string | null, number][][];
  facts: [string, string][][];
}

export interface Port {
  name: string;
  point: Point;
  direction: Point | null;
  diameter: number | null;
}

export interface Unit {
  id: string;
  tag: string;
  type: string;
  kind: string | null;
  kind_guesses: [string, number][];
  parts: number[];
  system: number;
  point: Point;
  size: Point;
  ports: Port[];
  missing: number;
  /** What can be done at it by hand or eye, or why nothing moves, in words. */
  handling: string;
  facts: [string, string][];
}

export interface End {
  id: string;
  name: string;
  kind: "junction" | "open" | "blind" | "unknown";
  point: Point;
  parts: number[];
  system: number;
}

export type Flow = "forward" | "backward" | "unknown";

export interface Connection {
  source: string;
  target: string;
  source_name: string;
  target_name: string;
  via: number[];
  path: number[];
  length: number | null;
  size: number | null;
  diameter: number | null;
  flow: Flow;
  reason: string | null;
  confidence: number | null;
  line: number;
}

export interface Line {
  tag: string;
  start: string;
  end: string;
  size: string;
  length: number | null;
  flow: string;
  connections: number[];
  system: number;
}

export interface System {
  id: string;
  units: number[];
  length: number | null;
  sizes: number[];
}

export interface Cluster {
  id: string;
  kind: string | null;
  n_parts: number;
}

export interface Joint {
  first: number;
  second: number;
  kind: string;
  point: Point;
  gap: number;
  score: number;
  made: boolean;
  reasons: string[];
}

export interface Network {
  units: Unit[];
  ends: End[];
  connections: Connection[];
  lines: Line[];
  systems: System[];
  clusters: Cluster[];
  joints: Joint[];
}

export interface Finding {
  code: string;
  message: string;
  parts: number[];
}

export interface Content {
  version: number;
  title: string;
  origin: Point;
  groups: Group[];
  meshes: { path: string[]; part: number[] };
  parts: Parts;
  network: Network;
  diagnostics: Finding[];
}

export interface Manifest {
  low: Point;
  high: Point;
  n_meshes: number;
  n_shapes: number;
  n_triangles: number;
  instances: string;
  chunks: { file: string; bytes: number; level: 0 | 1; n_shapes: number; low: Point; high: Point }[];
}

export interface ServerState {
  status: "building" | "ready" | "failed";
  stage: string;
  share: number;
  message: string;
  version: number;
  read_only: string | null;
  /** Set by the page itself: the server has gone, and what is shown is what it said last. */
  away?: boolean;
  title: string;
  folder: string;
  can_undo: boolean;
  can_redo: boolean;
  undo: string | null;
  redo: string | null;
  n_edits: number;
  lost: string[];
  who: string;
}

export type Edit =
  | { kind: "label"; part: string; group: string; name: string | null; this_only: boolean }
  | { kind: "forget"; part: string }
  | { kind: "merge"; parts: string[] }
  | { kind: "split"; parts: string[] }
  | { kind: "join"; first: string; second: string }
  | { kind: "cut"; first: string; second: string }
  | { kind: "direction"; source: string; target: string; via: string[]; flow: Flow }
  | { kind: "tag"; unit: string; tag: string }
  | { kind: "device"; unit: string; device: string }
  | { kind: "ground"; part: string; ground: boolean };

export interface Update {
  version: number;
  state: ServerState;
  message: string;
  changed: number[];
  rows: number[];
  parts: Parts;
  network: Network;
  diagnostics: Finding[];
  reload: boolean;
}

export interface Option {
  text: string;
  confidence: number | null;
  edits: Edit[];
}

export interface Question {
  id: string;
  kind: "label" | "ports" | "kind" | "joint" | "contradiction";
  title: string;
  why: string;
  parts: number[];
  alike: number[];
  gain: number;
  options: Option[];
}

export interface Doubt {
  text: string;
  parts: number[];
  place: string | null;
}

export interface Traced {
  title: string;
  lines: string[];
  places: string[];
  connections: number[];
  doubts: Doubt[];
}

export interface Isolated extends Traced {
  sure: boolean;
  close: string[];
}

export interface AuditRow {
  id: number;
  when: string;
  who: string;
  what: string;
  why: string;
  undone: boolean;
}
