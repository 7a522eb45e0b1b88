// The tool that measures: what the cursor catches, lines and labels over the plant that follow it.

import { Vector3 } from "three";
import type { Store } from "../store.ts";
import { el, svg } from "../dom.ts";
import { iconButton } from "./icons.ts";
import { besideLine, besideOthers, catchPoint, measure, measuredText } from "./measure.ts";
import type { Box, Caught } from "./measure.ts";
import type { PlantView } from "./plant_view.ts";

const LOOK_EVERY = 40; // ms: reading a pixel back waits for the card
const SAME = 1e-7; // m

interface Drawn {
  from: Vector3;
  to: Vector3;
  group: SVGGElement;
  label: HTMLElement;
  /** Of the label [px]. */
  size: { width: number; height: number };
}

export class MeasureTool {
  readonly overlay: HTMLElement;
  readonly panel: HTMLElement;
  private readonly view: PlantView;
  private readonly store: Store;
  private readonly lines = svg("svg", { class: "scene-measure-lines", "aria-hidden": "true" });
  private readonly cursor = svg("g", { class: "scene-catch" });
  private readonly hint = el("span", { role: "status", "data-test": "measure-hint" });
  private readonly clear: HTMLButtonElement;
  private readonly kept: Drawn[] = [];
  private preview: Drawn | null = null;
  private first: Caught | null = null;
  private caught: Caught | null = null;
  private timer = 0;
  /** The last measurement in words, until the next one begins. */
  private said = "";

  constructor(view: PlantView, store: Store) {
    this.view = view;
    this.store = store;
    this.lines.append(this.cursor);
    this.overlay = el("div", { class: "scene-measure", "data-test": "measurements" }, this.lines);
    this.clear = el("button", { type: "button", "data-test": "measure-clear", onclick: () => this.removeAll() }, "Remove all");
    this.panel = el("div", { class: "scene-card", role: "group", "aria-label": "Measure", "data-test": "measure-panel" },
      el("span", { class: "scene-card-title" }, "Measure"), this.hint, this.clear,
      iconButton("close", "End measuring (Esc)", "measure-close", () => store.set({ tool: "select" })));
    view.onFrame(() => this.place());
    view.element.querySelector("canvas")!.addEventListener("pointerleave", () => this.look(null));
    store.watch(["tool"], () => this.update());
    this.update();
  }

  private get isOn(): boolean {
    return this.store.shown.tool === "measure";
  }

  isBusy(): boolean {
    return this.isOn || this.kept.length > 0;
  }

  /** Drops the first point, else ends the tool, else removes what was measured. */
  escape(): boolean {
    if (this.first) this.drop();
    else if (this.isOn) this.store.set({ tool: "select" });
    else if (this.kept.length) this.removeAll();
    else return false;
    return true;
  }

