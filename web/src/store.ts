// What the page shows: one object that all areas read, change by `set`, and listen to.

import { placeAgain, rowsFrom } from "./kept.ts";
import type { Content, Isolated, Parts, Point, Question, ServerState, Traced, Update } from "./types.ts";

export type ColorBy =
  | "group" | "name" | "unit" | "system" | "cluster" | "confidence" | "source" | "original";
export type LeftTab = "review" | "find" | "network" | "warnings" | "history";
export type Tool = "select" | "measure";

/** A view of the plant: position of the eye and the point it looks at [m], relative to the content's origin. */
export interface Camera {
  eye: Point;
  target: Point;
  orthographic: boolean;
}

/** What a trace or an isolation marks. */
export interface Marks {
  kind: "trace" | "isolate";
  result: Traced | Isolated;
  places: ReadonlySet<string>;
  connections: ReadonlySet<number>;
  parts: ReadonlySet<number>;
  close: ReadonlySet<string>;
}

/** A plane across an axis, at a place on it [m]: what lies beyond is cut away, or what lies before where it is flipped. */
export interface Section {
  axis: "x" | "y" | "z";
  at: number;
  flipped: boolean;
}

export interface Shown {
  /** Rows of the selected parts; the first one is what the inspector tells of. */
  selection: readonly number[];
  /** Id of the selected unit, junction or terminal; its parts are the selection then. */
  place: string | null;
  hovered: number;
  hidden: ReadonlySet<number>;
  /** Only these are shown; null shows all. */
  isolated: ReadonlySet<number> | null;
  /** Whether what is not isolated is drawn faint rather than left out. */
  ghost: boolean;
  colorBy: ColorBy;
  marks: Marks | null;
  network: boolean;
  tags: boolean;
  section: Section | null;
  /** A unit drawn apart, and how far: 0 not at all, 1 wide. */
  explode: { unit: string; share: number } | null;
  tool: Tool;
  question: Question | null;
  leftTab: LeftTab;
  schematic: boolean;
  table: boolean;
  theme: "light" | "dark";
  camera: Camera | null;
}

export const START: Shown = {
  selection: [], place: null, hovered: -1, hidden: new Set(), isolated: null, ghost: true, colorBy: "group",
  marks: null, network: true, tags: true, section: null, explode: null, tool: "select", question: null,
  leftTab: "find", schematic: false, table: false, theme: "light", camera: null,
};

export interface Topics {
  content: Content;
  state: ServerState;
  shown: ReadonlySet<keyof Shown>;
  /** Name of the unit, junction or end that was selected and is no more. */
  gone: string;
}

type Listener<T> = (value: T) => void;

export class Store {
  content: Content | null = null;
  state: ServerState | null = null;
  shown: Readonly<Shown> = START;
  private readonly listeners: { [K in keyof Topics]: Set<Listener<Topics[K]>> } = {
    content: new Set(), state: new Set(), shown: new Set(), gone: new Set(),
  };

  /** Calls back on changes; gives the way to stop that. `content`: labels or network are others now. */
  on<K extends keyof Topics>(topic: K, listener: Listener<Topics[K]>): () => void {
    this.listeners[topic].add(listener);
    return () => this.listeners[topic].delete(listener);
  }

  /** Calls back when one of these things that are shown has changed. */
  watch(keys: (keyof Shown)[], listener: () => void): () => void {
    return this.on("shown", (changed) => {
      if (keys.some((key) => changed.has(key))) listener();
    });
  }

  set(patch: Partial<Shown>): void {
    const changed = new Set<keyof Shown>();
    for (const key of Object.keys(patch) as (keyof Shown)[]) if (patch[key] !== this.shown[key]) changed.add(key);
    if (!changed.size) return;
    this.shown = { ...this.shown, ...patch };
    this.tell("shown", changed);
  }

  setState(state: ServerState): void {
    this.state = state;
    this.tell("state", state);
  }

  setContent(content: Content): void {
    const before = this.content;
    const same = before && sameMeshes(before.meshes, content.meshes);
    // What was worked out for the meshes stays good as long as they are the same object.
    this.content = same ? { ...content, meshes: before.meshes } : content;
    const { place } = this.shown;
    if (before && !same) this.keepRows(before);
    const gone = this.keepPlaces(before ?? this.content);
    this.tell("content", this.content);
    if (gone && place) this.tell("gone", nameOf(before ?? this.content, place));
  }

  /** Lays an update over the content; false where the content has to be fetched anew. */
  apply(update: Update): boolean {
    this.setState(update.state);
    if (update.reload || !this.content) return false;
    const parts = this.content.parts;
    for (const key of Object.keys(parts) as (keyof Parts)[]) {
      const all = parts[key] as unknown[];
      const some = update.parts[key] as unknown[];
      const width = key === "center" || key === "size" || key === "extents" ? 3 : 1;
      update.rows.forEach((row, i) => {
        for (let k = 0; k < width; k++) all[row * width + k] = some[i * width + k];
      });
    }
    this.setContent({
      ...this.content, version: update.version, parts, network: update.network, diagnostics: update.diagnostics,
    });
    return true;
  }

  /** Selects parts; their unit, where all of them are in one and that is meant. */
  select(parts: readonly number[], place: string | null = null): void {
    this.set({ selection: parts, place });
  }

  /** Selects a unit, junction or terminal by its id. */
  selectPlace(id: string): void {
    const network = this.content?.network;
    const node = network?.units.find((unit) => unit.id === id) ?? network?.ends.find((end) => end.id === id);
    if (node) this.select(node.parts, id);
  }

  /** Goes on with the same unit or end, whatever its id is now; whether what was selected is gone. */
  private keepPlaces(before: Content): boolean {
    const now = this.content!;
    const { place, selection, explode } = this.shown;
    const n = now.parts.id.length;
    if (selection.some((row) => row >= n)) this.set({ selection: selection.filter((row) => row < n) });
    if (explode) {
      const unit = placeAgain(before, explode.unit, now);
      if (unit?.id !== explode.unit) this.set({ explode: unit && { ...explode, unit: unit.id } });
    }
    if (!place) return false;
    const node = placeAgain(before, place, now);
    if (!node) {
      this.set({ selection: [], place: null });
      return true;
    }
    const same = node.parts.length === selection.length && node.parts.every((row, i) => row === selection[i]);
    if (!same || node.id !== place) this.set({ selection: node.parts, place: node.id });
    return false;
  }

  /** The parts themselves may be others now: what was selected or hidden is found again by its meshes. */
  private keepRows(before: Content): void {
    const next = rowsFrom(before, this.content!);
    const keep = (rows: Iterable<number>) => [...new Set([...rows].map(next))].filter((row) => row >= 0);
    const { selection, hidden, isolated } = this.shown;
    this.set({
      selection: keep(selection), hidden: new Set(keep(hidden)), isolated: isolated && new Set(keep(isolated)),
      hovered: -1, marks: null, question: null,
    });
  }

  private tell<K extends keyof Topics>(topic: K, value: Topics[K]): void {
    for (const listener of [...this.listeners[topic]]) listener(value);
  }
}

function sameMeshes(a: Content["meshes"], b: Content["meshes"]): boolean {
  return a === b || (a.path.length === b.path.length && a.path.every((path, mesh) => path === b.path[mesh] && a.part[mesh] === b.part[mesh]));
}

function nameOf({ network }: Content, id: string): string {
  return network.units.find((unit) => unit.id === id)?.tag ?? network.ends.find((end) => end.id === id)?.name ?? id;
}
