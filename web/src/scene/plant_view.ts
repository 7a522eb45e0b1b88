// The 3D view: what the other areas ask of it, and the loop that draws.

import { BufferGeometry, Matrix4, Mesh, Ray, Vector2, Vector3, Vector4, Raycaster } from "three";
import type { Object3D } from "three";
import type { Source } from "../api.ts";
import type { Camera, Shown, Store } from "../store.ts";
import type { Manifest, Point } from "../types.ts";
import { Culling } from "./culling.ts";
import type { AnyCamera } from "./culling.ts";
import { DepthCopy } from "./depth.ts";
import { Loader } from "./loader.ts";
import { Look } from "./look.ts";
import { Navigation } from "./navigation.ts";
import type { Ball } from "./navigation.ts";
import { Trees } from "./picking.ts";
import type { Hit } from "./picking.ts";
import { Pipeline } from "./pipeline.ts";
import type { Palette } from "./pipeline.ts";
import { Plant } from "./plant.ts";
import { Pace } from "./pace.ts";
import { clearWay } from "./sightline.ts";
import type { Pick, SceneView } from "./view.ts";

const REST = 160; // ms without movement, after which the picture is finished
const MOST_MASKED = 400;
const MARGIN = 2.2; // what a part is looked at with: some of its neighbourhood
/** Changes of these make the picture another one, though no colour. */
const LOOKS: (keyof Shown)[] = ["selection", "hidden", "isolated", "ghost", "marks", "question", "explode", "theme"];

export class PlantView implements SceneView {
  readonly element: HTMLElement;
  readonly navigation: Navigation;
  readonly pipeline: Pipeline;
  readonly plant: Plant;
  readonly store: Store;
  private readonly culling: Culling;
  private readonly look: Look;
  private readonly loader: Loader;
  private readonly trees: Trees;
  private readonly depth = new DepthCopy();
  private depthIsOld = false;
  private readonly pace: Pace;
  private readonly listeners = new Set<() => void>();
  private readonly canvas: HTMLCanvasElement;
  private frame = 0;
  private sample = 0;
  private movedAt = -Infinity;
  private finished = false;
  private cameraTimer = 0;
  private followed: Camera | null = null;
  private cut: Vector4 | null = null;

  constructor(element: HTMLElement, canvas: HTMLCanvasElement, store: Store, source: Source, pipeline: Pipeline,
    software: boolean, manifest: Manifest, instances: ArrayBuffer) {
    this.element = element;
    this.canvas = canvas;
    this.store = store;
    this.pipeline = pipeline;
    this.plant = new Plant(manifest, instances, store.content!);
    this.culling = new Culling(this.plant);
    this.look = new Look(this.plant, store);
    this.trees = new Trees(this.plant, this.culling);
    this.pace = new Pace(software);
    this.navigation = new Navigation(() => this.moved());
    this.loader = new Loader(source, manifest, this.plant, this.culling, pipeline, () => this.arrived());
    this.navigation.setBounds(ballOf(manifest));
    this.resize();
    new ResizeObserver(() => this.resize()).observe(element);
    this.repaint();
    this.look.recolor();
    this.listen();
    const wanted = store.shown.camera;
    if (wanted) this.navigation.set(wanted);
    else this.home(false);
  }

  private listen(): void {
    const { store } = this;
    store.on("content", () => this.changed(true));
    store.watch(["colorBy"], () => this.changed(true));
    store.watch(LOOKS, () => this.changed(false));
    store.watch(["section"], () => this.setSection());
    store.watch(["hovered"], () => this.hover());
    store.watch(["camera"], () => this.follow());
    new MutationObserver(() => this.repaint()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.repaint());
    if (store.shown.section) this.setSection();
  }

  /** Loads all; ends when the coarse forms are there. */
  async load(): Promise<void> {
    await this.loader.loadCoarse();
    this.fill();
  }

  get loaded(): number {
    return this.loader.share;
  }

