// Tags over the 3D view: as many as there is room for, with a line to what they name; none over another.

import { Matrix4 } from "three";
import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";
import type { Point } from "../types.ts";
import { el, svg } from "../dom.ts";
import { keepPresses } from "./presses.ts";
import type { Focus } from "./focus.ts";
import { type Item, itemsOf, rankOf } from "./items.ts";
import { leaderEnd, type Placed, placeLabels, type Wish } from "./placement.ts";
import type { Plan } from "./plan.ts";
import type { NetworkWarning } from "./warnings.ts";

export interface TagActions {
  place(id: string): void;
  line(row: number): void;
  warning(key: string): void;
}

const REST = 110; // ms without a frame, after which the view rests
const SLICE = 3; // ms of looking what is hidden, at a time
const SMALLEST = 7; // px, units that appear smaller have no tag
const AREA = 13000; // px² of the view for each tag
const MOST = 80;
const SPECIAL = 500;
const KEPT = 8; // a tag that is shown is not driven out by one that matters just a little more
const HEIGHT = 20; // px, of a tag; see network.css

type Box = readonly [number, number, number, number];

interface Shown_ {
  element: HTMLButtonElement;
  slot: number;
}

export class TagLayer {
  /** Time of the last placing [ms], for those who measure. */
  lastMs = 0;
  private readonly root = el("div", { class: "net-tags", "data-test": "net-tags" });
  private readonly leaders = svg("path", { class: "net-leaders" });
  private readonly dots = svg("path", { class: "net-leader-dots" });
  private readonly shown = new Map<string, Shown_>();
  /** Whether what was looked at lately is hidden; items that nobody has looked for are not in here. */
  private hiddenOf = new Map<string, boolean>();
  private items: Item[] = [];
  private byKey = new Map<string, Item>();
  private ranks: number[] = [];
  private plan: Plan | null = null;
  private size = { width: 1, height: 1 };
  private seenFrom: number[] = [];
  private taken: Box[] = [];
  private dirty = true;
  private timer = 0;
  private readonly widths = new Map<string, number>();
  private readonly pen = document.createElement("canvas").getContext("2d")!;
  private readonly view: SceneView;
  private readonly store: Store;
  private readonly focus: Focus;
  private readonly actions: TagActions;

  constructor(view: SceneView, store: Store, focus: Focus, actions: TagActions) {
    this.view = view;
    this.store = store;
    this.focus = focus;
    this.actions = actions;
    const drawing = svg("svg", { class: "net-leader-layer", "aria-hidden": "true" }, this.leaders, this.dots);
    this.root.append(drawing);
    keepPresses(this.root);
    view.element.append(this.root);
    new ResizeObserver(() => this.measure()).observe(view.element);
    this.measure();
    view.onFrame(() => this.frame());
  }

  setPlan(plan: Plan, warnings: readonly NetworkWarning[]): void {
    this.plan = plan;
    this.items = itemsOf(plan, warnings);
    this.byKey = new Map(this.items.map((item) => [item.key, item]));
    this.pen.font = `600 11px ${getComputedStyle(this.root).fontFamily}`;
    this.hiddenOf.clear();
    this.refresh();
  }

  /** What is selected, hovered, marked or shown has changed. */
  refresh(): void {
    if (!this.plan) return;
    const { shown } = this.store;
    const attention = {
      shown, focus: this.focus, place: this.focus.place?.id ?? null, hoveredPlace: this.focus.hoveredPlace,
      marks: shown.marks,
    };
    this.ranks = this.items.map((item) => rankOf(item, this.plan!, attention));
    this.dirty = true;
    // Not at once: several things change together, and the pointer moves fast.
    requestAnimationFrame(() => this.frame());
  }

  /** What hides what has changed, though the eye has not moved. */
  forgetHidden(): void {
    this.hiddenOf.clear();
    this.rest();
  }

  private measure(): void {
    this.size = { width: this.view.element.clientWidth, height: this.view.element.clientHeight };
    this.dirty = true;
    this.frame();
  }

  private frame(): void {
    if (!this.plan) return;
    const moved = this.hasMoved();
    if (!moved && !this.dirty) return;
    this.dirty = false;
    this.place();
    this.rest();
  }

