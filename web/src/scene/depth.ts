// A small copy of the picture's depth for the processor: which tags are behind something.

import { Matrix4, Mesh, OrthographicCamera, PlaneGeometry, Scene, Vector2, Vector4, WebGLRenderTarget } from "three";
import type { AnyCamera } from "./culling.ts";
import { fullScreen } from "./pipeline.ts";
import type { Pipeline } from "./pipeline.ts";
import { DEPTH_FRAGMENT } from "./shaders.ts";

const WIDTH = 320;

export class DepthCopy {
  private height = 180;
  private target = new WebGLRenderTarget(WIDTH, this.height, { depthBuffer: false });
  private pixels: Uint8Array | null = null;
  private next: Uint8Array | null = null;
  private readonly toClip = new Matrix4();
  private readonly fromClip = new Matrix4();
  private readonly material = fullScreen(DEPTH_FRAGMENT, { tDepth: { value: null }, used: { value: new Vector2() } },
    { depthTest: false, depthWrite: false });
  private readonly scene = new Scene();
  private readonly flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private busy = false;
  /** Grows with each copy that has arrived. */
  turn = 0;

  constructor() {
    const screen = new Mesh(new PlaneGeometry(2, 2), this.material);
    screen.frustumCulled = false;
    this.scene.add(screen);
  }

  /** Begins to copy the depth of the last picture; calls back when it is there. False while an earlier copy is on its way. */
  copy(pipeline: Pipeline, camera: AnyCamera, done: () => void): boolean {
    if (this.busy) return false;
    this.busy = true;
    const height = Math.max(1, Math.round((WIDTH * pipeline.renderer.domElement.height) / pipeline.renderer.domElement.width));
    if (height !== this.height) {
      this.height = height;
      this.target.setSize(WIDTH, height);
      this.next = null;
    }
    const { texture, used } = pipeline.depth;
    this.material.uniforms.tDepth.value = texture;
    (this.material.uniforms.used.value as Vector2).copy(used);
    pipeline.renderer.setRenderTarget(this.target);
    pipeline.renderer.render(this.scene, this.flat);
    pipeline.renderer.setRenderTarget(null);
    const toClip = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const into = this.next ?? new Uint8Array(4 * WIDTH * height);
    pipeline.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, WIDTH, height, into).then(
      () => {
        this.next = this.pixels?.length === into.length ? this.pixels : null;
        this.pixels = into;
        this.toClip.copy(toClip);
        this.fromClip.copy(toClip).invert();
        this.busy = false;
        this.turn++;
        done();
      },
      () => (this.busy = false),
    );
    return true;
  }

  /** Whether something lies well before a point, in the picture that was copied last. */
  isBefore(x: number, y: number, z: number): boolean {
    if (!this.pixels) return false;
    const clip = new Vector4(x, y, z, 1).applyMatrix4(this.toClip);
    if (clip.w <= 0) return true;
    const px = Math.floor((clip.x / clip.w / 2 + 0.5) * WIDTH);
    const py = Math.floor((clip.y / clip.w / 2 + 0.5) * this.height);
    if (px < 1 || py < 1 || px >= WIDTH - 1 || py >= this.height - 1) return false;
    const depth = clip.z / clip.w;
    const slack = this.slackAt(clip);
    // All around, not only here: a point at an edge is seen.
    for (let dy = -1; dy <= 1; dy++) {
      for (let dx = -1; dx <= 1; dx++) {
        const at = 4 * ((py + dy) * WIDTH + px + dx);
        const value = (this.pixels[at] + 256 * this.pixels[at + 1] + 65536 * this.pixels[at + 2]) / 16777215;
        if (value * 2 - 1 >= depth - slack) return false;
      }
    }
    return true;
  }

  /** Depth in clip space of about two per cent of the distance: what belongs to the point itself. */
  private slackAt(clip: Vector4): number {
    const here = new Vector4(clip.x / clip.w, clip.y / clip.w, clip.z / clip.w, 1).applyMatrix4(this.fromClip);
    const eye = new Vector4(0, 0, -1, 1).applyMatrix4(this.fromClip);
    const [a, b] = [here.divideScalar(here.w), eye.divideScalar(eye.w)];
    const nearer = a.clone().lerp(b, 0.02).setW(1).applyMatrix4(this.toClip);
    return Math.max(0, clip.z / clip.w - nearer.z / nearer.w);
  }
}