  get camera(): AnyCamera {
    return this.navigation.camera;
  }

  get stats(): SceneView["stats"] {
    return {
      frameMs: this.pace.frameMs, triangles: this.culling.triangles, meshes: this.culling.meshes,
      bytes: this.loader.bytes, loaded: this.loader.share,
    };
  }

  /** Whether the picture is as good as it gets. */
  get isAtRest(): boolean {
    return this.finished && this.loader.isComplete;
  }

  // Looking

  pickHit(x: number, y: number): Hit | null {
    const mesh = this.pipeline.meshAt(x / this.element.clientWidth, y / this.element.clientHeight);
    return mesh < 0 ? null : this.trees.hit(mesh, this.rayAt(x, y), this.cut);
  }

  pick(x: number, y: number): Pick | null {
    const hit = this.pickHit(x, y);
    return hit && {
      mesh: hit.mesh, part: this.plant.partOf[hit.mesh], point: hit.point.toArray(), normal: hit.normal.toArray(),
    };
  }

  /** The part under a point, without where exactly; quicker than `pick`. */
  partAt(x: number, y: number): number {
    const mesh = this.pipeline.meshAt(x / this.element.clientWidth, y / this.element.clientHeight);
    return mesh < 0 ? -1 : this.plant.partOf[mesh];
  }

  rayAt(x: number, y: number): Ray {
    const at = new Vector2((x / this.element.clientWidth) * 2 - 1, 1 - (y / this.element.clientHeight) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.camera);
    return caster.ray;
  }

