// What the other areas may ask of the 3D view.

import type { Object3D, PerspectiveCamera, OrthographicCamera } from "three";
import type { Camera } from "../store.ts";
import type { Point } from "../types.ts";

/** What lies under a pixel. */
export interface Pick {
  mesh: number;
  part: number;
  point: Point;
  normal: Point;
}

export interface SceneView {
  /** The element that holds the canvas; overlays of labels go into it, above the canvas. */
  readonly element: HTMLElement;
  /** The camera as it draws; overlays look, nobody but the view changes it. */
  readonly camera: PerspectiveCamera | OrthographicCamera;
  /** What is under a point of the element [CSS px], nearest first seen; null where nothing is. */
  pick(x: number, y: number): Pick | null;
  /** Where a point of the world appears in the element [CSS px]; null behind the eye. `hidden`: something is before it. */
  project(point: Point): { x: number; y: number; depth: number } | null;
  /** Whether something of the plant is between the eye and a point. */
  isHidden(point: Point): boolean;
  /** Another number each time that `isHidden` may answer otherwise. */
  readonly depthTurn: number;
  /** Moves so that these parts fill the view. */
  flyTo(parts: readonly number[]): void;
  home(): void;
  getCamera(): Camera;
  setCamera(camera: Camera): void;
  /** Draws something else with the plant (lines, arrows), in the content's coordinates; `onTop`: over everything. */
  add(object: Object3D, onTop?: boolean): void;
  remove(object: Object3D): void;
  /** Asks for a new frame. */
  invalidate(): void;
  /** Calls back after each frame, for labels that follow the plant. */
  onFrame(listener: () => void): () => void;
  /** The picture as it is now. */
  picture(): Promise<Blob>;
  readonly stats: { frameMs: number; triangles: number; meshes: number; bytes: number; loaded: number };
}
