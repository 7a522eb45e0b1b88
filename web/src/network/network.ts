// The network over the plant, and the schematic beside it.

import type { Source } from "../api.ts";
import { addCommands } from "../commands.ts";
import type { Panels } from "../panels/panels.ts";
import type { SceneView } from "../scene/view.ts";
import type { Store } from "../store.ts";
import { Asking } from "./asking.ts";
import { el } from "../dom.ts";
import { keepPresses } from "./presses.ts";
import { Focus } from "./focus.ts";
import { fillNotes } from "./notes.ts";
import { Motion } from "./motion.ts";
import { Overlay, type PointLook } from "./overlay.ts";
import { type Plan, planOf } from "./plan.ts";
import { Schematic } from "./schematic.ts";
import { slotContent } from "./slot.ts";
import { readPalette, strokesOf } from "./style.ts";
import { NetworkTab } from "./tab.ts";
import { TagLayer } from "./tags.ts";
import { networkWarnings, type NetworkWarning } from "./warnings.ts";

export function startNetwork(view: SceneView, store: Store, source: Source, panels: Panels): void {
  new NetworkArea(view, store, source, panels);
}

class NetworkArea {
  private plan: Plan;
  private warnings: NetworkWarning[] = [];
  private readonly focus: Focus;
  private readonly asking: Asking;
  private readonly overlay: Overlay;
  private readonly motion: Motion;
  private readonly tags: TagLayer;
  private readonly schematic: Schematic;
  private readonly tab: NetworkTab;
  private readonly notes = el("div", { class: "net-notes" });
  private paintAsked = false;
  private readonly view: SceneView;
  private readonly store: Store;
  private readonly source: Source;
  private readonly panels: Panels;

  constructor(view: SceneView, store: Store, source: Source, panels: Panels) {
    this.view = view;
    this.store = store;
    this.source = source;
    this.panels = panels;
    const planNow = () => this.plan;
    this.plan = planOf(store.content!);
    this.focus = new Focus(store, planNow);
    this.asking = new Asking(store, source, panels, planNow);
    this.overlay = new Overlay(() => view.element.clientHeight);
    this.motion = new Motion(view, store, this.focus, this.overlay);
    view.add(this.overlay.through, true);
    view.add(this.overlay.front);
    panels.followLine(() => store.content?.network.lines[this.focus.selectedLine] ?? null);
    const actions = { place: (id: string) => store.selectPlace(id), line: (row: number) => this.focus.selectLine(row) };
    this.tags = new TagLayer(view, store, this.focus, { ...actions, warning: (key) => this.tell(key, false) });
    this.schematic = new Schematic(panels.schematicPane, store, source, this.focus, planNow, actions);
    this.tab = new NetworkTab(panels.networkTab, {
      store, focus: this.focus, planNow, warningsNow: () => this.warnings, go: (id) => this.go(id),
    });
    keepPresses(this.notes);
    view.element.append(this.notes);
    this.addCommands();
    this.listen();
    this.renew();
  }

  private listen(): void {
    const { store, focus, asking } = this;
    store.on("content", () => this.renew());
    // Not on every message of the server: what somebody has unfolded or is about to click would be gone.
    let editable = this.isEditable();
    store.on("state", () => {
      if (editable === this.isEditable()) return;
      editable = this.isEditable();
      this.fillSlot();
    });
    store.watch(["selection", "place"], () => {
      // Who lets go of what a warning is about, by Escape or a click beside it, has done with it.
      const told = this.warnings.find((warning) => warning.key === focus.warning);
      if (told?.parts.length && !store.shown.selection.length) focus.set({ warning: null });
      this.fillSlot();
      this.tab.mark();
    });
    store.watch(
      ["selection", "place", "hovered", "marks", "hidden", "isolated", "section", "network", "tags", "theme"],
      () => this.paint(),
    );
    store.watch(["hidden", "isolated", "section", "explode", "ghost"], () => this.tags.forgetHidden());
    // Once the page has taken the theme.
    store.watch(["theme"], () => requestAnimationFrame(() => this.tab.paint()));
    // Two things that are asked to be looked at are one too many.
    store.watch(["question"], () => {
      if (store.shown.question && focus.warning !== null) focus.set({ warning: null });
    });
    store.watch(["schematic"], () => this.schematic.refresh());
    store.watch(["network", "tags", "schematic"], () => this.tab.fillHead());
    focus.onChange((hoverOnly) => {
      this.paint();
      if (hoverOnly) return;
      this.tab.fillHead();
      this.tab.paint();
      this.tab.mark();
      this.fillSlot();
      this.fillNotes();
    });
    asking.onChange(() => {
      this.fillSlot();
      this.fillNotes();
    });
  }

