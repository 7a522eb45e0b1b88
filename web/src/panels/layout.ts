// Where things stand: panels left and right of the view, panes below it; all can be sized and folded away.

import type { LeftTab, Store } from "../store.ts";
import { el } from "../dom.ts";
import { iconButton } from "./widgets.ts";
import { remember, remembered } from "./page.ts";

export interface Layout {
  root: HTMLElement;
  middle: HTMLElement;
  schematicPane: HTMLElement;
  tabs: Map<LeftTab, { button: HTMLButtonElement; panel: HTMLElement; badge: HTMLElement }>;
  toggle: (side: "left" | "right", open?: boolean) => void;
  isOpen: (side: "left" | "right") => boolean;
}

interface Bounds {
  key: string;
  start: number;
  least: number;
  most: () => number;
}

const NARROW = 900;
/** The table keeps this width beside the drawing [px]. */
const TABLE = 240;

export function layOut(
  store: Store, top: HTMLElement, inspector: HTMLElement, table: HTMLElement, panels: Record<LeftTab, HTMLElement>
): Layout {
  const middle = el("main", { class: "middle", id: "view", "aria-label": "The plant" });
  const schematicPane = el(
    "section", { class: "schematic-pane", id: "schematic", "aria-label": "Schematic", "data-test": "schematic" }
  );
  const { element: left, tabs } = leftPanel(store, panels);
  const right = el("aside", { class: "right", "aria-label": "Inspector", id: "right" }, inspector);
  const bottom = el("div", { class: "bottom" }, schematicPane, table);
  const center = el("div", { class: "center" }, middle, bottom);
  const body = el("div", { class: "body" }, left, center, right);
  const root = el("div", { class: "page" }, top, body);

  const size = (name: string) => (value: number) => root.style.setProperty(name, `${value}px`);
  left.after(
    splitter(
      "Width of the left panel", "vertical",
      { key: "left", start: 300, least: 230, most: () => Math.min(520, innerWidth * 0.45) }, size("--left"),
      (now, moved) => now + moved.x
    )
  );
  right.before(
    splitter(
      "Width of the inspector", "vertical",
      { key: "right", start: 310, least: 240, most: () => Math.min(560, innerWidth * 0.45) }, size("--right"),
      (now, moved) => now - moved.x
    )
  );
  bottom.before(
    splitter(
      "Height of the panes below", "horizontal",
      { key: "bottom", start: 240, least: 100, most: () => innerHeight * 0.7 }, size("--bottom"),
      (now, moved) => now - moved.y
    )
  );
  schematicPane.after(
    splitter(
      "Width of the schematic", "vertical",
      { key: "drawing", start: 330, least: 160, most: () => (center.clientWidth || innerWidth) - TABLE },
      size("--drawing"), (now, moved) => now + moved.x
    )
  );

  const open = { left: true, right: true };
  const handles = {
    left: iconButton("left", "Fold the left panel away ([)", () => toggle("left"), "fold-left"),
    right: iconButton("right", "Fold the inspector away (])", () => toggle("right"), "fold-right"),
  };
  for (const side of ["left", "right"] as const) {
    handles[side].classList.add("handle", `handle-${side}`);
    middle.append(handles[side]);
  }
  const toggle = (side: "left" | "right", wanted = !open[side]) => {
    open[side] = wanted;
    // On a narrow window the panels lie over the view, one at a time.
    if (wanted && innerWidth < NARROW) setOpen(side === "left" ? "right" : "left", false);
    setOpen(side, wanted);
    remember(`open-${side}`, String(wanted));
  };
  const setOpen = (side: "left" | "right", wanted: boolean) => {
    open[side] = wanted;
    root.classList.toggle(`no-${side}`, !wanted);
    const words = side === "left" ? "the left panel ([)" : "the inspector (])";
    handles[side].title = wanted ? `Fold ${words} away` : `Show ${words}`;
    handles[side].setAttribute("aria-label", handles[side].title);
    handles[side].setAttribute("aria-expanded", String(wanted));
  };
  for (const side of ["left", "right"] as const) setOpen(
    side, innerWidth >= NARROW && remembered(`open-${side}`) !== "false"
  );

  matchMedia(`(max-width: ${NARROW - 1}px)`).addEventListener("change", ({ matches }) => {
    for (const side of ["left", "right"] as const) setOpen(side, !matches && remembered(`open-${side}`) !== "false");
  });

  const panes = () => {
    root.classList.toggle("with-drawing", store.shown.schematic);
    root.classList.toggle("with-table", store.shown.table);
  };
  store.watch(["schematic", "table"], panes);
  panes();
  return { root, middle, schematicPane, tabs, toggle, isOpen: (side) => open[side] };
}

