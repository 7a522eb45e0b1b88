// Puts the page together: data, 3D view, network, panels.

import "./page.css";
import "./scene/scene.css";
import "./network/network.css";
import "./panels/panels.css";
import { openSource } from "./api.ts";
import { listenToKeys } from "./commands.ts";
import { startNetwork } from "./network/network.ts";
import { startPanels } from "./panels/panels.ts";
import { openView } from "./scene/open.ts";
import type { SceneView } from "./scene/view.ts";
import { Store } from "./store.ts";

declare global {
  interface Window {
    /** For tests: what the page shows. */
    cadgraph: { store: Store; view: SceneView | null };
  }
}

const source = openSource();
const store = new Store();
window.cadgraph = { store, view: null };
const panels = startPanels(document.getElementById("app")!, store, source);
listenToKeys(document);
await panels.untilReady();
try {
  const view = await openView(panels.middle, store, source);
  window.cadgraph.view = view;
  startNetwork(view, store, source, panels);
  panels.connect(view);
} catch (error) {
  // Lists, corrections and the review are of use without the picture.
  panels.say(`The plant can't be drawn: ${(error as Error).message}`, "bad");
  throw error;
}
