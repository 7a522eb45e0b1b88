// Choosing a label of the vocabulary: type a few letters, arrow keys, Enter.

import type { Content } from "../types.ts";
import { el, fill } from "../dom.ts";
import { swatch } from "./widgets.ts";
import { openDialog } from "./dialog.ts";
import type { LabelChoice } from "./page.ts";
import { upper } from "./words.ts";

interface Row extends LabelChoice {
  color: string;
  text: string;
}

const recent: LabelChoice[] = [];
const RECENT = 4;

/** All labels, groups before their names. */
function vocabulary(content: Content): Row[] {
  return content.groups.flatMap((group) => [
    { group: group.name, name: null, color: group.color, text: group.name.toLowerCase() },
    ...group.names.map(
      (name) => ({ group: group.name, name, color: group.color, text: `${name} ${group.name}`.toLowerCase() })
    ),
  ]);
}

/** Rows that hold all words, those whose name begins with them first. */
export function matching<T extends { text: string }>(rows: T[], query: string): T[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const hits = rows.filter((row) => words.every((word) => row.text.includes(word)));
  const lead = (row: T) => (
    row.text.startsWith(words.join(" ")) ? 0 : words.every((word) => ` ${row.text}`.includes(` ${word}`)) ? 1 : 2
  );
  return words.length ? hits.sort((a, b) => lead(a) - lead(b)) : hits;
}

export function pickLabel(
  content: Content, title: string, first: LabelChoice[], take: (choice: LabelChoice) => void
): void {
  const rows = vocabulary(content);
  const find = (choice: LabelChoice) => rows.find((row) => row.group === choice.group && row.name === choice.name);
  const list = el("div", { class: "picker-list", role: "listbox", id: "picker-list", "aria-label": "Labels" });
  let shown: Row[] = [];
  let active = 0;
  const input = el("input", {
    type: "text", class: "picker-input", placeholder: "Type a label: valve body, flange, support…", role: "combobox", autocomplete: "off",
    "aria-expanded": "true", "aria-controls": "picker-list", "aria-label": "Filter labels", "data-test": "picker-input",
    oninput: () => { active = 0; render(); },
    onkeydown: (event: KeyboardEvent) => {
      const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[event.key];
      if (step) active = Math.max(0, Math.min(shown.length - 1, active + step));
      else if (event.key === "Enter" && shown[active]) choose(shown[active]);
      else return;
      event.preventDefault();
      mark();
    },
  });
  const dialog = openDialog(title, [input, list], "picker", "picker");

  function choose(row: Row): void {
    dialog.close();
    const choice = { group: row.group, name: row.name };
    const at = recent.findIndex((known) => known.group === row.group && known.name === row.name);
    if (at >= 0) recent.splice(at, 1);
    recent.unshift(choice);
    recent.length = Math.min(recent.length, RECENT);
    take(choice);
  }

  function render(): void {
    const query = input.value.trim();
    const near = query ? [] : [...first, ...recent].map(find).filter((row) => row !== undefined);
    shown = query ? matching(rows, query) : [...new Set([...near, ...rows])];
    const options = shown.map((row, i) =>
      el("div", {
        role: "option", id: `picker-${i}`, class: row.name ? "option" : "option whole", "data-test": "picker-option",
        onclick: () => choose(row), onpointermove: () => { if (active !== i) { active = i; mark(false); } }
      },
        swatch(row.color, "sure"), el("span", { class: "grow" }, row.name ? upper(row.name) : row.group),
        el("span", { class: "soft" }, row.name ? row.group : "group only")));
    if (near.length) options[new Set(near).size - 1]?.classList.add("last-near");
    fill(
      list, ...options,
      !shown.length && el(
        "p", { class: "empty" }, "No label holds these letters. The vocabulary is what the plant was built with."
      )
    );
    mark();
  }

  function mark(scroll = true): void {
    [...list.children].forEach((row, i) => row.setAttribute("aria-selected", String(i === active)));
    input.setAttribute("aria-activedescendant", `picker-${active}`);
    if (scroll) list.children[active]?.scrollIntoView({ block: "nearest" });
  }

  render();
  input.focus();
}
