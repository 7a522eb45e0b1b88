// The network over the plant, and the schematic beside it.

import type { Source } from "../api.ts";
import type { Panels } from "../panels/panels.ts";
import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";

export function startNetwork(_view: SceneView, _store: Store, _source: Source, _panels: Panels): void {}