  private hasMoved(): boolean {
    const { matrixWorld, projectionMatrix } = this.view.camera;
    const now = [...matrixWorld.elements, ...projectionMatrix.elements, this.view.depthTurn];
    const moved = now.some((value, i) => value !== this.seenFrom[i]);
    if (moved) this.seenFrom = now;
    return moved;
  }

  private rest(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.look(), REST);
  }

  private place(): void {
    const start = performance.now();
    const wishes = this.wishes((item, rank) => rank >= SPECIAL || this.hiddenOf.get(item.key) === false);
    const limit = Math.min(MOST, Math.round((this.size.width * this.size.height) / AREA));
    this.draw(placeLabels(wishes, { ...this.size, taken: this.taken }, limit));
    this.lastMs = performance.now() - start;
  }

  /** Labels that want to be shown, of the items that a test lets through. */
  private wishes(test: (item: Item, rank: number) => boolean): Wish[] {
    const toScreen = projector(this.view, this.size);
    const wishes: Wish[] = [];
    this.items.forEach((item, i) => {
      const rank = this.ranks[i];
      if (rank < 0 || !test(item, rank)) return;
      const at = toScreen(item.point);
      if (!at || at.x < 0 || at.y < 0 || at.x > this.size.width || at.y > this.size.height) return;
      const appears = item.reach * at.metre;
      if (appears < SMALLEST && rank < SPECIAL) return;
      const before = this.shown.get(item.key);
      wishes.push({
        key: item.key, x: at.x, y: at.y, width: this.widthOf(item), height: item.kind === "warning" ? 18 : HEIGHT,
        rank: rank + Math.min(15, appears / 10) + (before ? KEPT : 0), slot: before?.slot ?? -1,
        fixed: item.kind === "warning",
      });
    });
    return wishes;
  }

  /** Looks in slices which of the items are hidden by the plant, most important first; then places anew. */
  private look(): void {
    const eye = eyeOf(this.view);
    const before = new Map(this.hiddenOf);
    const room = String(this.taken);
    this.taken = boxesOver(this.view.element, this.root);
    const changed = room !== String(this.taken);
    const wishes = this.wishes(() => true).sort((a, b) => b.rank - a.rank);
    const from = this.seenFrom;
    let next = 0;
    let seen = 0;
    const slice = () => {
      if (from !== this.seenFrom) return;
      const end = performance.now() + SLICE;
      while (next < wishes.length && seen < 2 * MOST && performance.now() < end) {
        const wish = wishes[next++];
        const hidden = wish.rank < SPECIAL && this.view.isHidden(towards(this.byKey.get(wish.key)!, eye));
        this.hiddenOf.set(wish.key, hidden);
        if (!hidden) seen++;
      }
      if (next < wishes.length && seen < 2 * MOST) this.timer = window.setTimeout(slice);
      else if (changed || wishes.some(({ key }) => before.get(key) !== this.hiddenOf.get(key))) this.place();
    };
    slice();
  }

  private draw(placed: readonly Placed[]): void {
    const keep = new Set(placed.map(({ wish }) => wish.key));
    for (const [key, { element }] of this.shown) {
      if (keep.has(key)) continue;
      element.remove();
      this.shown.delete(key);
    }
    let leaders = "";
    let dots = "";
    for (const place of placed) {
      const item = this.byKey.get(place.wish.key)!;
      const element = this.elementOf(item, place.slot);
      element.style.transform = `translate(${Math.round(place.left)}px,${Math.round(place.top)}px)`;
      this.mark(element, item);
      if (item.kind === "warning") continue;
      const end = leaderEnd(place);
      leaders += `M${place.wish.x.toFixed(1)} ${place.wish.y.toFixed(1)}L${end.x.toFixed(1)} ${end.y.toFixed(1)}`;
      dots += `M${place.wish.x.toFixed(1)} ${place.wish.y.toFixed(1)}h0`;
    }
    this.leaders.setAttribute("d", leaders);
    this.dots.setAttribute("d", dots);
  }

  private elementOf(item: Item, slot: number): HTMLButtonElement {
    const known = this.shown.get(item.key);
    if (known) {
      known.slot = slot;
      if (known.element.textContent !== item.text) known.element.textContent = item.text;
      return known.element;
    }
    const element = el("button", {
      type: "button", tabindex: "-1", title: item.title, class: `net-${item.kind === "place" ? "tag" : item.kind}`,
      "data-test": `net-${item.kind}`, "data-id": item.id, onclick: () => this.click(item),
      onpointerenter: () => this.hover(item, true), onpointerleave: () => this.hover(item, false),
    }, item.text);
    if (item.kind === "warning") element.setAttribute("aria-label", item.title);
    if (item.kind === "warning" && item.text === "") element.classList.add("is-end");
    if (item.color) element.style.borderLeftColor = item.color;
    // The wheel over a tag zooms as beside it.
    element.addEventListener("wheel", (event) => this.passOn(event), { passive: false });
    this.root.append(element);
    this.shown.set(item.key, { element, slot });
    return element;
  }

  private mark(element: HTMLElement, item: Item): void {
    const { marks } = this.store.shown;
    const id = item.kind === "place" ? item.id : null;
    const list = element.classList;
    const line = item.kind === "line" ? Number(item.id) : -2;
    const selected = id !== null && id === this.focus.place?.id;
    list.toggle("is-selected", selected || line === this.focus.selectedLine || this.focus.warning === item.id);
    list.toggle("is-hovered", (id !== null && id === this.focus.hoveredPlace) || line === this.focus.hovered);
    list.toggle("is-close", id !== null && !!marks?.close.has(id));
    list.toggle("is-marked", id !== null && !!marks?.places.has(id));
  }

  private click(item: Item): void {
    if (item.kind === "place") this.actions.place(item.id);
    else if (item.kind === "line") this.actions.line(Number(item.id));
    else this.actions.warning(item.id);
  }

  private hover(item: Item, on: boolean): void {
    if (item.kind === "place") this.focus.hoverPlace(on ? item.id : null);
    else if (item.kind === "line") this.focus.hoverLine(on ? Number(item.id) : -1);
  }

  private passOn(event: WheelEvent): void {
    event.preventDefault();
    event.stopPropagation();
    this.view.element.querySelector("canvas")?.dispatchEvent(new WheelEvent(event.type, event));
  }

  private widthOf(item: Item): number {
    if (item.kind === "warning") return 18;
    const known = this.widths.get(item.text);
    if (known !== undefined) return known;
    const width = Math.ceil(this.pen.measureText(item.text).width) + 16;
    this.widths.set(item.text, width);
    return width;
  }
}

