// Mouse, fingers and wheel over the view.

import { Vector3 } from "three";
import type { Navigation } from "./navigation.ts";

const CLICK = 5; // px that a hand may shake

export interface GestureTarget {
  /** The point of the plant under the cursor, else one at a sensible depth. */
  pointAt(x: number, y: number): Vector3;
  clicked(x: number, y: number, event: PointerEvent): void;
  doubleClicked(x: number, y: number): void;
  hovered(x: number, y: number): void;
  left(): void;
}

export class Gestures {
  private readonly down = new Map<number, { x: number; y: number }>();
  private start = { x: 0, y: 0, moved: false };
  private pivot = new Vector3();
  private spread = 0;
  private readonly element: HTMLElement;
  private readonly navigation: Navigation;
  private readonly target: GestureTarget;
  private wheelPoint: { x: number; y: number; at: number; point: Vector3 } | null = null;

  constructor(element: HTMLElement, navigation: Navigation, target: GestureTarget) {
    this.element = element;
    this.navigation = navigation;
    this.target = target;
    element.addEventListener("pointerdown", (event) => this.press(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    element.addEventListener("pointerup", (event) => this.release(event));
    element.addEventListener("pointercancel", (event) => this.down.delete(event.pointerId));
    element.addEventListener("pointerleave", () => target.left());
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    element.addEventListener("dblclick", (event) => target.doubleClicked(...this.at(event)));
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private at(event: MouseEvent): [number, number] {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private press(event: PointerEvent): void {
    const [x, y] = this.at(event);
    this.element.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, { x, y });
    if (this.down.size === 1) {
      this.start = { x, y, moved: false };
      this.pivot = this.target.pointAt(x, y);
    } else {
      this.start.moved = true;
      this.spread = this.fingers().spread;
    }
  }

  private move(event: PointerEvent): void {
    const [x, y] = this.at(event);
    const before = this.down.get(event.pointerId);
    if (!before) {
      this.target.hovered(x, y);
      return;
    }
    const was = this.down.size > 1 ? this.fingers() : null;
    const [dx, dy] = [x - before.x, y - before.y];
    this.down.set(event.pointerId, { x, y });
    if (!this.start.moved && Math.hypot(x - this.start.x, y - this.start.y) < CLICK) return;
    this.start.moved = true;
    const height = this.element.clientHeight;
    if (was) {
      const now = this.fingers();
      this.navigation.pan(this.pivot, now.x - was.x, now.y - was.y, height);
      if (now.spread > 1 && this.spread > 1) this.navigation.zoom(this.pivot, this.spread / now.spread);
      this.spread = now.spread;
    } else if (event.buttons & 1 && !event.shiftKey) {
      this.navigation.orbit(this.pivot, (dx / height) * Math.PI * 1.2, (dy / height) * Math.PI * 1.2);
    } else {
      this.navigation.pan(this.pivot, dx, dy, height);
    }
  }

  private release(event: PointerEvent): void {
    const known = this.down.delete(event.pointerId);
    if (known && !this.start.moved && event.button === 0 && this.down.size === 0) {
      this.target.clicked(...this.at(event), event);
    }
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const [x, y] = this.at(event);
    const now = performance.now();
    const old = this.wheelPoint;
    // While the wheel turns at one place the point stays the same: looking it up costs a frame.
    const same = old && Math.hypot(x - old.x, y - old.y) < 3 && now - old.at < 400;
    const point = same ? old.point : this.target.pointAt(x, y);
    this.wheelPoint = { x, y, at: now, point };
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    this.navigation.zoom(point, Math.exp(Math.max(-300, Math.min(300, event.deltaY * lines)) * 0.0012));
  }

  private fingers(): { x: number; y: number; spread: number } {
    const [a, b] = [...this.down.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y) };
  }
}
