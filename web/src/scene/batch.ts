// One chunk of shapes on the graphics card, with all that stand in the plant.

import {
  BatchedMesh, BufferAttribute, BufferGeometry, DataTexture, Matrix4, NearestFilter, RGBAFormat, ShaderMaterial,
  UnsignedByteType,
} from "three";
import type { ShapeForm } from "./chunk.ts";
import type { Plant } from "./plant.ts";

const MOST_U16 = 65535;

/** A form of a shape in the shared buffers, for those who look at single shapes. */
export interface FormRange {
  vertexStart: number;
  vertexCount: number;
  indexStart: number;
  indexCount: number;
  low: readonly number[];
  step: readonly number[];
}

export class Batch {
  readonly object: BatchedMesh;
  readonly bytes: number;
  readonly level: 0 | 1;
  /** Mesh of each instance. */
  readonly meshes: Uint32Array;
  /** Triangles of each instance. */
  readonly triangles: Uint32Array;
  readonly ranges: FormRange[] = [];
  /** Row in `ranges` of each instance. */
  private readonly rangeOf: Uint32Array;
  private readonly state: Uint8Array;
  private readonly texture: DataTexture;
  private dirty = false;

  /** All meshes that have one of the forms; `material`: shared, what is the batch's own is set before it is drawn. */
  constructor(forms: ShapeForm[], plant: Plant, material: ShaderMaterial) {
    let vertices = 0;
    let indices = 0;
    let instances = 0;
    for (const form of forms) {
      vertices += form.positions.length / 3;
      indices += form.indices.length;
      instances += plant.meshesOfShape.of(form.shape).length;
    }
    this.level = forms[0]?.level ?? 1;
    this.meshes = new Uint32Array(instances);
    this.triangles = new Uint32Array(instances);
    this.rangeOf = new Uint32Array(instances);
    const width = 512;
    const height = Math.max(1, Math.ceil((2 * instances) / width));
    this.state = new Uint8Array(4 * width * height);
    this.texture = new DataTexture(this.state, width, height, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    this.object = new BatchedMesh(Math.max(instances, 1), Math.max(vertices, 1), Math.max(indices, 1), material);
    this.object.frustumCulled = this.object.perObjectFrustumCulled = this.object.sortObjects = false;
    this.object.matrixAutoUpdate = false;
    const own = this.object.onBeforeRender;
    this.object.onBeforeRender = (renderer, scene, camera, geometry, drawn, group) => {
      this.bindState(drawn as ShaderMaterial);
      own.call(this.object, renderer, scene, camera, geometry, drawn, group);
    };
    for (const form of forms) this.addForm(form, plant);
    this.bytes = vertices * 8 + indices * (vertices > MOST_U16 ? 4 : 2) + instances * 80;
  }

  private addForm(form: ShapeForm, plant: Plant): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(form.positions, 3));
    geometry.setAttribute("oct", new BufferAttribute(form.normals, 2));
    geometry.setIndex(new BufferAttribute(form.indices, 1));
    const id = this.object.addGeometry(geometry);
    const range = this.object.getGeometryRangeAt(id)!;
    this.ranges.push({
      vertexStart: range.vertexStart, vertexCount: range.vertexCount,
      indexStart: range.indexStart, indexCount: range.indexCount, low: form.low, step: form.step,
    });
    for (const mesh of plant.meshesOfShape.of(form.shape)) {
      const instance = this.object.addInstance(id);
      this.meshes[instance] = mesh;
      this.triangles[instance] = form.indices.length / 3;
      this.rangeOf[instance] = this.ranges.length - 1;
      this.object.setVisibleAt(instance, false);
      this.setMatrix(instance, plant);
      const at = 8 * instance + 4;
      this.state[at] = (mesh + 1) & 255;
      this.state[at + 1] = ((mesh + 1) >> 8) & 255;
      this.state[at + 2] = ((mesh + 1) >> 16) & 255;
    }
    this.dirty = true;
  }

  rangeAt(instance: number): FormRange {
    return this.ranges[this.rangeOf[instance]];
  }

  setVisible(instance: number, visible: boolean): void {
    this.object.setVisibleAt(instance, visible);
  }

  /** Colour (sRGB) and flags of an instance. */
  setState(instance: number, r: number, g: number, b: number, flags: number): void {
    const at = 8 * instance;
    this.state[at] = r;
    this.state[at + 1] = g;
    this.state[at + 2] = b;
    this.state[at + 3] = flags;
    this.dirty = true;
  }

  /** Places an instance: its grid of 65,536 steps is part of the matrix, whose columns the shader makes units again. */
  setMatrix(instance: number, plant: Plant): void {
    this.object.setMatrixAt(instance, this.matrixAt(instance, plant, MATRIX));
  }

  matrixAt(instance: number, plant: Plant, target: Matrix4): Matrix4 {
    const { low, step } = this.rangeAt(instance);
    plant.matrixOf(this.meshes[instance], target);
    GRID.makeScale(step[0] || 1e-9, step[1] || 1e-9, step[2] || 1e-9).setPosition(low[0], low[1], low[2]);
    return target.multiply(GRID);
  }

  /** The material is shared by all batches; what each instance looks like is not. */
  private bindState(material: ShaderMaterial): void {
    if (this.dirty) {
      this.texture.needsUpdate = true;
      this.dirty = false;
    }
    material.uniforms.stateTexture.value = this.texture;
    material.uniformsNeedUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
    this.object.dispose();
  }
}

const MATRIX = new Matrix4();
const GRID = new Matrix4();
