// What is worth drawing: what is in the picture, large enough to be seen, and within what the machine can draw in time.

import { Frustum, Matrix4, Sphere, Vector3 } from "three";
import type { OrthographicCamera, PerspectiveCamera } from "three";
import type { Batch } from "./batch.ts";
import type { Plant } from "./plant.ts";

export const DRAWN = { none: 0, coarse: 1, full: 2 } as const;

export type AnyCamera = PerspectiveCamera | OrthographicCamera;

const BINS = 48;
/** A mesh this large [px across] is drawn in its full form when the picture rests. */
const FULL_FROM = 24;

/** Where a mesh can be drawn from. */
interface Forms {
  batch: (Batch | null)[];
  instance: Uint32Array;
  triangles: Uint32Array;
}

export class Culling {
  readonly drawn: Uint8Array;
  /** Pixels across of each mesh in the last look, 0 where it is out of the picture. */
  readonly pixels: Float32Array;
  triangles = 0;
  meshes = 0;
  private readonly coarse: Forms;
  private readonly full: Forms;
  private readonly plant: Plant;
  private readonly frustum = new Frustum();
  private readonly matrix = new Matrix4();
  private readonly ball = new Sphere();
  private readonly eye = new Vector3();
  private readonly ahead = new Vector3();

  constructor(plant: Plant) {
    this.plant = plant;
    this.drawn = new Uint8Array(plant.n);
    this.pixels = new Float32Array(plant.n);
    const forms = (): Forms => ({
      batch: new Array<Batch | null>(plant.n).fill(null), instance: new Uint32Array(plant.n),
      triangles: new Uint32Array(plant.n),
    });
    this.coarse = forms();
    this.full = forms();
  }

  add(batch: Batch): void {
    const forms = batch.level === 0 ? this.full : this.coarse;
    batch.meshes.forEach((mesh, instance) => {
      forms.batch[mesh] = batch;
      forms.instance[mesh] = instance;
      forms.triangles[mesh] = batch.triangles[instance];
    });
  }

  remove(batch: Batch): void {
    const forms = batch.level === 0 ? this.full : this.coarse;
    batch.meshes.forEach((mesh) => {
      if (forms.batch[mesh] !== batch) return;
      if (this.drawn[mesh] === (batch.level === 0 ? DRAWN.full : DRAWN.coarse)) this.drawn[mesh] = DRAWN.none;
      forms.batch[mesh] = null;
    });
  }

  /** The batch and instance of the best form of a mesh that is there. */
  formOf(mesh: number): { batch: Batch; instance: number } | null {
    for (const forms of [this.full, this.coarse]) {
      const batch = forms.batch[mesh];
      if (batch) return { batch, instance: forms.instance[mesh] };
    }
    return null;
  }

  /** All forms of a mesh that are there. */
  eachForm(mesh: number, act: (batch: Batch, instance: number) => void): void {
    for (const forms of [this.full, this.coarse]) {
      const batch = forms.batch[mesh];
      if (batch) act(batch, forms.instance[mesh]);
    }
  }

  /**
   * Decides what is drawn; gives whether anything has changed.
   *
   * `least`: what is smaller [px] is left out. `budget`: triangles at most; the largest come first.
   */
  look(camera: AnyCamera, height: number, visible: Uint8Array, least: number, budget: number): boolean {
    this.measure(camera, height, visible);
    const { plant, pixels, coarse, full } = this;
    const cost = new Float64Array(BINS);
    for (let mesh = 0; mesh < plant.n; mesh++) {
      if (pixels[mesh] >= least) cost[binOf(pixels[mesh])] += this.cost(mesh, pixels[mesh], budget);
    }
    let bin = BINS;
    let sum = 0;
    while (bin > 0 && sum + cost[bin - 1] <= budget) sum += cost[--bin];
    let changed = false;
    this.triangles = this.meshes = 0;
    for (let mesh = 0; mesh < plant.n; mesh++) {
      const size = pixels[mesh];
      let now: number = DRAWN.none;
      if (size >= least && (binOf(size) >= bin || size > 80)) {
        const wantsFull = full.batch[mesh] !== null && (coarse.batch[mesh] === null || this.isFull(mesh, size, budget));
        now = wantsFull ? DRAWN.full : coarse.batch[mesh] ? DRAWN.coarse : DRAWN.none;
        this.meshes++;
        this.triangles += now === DRAWN.full ? full.triangles[mesh] : coarse.triangles[mesh];
      }
      if (now !== this.drawn[mesh]) {
        this.show(mesh, now);
        changed = true;
      }
    }
    return changed;
  }

  /** In a hurry only what is large is drawn in full. */
  private isFull(mesh: number, size: number, budget: number): boolean {
    if (this.full.batch[mesh] === null) return false;
    return size >= (budget < Infinity ? 160 : FULL_FROM);
  }

  private cost(mesh: number, size: number, budget: number): number {
    return this.isFull(mesh, size, budget) ? this.full.triangles[mesh] : this.coarse.triangles[mesh];
  }

  private show(mesh: number, now: number): void {
    const { coarse, full } = this;
    coarse.batch[mesh]?.setVisible(coarse.instance[mesh], now === DRAWN.coarse);
    full.batch[mesh]?.setVisible(full.instance[mesh], now === DRAWN.full);
    this.drawn[mesh] = now;
  }

  private measure(camera: AnyCamera, height: number, visible: Uint8Array): void {
    const { plant, pixels, ball, eye, ahead } = this;
    this.frustum.setFromProjectionMatrix(
      this.matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    eye.setFromMatrixPosition(camera.matrixWorld);
    camera.getWorldDirection(ahead);
    const parallel = "isOrthographicCamera" in camera;
    const scale = parallel
      ? height / ((camera as OrthographicCamera).top - (camera as OrthographicCamera).bottom)
      : height / (2 * Math.tan(((camera as PerspectiveCamera).fov * Math.PI) / 360));
    for (let mesh = 0; mesh < plant.n; mesh++) {
      pixels[mesh] = 0;
      const radius = plant.radius[mesh];
      if (!radius || !visible[mesh]) continue;
      ball.center.set(
        plant.center[3 * mesh] + plant.offset[3 * mesh], plant.center[3 * mesh + 1] + plant.offset[3 * mesh + 1],
        plant.center[3 * mesh + 2] + plant.offset[3 * mesh + 2],
      );
      ball.radius = radius;
      if (!this.frustum.intersectsSphere(ball)) continue;
      const distance = parallel ? 1 : Math.max(ball.center.sub(eye).dot(ahead), radius * 0.5);
      pixels[mesh] = (2 * radius * scale) / distance;
    }
  }
}

/** Half powers of two of the size in pixels. */
function binOf(pixels: number): number {
  return Math.max(0, Math.min(BINS - 1, Math.floor(2 * Math.log2(pixels + 1e-6)) + 8));
}
