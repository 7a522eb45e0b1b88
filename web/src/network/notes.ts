// What stands over the 3D view: the answer that is shown, and the warning that is told.

import { el } from "../dom.ts";
import { answerLine, type Shower } from "./result.ts";
import type { NetworkWarning } from "./warnings.ts";

export interface NoteActions {
  step(by: 1 | -1): void;
  close(): void;
}

/** Fills the notes anew; nothing where there is nothing to say. */
export function fillNotes(
  root: HTMLElement, shower: Shower, warnings: readonly NetworkWarning[], current: number, actions: NoteActions,
): void {
  const notes: HTMLElement[] = [];
  const { asking } = shower;
  if (asking.picking !== null) {
    const name = shower.plan.places.get(asking.picking)?.name ?? "it";
    notes.push(bar(`Click where the way from ${name} should lead.`, "", "Stop", () => asking.startPick(asking.picking!)));
  }
  if (asking.answer) {
    const { text, certain } = answerLine(asking.answer, shower.plan);
    notes.push(bar(text, certain ? "" : "is-unsure", "Clear", () => asking.clear()));
  }
  const warning = warnings[current];
  if (warning) notes.push(warningCard(warning, current, warnings.length, actions));
  root.replaceChildren(...notes);
}

function bar(text: string, style: string, end: string, run: () => void): HTMLElement {
  return el("div", { class: `net-note ${style}`, role: "status", "data-test": "net-note" },
    el("span", {}, text), el("button", { type: "button", "data-test": "net-note-end", onclick: run }, end));
}

function warningCard(warning: NetworkWarning, at: number, n: number, actions: NoteActions): HTMLElement {
  const button = (test: string, text: string, title: string, run: () => void) =>
    el("button", { type: "button", "data-test": test, title, "aria-label": title, onclick: run }, text);
  return el("div", { class: "net-note net-warning-card", role: "status", "data-test": "net-warning-card" },
    el("div", {}, el("strong", {}, warning.title), el("p", {}, warning.text)),
    el("div", { class: "net-note-tools" },
      button("net-warning-previous", "‹", "Previous warning (W)", () => actions.step(-1)),
      el("span", {}, `${at + 1} of ${n}`),
      button("net-warning-next", "›", "Next warning (w)", () => actions.step(1)),
      button("net-warning-close", "×", "Close", () => actions.close())));
}
