// The table below the view: parts, units or lines, however many; only the rows in sight are drawn.

import type { Content } from "../types.ts";
import { csv, saveText } from "./csv.ts";
import { el, fill, put } from "../dom.ts";
import { icon, swatch } from "./widgets.ts";
import type { Page } from "./page.ts";
import { columns, countWords, listed, partsOf, type Column, type Kind, type Scope, type Wish } from "./rows.ts";
import { labelOf, whole } from "./words.ts";

const ROW = 24;
const SPARE = 8;

export class Table {
  readonly element = el("section", { class: "table-pane", "aria-label": "Table", "data-test": "table" });
  private readonly page: Page;
  private readonly wish: Wish = { kind: "parts", scope: "all", text: "", sort: null, descending: false };
  private readonly head = el("div", { class: "table-head", role: "row", "aria-rowindex": "1" });
  private readonly body = el("div", { class: "table-body", role: "rowgroup" });
  private readonly scroll = el(
    "div",
    {
      class: "table-scroll", role: "grid", tabindex: "0", "aria-label": "Rows: arrow keys choose, Enter moves there",
      "data-test": "table-rows"
    },
    this.head, this.body
  );
  private readonly total = el("span", { class: "soft", role: "status", "data-test": "table-count" });
  private readonly kinds = new Map<Kind, HTMLButtonElement>();
  private all: Column[] = [];
  private rows: number[] = [];
  private place = new Map<number, number>();
  private chosen = new Set<number>();
  private stale = true;
  /** A click in the table must not make it jump. */
  private clicked = false;

  constructor(page: Page) {
    this.page = page;
    this.element.append(this.bar(), this.scroll);
    this.scroll.addEventListener("scroll", () => this.draw());
    this.scroll.addEventListener("keydown", (event) => this.key(event));
    this.body.addEventListener("click", (event) => this.click(event));
    this.body.addEventListener("dblclick", (event) => this.fly(this.rowOf(event)));
    new ResizeObserver(() => this.draw()).observe(this.scroll);
    page.store.on("content", () => this.refresh());
    page.store.watch(["table"], () => this.refresh(this.stale));
    page.store.watch(["hidden", "isolated", "section"], () => this.wish.scope === "seen" && this.refresh());
    page.store.watch(["selection", "place"], () => this.follow());
  }

  private bar(): HTMLElement {
    const tabs = el("div", { class: "segments", role: "group", "aria-label": "What is listed" });
    for (const [kind, text] of [["parts", "Parts"], ["units", "Units"], ["lines", "Lines"]] as const) {
      const made = el(
        "button",
        {
          type: "button", "aria-pressed": String(kind === this.wish.kind), "data-test": `table-${kind}`,
          onclick: () => this.show(kind)
        },
        text
      );
      this.kinds.set(kind, made);
      put(tabs, made);
    }
    let due = 0;
    const filter = el("input", { type: "search", placeholder: "Filter rows…", "aria-label": "Filter rows",
      "data-test": "table-filter", oninput: (event: Event) => {
      this.wish.text = (event.target as HTMLInputElement).value;
      clearTimeout(due);
      due = window.setTimeout(() => this.refresh(), 120);
    } });
    const scope = el("select", { "aria-label": "Which rows", "data-test": "table-scope", onchange: (event: Event) => {
      this.wish.scope = (event.target as HTMLSelectElement).value as Scope;
      this.refresh();
    } }, el("option", { value: "all" }, "All"), el("option", { value: "seen" }, "Only what is seen"), el(
      "option", { value: "selected" }, "In the selection"
    ));
    return el("div", { class: "table-bar" }, tabs, filter, scope, this.total, el("span", { class: "grow" }),
      el(
        "button",
        {
          type: "button", class: "quiet", title: "Save the listed rows as CSV", "data-test": "csv",
          onclick: () => this.save()
        },
        "CSV"
      ),
      el(
        "button",
        {
          type: "button", class: "icon-button", title: "Close the table (b)", "aria-label": "Close the table",
          onclick: () => this.page.store.set({ table: false })
        },
        icon("close")
      ));
  }

