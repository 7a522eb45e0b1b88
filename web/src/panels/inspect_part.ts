// The inspector of one part: what it is, how sure that is, and putting it right.

import type { Content, Edit } from "../types.ts";
import { el, fill, put } from "../dom.ts";
import { fold, iconButton, swatch } from "./widgets.ts";
import type { LabelChoice, Page } from "./page.ts";
import { button, lines, linkButton, partButton, sureBar, viewButtons, whyField } from "./pieces.ts";
import {
  area, count, fromWhere, howSure, labelOf, lengths, meshesOf, percent, repeatsOf, upper, volume, whole,
} from "./words.ts";

/** Whether a correction is for the part alone; asked for anew at each selection, as it is the exception. */
let onlyThis = false;
let lastRow = -1;

/** Whether the person wants the next label for this part alone. */
export function isForThisOnly(row: number): boolean {
  return onlyThis && row === lastRow;
}

export function inspectPart(page: Page, content: Content, row: number, head: HTMLElement, rest: HTMLElement): void {
  if (row !== lastRow) onlyThis = false;
  lastRow = row;
  fill(
    head, title(content, row), sureness(content, row), page.canEdit() && correction(page, content, row),
    viewButtons(page, [row])
  );
  fill(rest,
    fold("About this part", true, about(page, content, row)),
    facts(content, row),
    page.source.live && why(page, content, row),
    page.canEdit() && fold("More corrections", false, more(page, content, row)));
}

function title(content: Content, row: number): HTMLElement {
  const label = labelOf(content, row);
  return el("div", { class: "title" },
    swatch(label.color, content.parts.state[row]),
    el("div", { class: "grow" },
      el("h2", { "data-test": "part-name" }, label.name),
      el(
        "p", { class: "soft" },
        [
          label.group, content.parts.ground[row] ? "ground" : ""
        ].filter(Boolean).join(" · ") || "Nothing is known of it yet"
      )));
}

function sureness(content: Content, row: number): HTMLElement {
  const { state, confidence, source } = content.parts;
  return el("div", { class: "sureness" },
    el(
      "div", { class: "spread" },
      el("b", { class: `state ${state[row]}`, "data-test": "part-state" }, howSure(state[row])),
      el("span", { class: "number" }, confidence[row] === null ? "" : percent(confidence[row]))
    ),
    sureBar(confidence[row], state[row]),
    el("p", { class: "soft" }, fromWhere(source[row])));
}

function correction(page: Page, content: Content, row: number): HTMLElement {
  const { parts, groups } = content;
  const alike = repeatsOf(parts, row);
  const reason = whyField();
  const send = (choice: LabelChoice) => {
    const edit: Edit = { kind: "label", part: parts.id[row], ...choice, this_only: onlyThis };
    void page.edit([edit], reason.value());
  };
  const guesses = parts.guesses[row].filter(([group]) => groups[group]);
  const current = (group: number, name: string | null) => group === parts.group[row] && name === parts.name[row];
  const list = el("div", { class: "guesses", role: "group", "aria-label": "What it may be" });
  for (const [group, name, confidence] of guesses) {
    const now = current(group, name);
    put(list, el("button", {
      type: "button", class: now ? "guess now" : "guess", "data-test": "guess", "data-key": `guess-${group}-${name}`,
      title: now ? "It is labelled so: click to confirm it" : alike.length > 1 ? `Label it so, or all ${whole(alike.length)} of its shape, as chosen below` : "Label it so",
      onclick: () => send({ group: groups[group].name, name }),
    }, swatch(groups[group].color, "sure"), el("span", { class: "grow" }, upper(name ?? groups[group].name)),
    now && el("span", { class: "tick" }, "✓ now"), el("span", { class: "number" }, percent(confidence))));
  }
  const first = guesses.map(([group, name]) => ({ group: groups[group].name, name }));
  put(list, el("button", {
    type: "button", class: "guess other", "data-test": "other-label", "data-key": "other-label", title: "Choose any label of the vocabulary (l)",
    onclick: () => page.pickLabel(`What is this ${labelOf(content, row).name.toLowerCase()}?`, first, send),
  }, "Other…"));
  return el("section", { class: "correct", "aria-label": "Correct the label" },
    el("h3", {}, parts.state[row] === "sure" ? "Wrong? Click what it is" : "What is it?"),
    guesses.length > 0 && page.store.shown.question !== null && el(
      "p", { class: "soft" }, "By the labeler alone; the review weighs all evidence."
    ), list,
    reach(alike.length),
    parts.source[row] === "human" && button(
      "Take my correction back", "The label it would have without your correction",
      () => void page.edit([{ kind: "forget", part: parts.id[row] }]), "forget"
    ),
    reason.element);
}

/** The part with its shape, and softly with what looks much like it, or the part alone: kin may follow a single part, too. */
function reach(n: number): HTMLElement {
  const choice = (only: boolean, text: string, test: string) =>
    el(
      "label", {},
      el(
        "input",
        {
          type: "radio", name: "reach", checked: onlyThis === only, "data-test": test, onchange: () => (onlyThis = only)
        }
      ),
      text
    );
  return el("fieldset", { class: "reach" }, el("legend", { class: "only-read" }, "For which parts"),
    choice(false, n > 1 ? `All ${whole(n)} of its shape, and parts much like it` : "It, and parts much like it", "all-alike"),
    choice(true, "This part only", "this-only"),
    el(
      "p", { class: "soft" },
      `${n > 1 ? "" : "No other part has its shape. "}Which parts look much enough like it is said once it is done, and can be narrowed then.`
    ));
}

