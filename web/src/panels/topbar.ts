// The bar at the top: what this is, search, undo and redo, counts, theme, help.

import { run } from "../commands.ts";
import { el, fill } from "../dom.ts";
import { icon, iconButton } from "./widgets.ts";
import { searchField } from "./find.ts";
import type { Page } from "./page.ts";
import { switchTheme } from "./theme.ts";
import { count } from "./words.ts";

export class TopBar {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly page: Page;
  private readonly title = el("h1", { class: "plant-title", "data-test": "title" });
  private readonly undo = iconButton("undo", "Undo", () => run("undo"), "undo");
  private readonly redo = iconButton("redo", "Redo", () => run("redo"), "redo");
  private readonly review = el(
    "button",
    {
      type: "button", class: "chip", "data-test": "review-count", title: "What is most worth a look first (r)",
      onclick: () => run("review")
    },
    "Review"
  );
  private readonly edits = el(
    "button",
    {
      type: "button", class: "chip", "data-test": "edit-count", title: "What was corrected",
      onclick: () => run("history")
    }
  );
  private readonly badge = el("button", {
    type: "button", class: "read-only", "data-test": "read-only", hidden: true,
    onclick: () => this.page.say(this.page.store.state?.read_only ?? "", "bad"),
  });
  private readonly theme = iconButton("moon", "Dark", () => switchTheme(this.page.store), "theme");
  private readonly table = paneButton("table", "Table", "Table of parts, units and lines (b)", "table");
  private readonly drawing = paneButton("schematic", "Schematic", "The schematic beside the plant (d)", "drawing");

  constructor(page: Page, findAll: (query: string) => void) {
    this.page = page;
    const { element, input } = this.quickSearch(findAll);
    this.search = input;
    const editing = page.source.live ? [
      el("div", { class: "group", role: "group", "aria-label": "Corrections" }, this.undo, this.redo), this.review,
      this.edits
    ] : [];
    for (
      const [made, key] of [[this.table, "table"], [this.drawing, "schematic"]] as const
    ) made.addEventListener("click", () => page.store.set({ [key]: !page.store.shown[key] }));
    this.element = el("header", { class: "top" },
      el("span", { class: "brand" }, "cadgraph"), this.title, element, ...editing, this.badge, el("span", { class: "grow" }),
      el("div", { class: "group", role: "group", "aria-label": "Panes" }, this.drawing, this.table),
      el(
        "div", { class: "group" }, iconButton("link", "Link to this view (k)", () => run("link"), "link"), this.theme,
        iconButton("help", "Keys and mouse (?)", () => run("help"), "help-button")
      ));
    page.store.on("state", () => this.update());
    page.store.watch(["theme", "table", "schematic"], () => this.marks());
    this.marks();
  }

  /** A short list under the field, while somebody is in it. */
  private quickSearch(findAll: (query: string) => void): { element: HTMLElement; input: HTMLInputElement } {
    const done = () => { field.input.blur(); };
    const field = searchField(
      this.page, "search", { units: 6, lines: 4, parts: 6 }, done, (query) => { done(); findAll(query); }
    );
    field.list.classList.add("drop");
    const element = el("div", { class: "search", role: "search" }, icon("search"), field.input, field.list);
    field.list.hidden = true;
    field.input.addEventListener("focus", () => { field.list.hidden = false; field.search(field.input.value); });
    field.input.addEventListener("blur", () => (field.list.hidden = true));
    return { element, input: field.input };
  }

  setLeft(words: string): void {
    fill(this.review, words === "" ? "Review" : words === "0" ? "Reviewed" : `Review ${words}`);
  }

  private update(): void {
    const { state } = this.page.store;
    if (!state) return;
    document.title = `${state.title || "cadgraph"} – cadgraph`;
    fill(this.title, state.title);
    this.title.title = [
      state.title, state.folder && `folder ${state.folder}`, state.who && `you are ${state.who}`
    ].filter(Boolean).join(", ");
    for (
      const [made, words, can, what] of [
        [this.undo, "Undo", state.can_undo, state.undo], [this.redo, "Redo", state.can_redo, state.redo]
      ] as const
    ) {
      made.disabled = !can || !this.page.canEdit();
      made.title = what ? `${words}: ${what}` : `Nothing to ${words.toLowerCase()}`;
      made.setAttribute("aria-label", made.title);
    }
    fill(
      this.edits, count(state.n_edits, "correction"),
      state.lost.length > 0 && el("span", { class: "badge bad" }, `${state.lost.length} lost`)
    );
    this.edits.title = state.lost.length ? `${count(state.lost.length, "correction")} no longer fit this model: see History` : "What was corrected, and by whom";
    this.badge.hidden = !state.read_only;
    const sign = state.away ? "No server" : "View only";
    fill(this.badge, sign);
    this.badge.title = state.read_only ?? "";
    this.badge.setAttribute("aria-label", `${sign}: ${state.read_only ?? ""}`);
  }

  private marks(): void {
    const { theme, table, schematic } = this.page.store.shown;
    fill(this.theme, icon(theme === "dark" ? "sun" : "moon"));
    this.theme.title = theme === "dark" ? "Light colours" : "Dark colours";
    this.theme.setAttribute("aria-label", this.theme.title);
    this.table.setAttribute("aria-pressed", String(table));
    this.drawing.setAttribute("aria-pressed", String(schematic));
  }
}

function paneButton(test: string, text: string, title: string, image: string): HTMLButtonElement {
  return el(
    "button", { type: "button", title, "aria-label": text, "data-test": `${test}-toggle` }, icon(image),
    el("span", { class: "wide-only" }, text)
  );
}