  show(kind: Kind): void {
    this.wish.kind = kind;
    this.wish.sort = null;
    for (const [key, made] of this.kinds) made.setAttribute("aria-pressed", String(key === kind));
    this.refresh();
    this.scroll.scrollTop = 0;
    this.follow();
  }

  /** Lists anew; while the table is closed nothing is done until it opens. */
  private refresh(needed = true): void {
    const { content, shown } = this.page.store;
    this.stale = true;
    if (!content || !shown.table || !needed) return;
    this.stale = false;
    this.all = columns(content, this.wish.kind);
    this.rows = listed(content, shown, this.wish, this.all);
    this.place = new Map(this.rows.map((row, i) => [row, i]));
    this.total.textContent = countWords(this.wish.kind, this.rows.length);
    this.body.style.height = `${Math.max(this.rows.length, 1) * ROW}px`;
    const template = this.all.map((column) => `minmax(${column.width * 9}px, ${column.width}fr)`).join(" ");
    const least = this.all.reduce((sum, column) => sum + column.width * 9, 0);
    for (const piece of [this.head, this.body]) {
      piece.style.setProperty("--columns", template);
      piece.style.minWidth = `${least}px`;
    }
    this.scroll.setAttribute("aria-rowcount", String(this.rows.length + 1));
    this.titles();
    this.mark(content);
    this.draw();
  }

  private titles(): void {
    fill(this.head, ...this.all.map((column) => {
      const by = this.wish.sort === column.key;
      return el("div", {
        role: "columnheader", class: column.number ? "num" : null,
        "aria-sort": by ? (this.wish.descending ? "descending" : "ascending") : "none"
      },
        el(
          "button",
          { type: "button", title: `Sort by ${column.title.toLowerCase()}`, onclick: () => this.sort(column.key) },
          column.title, by ? (this.wish.descending ? " ▼" : " ▲") : ""
        ));
    }));
  }

  /** Up, down, and then as in the file again. */
  private sort(key: string): void {
    const by = this.wish.sort === key;
    if (by && this.wish.descending) this.wish.sort = null;
    else {
      this.wish.sort = key;
      this.wish.descending = by;
    }
    if (this.wish.sort === null) this.wish.descending = false;
    this.refresh();
  }

  private draw(): void {
    const { content, shown } = this.page.store;
    if (!content || !shown.table || this.stale) return;
    const first = Math.max(0, Math.floor(this.scroll.scrollTop / ROW) - SPARE);
    const last = Math.min(
      this.rows.length, Math.ceil((this.scroll.scrollTop + this.scroll.clientHeight) / ROW) + SPARE
    );
    const drawn: Node[] = [];
    for (let i = first; i < last; i++) drawn.push(this.line(content, i));
    if (!this.rows.length) drawn.push(
      el(
        "p", { class: "empty" },
        this.wish.scope === "selected" ? "Nothing is selected." : "No row holds that. Clear the filter to see all."
      )
    );
    fill(this.body, ...drawn);
  }

  private line(content: Content, i: number): HTMLElement {
    const row = this.rows[i];
    const line = el(
      "div",
      {
        role: "row", class: "table-row", "data-index": i, "aria-rowindex": i + 2,
        "aria-selected": String(this.chosen.has(row))
      }
    );
    line.style.transform = `translateY(${i * ROW}px)`;
    this.all.forEach((column, k) => {
      const value = column.of(row);
      const cell = el(
        "div", { role: "gridcell", class: column.number ? "num" : null }, k === 0 && this.swatch(content, row),
        column.number && typeof value === "number" && Number.isInteger(value) ? whole(value) : value
      );
      if (typeof value === "string" && value.length > 12) cell.title = value;
      put(line, cell);
    });
    return line;
  }

