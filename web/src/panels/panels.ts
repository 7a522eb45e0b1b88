// The page around the 3D view.

import type { Source } from "../api.ts";
import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";
import type { Edit } from "../types.ts";

export interface Panels {
  /** Where the 3D view goes. */
  readonly middle: HTMLElement;
  /** Where the schematic goes: a pane below the view, shown while store.shown.schematic. */
  readonly schematicPane: HTMLElement;
  /** A place in the inspector for what an area has to say of the selection; filled anew by the area itself. */
  readonly networkSlot: HTMLElement;
  /** The list of the left tab "network". */
  readonly networkTab: HTMLElement;
  /** Shows progress until the content is there. */
  untilReady(): Promise<void>;
  connect(view: SceneView): void;
  /** Sends corrections, says what came of them, and lays the answer over the store; false where it was refused. */
  edit(edits: Edit[], why?: string): Promise<boolean>;
  /** A line for the person, told to screen readers, too. */
  say(text: string, kind?: "info" | "good" | "bad"): void;
}

export function startPanels(app: HTMLElement, _store: Store, _source: Source): Panels {
  const middle = document.createElement("main");
  const pane = document.createElement("section");
  app.append(middle, pane);
  return {
    middle, schematicPane: pane, networkSlot: document.createElement("div"), networkTab: document.createElement("div"),
    untilReady: async () => { _store.setState(await _source.state()); _store.setContent(await _source.content()); },
    connect: () => {}, edit: async () => false, say: (text) => console.log(text),
  };
}
