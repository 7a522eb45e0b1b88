// What a measurement is: the points that the cursor catches, and what lies between two of them.

import { Line3, Vector3 } from "three";

const CORNER = 10; // px
const EDGE = 8; // px
const PARALLEL = Math.cos((0.5 * Math.PI) / 180);

export interface Caught {
  point: Vector3;
  /** Of the face it lies on. */
  normal: Vector3;
  kind: "corner" | "edge" | "face";
}

export interface Measured {
  distance: number;
  /** Along the axes, unsigned [m]. */
  along: [number, number, number];
  /** Between the planes of two parallel faces [m]; null for others. */
  between: number | null;
}

type Project = (point: Vector3) => { x: number; y: number } | null;

/** What the cursor catches on the triangle under it: a corner, else an edge, else the point itself. */
export function catchPoint(
  hit: { point: Vector3; normal: Vector3; corners: readonly Vector3[] }, cursor: { x: number; y: number }, project: Project,
): Caught {
  const { corners, normal } = hit;
  const away = (point: Vector3) => {
    const at = project(point);
    return at ? Math.hypot(at.x - cursor.x, at.y - cursor.y) : Infinity;
  };
  const corner = nearest(corners, away);
  if (corner && away(corner) <= CORNER) return { point: corner.clone(), normal, kind: "corner" };
  const onEdges = corners.map((start, i) => (
    new Line3(start, corners[(i + 1) % corners.length]).closestPointToPoint(hit.point, true, new Vector3())
  ));
  const edge = nearest(onEdges, away);
  if (edge && away(edge) <= EDGE) return { point: edge, normal, kind: "edge" };
  return { point: hit.point.clone(), normal, kind: "face" };
}

function nearest(points: readonly Vector3[], away: (point: Vector3) => number): Vector3 | null {
  let best: Vector3 | null = null;
  for (const point of points) if (!best || away(point) < away(best)) best = point;
  return best;
}

export function measure(from: Caught, to: Caught): Measured {
  const way = new Vector3().subVectors(to.point, from.point);
  const parallel = Math.abs(from.normal.dot(to.normal)) > PARALLEL;
  return {
    distance: way.length(),
    along: [Math.abs(way.x), Math.abs(way.y), Math.abs(way.z)],
    between: parallel ? Math.abs(way.dot(from.normal)) : null,
  };
}

/** A length as engineers write it: millimetres below a metre; no finer than a tenth of one. */
export function lengthText(metres: number): string {
  if (metres < 0.9995) return `${trimmed((1000 * metres).toFixed(metres < 0.1 ? 1 : 0))} mm`;
  return `${metres.toFixed(metres < 100 ? 3 : 2)} m`;
}

function trimmed(number: string): string {
  return number.replace(/\.0$/, "");
}

/** A measurement in words: the distance, along the axes, between the faces. */
export function measuredText({ distance, along, between }: Measured): [string, string, string | null] {
  return [
    lengthText(distance),
    ["x", "y", "z"].map((axis, k) => `d${axis} ${lengthText(along[k])}`).join("   "),
    between === null || between < 5e-5 ? null : `parallel faces ${lengthText(between)} apart`,
  ];
}

/** The middle of a label that stands beside a line on the screen, above it rather than below, and covers nothing of it. */
export function besideLine(
  a: { x: number; y: number }, b: { x: number; y: number }, label: { width: number; height: number },
): { x: number; y: number } {
  const long = Math.hypot(b.x - a.x, b.y - a.y);
  const side = b.x < a.x ? -1 : 1;
  const normal = long < 1 ? { x: 0, y: -1 } : { x: (side * (b.y - a.y)) / long, y: (-side * (b.x - a.x)) / long };
  const away = (Math.abs(normal.x) * label.width + Math.abs(normal.y) * label.height) / 2 + 8;
  return { x: (a.x + b.x) / 2 + normal.x * away, y: (a.y + b.y) / 2 + normal.y * away };
}

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

const GAP = 4; // px between labels
const MOST_STEPS = 12;

/** Where a label goes (its middle) so that it covers none that is placed already: as near above or below its place as there is room. */
export function besideOthers(at: { x: number; y: number }, size: { width: number; height: number }, taken: readonly Box[]): Box {
  const tried = (y: number): Box => ({ x: at.x, y, ...size });
  const covered = (box: Box) => taken.filter((other) =>
    Math.abs(box.x - other.x) < (box.width + other.width) / 2 && Math.abs(box.y - other.y) < (box.height + other.height) / 2 + GAP - 1);
  let best: Box | null = null;
  for (const way of [-1, 1]) {
    let box = tried(at.y);
    let under = covered(box);
    for (let step = 0; step < MOST_STEPS && under.length; step++) {
      const edges = under.map((other) => way * other.y + other.height / 2);
      box = tried(way * (Math.max(...edges) + size.height / 2 + GAP));
      under = covered(box);
    }
    if (!under.length && (!best || Math.abs(box.y - at.y) < Math.abs(best.y - at.y))) best = box;
  }
  return best ?? tried(at.y);
}
