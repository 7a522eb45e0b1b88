// What a trace or an isolation has found, in words: doubts first, as somebody may open a pipe by it.

import type { Store } from "../store.ts";
import type { Doubt, Isolated } from "../types.ts";
import { type Answer, type Asking, closeOf, isCertain } from "./asking.ts";
import { el } from "../dom.ts";
import type { Focus } from "./focus.ts";
import type { Plan } from "./plan.ts";
import { columns, pieces } from "./told.ts";

export interface Shower {
  plan: Plan;
  store: Store;
  focus: Focus;
  asking: Asking;
  /** Selects a place and goes there. */
  go(id: string): void;
  /** Selects parts and goes there. */
  goParts(parts: readonly number[]): void;
}

/** The whole answer, for the inspector. */
export function answerCard(answer: Answer, shower: Shower): HTMLElement {
  const { result, query } = answer;
  const clear = el("button", {
    type: "button", "data-test": "net-clear", title: "End this and show everything again (c)", onclick: () => shower.asking.clear(),
  }, "Clear");
  const title = titleOf(answer);
  return el("section", { class: "net-card", "data-test": "net-answer", "aria-label": title },
    el("header", {}, el("h3", {}, title), clear),
    query.kind === "isolate" ? verdict(result as Isolated) : null,
    doubtList(result.doubts, shower),
    query.kind === "isolate" ? closeList(answer, shower) : null,
    steps(result.lines, shower, query.kind === "isolate"));
}

/** One line for the 3D view. */
export function answerLine(answer: Answer, plan: Plan): { text: string; certain: boolean } {
  const { result, query } = answer;
  if (query.kind === "trace") {
    const n = result.doubts.length;
    return { text: `${titleOf(answer)}${n ? `: not certain, ${counted(n, "doubt")}` : ""}`, certain: n === 0 };
  }
  const isolated = result as Isolated;
  const names = isolated.close.map((id) => plan.places.get(id)?.name ?? id);
  const close = names.length === 0 ? "no valve found to close"
    : `close ${names.slice(0, 6).join(", ")}${names.length > 6 ? ` and ${names.length - 6} more` : ""}`;
  const certain = isCertain(isolated);
  return { text: `${certain ? "" : "Not certain: "}${titleOf(answer)}: ${close}`, certain };
}

function titleOf({ result: { title } }: Answer): string {
  return title.charAt(0).toUpperCase() + title.slice(1);
}

function verdict(result: Isolated): HTMLElement {
  if (isCertain(result)) {
    return el("p", { class: "net-verdict" },
      "No doubt was found. That is what the model's geometry says: check it on site before anything is opened.");
  }
  const n = result.doubts.length;
  const reasons = n ? `${counted(n, "doubt")} below must be cleared on site.` : "a way may stay open; read the steps below.";
  return el("p", { class: "net-verdict is-unsure", role: "alert" }, el("strong", {}, "Not certain. "),
    `Closing these valves may not cut it off: ${reasons}`);
}

function doubtList(doubts: readonly Doubt[], shower: Shower): HTMLElement | null {
  if (!doubts.length) return null;
  return el("ul", { class: "net-doubts", "aria-label": "Doubts" }, ...doubts.map((doubt) => {
    const go = () => (doubt.place !== null ? shower.go(doubt.place) : shower.goParts(doubt.parts));
    const reachable = doubt.place !== null || doubt.parts.length > 0;
    const text = `Not certain: ${doubt.text}`;
    return el("li", {}, reachable
      ? el("button", { type: "button", class: "net-doubt", "data-test": "net-doubt", onclick: go }, text)
      : el("span", { class: "net-doubt" }, text));
  }));
}

function closeList(answer: Answer, shower: Shower): HTMLElement {
  const close = closeOf(answer.result);
  if (!close.length) return el("p", { class: "net-soft" }, "No valve to close was found.");
  const done = close.filter((id) => answer.ticked.has(id)).length;
  return el("div", {},
    el("h4", {}, "To be closed ", el("span", { class: "net-soft" }, `${done} of ${close.length} ticked off`)),
    el("ul", { class: "net-close" }, ...close.map((id) => {
      const place = shower.plan.places.get(id);
      const box = el("input", {
        type: "checkbox", "data-test": "net-close-tick", "data-id": id, "aria-label": `${place?.name ?? id} is closed`,
        checked: answer.ticked.has(id),
        onchange: (event) => shower.asking.tick(id, (event.target as HTMLInputElement).checked),
      });
      return el("li", {}, box, placeLink(id, place?.name ?? id, shower), el("span", { class: "net-soft" }, place?.what ?? ""));
    })));
}

function steps(lines: readonly string[], shower: Shower, folded: boolean): HTMLElement | null {
  if (!lines.length) return null;
  // The lines are columns of text, as the command line prints them: here they break where there is no room.
  const list = el("div", { class: "net-steps", "data-test": "net-steps", tabindex: "0", role: "group", "aria-label": "Steps" },
    ...lines.map((line) => {
      const { indent, cells } = columns(line);
      const row = el("div", {}, ...cells.map((cell) => el("span", {}, ...linked(cell, shower))));
      row.style.setProperty("--indent", String(indent));
      return row;
    }));
  if (!folded) return list;
  return el("details", { open: true }, el("summary", {}, "How it was found"), list);
}

/** A text whose tags can be clicked. */
export function linked(text: string, shower: Shower): Node[] {
  return pieces(text, shower.plan).map((piece) =>
    piece.place === null ? document.createTextNode(piece.text) : placeLink(piece.place, piece.text, shower));
}

export function placeLink(id: string, text: string, shower: Shower): HTMLElement {
  return el("button", {
    type: "button", class: "net-link", "data-id": id, "data-test": "net-link", onclick: () => shower.go(id),
    onpointerenter: () => shower.focus.hoverPlace(id), onpointerleave: () => shower.focus.hoverPlace(null),
  }, text);
}

export function counted(n: number, one: string, more = `${one}s`): string {
  return `${n} ${n === 1 ? one : more}`;
}
