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
import { Store } from "./store.ts";

const source = openSource();
const store = new Store();
const app = document.getElementById("app")!;
const panels = startPanels(app, store, source);
listenToKeys(document);
await panels.untilReady();
const view = await openView(panels.middle, store, source);
startNetwork(view, store, source, panels);
panels.connect(view);
(window as unknown as Record<string, unknown>).cadgraph = { store, view };
