import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { fullOffsets, offsetsAt } from "../src/scene/explode.ts";
import { besideLine, besideOthers, catchPoint, lengthText, measure, measuredText } from "../src/scene/measure.ts";
import { boundsOf, sectionAcross } from "../src/scene/section.ts";
import type { Content, Point, Unit } from "../src/types.ts";

interface Box {
  name?: string;
  center: Point;
  size: Point;
  shape?: number;
}

function unitOf(boxes: Box[], ports: Unit["ports"] = []): { content: Content; unit: Unit } {
  const parts = {
    id: boxes.map((_, row) => `p${row}`), name: boxes.map((box) => box.name ?? "part"), center: boxes.flatMap((box) => box.center),
    size: boxes.flatMap((box) => box.size), extents: boxes.flatMap((box) => [...box.size].sort((a, b) => b - a)),
    shape: boxes.map((box, row) => box.shape ?? 100 + row),
  };
  return { content: { parts } as unknown as Content, unit: { parts: [...boxes.keys()], ports } as unknown as Unit };
}

const VALVE: Box[] = [
  { name: "valve body", center: [0, 0, 0], size: [0.3, 0.2, 0.2] },
  { name: "valve bonnet", center: [0, 0, 0.12], size: [0.1, 0.1, 0.1] },
  { name: "handwheel", center: [0, 0, 0.2], size: [0.2, 0.2, 0.03] },
  { name: "flange", center: [-0.16, 0, 0], size: [0.02, 0.2, 0.2], shape: 7 },
  { name: "flange", center: [0.16, 0, 0], size: [0.02, 0.2, 0.2], shape: 7 },
  { name: "bolt", center: [0.17, 0.08, 0], size: [0.06, 0.01, 0.01], shape: 8 },
  { name: "bolt", center: [0.17, -0.08, 0], size: [0.06, 0.01, 0.01], shape: 8 },
];

test("parts of a unit drawn apart follow one another on its axes without covering each other", () => {
  const { content, unit } = unitOf(VALVE);
  const offsets = fullOffsets(content, unit);
  const moved = (row: number) => new Vector3(...VALVE[row].center).add(offsets.get(row) ?? new Vector3());
  assert.ok(moved(2).z - 0.015 > moved(1).z + 0.05, "handwheel above bonnet");
  assert.ok(moved(1).z - 0.05 > moved(0).z + 0.1, "bonnet above body");
  assert.ok(moved(4).x - 0.01 > 0.15 && moved(3).x + 0.01 < -0.15, "flanges off the body");
  assert.ok(moved(5).x > moved(4).x, "bolts outside their flange");
});

test("bolts of one ring move together along their own axis", () => {
  const { content, unit } = unitOf(VALVE);
  const offsets = fullOffsets(content, unit);
  assert.deepEqual(offsets.get(5)!.toArray(), offsets.get(6)!.toArray());
  assert.ok(offsets.get(5)!.x > 0 && offsets.get(5)!.y === 0 && offsets.get(5)!.z === 0);
});

test("a unit drawn apart moves by its share and comes together again", () => {
  const { content, unit } = unitOf(VALVE);
  const full = fullOffsets(content, unit);
  assert.equal(offsetsAt(full, 0).size, 0);
  const [half, whole] = [offsetsAt(full, 0.5), offsetsAt(full, 1)];
  for (const [row, way] of whole) assert.ok(half.get(row)!.multiplyScalar(2).distanceTo(way) < 1e-12);
});

test("what lies on no axis moves outwards, and nothing goes far away", () => {
  const boxes: Box[] = [{ center: [0, 0, 0], size: [1, 1, 1] }, { center: [0.4, 0.4, 0.4], size: [0.1, 0.1, 0.1] }];
  for (let i = 0; i < 40; i++) boxes.push({ center: [0, 0, 0.5 + 0.001 * i], size: [0.2, 0.2, 0.2] });
  const { content, unit } = unitOf(boxes);
  const offsets = fullOffsets(content, unit);
  assert.ok(offsets.get(1)!.dot(new Vector3(1, 1, 1)) > 0);
  for (const way of offsets.values()) assert.ok(way.length() < 3.5 && way.toArray().every(Number.isFinite));
});

test("a unit that stands askew is drawn apart along its port", () => {
  const way: Point = [Math.SQRT1_2, Math.SQRT1_2, 0];
  const { content, unit } = unitOf(
    [{ center: [-0.5, -0.5, 0], size: [0.1, 0.1, 0.1] }, { center: [0, 0, 0], size: [0.1, 0.1, 0.1] }, { center: [0.5, 0.5, 0], size: [0.1, 0.1, 0.1] }],
    [{ name: "N1", point: [0, 0, 0], direction: way, diameter: null }],
  );
  const moved = fullOffsets(content, unit).get(2)!.clone().normalize();
  assert.ok(moved.distanceTo(new Vector3(...way)) < 1e-9);
});

