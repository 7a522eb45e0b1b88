// The inspector of a unit, and of a junction or an end of a pipe.

import type { Content, Edit, End, Unit } from "../types.ts";
import { el, fill } from "../dom.ts";
import { bar, fold, iconButton, swatch } from "./widgets.ts";
import type { Page } from "./page.ts";
import { button, jointsOf, lines, linkButton, note, partList, viewButtons } from "./pieces.ts";
import { lazily } from "./inspect_part.ts";
import { count, length, lengths, percent, upper } from "./words.ts";

export function inspectUnit(page: Page, content: Content, unit: Unit, head: HTMLElement, rest: HTMLElement): void {
  const row = content.network.units.indexOf(unit);
  const color = content.groups.find((group) => group.unit === unit.type)?.color ?? null;
  fill(head,
    el("div", { class: "title" }, swatch(color, unit.kind ? "sure" : "likely"), tagLine(page, unit)),
    kind(page, unit),
    unit.handling && el("p", { "data-test": "unit-handling" }, upper(unit.handling)),
    missing(page, content, unit),
    viewButtons(page, unit.parts),
    explode(page, unit));
  const joints = jointsOf(page, content, unit.parts);
  const system = content.network.systems[unit.system];
  fill(rest,
    !unit.missing && joints.open && note("It may join what it was not joined to:", joints.open),
    fold("About this unit", true, lines([
      [
        "System",
        system && linkButton(
          `${system.id}, ${count(system.units.length, "unit")}`, "Select all units of the system",
          () => page.go(system.units.flatMap((i) => content.network.units[i].parts))
        )
      ],
      ["Size", lengths(unit.size)],
      ["Place", unit.point.map((at, i) => (at + content.origin[i]).toFixed(2)).join(", ") + " m"],
      ...unit.facts.map(([key, value]): [string, string] => [upper(key), value]),
      ["Unit", unit.id]])),
    fold(`Ports (${unit.ports.length})`, unit.ports.length < 5, ports(unit)),
    fold(`Parts (${unit.parts.length})`, unit.parts.length < 13, partList(page, content, unit.parts)),
    page.source.live && lazily("Why this unit?", () => page.source.explain("unit", unit.id)),
    joints.made && fold("Joints", false, joints.made),
    page.canEdit() && fold("More corrections", false, more(page, content, unit, row)));
}

/** A value that is put right in its place: Enter takes it, Escape leaves it; a refusal is said beneath. */
interface InPlace {
  name: string;
  /** What is drawn while nobody changes it. */
  shown: HTMLElement;
  value: string;
  change: string;
  empty: string;
  /** What it may be, offered while one types. */
  offered?: readonly string[];
  edit: (value: string) => Edit;
}

function inPlace(page: Page, what: InPlace): HTMLElement {
  const box = el("div", { class: "grow tag-line" });
  const test = what.name.toLowerCase();
  const show = () => fill(box, el("div", { class: "spread" }, what.shown,
    page.canEdit() && iconButton("edit", what.change, edit, `edit-${test}`)));
  const edit = () => {
    const list = what.offered && el("datalist", { id: `${test}-offered` }, ...what.offered.map((value) => el("option", { value })));
    const input = el(
      "input",
      {
        type: "text", value: what.value, maxlength: 80, "aria-label": what.name, "data-test": `${test}-input`,
        spellcheck: "false", list: list ? list.id : null
      }
    );
    const trouble = el("p", { class: "trouble", role: "alert" });
    const save = async () => {
      const value = input.value.trim();
      if (value === what.value) return show();
      if (!value) return void (trouble.textContent = what.empty);
      input.disabled = true;
      const taken = await page.edit([what.edit(value)]);
      input.disabled = false;
      if (taken) return input.blur();
      if (!input.isConnected) return;
      trouble.textContent = page.refusal() || "This was not taken.";
      input.focus();
    };
    input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") void save();
      else if (event.key === "Escape") show();
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    fill(
      box,
      el("div", { class: "spread" }, input, button("Save", `${what.change}: take this`, () => void save(), `${test}-save`, "main")),
      list, trouble
    );
    input.select();
  };
  show();
  return box;
}

