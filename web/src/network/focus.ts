// What of the network is selected, hovered and shown: derived from the store, and the little that the store doesn't hold.

import { lineAgain } from "../kept.ts";
import { isCut } from "../seen.ts";
import type { Store } from "../store.ts";
import type { Content } from "../types.ts";
import { partsOfLine, type Place, type Plan } from "./plan.ts";
import type { LinesBy } from "./style.ts";

export class Focus {
  linesBy: LinesBy = "flow";
  /** Whether light moves along the flow. */
  moving = false;
  /** Key of the warning that is told now. */
  warning: string | null = null;
  /** Whether warnings are shown in 3D. */
  warnings = true;
  private line: { row: number; selection: readonly number[] } | null = null;
  private hoveredLine = -1;
  private readonly listeners = new Set<(hoverOnly: boolean) => void>();
  private readonly store: Store;
  private readonly planNow: () => Plan;

  constructor(store: Store, planNow: () => Plan) {
    this.store = store;
    this.planNow = planNow;
  }

  /** Calls back on changes; says whether only the pointer went elsewhere. */
  onChange(listener: (hoverOnly: boolean) => void): void {
    this.listeners.add(listener);
  }

  set(patch: Partial<Pick<Focus, "linesBy" | "moving" | "warning" | "warnings">>): void {
    Object.assign(this, patch);
    this.tell();
  }

  /** Selects all of a line. */
  selectLine(row: number): void {
    const plan = this.planNow();
    const line = plan.content.network.lines[row];
    if (!line) return;
    const selection = partsOfLine(plan, line);
    this.line = { row, selection };
    this.store.select(selection);
    this.tell();
  }

  /** The content is another one: the same line stays selected wherever it is listed now. False where it is gone. */
  keepLine(before: Content): boolean {
    this.hoveredLine = -1;
    const row = this.selectedLine;
    if (row < 0) return true;
    this.line = null;
    const now = lineAgain(before, row, this.planNow().content);
    if (now >= 0) this.selectLine(now);
    else this.store.select([]);
    return now >= 0;
  }

  hoverLine(row: number): void {
    if (row === this.hoveredLine) return;
    this.hoveredLine = row;
    this.tell(true);
  }

  /** Lights the first part of a place, as if the pointer were on it. */
  hoverPlace(id: string | null): void {
    const part = id === null ? undefined : this.planNow().places.get(id)?.parts[0];
    this.store.set({ hovered: part ?? -1 });
  }

  /** Row of the selected line; -1 where none is. */
  get selectedLine(): number {
    return this.line && this.line.selection === this.store.shown.selection ? this.line.row : -1;
  }

  /** The place that is selected: as such, or since a part of a junction or an end is. */
  get place(): Place | null {
    const plan = this.planNow();
    const { place, selection } = this.store.shown;
    if (place) return plan.places.get(place) ?? null;
    if (this.selectedLine >= 0 || selection.length === 0) return null;
    const owners = new Set(selection.map((part) => plan.placeOfPart.get(part)));
    const [owner] = owners;
    return owners.size === 1 && owner ? plan.places.get(owner) ?? null : null;
  }

  /** Rows of the selected connections: those of the line, else those that lead through the selected pipe. */
  get connections(): Set<number> {
    const plan = this.planNow();
    if (this.selectedLine >= 0) return new Set(plan.content.network.lines[this.selectedLine].connections);
    const rows = new Set<number>();
    if (this.store.shown.place || this.store.shown.selection.length > 40) return rows;
    for (const part of this.store.shown.selection) {
      if (!plan.placeOfPart.has(part)) plan.connectionsOfPart.get(part)?.forEach((row) => rows.add(row));
    }
    return rows;
  }

  get hoveredConnections(): Set<number> {
    const plan = this.planNow();
    const line = plan.content.network.lines[this.hoveredLine];
    if (line) return new Set(line.connections);
    const { hovered } = this.store.shown;
    return new Set(plan.placeOfPart.has(hovered) ? [] : plan.connectionsOfPart.get(hovered) ?? []);
  }

  get hoveredPlace(): string | null {
    return this.planNow().placeOfPart.get(this.store.shown.hovered) ?? null;
  }

  get hovered(): number {
    return this.hoveredLine;
  }

  /** Whether a part is there to be seen: neither hidden nor left out. */
  isPartShown(part: number): boolean {
    const { shown } = this.store;
    const left = !shown.hidden.has(part) && (shown.isolated === null || shown.isolated.has(part));
    return left && !isCut(this.planNow().content, shown, part);
  }

  isPlaceShown(place: Place): boolean {
    return place.parts.length === 0 || place.parts.some((part) => this.isPartShown(part));
  }

  isConnectionShown = (row: number): boolean => {
    const { via, source, target } = this.planNow().content.network.connections[row];
    if (via.length) return via.some((part) => this.isPartShown(part));
    const places = this.planNow().places;
    return [source, target].every((id) => this.isPlaceShown(places.get(id)!));
  };

  private tell(hoverOnly = false): void {
    for (const listener of this.listeners) listener(hoverOnly);
  }
}
