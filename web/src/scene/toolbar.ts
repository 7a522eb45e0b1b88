// The row of buttons under the plant.

import { allCommands, run } from "../commands.ts";
import type { Store } from "../store.ts";
import { el } from "../dom.ts";
import { iconButton } from "./icons.ts";
import type { IconName } from "./icons.ts";
import type { PlantView } from "./plant_view.ts";
import { isAltered } from "./view_commands.ts";

interface Item {
  icon: IconName;
  command: string;
  /** For what stays on until it is pressed again. */
  pressed?: () => boolean;
}

export function toolbar(view: PlantView, store: Store): HTMLElement {
  const { navigation } = view;
  const groups: Item[][] = [
    [{ icon: "home", command: "view-home" }, { icon: "fly", command: "view-fly" }],
    [
      { icon: "hide", command: "view-hide" },
      { icon: "isolate", command: "view-isolate", pressed: () => !!store.shown.isolated },
      { icon: "all", command: "view-all" },
      { icon: "ghost", command: "view-ghost", pressed: () => store.shown.ghost },
    ],
    [
      { icon: "section", command: "view-section", pressed: () => !!store.shown.section },
      { icon: "explode", command: "view-explode", pressed: () => !!store.shown.explode },
      { icon: "measure", command: "view-measure", pressed: () => store.shown.tool === "measure" },
    ],
    [{ icon: "parallel", command: "view-parallel", pressed: () => navigation.orthographic }, { icon: "picture", command: "view-picture" }],
  ];
  const commands = new Map(allCommands().map((command) => [command.id, command]));
  const buttons: HTMLButtonElement[] = [];
  const updates: (() => void)[] = [];
  const make = (item: Item) => {
    const command = commands.get(item.command)!;
    const title = command.key ? `${command.title} (${command.key})` : command.title;
    const button = iconButton(item.icon, title, item.command, () => run(item.command));
    if (command.key) button.setAttribute("aria-keyshortcuts", command.key);
    buttons.push(button);
    updates.push(() => {
      button.disabled = !(command.when?.() ?? true) || (item.command === "view-all" && !isAltered(store));
      if (item.pressed) button.setAttribute("aria-pressed", String(item.pressed()));
    });
    return button;
  };
  const bar = el("div", { class: "scene-bar", role: "toolbar", "aria-label": "View", "data-test": "toolbar" },
    ...groups.map((group) => el("div", { class: "scene-bar-group" }, ...group.map(make))));
  const update = () => {
    updates.forEach((one) => one());
    stop(buttons);
  };
  bar.addEventListener("keydown", (event) => walk(event, buttons));
  store.on("shown", update);
  store.on("content", update);
  let orthographic = navigation.orthographic;
  view.onFrame(() => {
    if (orthographic === navigation.orthographic) return;
    orthographic = navigation.orthographic;
    update();
  });
  update();
  return bar;
}

/** The Tab key stops at one button of the bar; the arrows go on from there. */
function stop(buttons: HTMLButtonElement[]): void {
  const current = buttons.find((button) => button.tabIndex === 0 && !button.disabled) ?? buttons.find((button) => !button.disabled);
  for (const button of buttons) button.tabIndex = button === current ? 0 : -1;
}

function walk(event: KeyboardEvent, buttons: HTMLButtonElement[]): void {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  const enabled = buttons.filter((button) => !button.disabled);
  const at = enabled.indexOf(document.activeElement as HTMLButtonElement);
  if (!step || at < 0) return;
  event.preventDefault();
  const next = enabled[(at + step + enabled.length) % enabled.length];
  for (const button of buttons) button.tabIndex = button === next ? 0 : -1;
  next.focus();
}
