// Pieces that several parts of the inspector are made of.

import { LIKELY } from "../network/warnings.ts";
import type { Content, Joint } from "../types.ts";
import { el, put } from "../dom.ts";
import { bar, icon, swatch } from "./widgets.ts";
import type { Page } from "./page.ts";
import { count, labelOf, length, partTitle, percent } from "./words.ts";

/** A table of "what: value" lines; lines without a value are left out. */
export function lines(rows: [string, (Node | string | null)?][]): HTMLElement {
  const list = el("dl", { class: "lines" });
  for (const [what, value] of rows) if (value) put(list, el("dt", {}, what), el("dd", {}, value));
  return list;
}

export function linkButton(text: string, title: string, run: () => void, test = ""): HTMLButtonElement {
  return el("button", { type: "button", class: "link", title, "data-test": test || null, onclick: run }, text);
}

export function button(text: string, title: string, run: () => void, test = "", kind = ""): HTMLButtonElement {
  return el(
    "button",
    { type: "button", class: kind || null, title, "data-test": test || null, "data-key": test || text, onclick: run },
    text
  );
}

/** Names of parts that select them; the first few, and how many more there are. */
export function partList(page: Page, content: Content, rows: readonly number[], most = 40): HTMLElement {
  const list = el("ul", { class: "rows" });
  for (const row of rows.slice(0, most)) put(list, el("li", {}, partButton(page, content, row)));
  if (rows.length > most) put(
    list, el("li", { class: "soft" }, `and ${count(rows.length - most, "more part", "more parts")}: see the table`)
  );
  return list;
}

export function partButton(page: Page, content: Content, row: number): HTMLElement {
  const label = labelOf(content, row);
  return el("button", { type: "button", class: "row", "data-test": "part-row", onclick: () => page.go([row]) },
    swatch(label.color, content.parts.state[row]), el("span", { class: "grow" }, partTitle(content, row)),
    el("span", { class: "soft" }, percent(content.parts.confidence[row])));
}

/** Buttons that every selection has: fly, hide, show alone. */
export function viewButtons(page: Page, rows: readonly number[]): HTMLElement {
  const { store } = page;
  const isolated = store.shown.isolated;
  const already = isolated && isolated.size === new Set(rows).size && rows.every((row) => isolated.has(row));
  return el("div", { class: "buttons", role: "group", "aria-label": "View" },
    button("Fly to", "Move so that it fills the view (f)", () => page.view?.flyTo(rows), "fly"),
    button(
      already ? "Show all" : "Show alone", already ? "Show the rest again" : "Show only this (i)",
      () => store.set({ isolated: already ? null : new Set(rows) }), "isolate-parts"
    ),
    button(
      "Hide", "Hide it (h)",
      () => store.set({ hidden: new Set([...store.shown.hidden, ...rows]), selection: [], place: null }), "hide"
    ));
}

/** The "why?" that goes into the history beside the next correction. */
export function whyField(): { element: HTMLElement; value: () => string } {
  const input = el(
    "input",
    {
      type: "text", class: "wide", maxlength: 300, placeholder: "e.g. seen on P&ID 4711 sheet 2",
      "aria-label": "Why, for the history", "data-test": "why"
    }
  );
  const element = el(
    "details", { class: "why" }, el("summary", {}, "Say why"), input,
    el("p", { class: "soft" }, "It stands beside the correction in the history.")
  );
  return { element, value: () => input.value.trim() };
}

/** A joint, with what can be done about it. */
function jointRow(page: Page, content: Content, joint: Joint, of: ReadonlySet<number>): HTMLElement {
  const other = of.has(joint.first) ? joint.second : joint.first;
  const id = (row: number) => content.parts.id[row];
  const ends = { first: id(joint.first), second: id(joint.second) };
  const edit = joint.made
    ? button(
      "Cut", "These two do not join: take the joint away", () => void page.edit([{ kind: "cut", ...ends }]), "cut",
      "small"
    )
    : button(
      "Join", "These two join: make the joint", () => void page.edit([{ kind: "join", ...ends }]), "join", "small"
    );
  const told = joint.made ? joint.kind : `gap ${length(joint.gap)}, ${percent(joint.score)} likely`;
  return el("li", { class: "joint" },
    linkButton(partTitle(content, other), "Select both and move there", () => page.go([joint.first, joint.second])),
    el("span", { class: "soft grow" }, told), page.canEdit() && edit,
    joint.reasons.length > 0 && el(
      "details", { class: "reasons" }, el("summary", {}, "reasons"),
      el("ul", {}, ...joint.reasons.map((reason) => el("li", {}, reason)))
    ));
}

/** Joints of some parts with others: those not made although they are likely. Those of one part the network's slot tells. */
export function jointsOf(
  page: Page, content: Content, rows: readonly number[]
): { open: HTMLElement | null; made: HTMLElement | null } {
  if (rows.length < 2) return { open: null, made: null };
  const of = new Set(rows);
  const across = content.network.joints.filter(
    (joint) => of.has(joint.first) !== of.has(joint.second) || (
      rows.length === 2 && of.has(joint.first) && of.has(joint.second)
    )
  );
  const list = (joints: Joint[]) =>
    joints.length ? el(
      "ul", { class: "joints" }, ...joints.slice(0, 30).map((joint) => jointRow(page, content, joint, of))
    ) : null;
  const open = across.filter((joint) => !joint.made && joint.score >= LIKELY).sort((a, b) => b.score - a.score);
  return { open: list(open), made: list(across.filter((joint) => joint.made)) };
}

/** A warning inside the inspector. */
export function note(text: string, ...children: (Node | null | false)[]): HTMLElement {
  return el("div", { class: "note" }, icon("warn"), el("div", {}, el("p", {}, text), ...children));
}

export function sureBar(confidence: number | null, state: string): HTMLElement {
  return bar(confidence ?? 0, `Confidence ${percent(confidence)}`, state);
}
