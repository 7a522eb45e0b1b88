// The network in 3D: one object for all lines, one for all arrows, one for all points.

import {
  BufferGeometry, Color, DoubleSide, DynamicDrawUsage, type Camera, Float32BufferAttribute, Group, InstancedBufferAttribute,
  InstancedBufferGeometry, Matrix4, Mesh, Points, ShaderMaterial, Vector2, Vector4, type WebGLRenderer,
} from "three";
import type { Section } from "../store.ts";
import { arrowsAlong, distance, piecesOf, wayOf } from "./path.ts";
import type { Plan } from "./plan.ts";
import {
  ARROW_FRAGMENT, ARROW_VERTEX, DOT_FRAGMENT, DOT_VERTEX, RIBBON_FRAGMENT, RIBBON_VERTEX,
} from "./shaders.ts";
import type { Palette, Rgb, Stroke } from "./style.ts";

const FAINT = 0.3; // how much of a line shows through what stands before it
const ARROWS = 0.35; // m, the least spacing of arrows
const MARGIN = 0.06; // m, that flanges and insulation stand out over a pipe
const LEAST_LEAD = 0.02; // m, a shorter way from a pipe's end to the middle of a unit isn't drawn

/** A piece of a line: which connection it belongs to, and whether it only leads on into a unit. */
interface Owner {
  row: number;
  lead: boolean;
}

export interface PointLook {
  color: Rgb;
  /** 0 leaves it out [CSS px]. */
  size: number;
}

export class Overlay {
  /** With the depth of the plant. */
  readonly front = new Group();
  /** Faint, over everything. */
  readonly through = new Group();
  private readonly uniforms = {
    uViewport: { value: new Vector2(1, 1) }, uScale: { value: 1 }, uTime: { value: -1 }, uCasing: { value: 1.4 },
    uCasingColor: { value: new Color(1, 1, 1) }, uPlane: { value: new Vector4(0, 0, 0, -1) },
  };
  private readonly ribbons = new InstancedBufferGeometry();
  private readonly arrows = new InstancedBufferGeometry();
  private readonly dots = new BufferGeometry();
  private owners: Owner[] = [];
  /** Beyond it is where its value is above 0, in the content's coordinates. */
  private readonly plane = new Vector4(0, 0, 0, -1);
  private arrowRows: number[] = [];
  /** Ids of the places of the dots, ports by the id of their unit. */
  private dotPlaces: string[] = [];

  constructor(heightOf: () => number) {
    quad(this.ribbons);
    triangle(this.arrows);
    const kinds: [BufferGeometry, string, string][] = [
      [this.ribbons, RIBBON_VERTEX, RIBBON_FRAGMENT], [this.arrows, ARROW_VERTEX, ARROW_FRAGMENT],
      [this.dots, DOT_VERTEX, DOT_FRAGMENT],
    ];
    for (const [group, faint] of [[this.through, FAINT], [this.front, 0]] as const) {
      kinds.forEach(([geometry, vertex, fragment], order) => {
        const material = this.material(vertex, fragment, faint);
        const object = geometry === this.dots ? new Points(geometry, material) : new Mesh(geometry, material);
        object.frustumCulled = false;
        object.renderOrder = 10 + order;
        object.raycast = () => {};
        object.onBeforeRender = (renderer, _scene, camera) => this.fit(renderer, camera, heightOf(), material);
        group.add(object);
      });
    }
  }

  /** Lays out the lines of a content anew. */
  setPlan(plan: Plan): void {
    this.layRibbons(plan);
    this.layArrows(plan);
    this.layDots(plan);
  }

  /** Colours what was laid out. */
  setStrokes(strokes: readonly Stroke[], points: (id: string, port: boolean) => PointLook, palette: Palette): void {
    this.uniforms.uCasingColor.value.setRGB(...palette.casing, "srgb");
    const color = this.ribbons.getAttribute("aColor");
    const look = this.ribbons.getAttribute("aLook");
    this.owners.forEach(({ row, lead }, i) => {
      const stroke = strokes[row];
      color.setXYZW(i, ...linear(stroke.color), stroke.shown ? (lead ? 0.9 : 1) : 0);
      const dash = stroke.dashed ? 1 : stroke.arrows ? 2 : 0;
      look.setXYZ(i, lead ? 0.5 * stroke.width : stroke.width, lead ? 0 : dash, stroke.strong ? 2 : lead || stroke.dim ? -1 : 1);
    });
    const arrowColor = this.arrows.getAttribute("aColor");
    const room = this.arrows.getAttribute("aRoom");
    this.arrowRows.forEach((row, i) => {
      const stroke = strokes[row];
      arrowColor.setXYZ(i, ...linear(stroke.color));
      room.setZ(i, stroke.shown && stroke.arrows ? (stroke.strong ? 1.3 : 1) : 0);
    });
    const dotColor = this.dots.getAttribute("aColor");
    const dot = this.dots.getAttribute("aDot");
    this.dotPlaces.forEach((id, i) => {
      const look_ = points(id, dot.getX(i) === 3);
      dotColor.setXYZ(i, ...linear(look_.color));
      dot.setY(i, look_.size);
    });
    for (const attribute of [color, look, arrowColor, room, dotColor, dot]) attribute.needsUpdate = true;
  }

  /** What lies beyond a section plane isn't drawn. */
  setSection(section: Section | null): void {
    const sign = section?.flipped ? -1 : 1;
    this.plane.set(0, 0, 0, section ? -sign * section.at : -1);
    if (section) this.plane.setComponent("xyz".indexOf(section.axis), sign);
  }

  /** How far the flow has moved; below 0 it stands still. */
  setTime(time: number): void {
    this.uniforms.uTime.value = time;
  }

