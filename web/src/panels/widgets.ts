// Small things that the page is made of: icons, bars, swatches, folds.

import { el, svg } from "../dom.ts";
import type { Child, Handler } from "../dom.ts";

/** A bar for a share of 0..1; said to screen readers by its label. */
export function bar(share: number, label: string, kind = ""): HTMLElement {
  const inner = el("span", { class: "bar-fill" });
  inner.style.width = `${Math.round(100 * Math.max(0, Math.min(1, share)))}%`;
  return el("span", { class: `bar ${kind}`, role: "img", "aria-label": label }, inner);
}

const ICONS: Record<string, string> = {
  undo: "M9 7 4 12l5 5M4 12h10a6 6 0 0 1 0 12h-2",
  redo: "M15 7l5 5-5 5M20 12H10a6 6 0 0 0 0 12h2",
  help: "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.1-1.5 2.4M12 18v.01",
  link: "M10 14a4 4 0 0 0 5.7 0l3-3a4 4 0 0 0-5.7-5.7l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",
  sun: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v3M12 19v3M2 12h3M19 12h3M5 5l2 2M17 17l2 2M19 5l-2 2M7 17l-2 2",
  moon: "M20 14.5A8.5 8.5 0 0 1 9.5 4 8.5 8.5 0 1 0 20 14.5z",
  left: "M14 6l-6 6 6 6",
  right: "M10 6l6 6-6 6",
  search: "M11 5a6 6 0 1 0 0 12 6 6 0 0 0 0-12zM15.5 15.5 21 21",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  close: "M6 6l12 12M18 6 6 18",
  edit: "M4 20l1-5L16 4l4 4L9 19zM14 6l4 4",
  table: "M4 5h16v14H4zM4 10h16M4 15h16M10 5v14",
  drawing: "M4 12h4M16 12h4M8 8l8 8V8l-8 8z",
  check: "M5 12l5 5 9-10",
  warn: "M12 4 2.5 20h19zM12 10v5M12 17.5v.01",
  dot: "M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
};

/** A line icon; decoration: what holds it carries the words. */
export function icon(name: keyof typeof ICONS & string): SVGElement {
  const viewBox = name === "undo" || name === "redo" ? "0 3 24 24" : "0 0 24 24";
  return svg("svg", { viewBox, class: "icon", "aria-hidden": "true" }, svg("path", { d: ICONS[name] }));
}

/** A button with an icon alone; its title says what it does. */
export function iconButton(name: string, title: string, run: Handler, test = ""): HTMLButtonElement {
  return el(
    "button",
    { type: "button", class: "icon-button", title, "aria-label": title, "data-test": test || null, onclick: run },
    icon(name)
  );
}

/** A small square in the colour of a group; striped where the label is not sure, hatched where there is none. */
export function swatch(color: string | null, state: "sure" | "likely" | "open"): HTMLElement {
  const made = el("span", { class: `swatch ${color ? state : "open"}`, "aria-hidden": "true" });
  if (color) made.style.setProperty("--swatch", color);
  return made;
}

/** A section that folds; it remembers nothing. */
export function fold(title: string, open: boolean, ...children: Child[]): HTMLDetailsElement {
  return el("details", { class: "fold", open }, el("summary", {}, title), ...children);
}
