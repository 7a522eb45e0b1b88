// From batches to the picture: what each pixel shows, edges and shade from that, and a few such pictures averaged.

import {
  Color, DepthTexture, GLSL3, HalfFloatType, Matrix4, Mesh, NearestFilter, OrthographicCamera, PlaneGeometry, RGBAFormat,
  Scene, ShaderMaterial, UnsignedByteType, UnsignedIntType, Vector2, Vector3, Vector4, WebGLRenderTarget, DoubleSide,
  NoBlending, CustomBlending, OneFactor, OneMinusSrcAlphaFactor, SrcAlphaFactor, LinearFilter, WebGLRenderer,
} from "three";
import type { IUniform, Object3D } from "three";
import type { AnyCamera } from "./culling.ts";
import {
  COMPOSE_FRAGMENT, FULL_VERTEX, GHOST_FRAGMENT, MASK_FRAGMENT, MASK_VERTEX, MOST_HOVERED, PLANT_FRAGMENT, PLANT_VERTEX,
  SHOW_FRAGMENT,
} from "./shaders.ts";

type Uniforms = Record<string, IUniform>;

/** What of the page's colours the picture needs. */
export interface Palette {
  top: string;
  bottom: string;
  ink: string;
  accent: string;
  mark: string;
}

export interface FrameOptions {
  /** Share of the full resolution, 0 to 1. */
  scale: number;
  /** Which of the pictures to average this is; 0 starts anew. */
  sample: number;
  occlusion: boolean;
  ghosts: boolean;
}

export class Pipeline {
  readonly renderer: WebGLRenderer;
  readonly plant = new Scene();
  /** Selected meshes alone, drawn through everything. */
  readonly mask = new Scene();
  readonly overlay = new Scene();
  readonly overlayOnTop = new Scene();
  readonly material: ShaderMaterial;
  readonly maskMaterial: ShaderMaterial;
  private readonly ghostMaterial: ShaderMaterial;
  private readonly composeMaterial: ShaderMaterial;
  private readonly showMaterial: ShaderMaterial;
  private readonly screen: Mesh;
  private readonly flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private targets: Targets;
  private used = new Vector2(1, 1);
  private size = new Vector2(1, 1);
  private readonly clearColor = new Color(0, 0, 0);

  constructor(canvas: HTMLCanvasElement, antialias: boolean) {
    this.renderer = new WebGLRenderer({ canvas, antialias, powerPreference: "high-performance", alpha: false });
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    const shared = {
      stateTexture: { value: null }, section: { value: new Vector4() }, cutting: { value: false },
      toLight: { value: new Vector3(0, 0, 1) }, lookDirection: { value: new Vector3(0, 1, 0) },
      parallel: { value: false }, accent: { value: new Color() }, markColor: { value: new Color() },
    };
    const plantOf = (fragmentShader: string, more: Uniforms, rest = {}) =>
      new ShaderMaterial({
        glslVersion: GLSL3, vertexShader: PLANT_VERTEX, fragmentShader, uniforms: { ...shared, ...more }, side: DoubleSide,
        blending: NoBlending, ...rest,
      });
    this.material = plantOf(PLANT_FRAGMENT, { ghosts: { value: 0 } });
    this.ghostMaterial = plantOf(GHOST_FRAGMENT, { ghosts: { value: 1 }, faint: { value: 0.3 } }, {
      transparent: true, depthWrite: false, blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor,
    });
    this.maskMaterial = new ShaderMaterial({
      glslVersion: GLSL3, vertexShader: MASK_VERTEX, fragmentShader: MASK_FRAGMENT, side: DoubleSide, depthTest: false,
      depthWrite: false, blending: NoBlending, uniforms: { section: shared.section, cutting: shared.cutting },
    });
    this.composeMaterial = fullScreen(COMPOSE_FRAGMENT, {
      tColor: { value: null }, tNormal: { value: null }, tMesh: { value: null }, tGhost: { value: null },
      tMask: { value: null }, tDepth: { value: null }, texel: { value: new Vector2() }, used: { value: new Vector2() },
      fromClip: { value: new Matrix4() }, occlusion: { value: false }, hasGhosts: { value: false },
      hasMask: { value: false }, weight: { value: 1 }, turn: { value: 0 }, edgeStrength: { value: 0.8 },
      skyTop: { value: new Color() }, skyBottom: { value: new Color() }, ink: { value: new Color() },
      accent: { value: new Color() },
    }, { blending: CustomBlending, blendSrc: SrcAlphaFactor, blendDst: OneMinusSrcAlphaFactor, transparent: true,
      depthTest: false, depthWrite: false });
    this.showMaterial = fullScreen(SHOW_FRAGMENT, {
      tPicture: { value: null }, tMesh: { value: null }, tDepth: { value: null }, used: { value: new Vector2() },
      hovered: { value: Array.from({ length: MOST_HOVERED }, () => new Vector3()) }, nHovered: { value: 0 },
    }, { blending: NoBlending });
    this.screen = new Mesh(new PlaneGeometry(2, 2), this.composeMaterial);
    this.screen.frustumCulled = false;
    this.targets = makeTargets(1, 1);
    for (const scene of [this.plant, this.mask]) scene.matrixAutoUpdate = false;
  }

