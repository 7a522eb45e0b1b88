// All meshes of a plant as columns: where each lies, which part it is, and in which batch it can be drawn.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Content, Manifest, Point } from "../types.ts";

const INSTANCE = 36;
const NOT_SHOWN = 0xffffffff;

/** Rows of items by the number that they belong to. */
export class Members {
  readonly start: Uint32Array;
  readonly items: Uint32Array;

  /** `owner`: of each item, -1 none. */
  constructor(owner: ArrayLike<number>, n: number) {
    this.start = new Uint32Array(n + 1);
    for (let i = 0; i < owner.length; i++) if (owner[i] >= 0 && owner[i] < n) this.start[owner[i] + 1]++;
    for (let k = 0; k < n; k++) this.start[k + 1] += this.start[k];
    this.items = new Uint32Array(this.start[n]);
    const filled = this.start.slice();
    for (let i = 0; i < owner.length; i++) if (owner[i] >= 0 && owner[i] < n) this.items[filled[owner[i]]++] = i;
  }

  of(k: number): Uint32Array {
    return this.items.subarray(this.start[k] ?? 0, this.start[k + 1] ?? 0);
  }
}

export class Plant {
  readonly n: number;
  readonly shapeOf: Int32Array;
  readonly partOf: Int32Array;
  /** Source colour, sRGB; alpha 0 where the source gives none. */
  readonly color: Uint8Array;
  /** Ball around each mesh as it stands in the plant; radius 0 until its shape is there. */
  readonly center: Float32Array;
  readonly radius: Float32Array;
  /** How far each mesh is moved from its place, for a unit that is drawn apart. */
  readonly offset: Float32Array;
  readonly meshesOfShape: Members;
  readonly meshesOfPart: Members;
  private readonly quaternion: Float32Array;
  private readonly shift: Float32Array;
  private readonly turn = new Quaternion();
  private readonly place = new Vector3();
  private readonly size = new Vector3();
  private readonly whole = new Vector3(1, 1, 1);

  constructor(manifest: Manifest, instances: ArrayBuffer, content: Content) {
    const n = Math.min(manifest.n_meshes, Math.floor(instances.byteLength / INSTANCE));
    const view = new DataView(instances);
    this.n = n;
    this.shapeOf = new Int32Array(n);
    this.partOf = Int32Array.from({ length: n }, (_, i) => content.meshes.part[i] ?? -1);
    this.color = new Uint8Array(4 * n);
    this.quaternion = new Float32Array(4 * n);
    this.shift = new Float32Array(3 * n);
    this.center = new Float32Array(3 * n);
    this.radius = new Float32Array(n);
    this.offset = new Float32Array(3 * n);
    for (let i = 0; i < n; i++) {
      const at = i * INSTANCE;
      const shape = view.getUint32(at, true);
      this.shapeOf[i] = shape === NOT_SHOWN ? -1 : shape;
      for (let k = 0; k < 4; k++) this.color[4 * i + k] = view.getUint8(at + 4 + k);
      for (let k = 0; k < 4; k++) this.quaternion[4 * i + k] = view.getFloat32(at + 8 + 4 * k, true);
      for (let k = 0; k < 3; k++) this.shift[3 * i + k] = view.getFloat32(at + 24 + 4 * k, true);
    }
    this.meshesOfShape = new Members(this.shapeOf, manifest.n_shapes);
    this.meshesOfPart = new Members(this.partOf, content.parts.id.length);
  }

  /** World from shape, without the move of a unit drawn apart where `still`. */
  matrixOf(mesh: number, target: Matrix4, still = false): Matrix4 {
    this.turn.fromArray(this.quaternion, 4 * mesh);
    this.place.fromArray(this.shift, 3 * mesh);
    if (!still) {
      this.place.x += this.offset[3 * mesh];
      this.place.y += this.offset[3 * mesh + 1];
      this.place.z += this.offset[3 * mesh + 2];
    }
    return target.compose(this.place, this.turn, this.whole);
  }

  /** Notes how large a shape is, so that what has it can be culled. */
  setBounds(shape: number, low: Point, high: Point): void {
    const matrix = new Matrix4();
    const middle = new Vector3();
    const radius = this.size.set(high[0] - low[0], high[1] - low[1], high[2] - low[2]).length() / 2;
    for (const mesh of this.meshesOfShape.of(shape)) {
      middle.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
      middle.applyMatrix4(this.matrixOf(mesh, matrix, true)).toArray(this.center, 3 * mesh);
      this.radius[mesh] = Math.max(radius, 1e-6);
    }
  }

  /** The ball around meshes as they stand; null for none. */
  ballOf(meshes: Iterable<number>): { center: Point; radius: number } | null {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const mesh of meshes) {
      const radius = this.radius[mesh];
      if (!radius) continue;
      for (let k = 0; k < 3; k++) {
        const at = this.center[3 * mesh + k] + this.offset[3 * mesh + k];
        low[k] = Math.min(low[k], at - radius);
        high[k] = Math.max(high[k], at + radius);
      }
    }
    if (low[0] > high[0]) return null;
    const center: Point = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
    return { center, radius: Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2 };
  }
}
