// What the pieces of the page share.

import type { Source } from "../api.ts";
import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";
import type { Edit } from "../types.ts";

export type Tone = "info" | "good" | "bad";

export interface Action {
  text: string;
  run: () => void;
}

export interface Page {
  readonly store: Store;
  readonly source: Source;
  /** The 3D view, once it is there. */
  view: SceneView | null;
  say(text: string, tone?: Tone, actions?: Action[]): void;
  /** Whether corrections can be made: a server answers, and the folder can be written. */
  canEdit(): boolean;
  edit(edits: Edit[], why?: string): Promise<boolean>;
  /** Why the last correction was not taken, for saying it in its place. */
  refusal(): string;
  undo(): Promise<void>;
  redo(): Promise<void>;
  /** Selects these parts, or a place, and moves to them. */
  go(parts: readonly number[], place?: string | null): void;
  /** Lets the person click what comes next in the view; Escape ends it. */
  pickNext(words: string, take: (row: number, place: string | null) => void): void;
  /** Lets the person choose a label of the vocabulary. */
  pickLabel(title: string, first: LabelChoice[], take: (choice: LabelChoice) => void): void;
}

export interface LabelChoice {
  group: string;
  name: string | null;
}

/** Remembers a choice of the person's on this computer; where the browser does not let it, not. */
export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`cadgraph.${key}`, value);
  } catch {
    // Private windows and files opened from disk may have no storage: the choice then lasts as long as the page.
  }
}

export function remembered(key: string): string | null {
  try {
    return localStorage.getItem(`cadgraph.${key}`);
  } catch {
    return null;
  }
}
