// Light that moves along the known flow: only where it costs nothing, or where somebody asked for it.

import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";
import type { Focus } from "./focus.ts";
import type { Overlay } from "./overlay.ts";

const CHEAP = 8; // ms a frame
const STEP = 50; // ms between frames

export class Motion {
  private timer = 0;
  private readonly view: SceneView;
  private readonly store: Store;
  private readonly focus: Focus;
  private readonly overlay: Overlay;
  private readonly still = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly slow: boolean;

  constructor(view: SceneView, store: Store, focus: Focus, overlay: Overlay) {
    this.view = view;
    this.store = store;
    this.focus = focus;
    this.overlay = overlay;
    this.slow = drawsInSoftware(view.element);
    this.still.addEventListener("change", () => this.refresh());
  }

  /** Starts or stops, as things are now. */
  refresh(): void {
    const on = this.isWanted();
    if (on && !this.timer) this.timer = window.setInterval(() => this.step(), STEP);
    if (!on && this.timer) {
      clearInterval(this.timer);
      this.timer = 0;
      this.overlay.setTime(-1);
      this.view.invalidate();
    }
  }

  private isWanted(): boolean {
    const { network, marks } = this.store.shown;
    if (!network && !marks) return false;
    if (this.focus.moving) return true;
    // A trace shows by itself which way it goes, where that is free.
    return marks?.kind === "trace" && !this.still.matches && !this.slow && this.view.stats.frameMs < CHEAP;
  }

  private step(): void {
    if (document.hidden) return;
    this.overlay.setTime((performance.now() / 1600) % 1);
    this.view.invalidate();
  }
}

function drawsInSoftware(element: HTMLElement): boolean {
  const gl = element.querySelector("canvas")?.getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software/i.test(name);
}
