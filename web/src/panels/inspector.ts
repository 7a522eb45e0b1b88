// The right panel: what is selected, and what can be done about it.

import type { Content, Line } from "../types.ts";
import { el, fill } from "../dom.ts";
import { bar, swatch } from "./widgets.ts";
import { inspectLine, inspectMany } from "./inspect_many.ts";
import { inspectPart } from "./inspect_part.ts";
import { inspectEnd, inspectUnit } from "./inspect_place.ts";
import type { Page } from "./page.ts";
import { button, linkButton } from "./pieces.ts";
import { count, percent, whole } from "./words.ts";

export class Inspector {
  readonly element: HTMLElement;
  readonly networkSlot = el("div", { class: "network-slot", "data-test": "network-slot" });
  /** The line whose parts are selected, as the network knows it. */
  lineNow: () => Line | null = () => null;
  private readonly head = el("div", { class: "inspector-head" });
  private readonly rest = el("div", { class: "inspector-rest" });
  private readonly page: Page;
  /** Which sections are open, by title: they stay so from part to part. */
  private readonly open = new Map<string, boolean>();
  private due = false;
  private drawn: { selection: readonly number[]; place: string | null } = { selection: [], place: null };
  /** Something has changed while the person was typing here. */
  private late = false;

  constructor(page: Page) {
    this.page = page;
    this.element = el(
      "section", { class: "inspector", "aria-label": "Selection", "data-test": "inspector" }, this.head,
      this.networkSlot, this.rest
    );
    this.rest.addEventListener("toggle", (event) => this.noteToggle(event.target as HTMLDetailsElement), true);
    this.element.addEventListener("focusout", () => this.late && this.render());
    page.store.watch(["selection", "place", "isolated"], () => this.render());
    page.store.on("content", () => this.render());
    let could = page.canEdit();
    page.store.on("state", () => {
      if (could !== page.canEdit()) this.render();
      could = page.canEdit();
    });
  }

  /** Draws once per turn, however many things have changed. */
  private render(): void {
    if (this.due) return;
    this.due = true;
    queueMicrotask(() => {
      this.due = false;
      const { content, shown } = this.page.store;
      if (!content) return;
      this.late = this.typing();
      if (this.late) return;
      const key = (document.activeElement as HTMLElement | null)?.dataset?.key;
      const inside = this.element.contains(document.activeElement);
      const other = shown.selection !== this.drawn.selection || shown.place !== this.drawn.place;
      this.draw(content, shown.selection, shown.place);
      this.restoreOpen();
      if (other) this.element.scrollTop = 0;
      if (inside && key) this.element.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
    });
  }

  /** Whether somebody types about what is shown already: what is typed must not be lost. */
  private typing(): boolean {
    const on = document.activeElement;
    const { selection, place } = this.page.store.shown;
    const same = selection === this.drawn.selection && place === this.drawn.place;
    return same && on instanceof HTMLInputElement && on.type === "text" && !on.disabled && this.element.contains(on);
  }

  private draw(content: Content, selection: readonly number[], place: string | null): void {
    this.drawn = { selection, place };
    const unit = place && content.network.units.find((unit) => unit.id === place);
    const end = place && content.network.ends.find((end) => end.id === place);
    const line = this.lineNow();
    if (line) inspectLine(this.page, content, line, selection, this.head, this.rest);
    else if (unit) inspectUnit(this.page, content, unit, this.head, this.rest);
    else if (end) inspectEnd(this.page, content, end, this.head, this.rest);
    else if (selection.length === 1) inspectPart(this.page, content, selection[0], this.head, this.rest);
    else if (selection.length > 1) inspectMany(this.page, content, selection, this.head, this.rest);
    else this.overview(content);
  }

  /** Nothing is selected: the plant as a whole, and what to do. */
  private overview(content: Content): void {
    const { parts, network } = content;
    const states = { sure: 0, likely: 0, open: 0 };
    for (const state of parts.state) states[state]++;
    const n = parts.id.length;
    const rows = (["sure", "likely", "open"] as const).map((state) =>
      el("li", { class: "row" }, swatch(state === "open" ? null : "var(--accent)", state),
        linkButton(
          { sure: "Sure", likely: "Likely, not sure", open: "Not known" }[state], "Select these parts",
          () => this.page.store.select(parts.state.flatMap((s, row) => (s === state ? [row] : [])))
        ),
        el("span", { class: "grow" }), bar(
          states[state] / Math.max(n, 1), percent(states[state] / Math.max(n, 1)), state
        ), el("span", { class: "number" }, whole(states[state]))));
    const { canEdit, store } = this.page;
    fill(this.head,
      el(
        "div", { class: "title" },
        el(
          "div", { class: "grow" }, el("h2", {}, content.title),
          el(
            "p", { class: "soft" },
            `${count(n, "part")}, ${count(network.units.length, "unit")}, ${count(network.lines.length, "line")}, ${count(network.systems.length, "system")}`
          )
        )
      ),
      el("h3", {}, "How sure the labels are"), el("ul", { class: "rows" }, ...rows));
    fill(this.rest,
      el("div", { class: "empty" },
        el("p", {}, "Click a part to see what it is and how sure that is. Click it again for its whole unit."),
        canEdit() && el(
          "p", {}, "A wrong label? Click the part, then click what it is: all parts of its shape follow."
        )),
      canEdit() && el(
        "div", { class: "buttons" },
        button(
          "Start the review", "What is most worth a look first (r)", () => store.set({ leftTab: "review" }),
          "start-review", "main"
        )
      ));
  }

  private noteToggle(box: HTMLDetailsElement): void {
    if (box.classList.contains("fold")) this.open.set(box.querySelector("summary")!.textContent!.replace(/ \(\d+\)$/, ""), box.open);
  }

  private restoreOpen(): void {
    for (const box of this.rest.querySelectorAll<HTMLDetailsElement>("details.fold")) {
      const was = this.open.get(box.querySelector("summary")!.textContent!.replace(/ \(\d+\)$/, ""));
      if (was !== undefined) box.open = was;
    }
  }
}