const TABS: [LeftTab, string, string][] = [
  ["review", "Review", "What is most worth a look (r)"],
  ["find", "Find", "Search the plant (/)"],
  ["network", "Network", "Systems, lines and units"],
  ["warnings", "Warnings", "What is doubtful"],
  ["history", "History", "What was corrected"],
];

function leftPanel(store: Store, panels: Record<LeftTab, HTMLElement>): { element: HTMLElement; tabs: Layout["tabs"] } {
  const bar = el("div", { class: "tabs", role: "tablist", "aria-label": "Left panel" });
  const tabs: Layout["tabs"] = new Map();
  const element = el(
    "aside", { class: "left", "aria-label": "Review, find, network, warnings, history", id: "left" }, bar
  );
  for (const [key, text, title] of TABS) {
    const badge = el("span", { class: "badge", hidden: true });
    const button = el(
      "button",
      {
        type: "button", role: "tab", id: `tab-${key}`, "aria-controls": `panel-${key}`, title,
        "data-test": `tab-${key}`, onclick: () => store.set({ leftTab: key })
      },
      text, badge
    );
    const panel = el(
      "div",
      { role: "tabpanel", id: `panel-${key}`, class: "tab-panel", "aria-labelledby": `tab-${key}`, tabindex: "-1" },
      panels[key]
    );
    tabs.set(key, { button, panel, badge });
    bar.append(button);
    element.append(panel);
  }
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const order = [...tabs.keys()].filter((key) => !tabs.get(key)!.button.hidden);
    const next = order[(order.indexOf(store.shown.leftTab) + step + order.length) % order.length];
    store.set({ leftTab: next });
    tabs.get(next)!.button.focus();
    event.preventDefault();
  });
  const show = () => {
    for (const [key, { button, panel }] of tabs) {
      const on = key === store.shown.leftTab;
      button.setAttribute("aria-selected", String(on));
      button.tabIndex = on ? 0 : -1;
      panel.hidden = !on;
    }
  };
  store.watch(["leftTab"], show);
  show();
  return { element, tabs };
}

/** A border that can be dragged, or moved by the arrow keys. */
function splitter(
  label: string, direction: "vertical" | "horizontal", bounds: Bounds, apply: (value: number) => void,
  moved: (now: number, by: { x: number; y: number }) => number
): HTMLElement {
  const saved = Number(remembered(`size-${bounds.key}`));
  let now = 0;
  const bar = el(
    "div",
    {
      class: `splitter ${direction} split-${bounds.key}`, role: "separator", tabindex: "0",
      "aria-orientation": direction, "aria-label": label
    }
  );
  const set = (value: number) => {
    now = Math.round(Math.max(bounds.least, Math.min(Math.max(bounds.most(), bounds.least), value)));
    bar.setAttribute("aria-valuenow", String(now));
    apply(now);
  };
  set(saved > 0 ? saved : bounds.start);
  const keep = () => remember(`size-${bounds.key}`, String(now));
  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    const from = { x: event.clientX, y: event.clientY, now };
    const move = (event: PointerEvent) => set(
      moved(from.now, { x: event.clientX - from.x, y: event.clientY - from.y })
    );
    bar.addEventListener("pointermove", move);
    bar.addEventListener(
      "lostpointercapture", () => { bar.removeEventListener("pointermove", move); keep(); }, { once: true }
    );
    event.preventDefault();
  });
  bar.addEventListener("dblclick", () => { set(bounds.start); keep(); });
  bar.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-16, 0], ArrowRight: [16, 0], ArrowUp: [0, -16], ArrowDown: [0, 16] }[event.key];
    if (!by) return;
    set(moved(now, { x: by[0], y: by[1] }));
    keep();
    event.preventDefault();
    event.stopPropagation();
  });
  return bar;
}
