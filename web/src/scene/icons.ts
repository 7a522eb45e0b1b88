// Icons and buttons of the tools.

import { el, svg } from "../dom.ts";

/** Lines on a grid of 24; what comes after "|" is filled. */
const ICONS = {
  home: "M4 11.5 12 5l8 6.5M6.5 10v9h11v-9M10.5 19v-5h3v5",
  fly: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4|M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  hide: "M4 4l16 16M9.5 6.2A10 10 0 0 1 12 6c4.5 0 7.6 3 9 6a12 12 0 0 1-2.6 3.6M6 8a12 12 0 0 0-3 4c1.4 3 4.5 6 9 6a9.6 9.6 0 0 0 3.6-.7M10 10a2.9 2.9 0 0 0 4 4",
  isolate: "M12 3l8 4.5v9L12 21l-8-4.5v-9z|M12 8.5l3.5 2v4L12 16.5l-3.5-2v-4z",
  all: "M3 12c1.4-3 4.5-6 9-6s7.6 3 9 6c-1.4 3-4.5 6-9 6s-7.6-3-9-6z|M12 9.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6z",
  ghost: "M5 20V11a7 7 0 0 1 14 0v9l-2.4-2-2.3 2-2.3-2-2.3 2-2.3-2z|M9.5 9.8a1.2 1.2 0 1 0 0 2.4 1.2 1.2 0 0 0 0-2.4zM14.5 9.8a1.2 1.2 0 1 0 0 2.4 1.2 1.2 0 0 0 0-2.4z",
  section: "M4 8l8-4 8 4v8l-8 4-8-4zM12 4v16|M12 4l8 4v8l-8 4z",
  explode: "M12 9.5V3M9.5 5 12 2.6 14.5 5M12 14.5V21M9.5 19l2.5 2.4L14.5 19M9.5 12H3M5 9.5 2.6 12 5 14.5M14.5 12H21M19 9.5l2.4 2.5-2.4 2.5",
  measure: "M3 15.5 15.5 3 21 8.5 8.5 21zM6.5 12l2 2M9.5 9l3 3M12.5 6l2 2",
  parallel: "M4 8h11v12H4zM9 4h11v12M4 8l5-4M15 8l5-4M15 20l5-4",
  picture: "M4 7.5h4L9.5 5h5L16 7.5h4v11.5H4zM12 9.8a3.4 3.4 0 1 0 0 6.8 3.4 3.4 0 0 0 0-6.8z",
  close: "M6 6l12 12M18 6 6 18",
  flip: "M12 4v16M8 8l-4 4 4 4M16 8l4 4-4 4",
  down: "M6 9.5l6 6 6-6",
} as const;

export type IconName = keyof typeof ICONS;

/** A line icon; what holds it carries the words. */
export function icon(name: IconName): SVGElement {
  const [lines, filled] = ICONS[name].split("|");
  return svg("svg", { viewBox: "0 0 24 24", class: "scene-icon", "aria-hidden": "true" },
    svg("path", { d: lines }), ...(filled ? [svg("path", { d: filled, class: "is-filled" })] : []));
}

export function iconButton(name: IconName, title: string, test: string, run: () => void): HTMLButtonElement {
  return el("button", { type: "button", class: "scene-button", title, "aria-label": title, "data-test": test, onclick: run },
    icon(name));
}

/** Gives the keys back to the view after a mouse was at a slider or list, which would take them. */
export function keysBack(input: HTMLElement, view: { element: HTMLElement }): void {
  let byMouse = false;
  const back = () => {
    if (byMouse) view.element.querySelector<HTMLElement>("canvas")?.focus({ preventScroll: true });
    byMouse = false;
  };
  input.addEventListener("pointerdown", () => (byMouse = true));
  input.addEventListener("keydown", () => (byMouse = false));
  input.addEventListener("change", back);
}
