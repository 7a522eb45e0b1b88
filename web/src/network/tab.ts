// The left tab of the network: what it consists of, how it is drawn, and what is doubtful in it.

import { run } from "../commands.ts";
import type { Store } from "../store.ts";
import { el } from "../dom.ts";
import { flowState, lengthText, lineSizeText } from "./flow.ts";
import type { Focus } from "./focus.ts";
import type { Plan } from "./plan.ts";
import { counted } from "./result.ts";
import { lineColor, type LinesBy, readPalette } from "./style.ts";
import type { NetworkWarning } from "./warnings.ts";

export interface TabContext {
  store: Store;
  focus: Focus;
  planNow: () => Plan;
  warningsNow: () => readonly NetworkWarning[];
  go(id: string): void;
}

const LINES_BY: Record<LinesBy, string> = { flow: "flow", line: "line", system: "system", size: "size" };
const MOST_FOUND = 300;

export class NetworkTab {
  private readonly head = el("div", { class: "net-tab-head" });
  private readonly list = el("div", { class: "net-tree", "data-test": "net-tree" });
  private readonly search = el("input", {
    type: "search", placeholder: "Filter: tag, kind, DN", "aria-label": "Filter the network", "data-test": "net-filter",
    oninput: () => this.fillList(),
  });
  private readonly open = new Set<number>([0]);
  private readonly rows = new Map<string, HTMLElement>();
  private readonly signs = new Map<number, HTMLElement>();
  private readonly context: TabContext;

  constructor(root: HTMLElement, context: TabContext) {
    this.context = context;
    root.classList.add("net-tab");
    root.append(this.head, this.search, this.list);
  }

  /** Other content. */
  fill(): void {
    this.fillHead();
    this.fillList();
  }

  /** The same content, shown otherwise. */
  fillHead(): void {
    const { store, focus } = this.context;
    const { network } = this.context.planNow().content;
    const { connections } = network;
    const { shown } = store;
    const toggle = (test: string, text: string, key: string, pressed: boolean, command: string) => el("button", {
      type: "button", "data-test": test, "aria-pressed": String(pressed), title: `${text} (${key})`, onclick: () => run(command),
    }, text);
    const by = el("select", {
      "data-test": "net-lines-by", "aria-label": "Colour the lines by",
      onchange: (event) => focus.set({ linesBy: (event.target as HTMLSelectElement).value as LinesBy }),
    }, ...Object.entries(LINES_BY).map(([value, text]) => el("option", { value, selected: value === focus.linesBy }, text)));
    const unknown = connections.filter((connection) => connection.flow === "unknown").length;
    const doubtful = connections.filter((connection) => flowState(connection) === "doubtful").length;
    const length = network.systems.reduce((sum, system) => sum + (system.length ?? 0), 0);
    this.head.replaceChildren(
      el("div", { class: "net-buttons" },
        toggle("net-toggle-lines", "Lines", "n", shown.network, "network.lines"),
        toggle("net-toggle-tags", "Tags", "t", shown.tags, "network.tags"),
        toggle("net-toggle-schematic", "Schematic", "d", shown.schematic, "network.schematic"),
        toggle("net-toggle-moving", "Moving flow", "no key", focus.moving, "network.moving")),
      el("label", { class: "net-row" }, "Colour lines by ", by),
      focus.linesBy === "flow" ? legend(connections.length - unknown - doubtful, doubtful, unknown) : "",
      el("p", { class: "net-soft", "data-test": "net-counts" }, [
        counted(network.units.length, "unit"), counted(network.lines.length, "line"),
        counted(network.systems.length, "system"), `${lengthText(length)} of pipe`,
      ].join(", ")),
      this.warningRow());
  }

  /** Gives the rows of lines the colours that the lines have in the view. */
  paint(): void {
    const palette = readPalette(this.list);
    const plan = this.context.planNow();
    for (const [row, sign] of this.signs) {
      if (!plan.content.network.lines[row]) continue;
      sign.style.borderTopColor = lineColor(plan, row, this.context.focus.linesBy, palette);
    }
  }