  setPalette(palette: Palette): void {
    const { composeMaterial: compose, material } = this;
    // Colours here are what a screen shows, never linear light.
    const set = (uniform: IUniform, css: string) => (uniform.value as Color).setStyle(css, "");
    set(compose.uniforms.skyTop, palette.top);
    set(compose.uniforms.skyBottom, palette.bottom);
    set(compose.uniforms.ink, palette.ink);
    set(compose.uniforms.accent, palette.accent);
    set(material.uniforms.accent, palette.accent);
    set(material.uniforms.markColor, palette.mark);
  }

  /** `width` and `height` in device pixels. */
  setSize(width: number, height: number, cssWidth: number, cssHeight: number): void {
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    const canvas = this.renderer.domElement;
    canvas.style.width = `${cssWidth}px`;
    canvas.style.height = `${cssHeight}px`;
    this.size.set(width, height);
    disposeTargets(this.targets);
    this.targets = makeTargets(width, height);
  }

  /** Lights meshes in the picture as it is, without drawing the plant again. */
  setHovered(meshes: ArrayLike<number>): void {
    const { hovered, nHovered } = this.showMaterial.uniforms;
    nHovered.value = Math.min(meshes.length, MOST_HOVERED);
    for (let k = 0; k < nHovered.value; k++) {
      const id = meshes[k] + 1;
      (hovered.value as Vector3[])[k].set(id & 255, (id >> 8) & 255, (id >> 16) & 255).divideScalar(255);
    }
  }

  setSection(plane: Vector4 | null): void {
    (this.material.uniforms.section.value as Vector4).copy(plane ?? new Vector4(0, 0, 0, 0));
    this.material.uniforms.cutting.value = this.maskMaterial.uniforms.cutting.value = plane !== null;
    this.ghostMaterial.uniforms.cutting.value = plane !== null;
  }

  /** Draws a picture, averages it with those before, and shows it. */
  draw(camera: AnyCamera, options: FrameOptions): void {
    const { renderer, targets } = this;
    const width = Math.max(1, Math.round(this.size.x * options.scale));
    const height = Math.max(1, Math.round(this.size.y * options.scale));
    this.used.set(width / this.size.x, height / this.size.y);
    renderer.info.reset();
    this.lookFrom(camera);
    const jitter = JITTER[options.sample % JITTER.length];
    camera.setViewOffset(width, height, jitter[0], jitter[1], width, height);
    camera.updateProjectionMatrix();
    for (const target of [targets.pixels, targets.ghosts, targets.mask, targets.sum]) {
      target.viewport.set(0, 0, width, height);
      target.scissor.set(0, 0, width, height);
      target.scissorTest = true;
    }
    renderer.setClearColor(this.clearColor, 0);
    this.plant.overrideMaterial = null;
    renderer.setRenderTarget(targets.pixels);
    renderer.clear();
    renderer.render(this.plant, camera);
    if (options.ghosts) {
      this.plant.overrideMaterial = this.ghostMaterial;
      renderer.setRenderTarget(targets.ghosts);
      renderer.clear(true, false, false);
      renderer.render(this.plant, camera);
      this.plant.overrideMaterial = null;
    }
    const masked = this.mask.children.length > 0;
    if (masked) {
      renderer.setRenderTarget(targets.mask);
      renderer.clear();
      renderer.render(this.mask, camera);
    }
    this.compose(camera, options, masked);
    camera.clearViewOffset();
    camera.updateProjectionMatrix();
    this.show();
  }

  private lookFrom(camera: AnyCamera): void {
    const { uniforms } = this.material;
    const ahead = camera.getWorldDirection(uniforms.lookDirection.value as Vector3);
    uniforms.parallel.value = this.ghostMaterial.uniforms.parallel.value = "isOrthographicCamera" in camera;
    // The light comes over the left shoulder, whichever way one looks, but from above.
    const light = uniforms.toLight.value as Vector3;
    const right = new Vector3().crossVectors(ahead, camera.up).normalize();
    light.copy(ahead).multiplyScalar(-0.55).addScaledVector(right, -0.5);
    light.z = Math.max(light.z, 0) + 0.75;
    light.normalize();
  }