  set visible(yes: boolean) {
    this.front.visible = yes;
    this.through.visible = yes;
  }

  private layRibbons(plan: Plan): void {
    const from: number[] = [];
    const to: number[] = [];
    const along: number[] = [];
    this.owners = [];
    const add = (a: readonly number[], b: readonly number[], start: number, end: number, pull: number, owner: Owner) => {
      from.push(...a);
      to.push(...b);
      along.push(start, end, pull);
      this.owners.push(owner);
    };
    plan.content.network.connections.forEach((connection, row) => {
      const way = wayOf(connection.path);
      const pull = pullOf(connection.diameter);
      const back = connection.flow === "backward";
      for (const piece of piecesOf(way)) {
        // From where the flow comes: the light that moves along runs that way.
        if (back) add(piece.to, piece.from, way.length - piece.end, way.length - piece.start, pull, { row, lead: false });
        else add(piece.from, piece.to, piece.start, piece.end, pull, { row, lead: false });
      }
      for (const [id, at] of [[connection.source, way.points[0]], [connection.target, way.points.at(-1)]] as const) {
        const place = plan.places.get(id);
        if (!at || !place?.unit || distance(at, place.point) < LEAST_LEAD) continue;
        add(at, place.point, 0, 1, pull, { row, lead: true });
      }
    });
    const n = this.owners.length;
    attributes(this.ribbons, n, { aFrom: [from, 3], aTo: [to, 3], aAlong: [along, 3], aColor: [null, 4], aLook: [null, 3] });
  }

  private layArrows(plan: Plan): void {
    const at: number[] = [];
    const direction: number[] = [];
    const room: number[] = [];
    this.arrowRows = [];
    plan.content.network.connections.forEach((connection, row) => {
      for (const arrow of arrowsAlong(wayOf(connection.path), connection.flow, ARROWS)) {
        at.push(...arrow.point);
        direction.push(...arrow.direction);
        room.push(arrow.room, pullOf(connection.diameter), 1);
        this.arrowRows.push(row);
      }
    });
    attributes(this.arrows, this.arrowRows.length, {
      aAt: [at, 3], aDirection: [direction, 3], aRoom: [room, 3], aColor: [null, 3],
    });
  }

  private layDots(plan: Plan): void {
    const at: number[] = [];
    const dot: number[] = [];
    this.dotPlaces = [];
    const forms: Record<string, number> = { junction: 0, open: 1, blind: 2, unknown: 1 };
    for (const place of plan.places.values()) {
      const pull = pullOf(widest(plan, place.connections));
      if (!place.unit) {
        at.push(...place.point);
        dot.push(forms[place.type] ?? 0, 1, pull);
        this.dotPlaces.push(place.id);
      }
      for (const port of place.unit?.ports ?? []) {
        at.push(...port.point);
        dot.push(3, 1, pullOf(port.diameter));
        this.dotPlaces.push(place.id);
      }
    }
    this.dots.dispose();
    this.dots.setAttribute("position", new Float32BufferAttribute(at, 3));
    this.dots.setAttribute("aDot", new Float32BufferAttribute(dot, 3));
    this.dots.setAttribute("aColor", new Float32BufferAttribute(new Float32Array(at.length), 3));
  }

  private material(vertexShader: string, fragmentShader: string, faint: number): ShaderMaterial {
    return new ShaderMaterial({
      vertexShader, fragmentShader, uniforms: { ...this.uniforms, uFaint: { value: faint } }, transparent: true,
      depthTest: faint === 0, depthWrite: false, toneMapped: false, side: DoubleSide,
    });
  }

  private fit(renderer: WebGLRenderer, camera: Camera, height: number, material: ShaderMaterial): void {
    const viewport = renderer.getCurrentViewport(scratch);
    this.uniforms.uViewport.value.set(viewport.z, viewport.w);
    this.uniforms.uScale.value = height > 0 ? viewport.w / height : 1;
    // Planes go from the world to the eye's coordinates by the inverse transposed of what points go by.
    this.uniforms.uPlane.value.copy(this.plane).applyMatrix4(turned.copy(camera.matrixWorld).transpose());
    material.uniformsNeedUpdate = true;
  }
}

const scratch = new Vector4();
const turned = new Matrix4();

function pullOf(diameter: number | null): number {
  return 0.75 * (diameter ?? 0.05) + MARGIN;
}

function widest(plan: Plan, rows: readonly number[]): number | null {
  const found = rows.map((row) => plan.content.network.connections[row].diameter ?? 0);
  return found.length ? Math.max(...found) : null;
}

const shade = new Color();

function linear(color: Rgb): [number, number, number] {
  shade.setRGB(...color, "srgb");
  return [shade.r, shade.g, shade.b];
}

function quad(geometry: InstancedBufferGeometry): void {
  geometry.setAttribute("position", new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.instanceCount = 0;
}

function triangle(geometry: InstancedBufferGeometry): void {
  geometry.setAttribute("position", new Float32BufferAttribute([1.5, 0, 0, -1.1, 1.25, 0, -1.1, -1.25, 0], 3));
  geometry.instanceCount = 0;
}

/** New attributes of n instances; those without values begin at 0. */
function attributes(
  geometry: InstancedBufferGeometry, n: number, columns: Record<string, [number[] | null, number]>,
): void {
  geometry.dispose();
  for (const [name, [values, width]] of Object.entries(columns)) {
    const array = values ? new Float32Array(values) : new Float32Array(n * width);
    const attribute = new InstancedBufferAttribute(array, width);
    if (!values) attribute.setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, attribute);
  }
  geometry.instanceCount = n;
}

