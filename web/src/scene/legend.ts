// By what the plant is coloured, and what the colours mean.

import type { ColorBy, Store } from "../store.ts";
import { colorParts } from "./colors.ts";
import type { LegendEntry } from "./colors.ts";
import { el } from "../dom.ts";
import { icon, keysBack } from "./icons.ts";
import type { PlantView } from "./plant_view.ts";

const CHOICES: [ColorBy, string][] = [
  ["group", "Group"], ["name", "Label"], ["unit", "Unit"], ["system", "System"], ["cluster", "Structure"],
  ["confidence", "How sure"], ["source", "Who said the label"], ["original", "Colours of the file"],
];
/** More rows nobody reads; the table and the search have them all. */
const MOST_ROWS = 200;
const LEAST_WIDTH = 480;

interface Row {
  parts: number[];
  button: HTMLButtonElement;
}

export function legendPanel(view: PlantView, store: Store): HTMLElement {
  const choice = el("select", { "aria-label": "Colour by", title: "Colour by", "data-test": "color-by", onchange: () => store.set({ colorBy: choice.value as ColorBy }) },
    ...CHOICES.map(([value, text]) => el("option", { value }, text)));
  keysBack(choice, view);
  const fold = el("button", {
    type: "button", class: "scene-button scene-fold", "aria-controls": "scene-legend-rows", "data-test": "legend-fold",
    onclick: () => open(!!list.hidden),
  }, icon("down"));
  const list = el("ul", { class: "scene-legend-rows", id: "scene-legend-rows", "data-test": "legend" });
  const panel = el("section", { class: "scene-legend", "aria-label": "Colours" },
    el("div", { class: "scene-legend-head" }, choice, fold), list);
  const open = (wanted: boolean) => {
    list.hidden = !wanted;
    fold.setAttribute("aria-expanded", String(wanted));
    fold.title = wanted ? "Fold the legend" : "Show what the colours mean";
    fold.setAttribute("aria-label", fold.title);
  };
  let rows: Row[] = [];
  const press = () => {
    const { isolated } = store.shown;
    for (const { parts, button } of rows) {
      button.setAttribute("aria-pressed", String(!!isolated && parts.length > 0 && parts.every((row) => isolated.has(row))));
    }
  };
  const update = () => {
    choice.value = store.shown.colorBy;
    rows = fillRows(list, store);
    press();
  };
  store.watch(["colorBy"], update);
  store.watch(["isolated"], press);
  store.on("content", update);
  update();
  open(view.element.clientWidth >= LEAST_WIDTH);
  return panel;
}

function fillRows(list: HTMLElement, store: Store): Row[] {
  list.replaceChildren();
  const { entries, hatched } = colorParts(store.content!, store.shown.colorBy);
  const rows = entries.slice(0, MOST_ROWS).map((entry) => rowOf(entry, store));
  const unlabelled = new Set(entries.flatMap((entry) => (entry.hatched ? entry.parts : [])));
  const unsure = [...hatched.keys()].filter((row) => hatched[row] && !unlabelled.has(row));
  if (unsure.length) rows.push(rowOf({ label: "Not sure", color: "", hatched: true, parts: unsure }, store));
  list.append(...rows.map(({ button }) => el("li", {}, button)));
  if (entries.length > MOST_ROWS) list.append(el("li", { class: "scene-soft" }, `and ${entries.length - MOST_ROWS} more with fewer parts`));
  if (!entries.length) list.append(el("li", { class: "scene-soft" }, "Each mesh has the colour that the file gives it."));
  return rows;
}

function rowOf(entry: LegendEntry, store: Store): Row {
  const swatch = el("span", { class: entry.hatched ? "scene-swatch is-hatched" : "scene-swatch" });
  if (entry.color) swatch.style.backgroundColor = entry.color;
  const { parts } = entry;
  const button = el("button", {
    type: "button", class: "scene-legend-row", "data-test": "legend-row", disabled: !parts.length,
    title: `${entry.label}: show only ${parts.length === 1 ? "this part" : `these ${parts.length} parts`}; with Ctrl these, too`,
    onclick: (event: MouseEvent) => isolate(store, parts, event.ctrlKey || event.metaKey),
  }, swatch, el("span", { class: "scene-legend-label" }, entry.label), el("span", { class: "scene-soft" }, String(parts.length)));
  return { parts, button };
}

/** Shows only these parts, or all again where that is so already; with `adding` beside what is shown. */
function isolate(store: Store, parts: readonly number[], adding: boolean): void {
  const { isolated } = store.shown;
  const all = !!isolated && parts.every((row) => isolated.has(row));
  if (!adding) {
    store.set({ isolated: all && isolated.size === parts.length ? null : new Set(parts) });
    return;
  }
  const next = new Set(isolated ?? []);
  for (const row of parts) if (all) next.delete(row); else next.add(row);
  store.set({ isolated: next.size ? next : null });
}