  /** Marks the rows of what is selected. */
  mark(): void {
    const { focus } = this.context;
    const place = focus.place?.id;
    for (const [key, row] of this.rows) {
      const on = key === `place ${place}` || key === `line ${focus.selectedLine}`;
      row.classList.toggle("is-selected", on);
      if (on && !row.hasAttribute("aria-current")) row.scrollIntoView({ block: "nearest" });
      if (on) row.setAttribute("aria-current", "true");
      else row.removeAttribute("aria-current");
    }
  }

  private warningRow(): HTMLElement {
    const { focus } = this.context;
    const warnings = this.context.warningsNow();
    if (!warnings.length) return el("p", { class: "net-soft" }, "No warnings in the network.");
    const at = warnings.findIndex((warning) => warning.key === focus.warning);
    const parts = (["missing", "joint", "open"] as const).map((kind) => warnings.filter((w) => w.kind === kind).length);
    const words = [
      parts[0] ? `${counted(parts[0], "unit")} without all lines` : "",
      parts[1] ? `${counted(parts[1], "unjoined face")}` : "", parts[2] ? counted(parts[2], "open end") : "",
    ].filter(Boolean).join(", ");
    const step = (text: string, title: string, key: string, command: string) => el("button", {
      type: "button", title: `${title} (${key})`, "aria-label": title, onclick: () => run(command),
    }, text);
    return el("div", { class: "net-row net-warning-row", "data-test": "net-warnings" },
      el("span", { class: "net-warn-sign", "aria-hidden": "true" }, "!"), el("span", {}, words),
      el("span", { class: "net-row-end" },
        step("‹", "Previous warning", "W", "network.warning.previous"),
        el("span", { class: "net-soft" }, `${at < 0 ? "–" : at + 1}/${warnings.length}`),
        step("›", "Next warning", "w", "network.warning.next"),
        el("button", {
          type: "button", title: "Show warnings in the view", "aria-pressed": String(focus.warnings),
          "data-test": "net-toggle-warnings",
          onclick: () => focus.set({ warnings: !focus.warnings }),
        }, "Show")));
  }

  private fillList(): void {
    const { network } = this.context.planNow().content;
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    this.rows.clear();
    this.signs.clear();
    const blocks: HTMLElement[] = [];
    network.systems.forEach((system, row) => {
      blocks.push(this.block(row, system.id, `${lengthText(system.length)}${system.sizes.length ? `, DN ${range(system.sizes)}` : ""}`, words));
    });
    if (network.units.some((unit) => unit.system < 0)) blocks.push(this.block(-1, "Not connected", "", words));
    this.list.replaceChildren(...blocks.filter((block) => !block.hidden));
    if (!this.list.childElementCount) {
      this.list.append(el("p", { class: "net-empty" }, words.length ? "Nothing in the network is called so." : "No units were found."));
    }
    this.mark();
    this.paint();
  }

  private block(system: number, title: string, note: string, words: string[]): HTMLElement {
    const plan = this.context.planNow();
    const { network } = plan.content;
    const fits = (text: string) => words.every((word) => text.toLowerCase().includes(word));
    const lines = network.lines.map((line, row) => ({ line, row })).filter(({ line }) =>
      line.system === system && fits(`${line.tag} line ${lineSizeText(line.size)} ${nameOf(plan, line.start)} ${nameOf(plan, line.end)}`));
    const units = network.units.filter((unit) => unit.system === system && fits(`${unit.tag} ${unit.kind ?? ""} ${unit.type}`));
    const body = el("div", { class: "net-block" });
    const fillBody = () => {
      if (body.childElementCount) return;
      body.append(
        ...lines.slice(0, MOST_FOUND).map(({ row }) => this.lineRow(row)),
        ...units.slice(0, MOST_FOUND).map((unit) => this.unitRow(unit.id)));
      const rest = Math.max(0, lines.length - MOST_FOUND) + Math.max(0, units.length - MOST_FOUND);
      if (rest) body.append(el("p", { class: "net-soft" }, `and ${rest} more: filter to see them`));
    };
    const block = el("details", {
      open: words.length > 0 || this.open.has(system),
      ontoggle: () => {
        if (block.open) {
          fillBody();
          this.paint();
        }
        if (words.length) return;
        if (block.open) this.open.add(system);
        else this.open.delete(system);
        this.mark();
      },
    }, el("summary", {}, el("strong", {}, title), el("span", { class: "net-soft" },
      [note, counted(lines.length, "line"), counted(units.length, "unit")].filter(Boolean).join(", "))), body);
    if (block.open) fillBody();
    block.hidden = words.length > 0 && !lines.length && !units.length;
    return block;
  }

