// Opens the 3D view in an element: canvas, data, gestures, tools.

import { Vector3 } from "three";
import type { Source } from "../api.ts";
import type { Store } from "../store.ts";
import { Gestures } from "./gestures.ts";
import { Pipeline } from "./pipeline.ts";
import { PlantView } from "./plant_view.ts";
import { addTools } from "./tools.ts";
import type { Tools } from "./tools.ts";
import type { SceneView } from "./view.ts";

const NO_WEBGL =
  "This browser draws no 3D here: WebGL 2 is switched off or missing. Lists, tables and the drawing work without it.";

export async function openView(parent: HTMLElement, store: Store, source: Source): Promise<SceneView> {
  const element = document.createElement("div");
  element.className = "scene";
  const canvas = document.createElement("canvas");
  canvas.className = "scene-canvas";
  canvas.dataset.test = "canvas";
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The plant in 3D. Arrow keys turn it, plus and minus come closer and go away.");
  const note = document.createElement("div");
  note.className = "scene-note";
  note.setAttribute("role", "status");
  note.dataset.test = "scene-note";
  element.append(canvas, note);
  parent.append(element);
  const software = softwareRendering();
  if (software === null) {
    note.textContent = NO_WEBGL;
    throw new Error(NO_WEBGL);
  }
  const pipeline = new Pipeline(canvas, !software);
  note.textContent = "Reading the plant...";
  const manifest = await source.manifest();
  const instances = await source.file(manifest.instances);
  const view = new PlantView(element, canvas, store, source, pipeline, software, manifest, instances);
  keepContext(canvas, note, view);
  const tools = addTools(view, store);
  addGestures(canvas, view, store, tools);
  const bar = progressBar(note);
  const stop = view.onFrame(() => bar(view.loaded));
  view.load().then(
    () => {
      stop();
      note.textContent = "";
    },
    (error: Error) => (note.textContent = `Parts of the plant could not be read: ${error.message}`),
  );
  return view;
}

/** Whether the processor draws, which is slow; null where nothing does. */
function softwareRendering(): boolean | null {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return null;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function keepContext(canvas: HTMLCanvasElement, note: HTMLElement, view: PlantView): void {
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    note.textContent = "The graphics card dropped the picture; it comes back by itself, else reload the page.";
  });
  canvas.addEventListener("webglcontextrestored", () => {
    note.textContent = "";
    view.redraw();
  });
}

function progressBar(note: HTMLElement): (share: number) => void {
  const bar = document.createElement("progress");
  bar.max = 1;
  note.replaceChildren("Loading shapes ", bar);
  return (share) => {
    bar.value = share;
  };
}

function addGestures(canvas: HTMLCanvasElement, view: PlantView, store: Store, tools: Tools): void {
  let hoverTimer = 0;
  new Gestures(canvas, view.navigation, {
    pointAt: (x, y) => view.pickHit(x, y)?.point ?? pointInAir(view, x, y),
    clicked: (x, y, event) => {
      canvas.focus({ preventScroll: true });
      if (!tools.clicked(x, y)) select(view, store, x, y, event.ctrlKey || event.metaKey);
    },
    doubleClicked: (x, y) => {
      if (store.shown.tool !== "select") return;
      const part = view.partAt(x, y);
      if (part >= 0) view.flyTo([part]);
    },
    hovered: (x, y) => {
      if (tools.hovered(x, y)) return;
      // Reading a pixel back waits for the card: not for every movement of a hand.
      window.clearTimeout(hoverTimer);
      hoverTimer = window.setTimeout(() => store.set({ hovered: view.partAt(x, y) }), 60);
    },
    left: () => {
      window.clearTimeout(hoverTimer);
      store.set({ hovered: -1 });
    },
  });
}

/** Where there is nothing under the cursor: the middle of what is looked at, at that depth. */
function pointInAir(view: PlantView, x: number, y: number): Vector3 {
  const ray = view.rayAt(x, y);
  const { eye, target } = view.getCamera();
  const ahead = new Vector3(...target).sub(new Vector3(...eye));
  const along = ray.direction.dot(ahead.clone().normalize());
  const distance = new Vector3(...target).sub(ray.origin).dot(ahead.normalize()) / Math.max(along, 1e-3);
  return ray.at(distance, new Vector3());
}

/** One click takes a part, a second one on it its unit; with Ctrl a part is added or taken out. */
function select(view: PlantView, store: Store, x: number, y: number, adding: boolean): void {
  const part = view.partAt(x, y);
  const { selection, place } = store.shown;
  if (part < 0) {
    if (!adding) store.select([]);
    return;
  }
  if (adding) {
    store.select(selection.includes(part) ? selection.filter((row) => row !== part) : [...selection, part]);
    return;
  }
  const unit = store.content!.network.units[store.content!.parts.unit[part]];
  if (unit && selection.length === 1 && selection[0] === part && place === null) store.selectPlace(unit.id);
  else store.select([part]);
}