/** Boxes of what else lies over the picture: buttons, the legend, notes. */
function boxesOver(element: HTMLElement, own: HTMLElement): Box[] {
  const frame = element.getBoundingClientRect();
  const boxes: Box[] = [];
  for (const other of element.children) {
    if (other === own || other.localName === "canvas") continue;
    const box = other.getBoundingClientRect();
    // What covers half of the view is a layer with something in it, no box.
    if (!box.width || !box.height || box.width * box.height > 0.4 * frame.width * frame.height) continue;
    boxes.push([box.left - frame.left, box.top - frame.top, box.right - frame.left, box.bottom - frame.top]);
  }
  return boxes;
}

type ToScreen = (point: Point) => { x: number; y: number; metre: number } | null;

/** What brings points onto the screen, and says how many pixels a metre has there. */
function projector(view: SceneView, size: { width: number; height: number }): ToScreen {
  const { camera } = view;
  const m = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  const scale = 0.5 * size.height * camera.projectionMatrix.elements[5];
  return ([x, y, z]) => {
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 1e-6) return null;
    const sx = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w;
    const sy = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
    return { x: (0.5 + 0.5 * sx) * size.width, y: (0.5 - 0.5 * sy) * size.height, metre: scale / w };
  };
}

/** Where the rays of sight come from: the eye, or for parallel rays a direction. */
function eyeOf(view: SceneView): { point: Point | null; back: Point } {
  const m = view.camera.matrixWorld.elements;
  const parallel = "isOrthographicCamera" in view.camera;
  return { point: parallel ? null : [m[12], m[13], m[14]], back: [m[8], m[9], m[10]] };
}

/** The point of an item, moved out of its own body towards the eye. */
function towards(item: Item, eye: { point: Point | null; back: Point }): Point {
  const [x, y, z] = item.point;
  const way: Point = eye.point ? [eye.point[0] - x, eye.point[1] - y, eye.point[2] - z] : eye.back;
  const length = Math.hypot(...way) || 1;
  const step = (eye.point ? Math.min(item.body, 0.9 * length) : item.body) / length;
  return [x + way[0] * step, y + way[1] * step, z + way[2] * step];
}