  /** The content is another one. */
  private renew(): void {
    const before = this.plan.content;
    const line = before.network.lines[this.focus.selectedLine]?.tag;
    this.plan = planOf(this.store.content!);
    if (!this.focus.keepLine(before)) this.panels.say(`Line ${line} is no more: nothing is selected now.`);
    this.warnings = networkWarnings(this.store.content!, this.plan);
    if (!this.warnings.some((warning) => warning.key === this.focus.warning)) this.focus.warning = null;
    this.overlay.setPlan(this.plan);
    this.tags.setPlan(this.plan, this.warnings);
    this.tab.fill();
    this.schematic.refresh();
    this.asking.again(before);
    this.fillSlot();
    this.fillNotes();
    this.paint();
  }

  /** Colours everything anew, once for all that changes in one frame. */
  private paint(): void {
    if (this.paintAsked) return;
    this.paintAsked = true;
    requestAnimationFrame(() => {
      this.paintAsked = false;
      this.paintNow();
    });
  }

  private paintNow(): void {
    const { store, focus, view } = this;
    const { shown } = store;
    this.overlay.visible = shown.network || shown.marks !== null;
    this.overlay.setSection(shown.section);
    const palette = readPalette(view.element);
    const strokes = strokesOf(this.plan, {
      by: focus.linesBy, marks: shown.marks, selected: focus.connections, hovered: focus.hoveredConnections,
      isShown: focus.isConnectionShown,
    }, palette);
    const selected = focus.place?.id;
    const hovered = focus.hoveredPlace;
    this.overlay.setStrokes(strokes, (id, port): PointLook => {
      const place = this.plan.places.get(id)!;
      if (!focus.isPlaceShown(place)) return { color: palette.faint, size: 0 };
      if (port) return { color: palette.known, size: shown.marks ? 0 : 5 };
      if (id === selected) return { color: palette.selected, size: 15 };
      if (shown.marks) {
        return shown.marks.places.has(id) ? { color: palette.mark, size: 11 } : { color: palette.faint, size: 6 };
      }
      const color = place.type === "junction" ? palette.known : place.type === "blind" ? palette.faint : palette.unknown;
      return { color, size: (place.type === "junction" ? 8 : 12) + (id === hovered ? 4 : 0) };
    }, palette);
    this.tags.refresh();
    this.schematic.refresh();
    this.motion.refresh();
    view.invalidate();
  }

  private isEditable(): boolean {
    const { state } = this.store;
    return this.source.live && state?.status === "ready" && state.read_only === null;
  }

  private fillSlot(): void {
    this.panels.networkSlot.classList.add("net-slot");
    this.panels.networkSlot.replaceChildren(...slotContent({
      plan: this.plan, store: this.store, focus: this.focus, asking: this.asking, panels: this.panels, live: this.source.live,
      editable: this.isEditable(), go: (id) => this.go(id), goParts: (parts) => this.goParts(parts),
    }));
  }

