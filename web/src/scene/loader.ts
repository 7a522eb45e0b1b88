// Brings the shapes: first all of them coarse, then in full what matters most, within a budget of memory.

import type { Source } from "../api.ts";
import type { Manifest, Point } from "../types.ts";
import { Batch } from "./batch.ts";
import { decodeChunk } from "./chunk.ts";
import type { ShapeForm } from "./chunk.ts";
import type { Culling } from "./culling.ts";
import type { Pipeline } from "./pipeline.ts";
import type { Plant } from "./plant.ts";

type Chunk = Manifest["chunks"][number];

const AT_ONCE = 3;
/** Bytes on the card and beside it; a chunk grows by what three.js keeps for each instance. */
export const MEMORY = 600e6;

export class Loader {
  bytes = 0;
  /** Share of the coarse forms that is there. */
  share = 0;
  private readonly batches = new Map<Chunk, Batch>();
  private readonly failed = new Set<Chunk>();
  private readonly source: Source;
  private readonly manifest: Manifest;
  private readonly plant: Plant;
  private readonly culling: Culling;
  private readonly pipeline: Pipeline;
  private readonly changed: () => void;
  private filling = false;
  private again = false;
  private eye: Point = [0, 0, 0];
  private readonly memory: number;

  constructor(
    source: Source, manifest: Manifest, plant: Plant, culling: Culling, pipeline: Pipeline, changed: () => void,
    memory = MEMORY,
  ) {
    this.source = source;
    this.manifest = manifest;
    this.plant = plant;
    this.culling = culling;
    this.pipeline = pipeline;
    this.changed = changed;
    this.memory = memory;
  }

  /** Whether all that fits is there. */
  get isComplete(): boolean {
    return this.share >= 1 && !this.filling;
  }

  /** All coarse forms, as far as memory goes: the first ones are the largest. */
  async loadCoarse(): Promise<void> {
    const chunks = this.manifest.chunks.filter((chunk) => chunk.level === 1);
    const total = chunks.reduce((sum, chunk) => sum + chunk.bytes, 0) || 1;
    let done = 0;
    await inTurn(chunks, AT_ONCE, async (chunk) => {
      if (this.bytes + 2 * chunk.bytes <= this.memory) await this.load(chunk);
      done += chunk.bytes;
      this.share = Math.min(done / total, 0.999);
      this.changed();
    });
    this.share = 1;
    this.changed();
  }

  /** Full forms, those near the eye first; what is far goes where there is no room. */
  async fill(eye: Point): Promise<void> {
    this.eye = eye;
    if (this.share < 1) return;
    if (this.filling) {
      this.again = true;
      return;
    }
    this.filling = true;
    const worth = new Map(
      this.manifest.chunks.filter((chunk) => chunk.level === 0).map((chunk) => [chunk, worthOf(chunk, eye)]),
    );
    const wanted = [...worth.keys()].sort((a, b) => worth.get(b)! - worth.get(a)!);
    try {
      await inTurn(wanted, 2, async (chunk) => {
        if (this.batches.has(chunk) || this.failed.has(chunk)) return;
        if (!this.makeRoom(chunk, worth)) return;
        await this.load(chunk);
        this.changed();
      });
    } finally {
      this.filling = false;
    }
    if (this.again) {
      this.again = false;
      await this.fill(this.eye);
    }
  }

  /** Whether a chunk fits, once others that are worth much less are gone. */
  private makeRoom(chunk: Chunk, worth: Map<Chunk, number>): boolean {
    const need = 2 * chunk.bytes;
    const others = [...this.batches.keys()].filter((other) => other.level === 0)
      .sort((a, b) => (worth.get(a) ?? 0) - (worth.get(b) ?? 0));
    for (const other of others) {
      if (this.bytes + need <= this.memory) break;
      if ((worth.get(other) ?? 0) * 1.5 > worth.get(chunk)!) break;
      this.drop(other);
    }
    return this.bytes + need <= this.memory;
  }

  private drop(chunk: Chunk): void {
    const batch = this.batches.get(chunk)!;
    this.batches.delete(chunk);
    this.culling.remove(batch);
    this.pipeline.plant.remove(batch.object);
    this.bytes -= 2 * batch.bytes;
    batch.dispose();
  }

  private async load(chunk: Chunk): Promise<void> {
    let forms: ShapeForm[];
    // Others that come at the same time must know that this room is taken.
    const reserved = 2 * chunk.bytes;
    this.bytes += reserved;
    try {
      forms = decodeChunk(await this.source.file(chunk.file));
    } catch (error) {
      this.failed.add(chunk);
      throw error;
    } finally {
      this.bytes -= reserved;
    }
    const batch = new Batch(forms, this.plant, this.pipeline.material);
    for (const form of forms) {
      const high = form.low.map((low, k) => low + form.step[k] * 65535) as Point;
      this.plant.setBounds(form.shape, form.low, high);
    }
    this.batches.set(chunk, batch);
    this.bytes += 2 * batch.bytes;
    this.pipeline.plant.add(batch.object);
    this.culling.add(batch);
  }

  dispose(): void {
    for (const chunk of [...this.batches.keys()]) this.drop(chunk);
  }
}

/** How large a chunk's place looks from the eye. */
export function worthOf(chunk: { low: Point; high: Point }, eye: Point): number {
  let away = 0;
  let across = 0;
  for (let k = 0; k < 3; k++) {
    away += Math.max(chunk.low[k] - eye[k], 0, eye[k] - chunk.high[k]) ** 2;
    across += (chunk.high[k] - chunk.low[k]) ** 2;
  }
  return Math.sqrt(across) / (Math.sqrt(away) + 0.1 * Math.sqrt(across) + 1e-3);
}

/** Does something for each item, a few at a time, in order; the first failure ends it. */
async function inTurn<T>(items: T[], most: number, act: (item: T) => Promise<void>): Promise<void> {
  let next = 0;
  const worker = async () => {
    while (next < items.length) await act(items[next++]);
  };
  await Promise.all(Array.from({ length: Math.min(most, items.length) }, worker));
}
