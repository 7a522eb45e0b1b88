// The history tab: who corrected what and when, and what no longer fits.

import type { AuditRow } from "../types.ts";
import { el, fill } from "../dom.ts";
import { icon } from "./widgets.ts";
import type { Page } from "./page.ts";
import { namesIn } from "./mentions.ts";
import { button, linkButton, note } from "./pieces.ts";
import { count, moment } from "./words.ts";

export class History {
  readonly element = el("div", { class: "history", "data-test": "history" });
  private readonly page: Page;
  private version = -1;
  private rows: AuditRow[] = [];
  private trouble = "";

  constructor(page: Page) {
    this.page = page;
    page.store.watch(["leftTab"], () => this.refresh());
    page.store.on("state", () => this.refresh());
    page.store.on("content", () => this.refresh());
  }

  private refresh(): void {
    const { state, shown } = this.page.store;
    if (shown.leftTab !== "history" || !state) return;
    this.draw();
    if (state.version === this.version) return;
    this.version = state.version;
    this.page.source.audit().then(
      (rows) => { this.rows = rows; this.trouble = ""; this.draw(); },
      (error: Error) => { this.version = -1; this.trouble = error.message; this.draw(); });
  }

  private draw(): void {
    const { state } = this.page.store;
    if (!state) return;
    const can = this.page.canEdit();
    fill(this.element,
      state.lost.length > 0 && note(
        `${count(state.lost.length, "correction no longer fits", "corrections no longer fit")} this model:`,
        el("ul", { "data-test": "lost" }, ...state.lost.map((lost) => el("li", {}, lost)))
      ),
      can && el(
        "div", { class: "buttons" }, this.step("undo", "Undo", state.can_undo, state.undo),
        this.step("redo", "Redo", state.can_redo, state.redo)
      ),
      this.trouble && el("p", { class: "trouble" }, this.trouble),
      this.rows.length
        ? el("ol", { class: "audit" }, ...this.rows.map((row) => this.row(row)))
        : el(
          "p", { class: "empty" },
          this.page.source.live ? "Nothing was corrected yet. What you correct is listed here: who, when, what and why." : "This file holds no history; it is kept in the plant's folder."
        ));
  }

  private step(which: "undo" | "redo", text: string, can: boolean, what: string | null): HTMLElement {
    const made = button(
      text, what ? `${text}: ${what}` : `Nothing to ${which}`, () => void this.page[which](), `history-${which}`
    );
    made.disabled = !can;
    made.prepend(icon(which));
    return made;
  }

  private row(row: AuditRow): HTMLElement {
    const time = el(
      "time",
      { datetime: row.when || null, title: row.when ? new Date(row.when).toLocaleString() : "The time was not kept" },
      moment(row.when)
    );
    const what = this.linked(row.what);
    return el("li", { class: row.undone ? "undone" : "", "data-test": "audit" },
      row.undone ? el("s", {}, ...what) : el("span", {}, ...what),
      row.undone && el("span", { class: "badge" }, "undone"),
      row.why && el("p", { class: "audit-why" }, row.why),
      el("p", { class: "soft" }, row.who || "somebody", ", ", time));
  }

  /** What was done, with those of its parts and units to click that are there by that name now. */
  private linked(text: string): (Node | string)[] {
    const { content } = this.page.store;
    if (!content) return [text];
    return namesIn(text, content).map(({ text, parts, place }) =>
      parts ? linkButton(text, `Select what is called ${text} now`, () => this.page.go(parts, place), "audit-link") : text);
  }
}
