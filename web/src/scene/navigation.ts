// The camera, and how mouse, fingers and keys move it: as CAD programs do, around what is under the cursor.

import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import type { Camera } from "../store.ts";
import type { Point } from "../types.ts";
import type { AnyCamera } from "./culling.ts";

const FOV = 38;
const STEEPEST = Math.cos((0.4 * Math.PI) / 180);

export interface Ball {
  center: Point;
  radius: number;
}

export class Navigation {
  readonly perspective = new PerspectiveCamera(FOV, 1, 0.01, 1000);
  readonly parallel = new OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  orthographic = false;
  private readonly eye = new Vector3(-10, -13, 9);
  private readonly target = new Vector3();
  private aspect = 1;
  private flight = 0;
  bounds: Ball = { center: [0, 0, 0], radius: 10 };
  private readonly moved: () => void;

  constructor(moved: () => void) {
    this.moved = moved;
    for (const camera of [this.perspective, this.parallel]) camera.up.set(0, 0, 1);
  }

  get camera(): AnyCamera {
    return this.orthographic ? this.parallel : this.perspective;
  }

  setBounds(ball: Ball): void {
    this.bounds = ball;
  }

  setAspect(aspect: number): void {
    this.aspect = aspect;
    this.place();
  }

  get(): Camera {
    return { eye: this.eye.toArray(), target: this.target.toArray(), orthographic: this.orthographic };
  }

  set(camera: Camera): void {
    this.stop();
    this.orthographic = camera.orthographic;
    this.eye.fromArray(camera.eye);
    this.target.fromArray(camera.target);
    this.place();
  }

  setOrthographic(on: boolean): void {
    this.orthographic = on;
    this.place();
  }

  /** Size of a pixel in the world at a point [m]. */
  pixelAt(point: Vector3, height: number): number {
    const distance = this.orthographic ? this.distance : Math.max(this.depthOf(point), 1e-6);
    return (2 * distance * Math.tan((FOV * Math.PI) / 360)) / height;
  }

  orbit(pivot: Vector3, dx: number, dy: number): void {
    this.stop();
    const yaw = -dx;
    const right = this.right();
    for (const point of [this.eye, this.target]) point.sub(pivot).applyAxisAngle(UP, yaw).add(pivot);
    right.applyAxisAngle(UP, yaw);
    const before = [this.eye.clone(), this.target.clone()];
    for (const point of [this.eye, this.target]) point.sub(pivot).applyAxisAngle(right, -dy).add(pivot);
    const ahead = this.ahead();
    // Not over the top: up stays up.
    if (Math.abs(ahead.z) > STEEPEST || ahead.dot(new Vector3().crossVectors(UP, right)) < 0) {
      this.eye.copy(before[0]);
      this.target.copy(before[1]);
    }
    this.place();
  }

  /** Moves the plant with the cursor, by pixels at the depth of a point. */
  pan(at: Vector3, dx: number, dy: number, height: number): void {
    this.stop();
    const size = this.pixelAt(at, height);
    const right = this.right();
    const up = new Vector3().crossVectors(right, this.ahead());
    const by = right.multiplyScalar(-dx * size).addScaledVector(up, dy * size);
    this.eye.add(by);
    this.target.add(by);
    this.place();
  }

  /** Comes closer to a point (factor below 1) or goes away from it. */
  zoom(to: Vector3, factor: number): void {
    this.stop();
    const least = this.bounds.radius * 1e-5;
    if (factor < 1 && this.distance * factor < least) return;
    if (factor > 1 && this.distance * factor > this.bounds.radius * 40) return;
    this.eye.sub(to).multiplyScalar(factor).add(to);
    this.target.sub(to).multiplyScalar(factor).add(to);
    this.place();
  }

  /** So that points fill the picture; from another direction (out of the plant to the eye) where one is given. */
  flyTo(points: Float32Array, way?: Vector3, smooth = true, margin = 1.08): void {
    const from = (way ?? this.ahead().negate()).clone().normalize();
    // Straight from above there is no right and left: almost straight, then.
    if (Math.abs(from.z) > STEEPEST) from.set(0, -Math.sqrt(1 - STEEPEST ** 2), from.z).normalize();
    const { target, distance } = this.fit(points, from, margin);
    this.travel(target.clone().addScaledVector(from, distance), target, smooth);
  }

