// The inspector of several parts at once.

import type { Content, Edit, Line } from "../types.ts";
import { el, fill } from "../dom.ts";
import { bar, fold, swatch } from "./widgets.ts";
import type { LabelChoice, Page } from "./page.ts";
import { button, jointsOf, note, partList, viewButtons } from "./pieces.ts";
import { count, labelOf, percent, whole } from "./words.ts";

let withAlike = false;

export function inspectMany(
  page: Page, content: Content, rows: readonly number[], head: HTMLElement, rest: HTMLElement
): void {
  fill(head,
    el(
      "div", { class: "title" },
      el("div", { class: "grow" }, el("h2", { "data-test": "many" }, `${count(rows.length, "part")} selected`))
    ),
    byLabel(page, content, rows),
    page.canEdit() && correct(page, content, rows),
    viewButtons(page, rows));
  const joints = rows.length <= 50 ? jointsOf(page, content, rows) : { open: null };
  fill(rest,
    joints.open && note("They may join what they were not joined to:", joints.open),
    fold("Parts", true, partList(page, content, rows)));
}

/** A line of the network: its own card, which the network fills in, comes before what can be done with its parts. */
export function inspectLine(
  page: Page, content: Content, line: Line, rows: readonly number[], head: HTMLElement, rest: HTMLElement
): void {
  fill(head,
    el("div", { class: "title" }, el(
      "div", { class: "grow" }, el("h2", { "data-test": "line-tag" }, `Line ${line.tag}`),
      el("p", { class: "soft" }, count(rows.length, "part"))
    )),
    viewButtons(page, rows));
  fill(rest,
    fold("What it is made of", true, byLabel(page, content, rows)),
    fold("Parts", false, partList(page, content, rows)),
    page.canEdit() && fold("Correct its parts", false, correct(page, content, rows)));
}

/** How many of each label, the most first; a click narrows the selection to them. */
function byLabel(page: Page, content: Content, rows: readonly number[]): HTMLElement {
  const { parts } = content;
  const counts = new Map<string, number[]>();
  for (const row of rows) {
    const key = `${parts.group[row]}|${parts.name[row]}`;
    const of = counts.get(key);
    if (of) of.push(row);
    else counts.set(key, [row]);
  }
  const sorted = [...counts.values()].sort((a, b) => b.length - a.length);
  const list = sorted.slice(0, 12).map((of) => {
    const label = labelOf(content, of[0]);
    return el("li", {}, el("button",
      { type: "button", class: "row", title: "Select only these", onclick: () => page.store.select(of) },
      swatch(label.color, label.color ? "sure" : "open"), el("span", { class: "grow" }, label.name),
      bar(
        of.length / rows.length, percent(of.length / rows.length)
      ), el("span", { class: "number" }, whole(of.length))));
  });
  return el("ul", { class: "rows", "aria-label": "Labels among them" }, ...list,
    sorted.length > 12 && el("li", { class: "soft" }, `and ${count(sorted.length - 12, "more label", "more labels")}`));
}

function correct(page: Page, content: Content, rows: readonly number[]): HTMLElement {
  const { parts } = content;
  const label = (choice: LabelChoice) => {
    const seen = new Set<number>();
    const edits: Edit[] = [];
    for (const row of rows) {
      if (withAlike && seen.has(parts.shape[row])) continue;
      seen.add(parts.shape[row]);
      edits.push({ kind: "label", part: parts.id[row], ...choice, this_only: !withAlike });
    }
    void page.edit(edits);
  };
  const ids = rows.map((row) => parts.id[row]);
  const units = new Set(rows.map((row) => parts.unit[row]));
  const oneUnit = units.size === 1 && !units.has(-1) ? content.network.units[[...units][0]] : null;
  return el("section", { class: "correct", "aria-label": "Correct them" },
    el("div", { class: "buttons" },
      button(
        "Label them all…", "Choose one label for all of them (l)",
        () => page.pickLabel(`What are these ${whole(rows.length)} parts?`, [], label), "label-all", "main"
      ),
      button(
        "Merge as one unit", "They are one unit together", () => void page.edit([{ kind: "merge", parts: ids }]),
        "merge-all"
      ),
      oneUnit && rows.length < oneUnit.parts.length && button(
        `Split off ${oneUnit.tag}`, "They are a unit of their own",
        () => void page.edit([{ kind: "split", parts: ids }]), "split-all"
      ),
      rows.length === 2 && button(
        "Join these two", "They join along the pipes",
        () => void page.edit([{ kind: "join", first: ids[0], second: ids[1] }]), "join-two"
      )),
    el(
      "label", { class: "check" },
      el(
        "input",
        {
          type: "checkbox", checked: withAlike,
          onchange: (event: Event) => (withAlike = (event.target as HTMLInputElement).checked)
        }
      ),
      "and all other parts of the same shapes"
    ));
}
