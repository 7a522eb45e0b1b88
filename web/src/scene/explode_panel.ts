// Draws a unit apart: follows what is wanted, and the panel that says how far.

import type { Store } from "../store.ts";
import { el } from "../dom.ts";
import { iconButton, keysBack } from "./icons.ts";
import { fullOffsets, offsetsAt } from "./explode.ts";
import type { PlantView } from "./plant_view.ts";

const NONE: ReturnType<typeof fullOffsets> = new Map();

export function explodePanel(view: PlantView, store: Store): HTMLElement {
  const title = el("span", { class: "scene-card-title" });
  const slider = el("input", {
    type: "range", min: 0, max: 100, step: 1, "aria-label": "How far its parts are drawn apart", "data-test": "explode-share",
    oninput: () => store.shown.explode && store.set({ explode: { ...store.shown.explode, share: Number(slider.value) / 100 } }),
  });
  const close = iconButton("close", "Together again (e)", "explode-close", () => store.set({ explode: null }));
  const panel = el("div", { class: "scene-card", role: "group", "aria-label": "Unit drawn apart", "data-test": "explode-panel" }, title, slider, close);
  keysBack(slider, view);

  let full = NONE;
  let of = "";
  let moved = false;
  let wanted = 0;
  const place = () => {
    wanted = 0;
    const { explode } = store.shown;
    if (explode || moved) view.setOffsets(explode ? offsetsAt(full, explode.share) : NONE);
    moved = !!explode;
  };
  const update = () => {
    const { explode } = store.shown;
    const unit = explode && store.content?.network.units.find((one) => one.id === explode.unit);
    if (explode && !unit) {
      store.set({ explode: null });
      return;
    }
    panel.hidden = !explode;
    if (!explode || !unit) of = "";
    else if (of !== unit.id) {
      of = unit.id;
      full = fullOffsets(store.content!, unit);
    }
    title.textContent = unit ? `${unit.tag} apart` : "";
    if (explode) slider.value = String(Math.round(100 * explode.share));
    if (!wanted) wanted = requestAnimationFrame(place);
  };
  store.watch(["explode"], update);
  store.on("content", () => {
    of = "";
    update();
  });
  update();
  return panel;
}
