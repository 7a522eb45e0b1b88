// The 3D view of the plant.

import type { Source } from "../api.ts";
import type { Store } from "../store.ts";
import type { SceneView } from "./view.ts";

export async function openView(_element: HTMLElement, _store: Store, _source: Source): Promise<SceneView> {
  throw new Error("not built yet");
}