function tagLine(page: Page, unit: Unit): HTMLElement {
  return inPlace(page, {
    name: "Tag", shown: el("h2", { "data-test": "unit-tag" }, unit.tag), value: unit.tag, change: "Change the tag",
    empty: "A tag has at least one letter.", edit: (tag) => ({ kind: "tag", unit: unit.id, tag })
  });
}

/** Usual kinds by type of unit; any other words are taken as well. */
const KINDS: Readonly<Record<string, readonly string[]>> = {
  valve: [
    "ball valve", "butterfly valve", "check valve", "control valve", "diaphragm valve", "gate valve", "globe valve",
    "needle valve", "plug valve", "pressure reducing valve", "relief valve", "safety valve", "solenoid valve", "three-way valve"
  ],
  gauge: ["flow meter", "level gauge", "pressure gauge", "sight glass", "temperature gauge", "thermowell", "transmitter"],
  pump: ["centrifugal pump", "diaphragm pump", "gear pump", "piston pump", "screw pump"],
  tank: ["column", "horizontal tank", "tank", "vessel"],
};

function kind(page: Page, unit: Unit): HTMLElement {
  const guesses = unit.kind_guesses.slice(0, 4);
  const edit = (device: string): Edit => ({ kind: "device", unit: unit.id, device });
  const guess = (name: string) => page.canEdit()
    ? linkButton(upper(name), `${unit.tag} is a ${name}`, () => void page.edit([edit(name)]), "kind-guess")
    : upper(name);
  return el("div", { class: "sureness" },
    inPlace(page, {
      name: "Kind", shown: el("p", { "data-test": "unit-kind" }, upper(unit.kind ?? `${unit.type}, kind not known`)),
      value: unit.kind ?? "", change: "Say what it is", empty: "Say in words what it is, as in check valve.",
      offered: KINDS[unit.type] ?? [], edit
    }),
    guesses.length > 0 && el("ul", { class: "rows" }, ...guesses.map(([name, share]) =>
      el(
        "li", { class: "row" }, el("span", { class: "grow" }, guess(name)), bar(share, percent(share)),
        el("span", { class: "number" }, percent(share))
      ))),
    guesses.length > 1 && el("p", { class: "soft" }, page.canEdit()
      ? "Nobody is sure: say what it is, or correct the label of what turns it."
      : "The kind follows the labels of its parts."));
}

function missing(page: Page, content: Content, unit: Unit): HTMLElement | null {
  if (unit.missing <= 0) return null;
  const open = jointsOf(page, content, unit.parts).open;
  return note(`${count(unit.missing, "line is", "lines are")} missing: a ${unit.kind ?? unit.type} needs more lines than were found here.`,
    el(
      "p", { class: "soft" },
      open ? "It may join one of these:" : "Look for a wrong label beside it, or join it by hand (More corrections)."
    ), open);
}

function ports(unit: Unit): HTMLElement {
  if (!unit.ports.length) return el("p", { class: "soft" }, "No port was found.");
  return el("ul", { class: "rows" }, ...unit.ports.map((port) =>
    el(
      "li", { class: "row" }, el("b", {}, port.name),
      el("span", { class: "grow soft" }, port.diameter === null ? "diameter not known" : `⌀ ${length(port.diameter)}`)
    )));
}

