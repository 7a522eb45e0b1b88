// How the axes stand, in a corner of the view; its ends and its middle turn the plant.

import { Vector3 } from "three";
import { el, svg } from "../dom.ts";
import type { PlantView } from "./plant_view.ts";

const SIZE = 76; // px
const REACH = 28;
/** A little from the south, so that a plan has north above as on paper. */
const NORTH_UP = new Vector3(0, -0.0075, 0);

interface End {
  name: string;
  way: Vector3;
  button: HTMLButtonElement;
  line: SVGLineElement | null;
}

export function axesWidget(view: PlantView): HTMLElement {
  const middle = SIZE / 2;
  const lines = svg("svg", { viewBox: `0 0 ${SIZE} ${SIZE}`, "aria-hidden": "true" });
  const ends = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"].map((name): End => {
    const positive = name[0] === "+";
    const axis = name[1].toLowerCase();
    const way = new Vector3().setComponent("XYZ".indexOf(name[1]), positive ? 1 : -1);
    const words = `Look from ${name}${{ "+Z": " (top)", "-Z": " (below)" }[name] ?? ""}`;
    const button = el("button", {
      type: "button", class: `scene-axis is-${axis}${positive ? "" : " is-back"}`, title: words, "aria-label": words,
      "data-test": `axis${name}`, onclick: () => view.lookAlong(way.clone().add(NORTH_UP)),
    }, positive ? name[1] : null);
    const line = positive ? svg("line", { class: `scene-axis-line is-${axis}`, x1: middle, y1: middle }) : null;
    if (line) lines.append(line);
    return { name, way, button, line };
  });
  const home = el("button", { type: "button", class: "scene-axis is-home", title: "The whole plant (0)", "aria-label": "The whole plant", "data-test": "axis-home", onclick: () => view.home() });
  const widget = el("div", { class: "scene-axes", role: "group", "aria-label": "Directions", "data-test": "axes" },
    lines, home, ...ends.map(({ button }) => button));
  const point = new Vector3();
  let before = "";
  const place = () => {
    const turn = view.camera.matrixWorldInverse;
    const now = turn.elements.slice(0, 11).map((value) => value.toFixed(3)).join();
    if (now === before) return;
    before = now;
    for (const { way, button, line } of ends) {
      point.copy(way).transformDirection(turn);
      const [x, y] = [point.x * REACH, -point.y * REACH];
      button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      button.style.zIndex = String(Math.round(4 + 3 * point.z));
      button.classList.toggle("is-far", point.z < -0.2);
      line?.setAttribute("x2", (middle + x).toFixed(1));
      line?.setAttribute("y2", (middle + y).toFixed(1));
    }
  };
  view.onFrame(place);
  place();
  return widget;
}