  private swatch(content: Content, row: number): HTMLElement | null {
    if (this.wish.kind === "parts") return swatch(labelOf(content, row).color, content.parts.state[row]);
    if (this.wish.kind === "lines") return null;
    const unit = content.network.units[row];
    return swatch(
      content.groups.find((group) => group.unit === unit.type)?.color ?? null, unit.kind ? "sure" : "likely"
    );
  }

  /** Rows of what is selected. */
  private mark(content: Content): void {
    const { selection, place } = this.page.store.shown;
    if (this.wish.kind === "parts") this.chosen = new Set(selection);
    else if (this.wish.kind === "units") {
      const unit = place ? content.network.units.findIndex((unit) => unit.id === place) : -1;
      this.chosen = new Set(unit >= 0 ? [unit] : selection.map((row) => content.parts.unit[row]));
    } else {
      const of = new Set(selection);
      const whole = (row: number) => {
        const parts = partsOf(content, "lines", row);
        return parts.length > 0 && parts.every((part) => of.has(part));
      };
      this.chosen = new Set(this.rows.filter((row) => of.size > 0 && whole(row)));
    }
  }

  /** What is selected in the view is scrolled to. */
  private follow(): void {
    const { content, shown } = this.page.store;
    if (!content || !shown.table) return;
    if (this.wish.scope === "selected") return this.refresh();
    this.mark(content);
    const at = Math.min(...[...this.chosen].map((row) => this.place.get(row) ?? Infinity));
    if (Number.isFinite(at) && !this.clicked) this.reveal(at);
    this.draw();
  }

  private reveal(at: number): void {
    const top = at * ROW;
    const room = this.scroll.clientHeight - this.head.offsetHeight;
    if (top < this.scroll.scrollTop || top + ROW > this.scroll.scrollTop + room) this.scroll.scrollTop = top - room / 2;
  }

  private rowOf(event: Event): number | null {
    const line = (event.target as HTMLElement).closest<HTMLElement>(".table-row");
    return line ? this.rows[Number(line.dataset.index)] : null;
  }

  private click(event: MouseEvent): void {
    const row = this.rowOf(event);
    if (row === null) return;
    this.clicked = true;
    this.select(row, event.ctrlKey || event.metaKey || event.shiftKey);
    this.clicked = false;
  }

  private select(row: number, add = false): void {
    const { store } = this.page;
    const content = store.content!;
    const parts = partsOf(content, this.wish.kind, row);
    if (add) store.select([...new Set([...store.shown.selection, ...parts])]);
    else if (this.wish.kind === "units") store.selectPlace(content.network.units[row].id);
    else store.select(parts);
  }

  private fly(row: number | null): void {
    if (row !== null) this.page.view?.flyTo(partsOf(this.page.store.content!, this.wish.kind, row));
  }

  private key(event: KeyboardEvent): void {
    if (event.target !== this.scroll || !this.rows.length) return;
    const at = Math.min(...[...this.chosen].map((row) => this.place.get(row) ?? Infinity));
    const now = Number.isFinite(at) ? at : -1;
    const page = Math.max(1, Math.floor(this.scroll.clientHeight / ROW) - 2);
    const to = {
      ArrowDown: now + 1, ArrowUp: now - 1, PageDown: now + page, PageUp: now - page, Home: 0, End: this.rows.length - 1
    }[event.key];
    if (to !== undefined) {
      const next = Math.max(0, Math.min(this.rows.length - 1, to));
      this.select(this.rows[next]);
      this.reveal(next);
    } else if (event.key === "Enter") this.fly(this.rows[now] ?? null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private save(): void {
    const name = (this.page.store.content?.title ?? "plant").replace(/\.[^.]*$/, "").replace(/[^\w.-]+/g, "_");
    saveText(
      `${name}-${this.wish.kind}.csv`,
      csv(this.all.map((column) => column.title), this.rows.map((row) => this.all.map((column) => column.of(row))))
    );
    this.page.say(`${countWords(this.wish.kind, this.rows.length)} saved as CSV.`, "good");
  }
}