test("one part alone and parts in one point stay", () => {
  const one = unitOf([VALVE[0]]);
  assert.equal(fullOffsets(one.content, one.unit).size, 0);
  const same = unitOf([{ center: [1, 1, 1], size: [0, 0, 0] }, { center: [1, 1, 1], size: [0, 0, 0] }]);
  assert.equal(fullOffsets(same.content, same.unit).size, 0);
});

const TRIANGLE = [new Vector3(0, 0, 0), new Vector3(100, 0, 0), new Vector3(0, 100, 0)];
const UP = new Vector3(0, 0, 1);
/** One metre is one pixel. */
const flat = (point: Vector3) => ({ x: point.x, y: point.y });

function caught(x: number, y: number) {
  return catchPoint({ point: new Vector3(x, y, 0), normal: UP, corners: TRIANGLE }, { x, y }, flat);
}

test("the cursor catches a corner before an edge before the face", () => {
  assert.deepEqual([caught(6, 7).kind, caught(6, 7).point.toArray()], ["corner", [0, 0, 0]]);
  assert.deepEqual([caught(40, 7.9).kind, caught(40, 7.9).point.toArray()], ["edge", [40, 0, 0]]);
  assert.deepEqual([caught(30, 30).kind, caught(30, 30).point.toArray()], ["face", [30, 30, 0]]);
});

test("corners behind the eye are not caught", () => {
  const behind = catchPoint({ point: new Vector3(1, 1, 0), normal: UP, corners: TRIANGLE }, { x: 1, y: 1 }, () => null);
  assert.equal(behind.kind, "face");
});

test("a measurement tells the distance, along the axes, and between parallel faces", () => {
  const from = { point: new Vector3(0, 0, 0), normal: UP, kind: "face" as const };
  const to = { point: new Vector3(3, -4, 0.12), normal: UP.clone().negate(), kind: "face" as const };
  const measured = measure(from, to);
  assert.ok(Math.abs(measured.distance - Math.hypot(3, 4, 0.12)) < 1e-12);
  assert.deepEqual(measured.along, [3, 4, 0.12]);
  assert.equal(measured.between, 0.12);
  assert.deepEqual(measuredText(measured), ["5.001 m", "dx 3.000 m   dy 4.000 m   dz 120 mm", "parallel faces 120 mm apart"]);
  assert.equal(measure(from, { ...to, normal: new Vector3(1, 0, 0) }).between, null);
  assert.equal(measuredText(measure(from, { ...to, point: new Vector3(1, 0, 0) }))[2], null, "one plane");
});

test("lengths are written in the unit that reads best", () => {
  assert.deepEqual([0, 0.00634, 0.05, 0.9994, 0.9996, 12.3456, 123.456].map(lengthText),
    ["0 mm", "6.3 mm", "50 mm", "999 mm", "1.000 m", "12.346 m", "123.46 m"]);
});

test("a label beside a line covers nothing of it and stands above", () => {
  const label = { width: 100, height: 40 };
  assert.deepEqual(besideLine({ x: 0, y: 50 }, { x: 200, y: 50 }, label), { x: 100, y: 22 });
  assert.deepEqual(besideLine({ x: 200, y: 50 }, { x: 0, y: 50 }, label), { x: 100, y: 22 });
  assert.equal(Math.abs(besideLine({ x: 10, y: 0 }, { x: 10, y: 80 }, label).x - 10), 58);
  assert.deepEqual(besideLine({ x: 5, y: 5 }, { x: 5, y: 5 }, label), { x: 5, y: -23 });
});

test("the section goes from end to end of the plant, or of the parts that are named", () => {
  const { content } = unitOf(VALVE);
  assert.deepEqual(boundsOf(content, [0]), { low: [-0.15, -0.1, -0.1], high: [0.15, 0.1, 0.1] });
  assert.ok(Math.abs(boundsOf(content)!.high[2] - 0.215) < 1e-12);
  assert.equal(boundsOf(content, []), null);
});

test("a section takes away the half of the plant that is before the eye", () => {
  const { content } = unitOf(VALVE);
  assert.deepEqual(sectionAcross("x", content, [0], [-5, 0, 0]), { axis: "x", at: 0, flipped: true });
  assert.deepEqual(sectionAcross("z", content, [0], [-5, 0, 3]), { axis: "z", at: 0, flipped: false });
  assert.equal(sectionAcross("z", unitOf([]).content, [], [0, 0, 0]), null);
});

test("labels of several measurements cover none of those before them", () => {
  const size = { width: 80, height: 40 };
  const taken: ReturnType<typeof besideOthers>[] = [];
  for (let i = 0; i < 6; i++) taken.push(besideOthers({ x: 200 + 5 * i, y: 150 }, size, taken));
  taken.forEach((a, i) => taken.slice(0, i).forEach((b) =>
    assert.ok(Math.abs(a.x - b.x) >= 80 || Math.abs(a.y - b.y) >= 40, `${JSON.stringify(a)} over ${JSON.stringify(b)}`)));
  assert.deepEqual(besideOthers({ x: 400, y: 150 }, size, taken), { x: 400, y: 150, ...size });
  assert.ok(Math.abs(taken[1].y - 150) < 50, "as near as there is room");
});
