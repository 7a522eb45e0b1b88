// How each part is drawn, by what is shown: colour, faint or not at all, selected, marked.

import type { Shown, Store } from "../store.ts";
import { colorParts, rgb } from "./colors.ts";
import type { Coloring } from "./colors.ts";
import type { Plant } from "./plant.ts";
import { FLAG } from "./shaders.ts";

/** What is left of the ground's colour where the page is dark: a bright slab would outshine the plant. */
const DIMMED = 0.42;
/** Parts drawn over everything: what a person looks for must not stay behind something. */
const MOST_EMPHASISED = 4000;

export class Look {
  /** Four bytes per mesh: colour (sRGB) and flags. */
  readonly state: Uint8Array;
  /** Whether each mesh is drawn at all, faint or not. */
  readonly visible: Uint8Array;
  /** Whether some are drawn faint. */
  hasGhosts = false;
  /** Meshes whose outline shows through what is before them. */
  emphasised: number[] = [];
  private coloring: Coloring | null = null;
  private readonly plant: Plant;
  private readonly store: Store;

  constructor(plant: Plant, store: Store) {
    this.plant = plant;
    this.store = store;
    this.state = new Uint8Array(4 * plant.n);
    this.visible = new Uint8Array(plant.n).fill(1);
  }

  /** The colours anew, too: labels or what colours mean have changed. */
  recolor(): void {
    this.coloring = colorParts(this.store.content!, this.store.shown.colorBy);
    this.update();
  }

  update(): void {
    const { plant } = this;
    const coloring = this.coloring!;
    const shown = this.store.shown;
    const flags = this.flagsOfParts(shown);
    const { ground } = this.store.content!.parts;
    const palette = coloring.entries.map((entry) => rgb(entry.color));
    this.emphasised = [];
    this.hasGhosts = false;
    for (let mesh = 0; mesh < plant.n; mesh++) {
      const part = plant.partOf[mesh];
      const at = 4 * mesh;
      const entry = part >= 0 ? coloring.entryOf[part] : -1;
      const color = entry >= 0 ? palette[entry] : this.ownColor(mesh);
      const share = shown.theme === "dark" && part >= 0 && ground[part] ? DIMMED : 1;
      for (let k = 0; k < 3; k++) this.state[at + k] = Math.round(share * color[k]);
      let flag = part >= 0 ? flags[part] : shown.isolated || shown.marks ? FLAG.ghost : 0;
      if (part >= 0 && coloring.hatched[part]) flag |= FLAG.hatched;
      const hidden = part >= 0 && shown.hidden.has(part);
      const ghost = (flag & FLAG.ghost) !== 0;
      this.visible[mesh] = hidden || plant.shapeOf[mesh] < 0 || (ghost && !shown.ghost) ? 0 : 1;
      this.state[at + 3] = flag;
      if (ghost && this.visible[mesh]) this.hasGhosts = true;
      if (flag & FLAG.selected && this.visible[mesh] && this.emphasised.length < MOST_EMPHASISED) {
        this.emphasised.push(mesh);
      }
    }
  }

  private ownColor(mesh: number): [number, number, number] {
    const { color } = this.plant;
    const at = 4 * mesh;
    return color[at + 3] ? [color[at], color[at + 1], color[at + 2]] : [174, 183, 194];
  }

  private flagsOfParts(shown: Readonly<Shown>): Uint8Array {
    const content = this.store.content!;
    const n = content.parts.id.length;
    const flags = new Uint8Array(n);
    const only = this.onlyThese(shown);
    if (only) for (let row = 0; row < n; row++) if (!only.has(row)) flags[row] |= FLAG.ghost;
    for (const row of shown.question?.alike ?? []) flags[row] |= FLAG.alike;
    const marked = shown.question ? shown.question.parts : shown.selection;
    for (const row of marked) flags[row] = (flags[row] | FLAG.selected) & ~FLAG.ghost;
    for (const unit of content.network.units) {
      if (shown.marks?.close.has(unit.id)) {
        for (const row of unit.parts) flags[row] = (flags[row] | FLAG.marked) & ~FLAG.ghost;
      }
    }
    return flags;
  }

  /** The parts that are not faint; null for all. */
  private onlyThese(shown: Readonly<Shown>): ReadonlySet<number> | null {
    if (shown.explode) {
      const unit = this.store.content!.network.units.find((one) => one.id === shown.explode!.unit);
      if (unit) return new Set(unit.parts);
    }
    if (shown.marks) return shown.marks.parts;
    return shown.isolated;
  }
}
