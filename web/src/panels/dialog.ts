// Windows over the page: one way of opening and closing them, and the help.

import { allCommands, type Command } from "../commands.ts";
import { el, put } from "../dom.ts";
import { iconButton } from "./widgets.ts";

/** Opens a window over the page; Escape, its button or a click beside it closes it; the browser gives the focus back. */
export function openDialog(title: string, content: Node[], test: string, kind = ""): HTMLDialogElement {
  const dialog = el("dialog", { class: `dialog ${kind}`, "aria-label": title, "data-test": test });
  put(dialog,
    el("header", {}, el("h2", {}, title), iconButton("close", "Close (Esc)", () => dialog.close(), "dialog-close")),
    el("div", { class: "dialog-body" }, ...content));
  // What is typed here is not meant for the page below.
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

const AREAS: Command["area"][] = ["View", "Selection", "Review", "Network", "Corrections", "Help"];
const GESTURES: [string, string][] = [
  ["Drag", "Turn around the point under the pointer"],
  ["Right or middle drag, Shift + drag", "Move sideways"],
  ["Wheel, pinch", "Nearer and farther, towards the pointer"],
  ["Click", "Select a part; click it again for its whole unit"],
  ["Ctrl + click", "Add to the selection"],
  ["Double click", "Fly to a part"],
];

/** All that keys and the mouse do, by area. */
export function openHelp(): void {
  const columns = AREAS.map((area) => {
    const keys = new Map<string, string[]>();
    for (const command of allCommands()) {
      if (command.area !== area || !command.key) continue;
      keys.set(command.title, [...(keys.get(command.title) ?? []), keyWords(command.key)]);
    }
    return keys.size ? table(area, [...keys].map(([title, pressed]) => [pressed, title])) : null;
  });
  const mouse = table("Mouse and touch", GESTURES.map(([gesture, does]) => [[gesture], does]));
  openDialog("Keys and mouse", [el("div", { class: "help" }, mouse, ...columns)], "help", "wide");
}

function table(title: string, rows: [string[], string][]): HTMLElement {
  const list = el("dl", {});
  for (const [keys, does] of rows) put(
    list, el("dt", {}, ...keys.map((key) => el("kbd", {}, key))), el("dd", {}, does)
  );
  return el("section", {}, el("h3", {}, title), list);
}

const NAMES: Record<string, string> = {
  Escape: "Esc", Backspace: "⌫ Backspace", ArrowUp: "↑", ArrowDown: "↓", ArrowLeft: "←", ArrowRight: "→", " ": "Space",
};

export function keyWords(key: string): string {
  // A capital letter is typed with Shift.
  const told = key.replace(/(?<=^|\+)([A-Z])$/, "Shift+$1");
  return told.split(/(?<=.)\+(?=.)/).map((piece) => NAMES[piece] ?? (piece.length === 1 ? piece.toUpperCase() : piece)).join(" + ");
}
