// What can be done to the view and to what is selected: by a key, by a button of the toolbar, from the help.

import { Vector3 } from "three";
import { addCommands } from "../commands.ts";
import type { Command } from "../commands.ts";
import type { Store } from "../store.ts";
import type { Unit } from "../types.ts";
import type { PlantView } from "./plant_view.ts";
import { sectionAcross } from "./section.ts";

const TURN = (10 * Math.PI) / 180;
const NEARER = 0.8;

/** Tools that Escape ends, the one that is worked with first. */
export interface Escapable {
  /** Ends what is going on or takes its leftovers away; false where there is nothing of it. */
  escape(): boolean;
  isBusy(): boolean;
}

export function addViewCommands(view: PlantView, store: Store, tools: Escapable): void {
  const chosen = () => subject(store).length > 0;
  addCommands(
    { id: "view-home", key: "0", title: "The whole plant", area: "View", run: () => view.home() },
    { id: "view-fly", key: "f", title: "Fly to the selection", area: "View", when: chosen, run: () => view.flyTo(subject(store)) },
    { id: "view-hide", key: "h", title: "Hide the selection", area: "Selection", when: chosen, run: () => hide(store) },
    { id: "view-isolate", key: "i", title: "Show only the selection", area: "Selection", when: () => chosen() || !!store.shown.isolated, run: () => isolate(store) },
    { id: "view-all", key: "a", title: "Show all again", area: "Selection", run: () => showAll(store) },
    { id: "view-ghost", key: "g", title: "Draw faintly what is not shown, or leave it out", area: "View", run: () => store.set({ ghost: !store.shown.ghost }) },
    { id: "view-section", key: "x", title: "Cut the plant open", area: "View", run: () => section(view, store) },
    { id: "view-explode", key: "e", title: "Draw the selected unit apart", area: "Selection", when: () => !!store.shown.explode || unitOf(store) !== null, run: () => explode(view, store) },
    { id: "view-measure", key: "m", title: "Measure between two points", area: "View", run: () => store.set({ tool: store.shown.tool === "measure" ? "select" : "measure", hovered: -1 }) },
    { id: "view-parallel", key: "p", title: "Without perspective", area: "View", run: () => view.navigation.setOrthographic(!view.navigation.orthographic) },
    { id: "view-picture", title: "Save the picture", area: "View", run: () => void savePicture(view, store) },
    { id: "view-nearer", key: "+", title: "Nearer", area: "View", run: () => zoom(view, NEARER) },
    { id: "view-farther", key: "-", title: "Farther", area: "View", run: () => zoom(view, 1 / NEARER) },
    ...turns(view),
    { id: "view-escape", key: "Escape", title: "End the tool, then drop the selection", area: "Selection", when: () => tools.isBusy() || !!clearing(store), run: () => tools.escape() || store.set(clearing(store) ?? {}) },
  );
}

function turns(view: PlantView): Command[] {
  // In a list or a panel the arrows belong to that.
  const when = () => document.activeElement === document.body || document.activeElement instanceof HTMLCanvasElement;
  const turn = (id: string, key: string, title: string, dx: number, dy: number): Command =>
    ({ id, key, title, area: "View", when, run: () => view.navigation.orbit(new Vector3(...view.getCamera().target), dx * TURN, dy * TURN) });
  return [
    turn("view-turn-left", "ArrowLeft", "Turn left", -1, 0), turn("view-turn-right", "ArrowRight", "Turn right", 1, 0),
    turn("view-turn-up", "ArrowUp", "Turn up", 0, -1), turn("view-turn-down", "ArrowDown", "Turn down", 0, 1),
  ];
}

/** What a command is about: the selection, else what the review asks about. */
export function subject(store: Store): readonly number[] {
  const { selection, question } = store.shown;
  return selection.length ? selection : (question?.parts ?? []);
}

/** The unit that is selected, or that the first selected part is in. */
export function unitOf(store: Store): Unit | null {
  const { content, shown } = store;
  if (!content) return null;
  const { units } = content.network;
  const found = shown.place
    ? units.find((unit) => unit.id === shown.place)
    : units[content.parts.unit[subject(store)[0] ?? -1] ?? -1];
  return found && found.parts.length > 1 ? found : null;
}

function hide(store: Store): void {
  store.set({ hidden: new Set([...store.shown.hidden, ...subject(store)]), selection: [], place: null });
}

function isolate(store: Store): void {
  const parts = subject(store);
  const { isolated } = store.shown;
  const already = isolated && (!parts.length || (isolated.size === new Set(parts).size && parts.every((row) => isolated.has(row))));
  store.set({ isolated: already ? null : new Set(parts) });
}

/** Whether something is hidden, faint or apart. */
export function isAltered(store: Store): boolean {
  const { hidden, isolated, marks, explode } = store.shown;
  return hidden.size > 0 || !!isolated || !!marks || !!explode;
}

export function showAll(store: Store): void {
  store.set({ hidden: new Set(), isolated: null, marks: null, explode: null });
}

function section(view: PlantView, store: Store): void {
  const { content, shown } = store;
  const on = content && !shown.section;
  store.set({ section: on ? sectionAcross("y", content, subject(store), view.getCamera().eye) : null });
}

function explode(view: PlantView, store: Store): void {
  const unit = unitOf(store);
  if (store.shown.explode || !unit) {
    store.set({ explode: null });
    return;
  }
  store.set({ explode: { unit: unit.id, share: 0.6 } });
  view.flyTo(unit.parts);
}

function zoom(view: PlantView, factor: number): void {
  view.navigation.zoom(new Vector3(...view.getCamera().target), factor);
}

/** What Escape takes away when no tool is in use: one thing at a time. */
function clearing(store: Store) {
  const { explode, selection, place, marks } = store.shown;
  if (explode) return { explode: null };
  if (selection.length || place) return { selection: [], place: null };
  return marks ? { marks: null } : null;
}

async function savePicture(view: PlantView, store: Store): Promise<void> {
  const address = URL.createObjectURL(await view.picture());
  const link = document.createElement("a");
  link.href = address;
  link.download = `${(store.content?.title ?? "plant").replace(/\.[^.]*$/, "").replace(/[^\p{L}\p{N} ._-]+/gu, "_") || "plant"}.png`;
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