function explode(page: Page, unit: Unit): HTMLElement | null {
  if (unit.parts.length < 2) return null;
  const share = () => {
    const now = page.store.shown.explode;
    return now?.unit === unit.id ? Math.round(100 * now.share) : 0;
  };
  const input = el(
    "input",
    {
      type: "range", min: 0, max: 100, value: share(),
      "aria-label": "Draw its parts apart", "data-test": "explode", "data-key": "explode"
    }
  );
  input.addEventListener("input", () => {
    const wanted = Number(input.value) / 100;
    page.store.set({ explode: wanted ? { unit: unit.id, share: wanted } : null });
  });
  // There is another slider in the view, and a key.
  const off = page.store.watch(["explode"], () => {
    if (input.isConnected) input.value = String(share());
    else off();
  });
  return el("label", { class: "slider" }, "Explode", input);
}

function more(page: Page, content: Content, unit: Unit, row: number): HTMLElement {
  const id = (part: number) => content.parts.id[part];
  return el("div", { class: "buttons stack" },
    button("Merge with the unit I click next", "Both are one unit",
      () => page.pickNext(`Click the unit that ${unit.tag} belongs to`, (part) => {
      const other = content.network.units[content.parts.unit[part]];
      if (content.parts.unit[part] === row) page.say(`That is ${unit.tag} itself.`);
      else void page.edit([{ kind: "merge", parts: [...unit.parts, ...(other?.parts ?? [part])].map(id) }]);
    }), "merge"),
    unit.parts.length > 1 && button("Split off the part I click next", "That part is a unit of its own", () => page.pickNext(`Click the part that does not belong to ${unit.tag}`, (part) => {
      if (content.parts.unit[part] === row) void page.edit([{ kind: "split", parts: [id(part)] }]);
      else page.say(`That part does not belong to ${unit.tag}.`);
    }), "split"),
    button("Join with the part I click next", "They join along the pipes",
      () => page.pickNext(`Click the part that joins ${unit.tag}`, (part) => {
      const first = nearest(content, unit.parts, part);
      if (content.parts.unit[part] !== row) void page.edit([{ kind: "join", first: id(first), second: id(part) }]);
    }), "join-next"));
}

/** The one of some parts whose box is nearest to another part's. */
function nearest(content: Content, rows: readonly number[], to: number): number {
  const { center, size } = content.parts;
  const gap = (row: number) => Math.hypot(...[0, 1, 2].map((k) =>
    Math.max(0, Math.abs(center[3 * row + k] - center[3 * to + k]) - (size[3 * row + k] + size[3 * to + k]) / 2)));
  return rows.reduce((best, row) => (gap(row) < gap(best) ? row : best), rows[0]);
}

const ENDS: Record<End["kind"], [string, string]> = {
  junction: ["Junction", "Lines meet here."],
  open: ["Open end", "A pipe ends here without a cap: it leads out of the model, or something is missing."],
  blind: ["Blind end", "A cap or a blind flange closes the pipe here."],
  unknown: ["End of a pipe", "It is not known whether it is open or closed."],
};

export function inspectEnd(page: Page, content: Content, end: End, head: HTMLElement, rest: HTMLElement): void {
  const [name, words] = ENDS[end.kind];
  fill(head,
    el(
      "div", { class: "title" },
      el("div", { class: "grow" }, el("h2", { "data-test": "end-name" }, name), el("p", { class: "soft" }, end.name))
    ),
    el("p", {}, words), viewButtons(page, end.parts));
  const joints = jointsOf(page, content, end.parts);
  const first = end.parts[0];
  fill(rest,
    joints.open && note("Near it, not joined:", joints.open),
    page.canEdit() && end.kind !== "junction" && first !== undefined && el("div", { class: "buttons" },
      button("Join with the part I click next", "They join along the pipes",
        () => page.pickNext("Click the part that this end joins", (part) => {
        if (!end.parts.includes(part)) void page.edit(
          [{ kind: "join", first: content.parts.id[nearest(content, end.parts, part)], second: content.parts.id[part] }]
        );
      }), "join-next")),
    fold("Parts here", true, partList(page, content, end.parts)),
    joints.made && fold("Joints", false, joints.made));
}