  /** Where to look, and from how far, to see all points (three numbers each) from a direction. */
  fit(points: Float32Array, from: Vector3, margin: number): { target: Vector3; distance: number } {
    const right = new Vector3().crossVectors(UP, from).normalize();
    const up = new Vector3().crossVectors(from, right);
    const tall = Math.tan((FOV * Math.PI) / 360) / margin;
    const wide = tall * this.aspect;
    const target = middleOf(points);
    let distance = 0;
    const at = new Vector3();
    // What is nearer looks larger: the middle of the picture is found step by step.
    for (let step = 0; step < 4; step++) {
      distance = this.bounds.radius * 1e-4;
      for (let i = 0; i < points.length; i += 3) {
        at.fromArray(points, i).sub(target);
        const aside = Math.max(Math.abs(at.dot(right)) / wide, Math.abs(at.dot(up)) / tall);
        distance = Math.max(distance, aside + at.dot(from));
      }
      const x = [Infinity, -Infinity];
      const y = [Infinity, -Infinity];
      for (let i = 0; i < points.length; i += 3) {
        at.fromArray(points, i).sub(target);
        const depth = this.orthographic ? distance : Math.max(distance - at.dot(from), 1e-6);
        const [sx, sy] = [at.dot(right) / depth, at.dot(up) / depth];
        [x[0], x[1]] = [Math.min(x[0], sx), Math.max(x[1], sx)];
        [y[0], y[1]] = [Math.min(y[0], sy), Math.max(y[1], sy)];
      }
      if (step < 3) {
        target.addScaledVector(right, ((x[0] + x[1]) / 2) * distance).addScaledVector(up, ((y[0] + y[1]) / 2) * distance);
      }
    }
    return { target, distance };
  }

  private travel(eye: Vector3, target: Vector3, smooth: boolean): void {
    this.stop();
    const still = !smooth || matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (still) {
      this.eye.copy(eye);
      this.target.copy(target);
      this.place();
      return;
    }
    const [eye0, target0] = [this.eye.clone(), this.target.clone()];
    const start = performance.now();
    const step = (now: number) => {
      const t = Math.min(1, Math.max(0, (now - start) / 420));
      const share = t * t * (3 - 2 * t);
      this.target.lerpVectors(target0, target, share);
      this.eye.lerpVectors(eye0, eye, share);
      this.place();
      this.flight = t < 1 ? requestAnimationFrame(step) : 0;
    };
    this.flight = requestAnimationFrame(step);
  }

  stop(): void {
    if (this.flight) cancelAnimationFrame(this.flight);
    this.flight = 0;
  }

  private get distance(): number {
    return this.eye.distanceTo(this.target);
  }

  private ahead(): Vector3 {
    return new Vector3().subVectors(this.target, this.eye).normalize();
  }

  private right(): Vector3 {
    const right = new Vector3().crossVectors(this.ahead(), UP);
    return right.lengthSq() > 1e-9 ? right.normalize() : right.set(1, 0, 0);
  }

  private depthOf(point: Vector3): number {
    return point.clone().sub(this.eye).dot(this.ahead());
  }

  private place(): void {
    const center = new Vector3(...this.bounds.center);
    const radius = this.bounds.radius * 1.3;
    const depth = this.depthOf(center);
    const { perspective, parallel } = this;
    perspective.far = Math.max(depth + radius, this.bounds.radius * 0.01);
    perspective.near = Math.max(depth - radius, perspective.far / 20000);
    perspective.aspect = this.aspect;
    const half = this.distance * Math.tan((FOV * Math.PI) / 360);
    parallel.top = half;
    parallel.bottom = -half;
    parallel.left = -half * this.aspect;
    parallel.right = half * this.aspect;
    parallel.near = depth - radius;
    parallel.far = depth + radius;
    for (const camera of [perspective, parallel]) {
      camera.position.copy(this.eye);
      camera.lookAt(this.target);
      camera.updateMatrixWorld();
      camera.updateProjectionMatrix();
    }
    this.moved();
  }
}

const UP = new Vector3(0, 0, 1);

/** The middle of the box around points. */
export function middleOf(points: Float32Array): Vector3 {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  const at = new Vector3();
  for (let i = 0; i < points.length; i += 3) {
    at.fromArray(points, i);
    low.min(at);
    high.max(at);
  }
  return low.add(high).multiplyScalar(0.5);
}
