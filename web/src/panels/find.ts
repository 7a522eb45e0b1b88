// Searching: a field with a list of what was found, in the top bar and, longer, in the left panel.

import type { Content } from "../types.ts";
import { el, fill, put } from "../dom.ts";
import { swatch } from "./widgets.ts";
import type { Page } from "./page.ts";
import { Index, type Found, type Results } from "./search.ts";
import { partsOf } from "./rows.ts";
import { count, labelOf, length, meshName, partTitle, whole } from "./words.ts";

/** One index for all fields, made when somebody first searches a content. */
const indices = new WeakMap<Content, Index>();

function indexOf(content: Content): Index {
  let index = indices.get(content);
  if (!index) indices.set(content, (index = new Index(content)));
  return index;
}

export interface SearchField {
  input: HTMLInputElement;
  list: HTMLElement;
  search: (query: string) => void;
}

/** A field that lists what it finds: arrow keys choose, Enter selects and moves there. */
export function searchField(
  page: Page, id: string, most: { units: number; lines: number; parts: number }, taken: () => void,
  all?: (query: string) => void
): SearchField {
  const list = el(
    "div", { class: "found", role: "listbox", id: `${id}-list`, "aria-label": "Found", "data-test": `${id}-list` }
  );
  const said = el("span", { class: "only-read", role: "status" });
  let rows: { element: HTMLElement; take: () => void }[] = [];
  let active = -1;
  let asked = 0;
  const input = el("input", {
    type: "search", id, placeholder: "Find a tag, label, DN80, 0.5 m, path…", role: "combobox", autocomplete: "off", spellcheck: "false",
    "aria-expanded": "false", "aria-controls": `${id}-list`, "aria-label": "Find tags, labels, sizes, paths", "data-test": id,
    oninput: () => { clearTimeout(asked); asked = window.setTimeout(() => search(input.value), 60); },
    onkeydown: (event: KeyboardEvent) => {
      if (event.key === "Escape") {
        if (input.value) search("");
        else input.blur();
        event.stopPropagation();
      }
      else if (event.key === "ArrowDown") mark(active + 1);
      else if (event.key === "ArrowUp") mark(active - 1);
      else if (event.key === "Enter") {
        clearTimeout(asked);
        if (shown !== input.value) search(input.value);
        rows[Math.max(active, 0)]?.take();
      }
      else return;
      event.preventDefault();
    },
  });
  let shown = "";

  function mark(to: number): void {
    rows[active]?.element.setAttribute("aria-selected", "false");
    active = rows.length ? (to + rows.length) % rows.length : -1;
    rows[active]?.element.setAttribute("aria-selected", "true");
    rows[active]?.element.scrollIntoView({ block: "nearest" });
    input.setAttribute("aria-activedescendant", rows[active]?.element.id ?? "");
  }

  function search(query: string): void {
    const { content } = page.store;
    if (!content) return;
    if (input.value !== query) input.value = query;
    shown = query;
    rows = [];
    active = -1;
    const found = indexOf(content).find(query, Math.max(most.units, most.lines, most.parts));
    fill(list);
    for (const kind of ["unit", "line", "part"] as const) group(content, found, kind);
    const { totals } = found;
    const total = totals.units + totals.lines + totals.parts;
    if (query.trim() && !total) put(
      list,
      el(
        "p", { class: "empty" },
        `Nothing holds “${query.trim()}”. Tags, labels, paths, part ids, sizes such as DN80 or 350 mm can be found.`
      )
    );
    if (all && total) row(`All ${whole(total)} in the Find tab`, null, "", () => all(query));
    input.setAttribute("aria-expanded", String(total > 0));
    said.textContent = query.trim() ? `${whole(total)} found` : "";
    if (rows.length) mark(0);
  }

  function group(content: Content, found: Results, kind: Found["kind"]): void {
    const key = `${kind}s` as keyof Results["totals"];
    const listed = found[key].slice(0, most[key]);
    if (!listed.length) return;
    put(list, el("h3", { role: "presentation" }, count(found.totals[key], kind)));
    for (const index of listed) {
      const { title, detail, swatch } = words(content, kind, index);
      row(title, swatch, detail, () => {
        taken();
        if (kind === "unit") page.go(content.network.units[index].parts, content.network.units[index].id);
        else page.go(partsOf(content, key as "lines" | "parts", index));
      });
    }
    if (found.totals[key] > listed.length && !all) put(
      list, el("p", { class: "soft" }, `and ${whole(found.totals[key] - listed.length)} more: the table lists them all`)
    );
  }

  function row(title: string, mark: Node | null, detail: string, take: () => void): void {
    const element = el("div", {
      role: "option", class: "option", id: `${id}-${rows.length}`, "aria-selected": "false", "data-test": "found",
      onclick: take
    },
      mark, el("span", { class: "grow" }, title), el("span", { class: "soft" }, detail));
    // The field keeps the focus, so that the list does not close before the click.
    element.addEventListener("pointerdown", (event) => event.preventDefault());
    rows.push({ element, take });
    put(list, element);
  }

  // What nobody sees is not searched again.
  page.store.on("content", () => shown && list.offsetParent && search(shown));
  list.append(said);
  return { input, list, search };
}

function words(content: Content, kind: Found["kind"], index: number): {
  title: string;
  detail: string;
  swatch: HTMLElement | null
} {
  if (kind === "unit") {
    const unit = content.network.units[index];
    const color = content.groups.find((group) => group.unit === unit.type)?.color ?? null;
    return { title: unit.tag, detail: unit.kind ?? unit.type, swatch: swatch(color, unit.kind ? "sure" : "likely") };
  }
  if (kind === "line") {
    const line = content.network.lines[index];
    return {
      title: line.tag,
      detail: [line.size && `DN ${line.size}`, line.length !== null && length(line.length)].filter(Boolean).join(", "),
      swatch: null
    };
  }
  return {
    title: partTitle(content, index), detail: meshName(content, index),
    swatch: swatch(labelOf(content, index).color, content.parts.state[index])
  };
}

export class Find {
  readonly element = el("div", { class: "find" });
  readonly field: SearchField;

  constructor(page: Page) {
    this.field = searchField(page, "find", { units: 100, lines: 100, parts: 200 }, () => undefined);
    const hints = el("div", { class: "empty hints" },
      el("p", {}, "Search the whole plant:"),
      el("ul", {}, ...(
        [
          ["V-0", "tags of units and lines"], ["gate valve", "labels and kinds"],
          ["DN80", "what runs in a nominal size"], ["350 mm", "parts with a side of that length"],
          ["Geo_0004", "paths and names of the file, part ids"]
        ] as const
      ).map(([query, means]) =>
        el(
          "li", {},
          el(
            "button",
            { type: "button", class: "link", onclick: () => { this.field.search(query); this.field.input.focus(); } },
            query
          ),
          el("span", { class: "soft" }, means)
        ))),
      el("p", { class: "soft" }, "Arrow keys choose, Enter selects and moves there."));
    this.element.append(this.field.input, this.field.list, hints);
    page.store.watch(["leftTab"], () => {
      if (page.store.shown.leftTab === "find" && this.field.input.value) this.field.search(this.field.input.value);
    });
  }

  open(query: string): void {
    this.field.search(query);
    this.field.input.focus();
  }
}