function about(page: Page, content: Content, row: number): HTMLElement {
  const { parts, network } = content;
  const unit = network.units[parts.unit[row]];
  const system = network.systems[unit?.system ?? -1];
  const cluster = network.clusters[parts.cluster[row]];
  const inCluster = () => parts.cluster.flatMap((other, i) => (other === parts.cluster[row] ? [i] : []));
  const repeats = repeatsOf(parts, row);
  return el("div", {},
    lines([
      [
        "Unit",
        unit && linkButton(
          `${unit.tag} (${unit.kind ?? unit.type})`, "Select the whole unit", () => page.go(unit.parts, unit.id),
          "to-unit"
        )
      ],
      [
        "System",
        system && linkButton(
          system.id, "Select all units of the system",
          () => page.go(system.units.flatMap((i) => network.units[i].parts))
        )
      ],
      [
        "Cluster",
        cluster && linkButton(
          `${cluster.kind ?? cluster.id}, ${count(cluster.n_parts, "part")}`, "Select the cluster",
          () => page.go(inCluster())
        )
      ],
      [
        "Alike",
        repeats.length > 1 ? linkButton(
          count(repeats.length, "part"), "Select all parts of this shape", () => page.go(repeats), "select-alike"
        ) : "no other part"
      ],
      ["Size", lengths(parts.extents.slice(3 * row, 3 * row + 3))],
      ["Area, volume", `${area(parts.area[row])}, ${volume(parts.volume[row])}`],
      ["Triangles", whole(parts.n_triangles[row])],
      ["Inside of", parts.inside[row] >= 0 ? partButton(page, content, parts.inside[row]) : null],
      ["Part", parts.id[row]],
    ]),
    paths(page, content, row));
}

function paths(page: Page, content: Content, row: number): HTMLElement {
  const all = meshesOf(content, row).map((mesh) => content.meshes.path[mesh]);
  const copy = () => navigator.clipboard.writeText(all.join("\n")).then(
    () => page.say("Copied the path."),
    () => page.say("The browser does not let the page copy; select the text instead.", "bad")
  );
  return el("div", { class: "paths" },
    el(
      "div", { class: "spread" },
      el(
        "span", { class: "soft" },
        all.length > 1 ? `In the file (${count(all.length, "mesh", "meshes")})` : "In the file"
      ),
      iconButton("copy", "Copy the path", copy, "copy-path")
    ),
    ...all.slice(0, 20).map((path) => el("code", {}, path)), all.length > 20 && el(
      "p", { class: "soft" }, `and ${whole(all.length - 20)} more`
    ));
}

function facts(content: Content, row: number): HTMLElement | null {
  const told = content.parts.facts[row];
  return told.length ? fold("What the file says", true, lines(told.map(([key, value]) => [upper(key), value]))) : null;
}

/** What the graph has to say for the label; asked for only when somebody wants to know. */
function why(page: Page, content: Content, row: number): HTMLElement {
  return lazily("Why this label?", () => page.source.explain("part", content.parts.id[row]));
}

export function lazily(title: string, ask: () => Promise<string[]>): HTMLElement {
  const text = el("div", { class: "explain", "data-test": "explain", "aria-live": "polite" });
  const box = fold(title, false, text);
  box.addEventListener("toggle", () => {
    if (!box.open || text.childElementCount) return;
    fill(text, el("p", { class: "soft" }, "Asking…"));
    ask().then(
      (told) => fill(text, told.length ? answer(told) : el("p", { class: "soft" }, "Nothing is known.")),
      (error: Error) => fill(text, el("p", { class: "soft" }, error.message)));
  });
  return box;
}

/** Lines of "what   value", as the command line prints them, as a table. */
function answer(told: string[]): HTMLElement {
  return lines(told.map((line): [string, string] => {
    const [what, ...rest] = line.trim().split(/\s{2,}/);
    return rest.length ? [upper(what), rest.join(" ")] : ["", what];
  }));
}

function more(page: Page, content: Content, row: number): HTMLElement {
  const { parts, network } = content;
  const id = parts.id[row];
  const unit = network.units[parts.unit[row]];
  const ground = parts.ground[row];
  return el("div", { class: "buttons stack" },
    unit && unit.parts.length > 1 && button(
      `Split off ${unit.tag}`, "This part is a unit of its own", () => void page.edit([{ kind: "split", parts: [id] }]),
      "split"
    ),
    button("Merge with what I click next", "Both are one unit", () => page.pickNext("Click the part or unit that belongs to the same unit", (other) => {
      if (other !== row) void page.edit([{ kind: "merge", parts: [id, parts.id[other]] }]);
    }), "merge"),
    button("Join with what I click next", "Both join along the pipes",
      () => page.pickNext("Click the part that it joins", (other) => {
      if (other !== row) void page.edit([{ kind: "join", first: id, second: parts.id[other] }]);
    }), "join-next"),
    button(
      ground ? "It is not the ground" : "It is the ground",
      ground ? "Count it among the plant again" : "Leave it out of clusters, as ground or floor",
      () => void page.edit([{ kind: "ground", part: id, ground: !ground }]), "ground"
    ));
}