  private fillNotes(): void {
    const current = this.warnings.findIndex((warning) => warning.key === this.focus.warning);
    const shower = {
      plan: this.plan, store: this.store, focus: this.focus, asking: this.asking, go: (id: string) => this.go(id),
      goParts: (parts: readonly number[]) => this.goParts(parts),
    };
    fillNotes(this.notes, shower, this.warnings, current, {
      step: (by) => this.step(by), close: () => this.focus.set({ warning: null }),
    });
  }

  private go(id: string): void {
    const place = this.plan.places.get(id);
    if (!place) return;
    this.store.selectPlace(id);
    if (place.parts.length) this.view.flyTo(place.parts);
  }

  private goParts(parts: readonly number[]): void {
    if (!parts.length) return;
    this.store.select(parts);
    this.view.flyTo(parts);
  }

  /** Tells of a warning; goes there if asked to. */
  private tell(key: string, fly: boolean): void {
    const warning = this.warnings.find((candidate) => candidate.key === key);
    if (!warning) return;
    this.focus.set({ warning: key });
    if (warning.place !== null) this.store.selectPlace(warning.place);
    else this.store.select(warning.parts);
    if (fly && warning.parts.length) this.view.flyTo(warning.parts);
  }

  private step(by: 1 | -1): void {
    const n = this.warnings.length;
    if (!n) {
      this.panels.say("No warnings in the network.");
      return;
    }
    const at = this.warnings.findIndex((warning) => warning.key === this.focus.warning);
    const next = at < 0 ? (by > 0 ? 0 : n - 1) : (at + by + n) % n;
    this.tell(this.warnings[next].key, true);
  }

  private addCommands(): void {
    const { store, focus, asking, source } = this;
    const area = "Network" as const;
    const live = () => source.live;
    const at = (ask: (id: string) => unknown) => {
      const { place } = focus;
      if (place?.connections.length) ask(place.id);
      else this.panels.say(place ? `No pipe was found at ${place.name}.` : "Select a unit, a junction or an end first.");
    };
    addCommands(
      { id: "network.lines", key: "n", title: "Lines and flow on the plant", area, run: () => store.set({ network: !store.shown.network }) },
      { id: "network.tags", key: "t", title: "Tags", area, run: () => store.set({ tags: !store.shown.tags }) },
      { id: "network.schematic", key: "d", title: "Schematic beside the plant", area, run: () => store.set({ schematic: !store.shown.schematic }) },
      { id: "network.moving", title: "Let the flow move", area, run: () => focus.set({ moving: !focus.moving }) },
      { id: "network.warning.next", key: "w", title: "Next warning of the network", area, run: () => this.step(1) },
      {
        id: "network.warning.end", key: "Escape", title: "End the walk through the warnings", area,
        when: () => focus.warning !== null, run: () => focus.set({ warning: null }),
      },
      { id: "network.warning.previous", key: "W", title: "Previous warning of the network", area, run: () => this.step(-1) },
      { id: "network.upstream", key: "Shift+ArrowUp", title: "Trace upstream of the selection", area, when: live, run: () => at((id) => asking.trace(id, "upstream")) },
      { id: "network.downstream", key: "Shift+ArrowDown", title: "Trace downstream of the selection", area, when: live, run: () => at((id) => asking.trace(id, "downstream")) },
      { id: "network.to", key: "Shift+ArrowRight", title: "Trace from the selection to what is clicked next", area, when: live, run: () => at((id) => asking.startPick(id)) },
      { id: "network.isolate", key: "v", title: "Valves to close to isolate the selected unit", area, when: live, run: () => at((id) => asking.isolate(id)) },
      { id: "network.clear", key: "c", title: "End the trace or isolation", area, when: () => !!asking.answer || asking.picking !== null || !!store.shown.marks, run: () => asking.clear() },
      { id: "network.sheet.fit", title: "Whole schematic", area, when: () => store.shown.schematic, run: () => this.schematic.fit() },
      { id: "network.sheet.selection", title: "Schematic: go to the selection", area, when: () => store.shown.schematic, run: () => this.schematic.toSelection() },
    );
  }
}
