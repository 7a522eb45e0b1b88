// The page while the plant is being built or read, and when that failed.

import type { ServerState } from "../types.ts";
import { el, fill } from "./dom.ts";
import { elapsed, percent } from "./words.ts";

export class Building {
  readonly element = el("section", { class: "building", "data-test": "building", "aria-label": "Progress", hidden: true });
  private readonly started = Date.now();
  private readonly stage = el("p", { class: "building-stage", "data-test": "building-stage", role: "status" });
  private readonly fillBar = el("span", { class: "bar-fill" });
  private readonly progress = el("div", { class: "bar big", role: "progressbar", "aria-valuemin": "0", "aria-valuemax": "100", "aria-label": "Progress" }, this.fillBar);
  private readonly time = el("p", { class: "soft", "data-test": "building-time" });
  private timer = 0;
  private showing = "";

  show(state: ServerState | null, trouble = ""): void {
    const failed = state?.status === "failed";
    if (state?.status === "ready" && !trouble) {
      clearInterval(this.timer);
      this.timer = 0;
      this.showing = "";
      this.element.hidden = true;
      return;
    }
    this.element.hidden = false;
    const kind = trouble ? "trouble" : failed ? "failed" : "building";
    if (kind !== this.showing) {
      this.showing = kind;
      if (kind === "building") this.layOut(state?.title ?? "");
      else this.layOutFailed(kind === "failed" ? "The plant could not be built" : "No answer from cadgraph", trouble || state?.message || "");
    }
    if (kind === "building") this.update(state);
  }

  private layOut(title: string): void {
    const card = el("div", { class: "card" },
      el("p", { class: "brand" }, "cadgraph"),
      el("h1", {}, title ? `Reading ${title}` : "Reading the plant"),
      this.stage, this.progress, this.time);
    fill(this.element, card);
    this.timer ||= window.setInterval(() => this.tick(), 1000);
    this.tick();
  }

  private layOutFailed(title: string, message: string): void {
    clearInterval(this.timer);
    this.timer = 0;
    fill(this.element, el("div", { class: "card", role: "alert" },
      el("p", { class: "brand" }, "cadgraph"), el("h1", {}, title),
      el("p", { class: "building-message", "data-test": "building-message" }, message),
      el("p", { class: "soft" }, "What went wrong stands in the terminal, too. Put it right there and start 'cadgraph view' again.")));
  }

  private update(state: ServerState | null): void {
    const share = Math.max(0, Math.min(1, state?.share ?? 0));
    const told = [state?.stage || "Starting", state?.message].filter(Boolean).join(": ");
    if (this.stage.textContent !== told) this.stage.textContent = told;
    this.fillBar.style.width = `${100 * share}%`;
    this.progress.setAttribute("aria-valuenow", String(Math.round(100 * share)));
    this.progress.setAttribute("aria-valuetext", `${told}, ${percent(share)}`);
  }

  private tick(): void {
    this.time.textContent = `${elapsed((Date.now() - this.started) / 1000)} so far`;
  }
}
