// What exactly lies under a pixel: the mesh as it was drawn, the point on it by a tree over its triangles.

import { BufferAttribute, BufferGeometry, DoubleSide, Matrix4, Ray, Vector3, Vector4 } from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Batch } from "./batch.ts";
import type { Culling } from "./culling.ts";
import type { Plant } from "./plant.ts";

const MOST_TREES = 48;

export interface Hit {
  mesh: number;
  point: Vector3;
  normal: Vector3;
  /** The triangle that was hit, in world coordinates. */
  corners: [Vector3, Vector3, Vector3];
}

export class Trees {
  private readonly kept = new Map<object, MeshBVH>();
  private readonly plant: Plant;
  private readonly culling: Culling;

  constructor(plant: Plant, culling: Culling) {
    this.plant = plant;
    this.culling = culling;
  }

  /** Where a ray hits a mesh first, on the near side of a section plane; null where it misses. */
  hit(mesh: number, ray: Ray, section: Vector4 | null): Hit | null {
    const form = this.culling.formOf(mesh);
    if (!form) return null;
    const tree = this.treeOf(form.batch, form.instance);
    const matrix = this.plant.matrixOf(mesh, new Matrix4());
    const local = ray.clone().applyMatrix4(matrix.clone().invert());
    let best: Hit | null = null;
    let least = Infinity;
    for (const found of tree.raycast(local, DoubleSide)) {
      if (found.distance >= least || !found.face) continue;
      const point = found.point.clone().applyMatrix4(matrix);
      if (section && section.x * point.x + section.y * point.y + section.z * point.z > section.w) continue;
      least = found.distance;
      const corners = this.cornersOf(tree, found.face, matrix);
      const normal = new Vector3().subVectors(corners[1], corners[0])
        .cross(new Vector3().subVectors(corners[2], corners[0])).normalize();
      if (normal.dot(ray.direction) > 0) normal.negate();
      best = { mesh, point, normal, corners };
    }
    return best;
  }

  private cornersOf(tree: MeshBVH, face: { a: number; b: number; c: number }, matrix: Matrix4): [Vector3, Vector3, Vector3] {
    const position = tree.geometry.getAttribute("position");
    const corner = (i: number) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(matrix);
    return [corner(face.a), corner(face.b), corner(face.c)];
  }

  private treeOf(batch: Batch, instance: number): MeshBVH {
    const range = batch.rangeAt(instance);
    const known = this.kept.get(range);
    if (known) {
      this.kept.delete(range);
      this.kept.set(range, known);
      return known;
    }
    const packed = batch.object.geometry.getAttribute("position").array;
    const index = batch.object.geometry.getIndex()!.array;
    const points = new Float32Array(3 * range.vertexCount);
    for (let i = 0; i < points.length; i++) {
      points[i] = range.low[i % 3] + range.step[i % 3] * packed[3 * range.vertexStart + i];
    }
    const corners = new Uint32Array(range.indexCount);
    for (let i = 0; i < corners.length; i++) corners[i] = index[range.indexStart + i] - range.vertexStart;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    geometry.setIndex(new BufferAttribute(corners, 1));
    const tree = new MeshBVH(geometry);
    this.kept.set(range, tree);
    if (this.kept.size > MOST_TREES) this.kept.delete(this.kept.keys().next().value!);
    return tree;
  }
}
