// Cutting the plant open: where the plane can go, and the panel that moves it.

import type { Section, Store } from "../store.ts";
import type { Content, Point } from "../types.ts";
import { el } from "../dom.ts";
import { iconButton, keysBack } from "./icons.ts";
import type { PlantView } from "./plant_view.ts";

const STEPS = 1000;
const AXES = ["x", "y", "z"] as const;

/** The box around parts (all, where none are named) [m, relative to the content's origin]; null for none. */
export function boundsOf(content: Content, rows?: Iterable<number>): { low: Point; high: Point } | null {
  const { center, size, id } = content.parts;
  const low: Point = [Infinity, Infinity, Infinity];
  const high: Point = [-Infinity, -Infinity, -Infinity];
  for (const row of rows ?? id.keys()) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], center[3 * row + k] - size[3 * row + k] / 2);
      high[k] = Math.max(high[k], center[3 * row + k] + size[3 * row + k] / 2);
    }
  }
  return low[0] <= high[0] ? { low, high } : null;
}

/** A plane through the middle of parts (all, where none are named) that takes away the half before the eye. */
export function sectionAcross(axis: Section["axis"], content: Content, rows: readonly number[], eye: Point): Section | null {
  const bounds = (rows.length ? boundsOf(content, rows) : null) ?? boundsOf(content);
  if (!bounds) return null;
  const k = AXES.indexOf(axis);
  const at = (bounds.low[k] + bounds.high[k]) / 2;
  return { axis, at, flipped: eye[k] < at };
}

/** The panel with which the section plane is moved; to be seen while there is one. */
export function sectionPanel(view: PlantView, store: Store): HTMLElement {
  const change = (patch: Partial<Section>) => store.shown.section && store.set({ section: { ...store.shown.section, ...patch } });
  const axes = AXES.map((axis) => el("button", {
    type: "button", title: `Cut across ${axis.toUpperCase()}`, "data-test": `section-${axis}`,
    onclick: () => store.set({ section: sectionAcross(axis, store.content!, store.shown.selection, view.getCamera().eye) }),
  }, axis.toUpperCase()));
  const slider = el("input", { type: "range", min: 0, max: STEPS, step: 1, "aria-label": "Where the plant is cut", "data-test": "section-at" });
  const value = el("output", { class: "scene-value", "data-test": "section-value" });
  const flip = iconButton("flip", "Show the other side", "section-flip", () => change({ flipped: !store.shown.section?.flipped }));
  const close = iconButton("close", "No section (x)", "section-close", () => store.set({ section: null }));
  const panel = el("div", { class: "scene-card", role: "group", "aria-label": "Section", "data-test": "section-panel" },
    el("span", { class: "scene-card-title" }, "Section"), el("div", { class: "scene-axes-choice" }, ...axes), slider, value, flip, close);
  keysBack(slider, view);

  let wanted = 0;
  slider.addEventListener("input", () => {
    // Many movements of a hand, one picture.
    if (!wanted) wanted = requestAnimationFrame(() => {
      wanted = 0;
      const range = rangeOf(store);
      if (range) change({ at: range.low + (range.high - range.low) * (Number(slider.value) / STEPS) });
    });
  });
  const update = () => {
    const { section } = store.shown;
    panel.hidden = !section;
    const range = rangeOf(store);
    if (!section || !range) return;
    axes.forEach((button, k) => button.setAttribute("aria-pressed", String(AXES[k] === section.axis)));
    flip.setAttribute("aria-pressed", String(section.flipped));
    slider.value = String(Math.round((STEPS * (section.at - range.low)) / Math.max(range.high - range.low, 1e-9)));
    value.textContent = `${(section.at + range.origin).toFixed(3)} m`;
    slider.setAttribute("aria-valuetext", `${section.axis} = ${value.textContent}`);
  };
  store.watch(["section"], update);
  store.on("content", update);
  update();
  return panel;
}

/** From where to where the plane can go along its axis. */
function rangeOf(store: Store): { low: number; high: number; origin: number } | null {
  const { content, shown } = store;
  const bounds = content && shown.section && boundsOf(content);
  if (!bounds) return null;
  const k = AXES.indexOf(shown.section!.axis);
  return { low: bounds.low[k], high: bounds.high[k], origin: content.origin[k] };
}