  project(point: Point): { x: number; y: number; depth: number } | null {
    const clip = PROJECTED.set(point[0], point[1], point[2], 1)
      .applyMatrix4(VIEW.multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse));
    if (clip.w <= 0) return null;
    return {
      x: (clip.x / clip.w / 2 + 0.5) * this.element.clientWidth,
      y: (0.5 - clip.y / clip.w / 2) * this.element.clientHeight,
      depth: clip.z / clip.w,
    };
  }

  isHidden(point: Point): boolean {
    return this.depth.isBefore(point[0], point[1], point[2]);
  }

  get depthTurn(): number {
    return this.depth.turn;
  }

  // Moving

  /** The corners of the boxes of parts, three numbers each. */
  private cornersOf(parts: readonly number[]): Float32Array {
    const { center, size } = this.store.content!.parts;
    const points = new Float32Array(24 * parts.length);
    parts.forEach((part, i) => {
      for (let corner = 0; corner < 8; corner++) {
        for (let k = 0; k < 3; k++) {
          const half = (corner >> k) & 1 ? 0.5 : -0.5;
          points[24 * i + 3 * corner + k] = center[3 * part + k] + half * size[3 * part + k];
        }
      }
    });
    return points;
  }

  /** Comes close to parts, from a side where nothing stands before them. */
  flyTo(parts: readonly number[]): void {
    if (!parts.length) return;
    const points = this.cornersOf(parts);
    const now = this.camera.getWorldDirection(new Vector3()).negate();
    const { center, size } = this.store.content!.parts;
    const isShown = (row: number) => this.plant.meshesOfPart.of(row).some((mesh) => this.look.visible[mesh] === 1);
    const { target, distance } = this.navigation.fit(points, now, MARGIN);
    const way = clearWay(target.toArray(), distance, now.toArray(), { center, size }, new Set(parts), isShown);
    this.navigation.flyTo(points, new Vector3(...way), !this.pace.slow, MARGIN);
  }

  home(smooth = true): void {
    const points = this.allCorners();
    const sides = [0, 1].map((k) => extent(points, k));
    const way = sides[0] >= sides[1] ? HOME : HOME_ASIDE;
    this.navigation.flyTo(points, way, smooth && !this.pace.slow);
  }

  lookAlong(way: Vector3): void {
    this.navigation.flyTo(this.allCorners(), way, !this.pace.slow);
  }

  /** Of all that is shown, but for the ground. */
  private allCorners(): Float32Array {
    const { ground } = this.store.content!.parts;
    const { hidden, isolated } = this.store.shown;
    const rows = ground.map((_, row) => row).filter((row) => !hidden.has(row) && (isolated?.has(row) ?? true));
    const standing = rows.filter((row) => !ground[row]);
    return this.cornersOf(standing.length ? standing : rows.length ? rows : [...ground.keys()]);
  }

  getCamera(): Camera {
    return this.navigation.get();
  }

  setCamera(camera: Camera): void {
    this.navigation.set(camera);
  }

  // Drawing

  add(object: Object3D, onTop = false): void {
    this.pipeline.add(object, onTop);
    this.invalidate();
  }

  remove(object: Object3D): void {
    object.removeFromParent();
    this.invalidate();
  }

  /** The plant has not changed, but what is drawn with it. */
  invalidate(): void {
    if (!this.frame) this.frame = requestAnimationFrame((now) => this.draw(now));
  }

  onFrame(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  picture(): Promise<Blob> {
    this.pipeline.show(this.camera);
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png");
    });
  }

  /** Everything anew, after the graphics card lost it. */
  redraw(): void {
    this.sample = 0;
    this.finished = false;
    this.invalidate();
  }

  private moved(): void {
    this.movedAt = performance.now();
    this.redraw();
    window.clearTimeout(this.cameraTimer);
    this.cameraTimer = window.setTimeout(() => {
      this.followed = this.navigation.get();
      this.store.set({ camera: this.followed });
      this.fill();
    }, 250);
  }

  private follow(): void {
    const { camera } = this.store.shown;
    if (camera && camera !== this.followed) this.navigation.set(camera);
  }

  private fill(): void {
    void this.loader.fill(this.navigation.get().eye).catch(() => this.redraw());
  }

  private arrived(): void {
    this.changed(false);
  }

  private changed(colors: boolean): void {
    if (colors) this.look.recolor();
    else this.look.update();
    this.paint();
    this.redraw();
  }

  /** Brings colours and flags to the batches. */
  private paint(): void {
    const { state } = this.look;
    for (let mesh = 0; mesh < this.plant.n; mesh++) {
      const at = 4 * mesh;
      this.culling.eachForm(mesh, (batch, instance) => {
        batch.setState(instance, state[at], state[at + 1], state[at + 2], state[at + 3]);
      });
    }
    this.maskSelected();
  }

  private maskSelected(): void {
    const { mask, maskMaterial } = this.pipeline;
    for (const object of [...mask.children]) {
      mask.remove(object);
      // The buffers are the batch's; only this view of them goes.
      (object as Mesh).geometry.dispose();
    }
    for (const mesh of this.look.emphasised.slice(0, MOST_MASKED)) {
      const form = this.culling.formOf(mesh);
      if (!form) continue;
      const range = form.batch.rangeAt(form.instance);
      const shared = form.batch.object.geometry;
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", shared.getAttribute("position"));
      geometry.setIndex(shared.getIndex());
      geometry.setDrawRange(range.indexStart, range.indexCount);
      const object = new Mesh(geometry, maskMaterial);
      object.frustumCulled = object.matrixAutoUpdate = object.matrixWorldAutoUpdate = false;
      form.batch.matrixAt(form.instance, this.plant, object.matrixWorld);
      mask.add(object);
    }
  }

  /** Moves the meshes of single parts from their places [m]; all others stand where they are. */
  setOffsets(offsets: ReadonlyMap<number, Vector3>): void {
    const { plant } = this;
    for (let mesh = 0; mesh < plant.n; mesh++) {
      const offset = offsets.get(plant.partOf[mesh]);
      const at = 3 * mesh;
      if (!offset && !plant.offset[at] && !plant.offset[at + 1] && !plant.offset[at + 2]) continue;
      (offset ?? ORIGIN).toArray(plant.offset, at);
      this.culling.eachForm(mesh, (batch, instance) => batch.setMatrix(instance, plant));
    }
    this.changed(false);
  }

  private hover(): void {
    const { hovered } = this.store.shown;
    this.pipeline.setHovered(hovered >= 0 ? this.plant.meshesOfPart.of(hovered) : []);
    this.invalidate();
  }

  private setSection(): void {
    const { section } = this.store.shown;
    if (section) {
      const axis = "xyz".indexOf(section.axis);
      const sign = section.flipped ? -1 : 1;
      this.cut = new Vector4(0, 0, 0, sign * section.at).setComponent(axis, sign);
    } else {
      this.cut = null;
    }
    this.pipeline.setSection(this.cut);
    this.redraw();
  }

  private repaint(): void {
    const css = getComputedStyle(document.documentElement);
    const get = (name: string, or: string) => css.getPropertyValue(name).trim() || or;
    const dark = document.documentElement.dataset.theme === "dark";
    const palette: Palette = {
      top: get("--sky-top", "#e9eef4"), bottom: get("--sky-bottom", "#ffffff"), ink: dark ? "#05080b" : "#10161d",
      accent: "#ffc400", mark: get("--mark", "#d1580a"),
    };
    this.pipeline.setPalette(palette);
    this.redraw();
  }

  private resize(): void {
    const width = Math.max(1, this.element.clientWidth);
    const height = Math.max(1, this.element.clientHeight);
    const ratio = Math.min(window.devicePixelRatio || 1, this.pace.slow ? 1 : 2);
    this.pipeline.setSize(Math.round(width * ratio), Math.round(height * ratio), width, height);
    this.navigation.setAspect(width / height);
  }

  private draw(now: number): void {
    this.frame = 0;
    const moving = performance.now() - this.movedAt < REST;
    if (!this.finished) this.drawPlant(moving);
    this.pipeline.show(this.camera);
    for (const listener of this.listeners) listener();
    if (!this.finished || moving) {
      this.pace.frame(now, moving);
      this.invalidate();
    }
  }

  private drawPlant(moving: boolean): void {
    const { pace, culling, look } = this;
    const height = this.element.clientHeight;
    if (moving) {
      culling.look(this.camera, height, look.visible, pace.leastPixels, pace.budget);
      this.pipeline.draw(this.camera, { scale: pace.scale, sample: 0, occlusion: false, ghosts: look.hasGhosts });
      this.sample = 0;
      return;
    }
    if (this.sample === 0) culling.look(this.camera, height, look.visible, 0.7, Infinity);
    this.pipeline.draw(this.camera, { scale: 1, sample: this.sample, occlusion: true, ghosts: look.hasGhosts });
    if (this.sample === 0) this.depthIsOld = true;
    if (this.depthIsOld) this.depthIsOld = !this.depth.copy(this.pipeline, this.camera, () => this.invalidate());
    this.sample++;
    // A copy of an earlier picture may still be on its way: what is hidden in this one must be known, too.
    this.finished = this.sample >= pace.samples && !this.depthIsOld;
  }

  dispose(): void {
    this.loader.dispose();
    this.pipeline.dispose();
  }
}

function ballOf(manifest: Manifest): Ball {
  const { low, high } = manifest;
  const center = low.map((value, k) => (value + high[k]) / 2) as Point;
  return { center, radius: Math.max(Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2, 1e-3) };
}

/** From the plant to the eye, as one stands before a model on a table, its long side across the picture. */
const HOME = new Vector3(-0.5, -0.8, 0.5).normalize();
const HOME_ASIDE = new Vector3(0.8, -0.5, 0.5).normalize();

function extent(points: Float32Array, k: number): number {
  let low = Infinity;
  let high = -Infinity;
  for (let i = k; i < points.length; i += 3) [low, high] = [Math.min(low, points[i]), Math.max(high, points[i])];
  return high - low;
}

const ORIGIN = new Vector3();
const PROJECTED = new Vector4();
const VIEW = new Matrix4();

