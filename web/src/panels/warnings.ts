// The warnings tab: what the graph itself doubts, in plain words, to be clicked through one by one.

import { networkWarnings, WARNING_TITLES } from "../network/warnings.ts";
import type { Content } from "../types.ts";
import { el, fill, put } from "../dom.ts";
import { iconButton } from "./widgets.ts";
import type { Page } from "./page.ts";
import { linkButton } from "./pieces.ts";
import { count, finding, meshName, partTitle, whole } from "./words.ts";

interface Item {
  text: string;
  /** Tells items with the same text apart. */
  note?: string;
  /** More of it, told when it is looked at. */
  detail: string;
  place: string | null;
  parts: number[];
}

export interface WarningGroup {
  key: string;
  title: string;
  items: Item[];
}

/** Said by the network's own warnings, one by one. */
const COVERED = new Set(["unit-short-of-lines"]);
/** Worth a look first; what is only to be known comes last. */
const LAST = ["ground", "excluded", "duplicate-mesh", "near-duplicate-mesh", "empty-mesh", "open-mesh", "likely"];

/** All warnings by kind. A finding about many parts is one item per part, so that one can go through them. */
export function warningGroups(content: Content): WarningGroup[] {
  const groups = new Map<string, WarningGroup>();
  const add = (key: string, title: string, item: Item) => {
    const group = groups.get(key);
    if (group) group.items.push(item);
    else groups.set(key, { key, title, items: [item] });
  };
  for (const warning of networkWarnings(content)) {
    add(
      warning.kind, WARNING_TITLES[warning.kind],
      { text: warning.title, detail: warning.text, place: warning.place, parts: warning.parts }
    );
  }
  for (const { code, message, parts } of content.diagnostics) {
    if (COVERED.has(code)) continue;
    const each = (code === "unlabelled" || code === "likely") && parts.length > 1;
    if (!each) add(code, finding(code), { text: message, detail: "", place: null, parts });
    else for (const row of parts) add(
      code, finding(code),
      { text: partTitle(content, row), detail: "", note: meshName(content, row), place: null, parts: [row] }
    );
  }
  const rank = (group: WarningGroup) => LAST.indexOf(group.key);
  return [...groups.values()].sort((a, b) => rank(a) - rank(b));
}

const MOST = 60;

export class Warnings {
  readonly element = el("div", { class: "warnings", "data-test": "warnings" });
  private readonly page: Page;
  private readonly changed: (n: number) => void;
  private readonly at = new Map<string, number>();
  private readonly open = new Set<string>();
  private stale = true;
  private known: { content: Content; groups: WarningGroup[] } | null = null;

  constructor(page: Page, changed: (n: number) => void) {
    this.page = page;
    this.changed = changed;
    page.store.on("content", (content) => {
      this.stale = true;
      this.changed(
        this.groups(content).filter((group) => !LAST.includes(group.key)).reduce(
          (n, group) => n + group.items.length, 0
        )
      );
      this.draw();
    });
    page.store.watch(["leftTab"], () => this.draw());
  }

  private groups(content: Content): WarningGroup[] {
    if (this.known?.content !== content) this.known = { content, groups: warningGroups(content) };
    return this.known.groups;
  }

  private draw(): void {
    const { content, shown } = this.page.store;
    if (!content || !this.stale || shown.leftTab !== "warnings") return;
    this.stale = false;
    const groups = this.groups(content);
    if (!groups.length) {
      fill(
        this.element,
        el("p", { class: "empty" }, "No warnings: every unit has the lines it needs, and every part a label.")
      );
      return;
    }
    const told = groups.some((group) => !LAST.includes(group.key));
    fill(
      this.element,
      el(
        "p", { class: "soft lead" },
        told ? "Click one to see it in its place; the arrows go through them one by one." : "Nothing is wrong; these are only to be known."
      ),
      ...groups.map((group) => this.group(group))
    );
  }

  private group(group: WarningGroup): HTMLElement {
    const n = group.items.length;
    const where = el("span", { class: "number", "aria-live": "polite" });
    const list = el("ul", { class: "rows" });
    const step = (by: number) => this.go(
      group, ((this.at.get(group.key) ?? (by > 0 ? -1 : 0)) + by + n) % n, list, where
    );
    const box = el("details", {
      class: "fold warning-group", open: this.open.has(group.key) || group.items.length <= 4,
      "data-test": "warning-group", "data-code": group.key
    },
      el("summary", {}, el("span", { class: "grow" }, group.title), el("span", { class: "badge" }, whole(n))),
      n > 1 && el("div", { class: "spread stepper" }, iconButton("left", "The one before", () => step(-1)), where,
        iconButton("right", "The next one", () => step(1), "warning-next"),
        linkButton(
          "Select all", "Select the parts of all of them",
          () => this.page.store.select([...new Set(group.items.flatMap((item) => item.parts))])
        )),
      list);
    box.addEventListener("toggle", () => (box.open ? this.open.add(group.key) : this.open.delete(group.key)));
    group.items.slice(0, MOST).forEach((item, i) => put(list, el("li", {}, el("button", {
      type: "button", class: "row wrap", "data-test": "warning", disabled: !item.parts.length && !item.place, onclick: () => this.go(group, i, list, where),
    }, el("span", { class: "grow" }, item.text), item.note && el("span", { class: "soft" }, item.note)))));
    if (n > MOST) put(
      list, el("li", { class: "soft" }, `and ${count(n - MOST, "more", "more")}: the arrows reach them all`)
    );
    where.textContent = `${n}`;
    return box;
  }

  private go(group: WarningGroup, i: number, list: HTMLElement, where: HTMLElement): void {
    this.at.set(group.key, i);
    where.textContent = `${i + 1} of ${group.items.length}`;
    list.querySelector("[aria-current]")?.removeAttribute("aria-current");
    const row = list.children[i]?.querySelector("button.row");
    row?.setAttribute("aria-current", "true");
    row?.scrollIntoView({ block: "nearest" });
    const item = group.items[i];
    list.querySelector(".detail")?.remove();
    const detail = item.detail ? el("p", { class: "soft detail", role: "status" }, item.detail) : null;
    if (row) put(row.parentElement!, detail);
    this.page.go(item.parts, item.place);
  }
}
