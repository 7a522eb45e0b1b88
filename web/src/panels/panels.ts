// The page around the 3D view.

import { Refused, type Source } from "../api.ts";
import { addCommands } from "../commands.ts";
import type { SceneView } from "../scene/view.ts";
import type { LeftTab, Store } from "../store.ts";
import type { Content, Edit, Line } from "../types.ts";
import { Address } from "./address.ts";
import { Building } from "./building.ts";
import { Corrector } from "./corrector.ts";
import { openHelp } from "./dialog.ts";
import { el, fill } from "../dom.ts";
import { Find } from "./find.ts";
import { History } from "./history.ts";
import { isForThisOnly } from "./inspect_part.ts";
import { Inspector } from "./inspector.ts";
import { layOut } from "./layout.ts";
import type { LabelChoice, Page } from "./page.ts";
import { pickLabel } from "./picker.ts";
import { Review } from "./review.ts";
import { Table } from "./table.ts";
import { followTheme } from "./theme.ts";
import { Toasts } from "./toasts.ts";
import { TopBar } from "./topbar.ts";
import { Warnings } from "./warnings.ts";
import { labelOf, whole } from "./words.ts";

export interface Panels {
  /** Where the 3D view goes. */
  readonly middle: HTMLElement;
  /** Where the schematic goes: a pane below the view, shown while store.shown.schematic. */
  readonly schematicPane: HTMLElement;
  /** A place in the inspector for what an area has to say of the selection; filled anew by the area itself. */
  readonly networkSlot: HTMLElement;
  /** The list of the left tab "network". */
  readonly networkTab: HTMLElement;
  /** Shows progress until the content is there. */
  untilReady(): Promise<void>;
  connect(view: SceneView): void;
  /** Lets the network say which line is selected, for the inspector's title. */
  followLine(lineNow: () => Line | null): void;
  /** Sends corrections, says what came of them, and lays the answer over the store; false where it was refused. */
  edit(edits: Edit[], why?: string): Promise<boolean>;
  /** A line for the person, told to screen readers, too. */
  say(text: string, kind?: "info" | "good" | "bad"): void;
}

export function startPanels(app: HTMLElement, store: Store, source: Source): Panels {
  followTheme(store);
  const toasts = new Toasts(app);
  const say: Page["say"] = (text, tone, actions) => toasts.say(text, tone, actions);
  const corrector = new Corrector(store, source, say);
  store.on("gone", (name) => say(`${name} is no more: nothing is selected now.`));
  const hint = el("div", { class: "pick-hint", role: "status", "data-test": "pick-hint", hidden: true });
  const picking = new NextPick(store, hint);
  const page: Page = {
    store, source, view: null, say,
    canEdit: () => source.live && store.state?.status === "ready" && !store.state.read_only,
    edit: (edits, why) => corrector.edit(edits, why),
    refusal: () => corrector.refusal,
    undo: async () => void (await corrector.undo()),
    redo: async () => void (await corrector.redo()),
    go: (parts, place = null) => {
      store.select(parts, place);
      if (parts.length) page.view?.flyTo(parts);
    },
    pickNext: (words, take) => picking.start(words, take),
    pickLabel: (title, first, take) => store.content && pickLabel(store.content, title, first, take),
  };

  const networkTab = el("div", { class: "network-tab" });
  const inspector = new Inspector(page);
  const find = new Find(page);
  const review = new Review(page, corrector, () => top.setLeft(review.left), () => layout.isOpen("left"));
  const warnings = new Warnings(page, (n) => {
    const { badge } = layout.tabs.get("warnings")!;
    fill(badge, whole(n));
    badge.hidden = n === 0;
  });
  const top = new TopBar(page, (query) => {
    open("find");
    find.open(query);
  });
  const panels: Record<LeftTab, HTMLElement> = {
    review: review.element, find: find.element, network: networkTab, warnings: warnings.element, history: new History(page).element,
  };
  const layout = layOut(store, top.element, inspector.element, new Table(page).element, panels);
  const building = new Building();
  app.prepend(layout.root, building.element);
  layout.middle.append(hint, building.strip, toasts.element);
  const address = new Address(page);

  function open(tab: LeftTab): void {
    layout.toggle("left", true);
    store.set({ leftTab: tab });
  }

  if (!source.live) for (const tab of ["review", "history"] as const) layout.tabs.get(tab)!.button.hidden = true;
  addPageCommands(page, { picking, layout, address, open, find: () => top.search.focus() });

  return {
    middle: layout.middle, schematicPane: layout.schematicPane, networkSlot: inspector.networkSlot, networkTab,
    edit: page.edit, say,
    untilReady: async () => {
      await untilReady(store, source, corrector, building, say);
      if (!source.live) layout.middle.append(
        el(
          "p", { class: "view-only", "data-test": "view-only" }, "View only: corrections are made with 'cadgraph view'."
        )
      );
      address.start();
      if (!source.live && ["review", "history"].includes(store.shown.leftTab)) store.set({ leftTab: "find" });
    },
    followLine: (lineNow) => (inspector.lineNow = lineNow),
    connect: (view) => {
      page.view = view;
      const { camera } = store.shown;
      if (camera) view.setCamera(camera);
      else review.viewed();
    },
  };
}

