// The schematic beside the plant: zoom, pan, and the same things lit as in 3D.

import type { Source } from "../api.ts";
import type { Store } from "../store.ts";
import { type Box2d, fitted, type Frame2d, opened, showing, zoomed } from "./camera2d.ts";
import { el, svg } from "../dom.ts";
import type { Focus } from "./focus.ts";
import { connectionsOf, markOf } from "./pieces.ts";
import type { Plan } from "./plan.ts";
import { readDrawing } from "./sanitize.ts";

export interface SchematicActions {
  place(id: string): void;
  line(row: number): void;
}

const QUIET = 250; // ms after the last change of the content before the drawing is fetched anew
const DRAG = 4; // px, below that a press is a click

export class Schematic {
  private readonly sheet = svg("g", {});
  private readonly halos = svg("g", { class: "net-halos" });
  private readonly drawn = svg("g", {});
  private readonly canvas: SVGSVGElement;
  private readonly note = el("p", { class: "net-empty", role: "status" }, "Drawing the schematic…");
  private readonly partly = el("p", { class: "net-sheet-partly", hidden: true, "data-test": "sheet-partly" },
    el("span", { class: "net-stroke is-partly", "aria-hidden": "true" }), "partly in it: what of it, the plant shows");
  private frame: Frame2d | null = null;
  private size = { width: 1, height: 1 };
  /** By what they stand for: "place ID" or "connection ROW". */
  private elements = new Map<string, SVGGraphicsElement[]>();
  private pieces: { element: SVGGraphicsElement; rows: readonly number[] }[] = [];
  private version = -1;
  private timer = 0;
  private asked = 0;
  private touched = false;
  private lastShown = "";
  private readonly store: Store;
  private readonly source: Source;
  private readonly focus: Focus;
  private readonly planNow: () => Plan;
  private readonly actions: SchematicActions;

  constructor(
    pane: HTMLElement, store: Store, source: Source, focus: Focus, planNow: () => Plan, actions: SchematicActions,
  ) {
    this.store = store;
    this.source = source;
    this.focus = focus;
    this.planNow = planNow;
    this.actions = actions;
    this.sheet.append(this.halos, this.drawn);
    this.canvas = svg("svg", { class: "net-sheet", role: "img", "aria-label": "Schematic of the plant" }, this.sheet);
    pane.classList.add("net-schematic");
    pane.append(this.toolbar(), this.canvas, this.partly, this.note);
    this.listen();
    new ResizeObserver(() => this.resized()).observe(this.canvas);
  }

