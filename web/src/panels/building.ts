// The page while the plant is being built or read, and when that failed.

import type { ServerState } from "../types.ts";
import { el, fill } from "../dom.ts";
import { elapsed, percent, stageWords } from "./words.ts";

export class Building {
  readonly element = el(
    "section", { class: "building", "data-test": "building", "aria-label": "Progress", hidden: true }
  );
  private readonly started = Date.now();
  private readonly stage = el("p", { class: "building-stage", "data-test": "building-stage", role: "status" });
  private readonly fillBar = el("span", { class: "bar-fill" });
  private readonly progress = el(
    "div",
    { class: "bar big", role: "progressbar", "aria-valuemin": "0", "aria-valuemax": "100", "aria-label": "Progress" },
    this.fillBar
  );
  private readonly time = el("p", { class: "soft", "data-test": "building-time" });
  /** Above the plant, where it can be seen already while the rest is made ready. */
  readonly strip = el("p", { class: "making-ready", role: "status", "data-test": "making-ready", hidden: true });
  /** What has been gone through so far, each with the time that it took. */
  private readonly steps = el("ol", { class: "steps" });
  private step = "";
  private stepped = Date.now();
  private timer = 0;
  private showing = "";

  show(state: ServerState | null, seen: boolean, trouble = ""): void {
    const failed = state?.status === "failed";
    this.strip.hidden = !seen || state?.status !== "building";
    if (!this.strip.hidden) this.say(`${stageWords(state!.stage)}… Corrections can be made when this is done.`);
    if ((state?.status === "ready" || (seen && !failed)) && !trouble) {
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
      else this.layOutFailed(
        kind === "failed" ? "The plant could not be built" : "No answer from cadgraph", trouble || state?.message || ""
      );
    }
    if (kind === "building") this.update(state);
  }

  private layOut(title: string): void {
    const card = el("div", { class: "card" },
      el("p", { class: "brand" }, "cadgraph"),
      el("h1", {}, title ? `Reading ${title}` : "Reading the plant"),
      this.steps, this.stage, this.progress, this.time);
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
      el(
        "p", { class: "soft" },
        "What went wrong stands in the terminal, too. Put it right there and start 'cadgraph view' again."
      )));
  }

  private say(words: string): void {
    if (this.strip.textContent !== words) this.strip.textContent = words;
  }

  private update(state: ServerState | null): void {
    const share = Math.max(0, Math.min(1, state?.share ?? 0));
    const told = [stageWords(state?.stage ?? ""), state?.message].filter(Boolean).join(": ");
    this.progress.classList.toggle("unknown", share === 0);
    if (this.stage.textContent !== told) this.stage.textContent = told;
    this.stepOn(state?.stage ?? "");
    this.fillBar.style.width = `${100 * share}%`;
    this.progress.setAttribute("aria-valuenow", String(Math.round(100 * share)));
    this.progress.setAttribute("aria-valuetext", `${told}, ${percent(share)}`);
  }

  private stepOn(stage: string): void {
    if (stage === this.step) return;
    const now = Date.now();
    if (this.step) this.steps.append(
      el(
        "li", {}, el("span", {}, `✓ ${stageWords(this.step)}`),
        el("span", { class: "number" }, elapsed((now - this.stepped) / 1000))
      )
    );
    this.step = stage;
    this.stepped = now;
  }

  private tick(): void {
    this.time.textContent = `${elapsed((Date.now() - this.started) / 1000)} so far`;
  }
}