/** Follows the server's state from the start; ends when there is something to show. */
async function untilReady(
  store: Store, source: Source, corrector: Corrector, building: Building, say: Page["say"]
): Promise<void> {
  if (!source.live) {
    store.setState(await source.state());
    store.setContent(await source.content());
    return;
  }
  let lost = "";
  let refused: string | null | undefined; // why nothing can be corrected; undefined until the server has spoken
  await new Promise<void>((resolve) => {
    let fetching: Promise<void> | null = null;
    const first = (content: Content) => {
      store.setContent(content);
      building.show(store.state, true);
      resolve();
    };
    const trouble = (reason: string) => {
      if (!store.content) building.show(store.state, false, reason);
      // Another reason is news: a server that was started again wants the address that it printed.
      else if (reason !== lost) say(reason, "bad");
      lost = reason;
      corrector.lost();
      // A message goes by; that nothing can be corrected now stays to be seen.
      if (store.state) store.setState({ ...store.state, read_only: reason, away: true });
    };
    void source.follow(new AbortController().signal, (state) => {
      if (lost && store.content) say("The server answers again.", "good");
      lost = "";
      if (state.read_only && refused !== undefined && state.read_only !== refused) say(state.read_only, "bad");
      refused = state.read_only;
      corrector.heard(state);
      building.show(store.state, !!store.content);
      // A plant that was built before can be looked at while it is made ready for corrections.
      if (store.content || state.status === "failed" || (state.status === "building" && state.version < 1)) return;
      fetching ??= source.content().then(first, (error: Error) => {
        fetching = null;
        if (!(error instanceof Refused && error.status === 423)) trouble(error.message);
      });
    }, trouble);
  });
}

/** Lets the person click what comes next; it ends with a click on a part, or by Escape. */
class NextPick {
  private readonly store: Store;
  private readonly hint: HTMLElement;
  private stop: (() => void) | null = null;

  constructor(store: Store, hint: HTMLElement) {
    this.store = store;
    this.hint = hint;
  }

  get active(): boolean {
    return this.stop !== null;
  }

  start(words: string, take: (row: number) => void): void {
    this.end();
    fill(
      this.hint, el("span", {}, words),
      el("button", { type: "button", class: "quiet", onclick: () => this.end() }, "Cancel (Esc)")
    );
    this.hint.hidden = false;
    const off = this.store.watch(["selection", "place"], () => {
      const { selection } = this.store.shown;
      if (!selection.length) return;
      this.end();
      take(selection.at(-1)!);
    });
    this.stop = off;
  }

  end(): void {
    this.stop?.();
    this.stop = null;
    this.hint.hidden = true;
  }
}

interface Means {
  picking: NextPick;
  layout: ReturnType<typeof layOut>;
  address: Address;
  open: (tab: LeftTab) => void;
  find: () => void;
}

function addPageCommands(page: Page, { picking, layout, address, open, find }: Means): void {
  const { store, source } = page;
  const live = () => source.live;
  /** Does it where the plant can be corrected, and says why where it can't: keys must not die without a word. */
  const correcting = (act: () => void) => {
    if (page.canEdit()) act();
    else page.say(store.state?.read_only ?? "The plant is still being made ready for corrections.", "bad");
  };
  const redo = {
    title: "Redo", area: "Corrections" as const,
    run: () => correcting(() => (store.state?.can_redo ? void page.redo() : page.say("Nothing to do again.")))
  };
  addCommands(
    {
      id: "pick-cancel", key: "Escape", title: "Cancel what is going on", area: "Selection", when: () => picking.active,
      run: () => picking.end()
    },
    { id: "find", key: "/", title: "Find", area: "Selection", run: find },
    {
      id: "table", key: "b", title: "Table of parts, units and lines", area: "View",
      run: () => store.set({ table: !store.shown.table })
    },
    { id: "fold-left", key: "[", title: "Left panel", area: "View", run: () => layout.toggle("left") },
    { id: "fold-right", key: "]", title: "Inspector", area: "View", run: () => layout.toggle("right") },
    { id: "link", key: "k", title: "Link to this view, and going to one", area: "View", run: () => address.open() },
    { id: "help", key: "?", title: "This list", area: "Help", run: openHelp });
  // A page that can't correct offers no keys for it.
  if (!live()) return;
  addCommands(
    { id: "review", key: "r", title: "Review: what is most worth a look", area: "Review", run: () => open("review") },
    { id: "history", title: "History", area: "Corrections", run: () => open("history") },
    {
      id: "label", key: "l", title: "Label what is selected", area: "Corrections",
      when: () => store.shown.selection.length > 0, run: () => correcting(() => labelSelection(page))
    },
    {
      id: "undo", key: "Ctrl+z", title: "Undo", area: "Corrections",
      run: () => correcting(() => (store.state?.can_undo ? void page.undo() : page.say("Nothing to undo.")))
    },
    { id: "redo", key: "Ctrl+y", ...redo },
    { id: "redo-shift", key: "Ctrl+Z", ...redo });
}

/** The label key: one part with all like it, or each of several. */
function labelSelection(page: Page): void {
  const content = page.store.content!;
  const rows = page.store.shown.selection;
  const title = rows.length === 1 ? `What is this ${labelOf(content, rows[0]).name.toLowerCase()}?` : `What are these ${whole(rows.length)} parts?`;
  const first = rows.length === 1 ? content.parts.guesses[rows[0]].flatMap(
    ([group, name]): LabelChoice[] => (content.groups[group] ? [{ group: content.groups[group].name, name }] : [])
  ) : [];
  page.pickLabel(
    title, first,
    (choice) => void page.edit(
      rows.map((row): Edit => ({ kind: "label", part: content.parts.id[row], ...choice, this_only: rows.length > 1 || isForThisOnly(row) }))
    )
  );
}
