// Short answers at the foot of the view; screen readers are told them, too.

import { el } from "../dom.ts";
import { icon } from "./widgets.ts";
import type { Action, Tone } from "./page.ts";

const LASTS = { info: 6000, good: 6000, bad: 15_000 };
const MANY_LAST = 15_000;
const MOST = 3;

export class Toasts {
  readonly element = el("div", { class: "toasts", "data-test": "toasts" });
  // Two regions that are always there: readers tell what is put into them, urgent things at once.
  private readonly polite = el("div", { class: "only-read", role: "status", "aria-live": "polite" });
  private readonly urgent = el("div", { class: "only-read", role: "alert", "aria-live": "assertive" });

  constructor(app: HTMLElement) {
    app.append(this.polite, this.urgent, this.element);
  }

  say(text: string, tone: Tone = "info", actions: Action[] = []): void {
    const reader = tone === "bad" ? this.urgent : this.polite;
    reader.textContent = "";
    requestAnimationFrame(() => (reader.textContent = text));
    const toast = el("div", { class: `toast ${tone}`, "data-test": "toast" },
      icon(tone === "good" ? "check" : tone === "bad" ? "warn" : "dot"), el("span", { class: "toast-text" }, text));
    const close = () => toast.remove();
    toast.append(el("span", { class: "toast-actions" }, ...actions.map((action) =>
      el("button", { type: "button", class: "quiet", onclick: () => { close(); action.run(); } }, action.text))));
    toast.append(
      el(
        "button", { type: "button", class: "icon-button", "aria-label": "Dismiss", title: "Dismiss", onclick: close },
        icon("close")
      )
    );
    // What was done before has been answered; only the last of it can be taken back from here.
    for (const old of [...this.element.children]) {
      if (
        (tone === "good" && old.classList.contains("good")) || old.querySelector(".toast-text")?.textContent === text
      ) old.remove();
    }
    this.element.append(toast);
    while (this.element.children.length > MOST) this.element.firstElementChild!.remove();
    // More to choose from takes longer to read.
    let timer = setTimeout(close, actions.length > 1 ? Math.max(LASTS[tone], MANY_LAST) : LASTS[tone]);
    // Who reads or reaches for a button is not to be hurried.
    for (const event of ["pointerenter", "focusin"]) toast.addEventListener(event, () => clearTimeout(timer));
    for (const event of ["pointerleave", "focusout"]) toast.addEventListener(
      event, () => { clearTimeout(timer); timer = setTimeout(close, 4000); }
    );
  }
}