  hovered(x: number, y: number): boolean {
    if (!this.isOn) return false;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.look(this.catchAt(x, y)), LOOK_EVERY);
    return true;
  }

  clicked(x: number, y: number): boolean {
    if (!this.isOn) return false;
    const caught = this.catchAt(x, y);
    if (caught && !this.first) {
      this.first = caught;
      this.said = "";
    } else if (caught && caught.point.distanceTo(this.first!.point) > SAME) this.keep(caught);
    this.look(caught);
    this.update();
    return true;
  }

  private catchAt(x: number, y: number): Caught | null {
    const hit = this.view.pickHit(x, y);
    return hit && catchPoint(hit, { x, y }, (point) => this.view.project(point.toArray()));
  }

  private keep(to: Caught): void {
    const from = this.first!;
    const [distance, along, between] = measuredText(measure(from, to));
    const drawn = this.draw(from.point, to.point, distance, along, between);
    drawn.label.classList.add("is-kept");
    drawn.label.append(iconButton("close", `Remove this measurement: ${distance}`, "measure-remove", () => this.remove(drawn)));
    drawn.size.width = drawn.label.offsetWidth;
    this.kept.push(drawn);
    this.said = `${distance}${between ? `, ${between}` : ""}. Click the next first point.`;
    this.drop();
  }

  private look(caught: Caught | null): void {
    window.clearTimeout(this.timer);
    this.caught = this.isOn ? caught : null;
    this.cursor.replaceChildren(...(this.caught ? [markOf(this.caught.kind)] : []));
    this.erase(this.preview);
    this.preview = null;
    if (this.first && this.caught && this.first.point.distanceTo(this.caught.point) > SAME) {
      const [distance, along, between] = measuredText(measure(this.first, this.caught));
      this.preview = this.draw(this.first.point, this.caught.point, distance, along, between);
    }
    this.place();
  }

  private draw(from: Vector3, to: Vector3, distance: string, along: string, between: string | null): Drawn {
    const group = svg("g");
    for (const name of ["leg is-x", "leg is-y", "leg is-z", "casing", "line"]) group.append(svg("line", { class: `scene-measure-${name}` }));
    for (let i = 0; i < 2; i++) group.append(svg("circle", { r: 3.5, class: "scene-measure-end" }));
    this.lines.insertBefore(group, this.cursor);
    const label = el("div", { class: "scene-measure-label", "data-test": "measurement" },
      el("div", {}, el("strong", {}, distance), el("div", { class: "scene-measure-along" }, along), between && el("div", {}, between)));
    this.overlay.append(label);
    return { from, to, group, label, size: { width: label.offsetWidth, height: label.offsetHeight } };
  }

  private erase(drawn: Drawn | null): void {
    drawn?.group.remove();
    drawn?.label.remove();
  }

  private remove(drawn: Drawn): void {
    this.erase(drawn);
    this.kept.splice(this.kept.indexOf(drawn), 1);
    this.update();
  }

  private removeAll(): void {
    for (const drawn of this.kept) this.erase(drawn);
    this.kept.length = 0;
    this.drop();
    this.update();
  }

  private drop(): void {
    this.first = null;
    this.look(this.caught);
    this.update();
  }

  private update(): void {
    if (!this.isOn) {
      this.first = null;
      this.said = "";
      if (this.caught || this.preview) this.look(null);
    }
    this.view.element.classList.toggle("is-measuring", this.isOn);
    this.panel.hidden = !this.isOn;
    this.clear.hidden = !this.kept.length;
    this.hint.textContent = this.first ? "Click the second point." : this.said || "Click the first point: corners and edges catch.";
    this.place();
  }

  /** Puts everything where its points appear now. */
  private place(): void {
    if (!this.caught && !this.kept.length && !this.preview && !this.first) return;
    const at = this.first && !this.caught ? this.first : this.caught;
    const mark = at && this.view.project(at.point.toArray());
    this.cursor.toggleAttribute("hidden", !mark);
    if (mark) this.cursor.setAttribute("transform", `translate(${mark.x} ${mark.y})`);
    const taken: Box[] = [];
    for (const drawn of this.preview ? [...this.kept, this.preview] : this.kept) this.placeOne(drawn, taken);
  }

  /** Draws a measurement; its label covers none of those before it. */
  private placeOne({ from, to, group, label, size }: Drawn, taken: Box[]): void {
    const corner = new Vector3(to.x, from.y, from.z);
    const above = new Vector3(to.x, to.y, from.z);
    const [a, b, c, d] = [from, to, corner, above].map((point) => this.view.project(point.toArray()));
    const seen = !!a && !!b && !!c && !!d;
    group.toggleAttribute("hidden", !seen);
    label.hidden = !seen;
    if (!seen) return;
    const ends = [[a, c], [c, d], [d, b], [a, b], [a, b]];
    [...group.querySelectorAll("line")].forEach((line, i) => {
      const [start, end] = ends[i];
      for (const [key, value] of [["x1", start.x], ["y1", start.y], ["x2", end.x], ["y2", end.y]] as const) {
        line.setAttribute(key, value.toFixed(1));
      }
    });
    [...group.querySelectorAll("circle")].forEach((circle, i) => {
      circle.setAttribute("cx", [a, b][i].x.toFixed(1));
      circle.setAttribute("cy", [a, b][i].y.toFixed(1));
    });
    const beside = besideOthers(besideLine(a, b, size), size, taken);
    taken.push(beside);
    label.style.transform = `translate(${(beside.x - size.width / 2).toFixed(1)}px, ${(beside.y - size.height / 2).toFixed(1)}px)`;
  }
}

/** What is caught is told by its form: a square on a corner, a triangle on an edge, a ring on a face. */
function markOf(kind: Caught["kind"]): SVGElement {
  if (kind === "corner") return svg("rect", { x: -5, y: -5, width: 10, height: 10 });
  if (kind === "edge") return svg("path", { d: "M0 -6.5 6 4.5H-6z" });
  return svg("circle", { r: 5 });
}