  /** Shown or not; the drawing is fetched when it is first shown, and when the content has changed since. */
  refresh(): void {
    if (!this.store.shown.schematic) return;
    const version = this.store.content?.version ?? -1;
    if (version !== this.version) {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => void this.load(), this.version < 0 ? 0 : QUIET);
    }
    this.light();
  }

  /** Shows the whole drawing. */
  fit(): void {
    const box = this.sheetSize();
    if (!box) return;
    this.touched = true;
    this.look(fitted(box, this.size));
  }

  private open(): void {
    const box = this.sheetSize();
    if (box) this.look(opened(box, this.size));
  }

  zoom(factor: number): void {
    this.touched = true;
    if (this.frame) this.look(zoomed(this.frame, factor, this.size.width / 2, this.size.height / 2, 0.05));
  }

  toSelection(): void {
    this.show(this.selected(), true);
  }

  private async load(): Promise<void> {
    const version = this.store.content?.version ?? -1;
    const turn = ++this.asked;
    let text: string;
    try {
      text = await this.source.schematic();
    } catch (error) {
      if (turn === this.asked) this.tell(error instanceof Error ? error.message : "The schematic could not be fetched.");
      return;
    }
    if (turn !== this.asked) return;
    this.version = version;
    const drawing = readDrawing(text);
    if (!drawing) {
      this.tell("The schematic could not be read.");
      return;
    }
    this.tell("");
    this.adopt(drawing);
  }

  private adopt(drawing: SVGSVGElement): void {
    drawing.classList.add("schematic");
    // The drawing's own title would be the tooltip of all of it.
    for (const child of [...drawing.children]) if (child.localName === "title") child.remove();
    for (const line of drawing.querySelectorAll("path[data-line]")) widen(line);
    this.drawn.replaceChildren(drawing);
    this.elements.clear();
    const plan = this.planNow();
    this.pieces = [];
    for (const element of drawing.querySelectorAll<SVGGraphicsElement>("[data-id],[data-line],[data-connection]")) {
      const id = element.getAttribute("data-id");
      if (id !== null) this.keep(`place ${id}`, element);
      else {
        const rows = connectionsOf(element, plan);
        this.pieces.push({ element, rows });
        for (const row of rows) this.keep(`connection ${row}`, element);
      }
    }
    if (this.measure() && (!this.frame || !this.touched)) this.open();
    this.lastShown = "";
    this.light();
  }

  private keep(key: string, element: SVGGraphicsElement): void {
    const known = this.elements.get(key);
    if (known) known.push(element);
    else this.elements.set(key, [element]);
  }

  /** Lights what is selected, hovered and marked; goes there if it is out of sight. */
  private light(): void {
    const { marks } = this.store.shown;
    const selected = this.selected();
    const hovered = new Set<string>();
    if (this.focus.hoveredPlace) hovered.add(`place ${this.focus.hoveredPlace}`);
    for (const row of this.focus.hoveredConnections) hovered.add(`connection ${row}`);
    const marked = new Set([...marks?.places ?? []].map((id) => `place ${id}`));
    this.drawn.classList.toggle("has-marks", marks !== null);
    for (const [key, elements] of this.elements) {
      if (!key.startsWith("place ")) continue;
      const close = marks?.close.has(key.slice("place ".length)) ?? false;
      for (const { classList } of elements) {
        classList.toggle("is-selected", selected.has(key));
        classList.toggle("is-hovered", hovered.has(key));
        classList.toggle("is-marked", marked.has(key));
        classList.toggle("is-close", close);
      }
    }
    let partly = false;
    for (const { element: { classList }, rows } of this.pieces) {
      const mark = marks ? markOf(rows, marks.connections) : "none";
      classList.toggle("is-selected", rows.some((row) => selected.has(`connection ${row}`)));
      classList.toggle("is-hovered", rows.some((row) => hovered.has(`connection ${row}`)));
      classList.toggle("is-marked", mark === "all");
      classList.toggle("is-partly", mark === "partly");
      partly ||= mark === "partly" && classList.contains("p");
    }
    this.partly.hidden = !partly;
    this.drawHalos(selected, marks ? [...marks.close].map((id) => `place ${id}`) : []);
    this.follow(selected);
  }

  private drawHalos(selected: ReadonlySet<string>, close: readonly string[]): void {
    const halos: SVGElement[] = [];
    const add = (key: string, name: string) => {
      const box = key.startsWith("place ") ? this.boxOf(new Set([key])) : null;
      if (!box) return;
      halos.push(svg("rect", {
        class: name, x: String(box.x - 4), y: String(box.y - 4), width: String(box.width + 8), height: String(box.height + 8), rx: "5",
      }));
    };
    close.forEach((key) => add(key, "is-close"));
    selected.forEach((key) => add(key, "is-selected"));
    this.halos.replaceChildren(...halos);
  }

  private follow(selected: ReadonlySet<string>): void {
    const name = [...selected].sort().join("\n");
    if (name === this.lastShown || !this.elements.size) return;
    this.lastShown = name;
    this.show(selected, false);
  }

  private show(keys: ReadonlySet<string>, closer: boolean): void {
    const box = this.boxOf(keys);
    const sheet = this.sheetSize();
    if (!box || !sheet || !this.frame || !this.measure()) return;
    const frame = showing(this.frame, box, sheet, this.size, closer);
    if (frame === this.frame) return;
    this.touched = true;
    this.look(frame);
  }

  private selected(): Set<string> {
    const found = new Set<string>();
    const { place } = this.focus;
    if (place) found.add(`place ${place.id}`);
    for (const row of this.focus.connections) found.add(`connection ${row}`);
    return found;
  }

  /** Around some elements, in the drawing's own pixels. */
  private boxOf(keys: ReadonlySet<string>): Box2d | null {
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const key of keys) {
      for (const element of this.elements.get(key) ?? []) {
        const box = element.getBBox();
        const matrix = matrixIn(element, this.drawn);
        for (const [x, y] of [[box.x, box.y], [box.x + box.width, box.y + box.height]]) {
          const at = new DOMPoint(x, y).matrixTransform(matrix);
          [left, right] = [Math.min(left, at.x), Math.max(right, at.x)];
          [top, bottom] = [Math.min(top, at.y), Math.max(bottom, at.y)];
        }
      }
    }
    return left > right ? null : { x: left, y: top, width: right - left, height: bottom - top };
  }

  private look(frame: Frame2d): void {
    this.frame = frame;
    this.sheet.setAttribute("transform", `translate(${frame.x} ${frame.y}) scale(${frame.zoom})`);
  }

  private sheetSize(): { width: number; height: number } | null {
    const drawing = this.drawn.firstElementChild;
    const width = Number(drawing?.getAttribute("width"));
    const height = Number(drawing?.getAttribute("height"));
    return width > 0 && height > 0 ? { width, height } : null;
  }

  private resized(): void {
    if (this.measure() && !this.touched) this.open();
  }

  /** False where the pane isn't there to be seen. */
  private measure(): boolean {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return false;
    this.size = { width, height };
    return true;
  }

  private tell(text: string): void {
    this.note.textContent = text;
    this.note.hidden = text === "";
  }

  private toolbar(): HTMLElement {
    const button = (test: string, text: string, title: string, run: () => void) =>
      el("button", { type: "button", "data-test": test, title, "aria-label": title, onclick: run }, text);
    return el("div", { class: "net-sheet-tools", role: "toolbar", "aria-label": "Schematic" },
      button("sheet-out", "−", "Smaller", () => this.zoom(1 / 1.4)),
      button("sheet-in", "+", "Larger", () => this.zoom(1.4)),
      button("sheet-fit", "Fit", "Show the whole schematic", () => this.fit()),
      button("sheet-selection", "To selection", "Show what is selected", () => this.toSelection()));
  }

  private listen(): void {
    const { canvas } = this;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (!this.frame) return;
      const box = canvas.getBoundingClientRect();
      const step = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
      this.touched = true;
      this.look(zoomed(this.frame, Math.exp(-step * 0.0016), event.clientX - box.left, event.clientY - box.top, 0.05));
    }, { passive: false });
    let from: { x: number; y: number; frame: Frame2d; moved: boolean } | null = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (this.frame && event.button <= 1) from = { x: event.clientX, y: event.clientY, frame: this.frame, moved: false };
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!from) {
        this.hover(event.target as Element);
        return;
      }
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      if (!from.moved && Math.hypot(dx, dy) < DRAG) return;
      if (!from.moved) canvas.setPointerCapture(event.pointerId);
      from.moved = true;
      this.touched = true;
      this.look({ ...from.frame, x: from.frame.x + dx, y: from.frame.y + dy });
    });
    canvas.addEventListener("pointerup", (event) => {
      if (from && !from.moved) this.click(event.target as Element);
      from = null;
    });
    canvas.addEventListener("pointercancel", () => (from = null));
    canvas.addEventListener("pointerleave", () => this.hover(null));
    canvas.addEventListener("dblclick", () => this.toSelection());
  }

  private click(target: Element | null): void {
    const found = this.under(target);
    if (found?.id !== undefined) this.actions.place(found.id);
    else if (found && found.line >= 0) this.actions.line(found.line);
    else this.store.select([]);
  }

  private hover(target: Element | null): void {
    const found = this.under(target);
    this.focus.hoverLine(found && found.id === undefined ? found.line : -1);
    const part = found?.id === undefined ? undefined : this.planNow().places.get(found.id)?.parts[0];
    if ((part ?? -1) !== this.store.shown.hovered) this.store.set({ hovered: part ?? -1 });
  }

  private under(target: Element | null): { id?: string; line: number } | null {
    const element = target?.closest("[data-id],[data-line]");
    // A drawing of before may call another line so.
    if (!element || !this.drawn.contains(element) || this.version !== this.store.content?.version) return null;
    const plan = this.planNow();
    const id = element.getAttribute("data-id");
    if (id !== null) return plan.places.has(id) ? { id, line: -1 } : null;
    const tag = element.getAttribute("data-line");
    return { line: plan.content.network.lines.findIndex((line) => line.tag === tag) };
  }
}

/** A line is easier to hit than it is wide. */
function widen(line: Element): void {
  const hit = svg("path", { class: "net-hit" });
  for (const name of ["d", "data-line", "data-connection"]) {
    const value = line.getAttribute(name);
    if (value !== null) hit.setAttribute(name, value);
  }
  // Before everything else, so that it is never in the way of a symbol.
  line.parentElement?.prepend(hit);
}

/** From an element's own pixels to those of one that it is in. A browser's own answer lags behind changes of the same frame. */
function matrixIn(element: SVGGraphicsElement, root: SVGElement): DOMMatrix {
  let matrix = new DOMMatrix();
  for (let at: Element | null = element; at && at !== root; at = at.parentElement) {
    const own = (at as SVGGraphicsElement).transform?.baseVal.consolidate()?.matrix;
    if (own) matrix = new DOMMatrix([own.a, own.b, own.c, own.d, own.e, own.f]).multiply(matrix);
  }
  return matrix;
}