  private lineRow(row: number): HTMLElement {
    const { focus } = this.context;
    const plan = this.context.planNow();
    const line = plan.content.network.lines[row];
    const sign = el("span", { class: `net-line-sign${line.flow === "unknown" ? " is-unknown" : ""}`, "aria-hidden": "true" });
    this.signs.set(row, sign);
    const arrow = { forward: "→", backward: "←" }[line.flow] ?? "–";
    const button = el("button", {
      type: "button", class: "net-item", "data-test": "net-tree-line", "data-line": line.tag,
      title: `${nameOf(plan, line.start)} ${arrow} ${nameOf(plan, line.end)}, ${lengthText(line.length)}`,
      onclick: () => focus.selectLine(row), onpointerenter: () => focus.hoverLine(row), onpointerleave: () => focus.hoverLine(-1),
    },
    sign, el("span", { class: "net-name" }, line.tag),
    el("span", { class: "net-soft" }, `${shortName(plan, line.start)} ${arrow} ${shortName(plan, line.end)}`),
    el("span", { class: "net-row-end net-soft" }, lineSizeText(line.size)));
    this.rows.set(`line ${row}`, button);
    return button;
  }

  private unitRow(id: string): HTMLElement {
    const { focus, go } = this.context;
    const plan = this.context.planNow();
    const place = plan.places.get(id)!;
    const swatch = el("span", { class: "net-swatch", "aria-hidden": "true" });
    const color = plan.content.groups.find((group) => group.unit === place.type)?.color;
    if (color) swatch.style.background = color;
    const button = el("button", {
      type: "button", class: "net-item", "data-test": "net-tree-unit", "data-id": id, onclick: () => go(id),
      onpointerenter: () => focus.hoverPlace(id), onpointerleave: () => focus.hoverPlace(null),
    },
    swatch, el("span", { class: "net-name" }, place.name), el("span", { class: "net-soft" }, place.what),
    place.unit!.missing > 0 && el("span", { class: "net-row-end is-unsure", title: "Lacks lines that its kind needs" }, "! lacks a line"));
    this.rows.set(`place ${id}`, button);
    return button;
  }
}

function nameOf(plan: Plan, id: string): string {
  return plan.places.get(id)?.name ?? id;
}

/** As in the schematic: J-000 for a junction; ends by what they are. */
function shortName(plan: Plan, id: string): string {
  const place = plan.places.get(id);
  if (!place || place.unit) return place?.name ?? id;
  return place.type === "junction" ? place.name.replace("junction-", "J-") : place.type === "blind" ? "closed" : "open";
}

function range(sizes: readonly number[]): string {
  const [low, high] = [Math.min(...sizes), Math.max(...sizes)];
  return low === high ? String(low) : `${low} to ${high}`;
}

function legend(known: number, doubtful: number, unknown: number): HTMLElement {
  const row = (style: string, text: string, n: number) => n > 0 && el("li", {},
    el("span", { class: `net-stroke ${style}`, "aria-hidden": "true" }), text, el("span", { class: "net-soft" }, String(n)));
  return el("ul", { class: "net-legend", "aria-label": "Lines" },
    row("is-known", "Direction known", known), row("is-doubtful", "Not certain", doubtful), row("is-unknown", "Direction unknown", unknown));
}