  private compose(camera: AnyCamera, options: FrameOptions, masked: boolean): void {
    const { renderer, targets } = this;
    const { uniforms } = this.composeMaterial;
    uniforms.tColor.value = targets.pixels.textures[0];
    uniforms.tNormal.value = targets.pixels.textures[1];
    uniforms.tMesh.value = targets.pixels.textures[2];
    uniforms.tDepth.value = targets.pixels.depthTexture;
    uniforms.tGhost.value = targets.ghosts.texture;
    uniforms.tMask.value = targets.mask.texture;
    (uniforms.texel.value as Vector2).set(1 / this.size.x, 1 / this.size.y);
    (uniforms.used.value as Vector2).copy(this.used);
    (uniforms.fromClip.value as Matrix4).copy(camera.projectionMatrix).invert();
    uniforms.occlusion.value = options.occlusion;
    uniforms.hasGhosts.value = options.ghosts;
    uniforms.hasMask.value = masked;
    uniforms.weight.value = 1 / (options.sample + 1);
    uniforms.turn.value = options.sample * 1.1;
    this.screen.material = this.composeMaterial;
    renderer.setRenderTarget(targets.sum);
    if (options.sample === 0) renderer.clear();
    renderer.render(this.screen, this.flat);
  }

  /** The last picture again, and what is drawn into it. */
  show(camera?: AnyCamera): void {
    const { renderer, targets } = this;
    const { uniforms } = this.showMaterial;
    uniforms.tPicture.value = targets.sum.texture;
    uniforms.tMesh.value = targets.pixels.textures[2];
    uniforms.tDepth.value = targets.pixels.depthTexture;
    (uniforms.used.value as Vector2).copy(this.used);
    this.screen.material = this.showMaterial;
    renderer.setRenderTarget(null);
    renderer.clear();
    renderer.render(this.screen, this.flat);
    if (camera) this.drawOverlays(camera);
  }

  drawOverlays(camera: AnyCamera): void {
    const { renderer } = this;
    renderer.setRenderTarget(null);
    if (this.overlay.children.length) renderer.render(this.overlay, camera);
    if (this.overlayOnTop.children.length) {
      renderer.clearDepth();
      renderer.render(this.overlayOnTop, camera);
    }
  }

  /** The mesh under a pixel of the last picture, counted from the top left, in shares of the picture; -1 none. */
  meshAt(x: number, y: number): number {
    const width = this.size.x * this.used.x;
    const height = this.size.y * this.used.y;
    const pixel = new Uint8Array(4);
    const px = Math.min(width - 1, Math.max(0, Math.floor(x * width)));
    const py = Math.min(height - 1, Math.max(0, Math.floor((1 - y) * height)));
    this.renderer.readRenderTargetPixels(this.targets.pixels, px, py, 1, 1, pixel, undefined, 2);
    return pixel[3] ? pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1 : -1;
  }

  /** Depth of the last picture as a texture, and which share of it is used. */
  get depth(): { texture: DepthTexture; used: Vector2 } {
    return { texture: this.targets.pixels.depthTexture!, used: this.used };
  }

  add(object: Object3D, onTop: boolean): void {
    (onTop ? this.overlayOnTop : this.overlay).add(object);
  }

  dispose(): void {
    disposeTargets(this.targets);
    this.renderer.dispose();
  }
}

/** Halton points around the middle of a pixel: so are edges smooth after some pictures. */
const JITTER: [number, number][] = [
  [0, 0], [-0.25, 0.17], [0.25, -0.17], [-0.38, -0.33], [0.13, 0.39], [-0.13, -0.06], [0.38, 0.28], [0.06, -0.44],
  [-0.44, 0.06], [0.31, 0.07], [-0.19, 0.41], [0.19, -0.3], [-0.31, -0.19], [0.44, -0.41], [-0.03, 0.22], [0.03, 0.02],
];

interface Targets {
  pixels: WebGLRenderTarget;
  ghosts: WebGLRenderTarget;
  mask: WebGLRenderTarget;
  sum: WebGLRenderTarget;
}

function makeTargets(width: number, height: number): Targets {
  const depthTexture = new DepthTexture(width, height, UnsignedIntType);
  const plain = { minFilter: NearestFilter, magFilter: NearestFilter, format: RGBAFormat, type: UnsignedByteType, generateMipmaps: false } as const;
  return {
    pixels: new WebGLRenderTarget(width, height, { ...plain, count: 3, depthTexture }),
    // They share the depth, so that what is faint is covered by what is not.
    ghosts: new WebGLRenderTarget(width, height, { ...plain, depthTexture }),
    mask: new WebGLRenderTarget(width, height, { ...plain, depthBuffer: false }),
    sum: new WebGLRenderTarget(width, height, {
      ...plain, type: HalfFloatType, minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: false,
    }),
  };
}

function disposeTargets(targets: Targets): void {
  for (const target of Object.values(targets) as WebGLRenderTarget[]) target.dispose();
  targets.pixels.depthTexture?.dispose();
}

export function fullScreen(fragmentShader: string, uniforms: Uniforms, rest = {}): ShaderMaterial {
  return new ShaderMaterial({ glslVersion: GLSL3, vertexShader: FULL_VERTEX, fragmentShader, uniforms, ...rest });
}
