import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, PerspectiveCamera, Scene, ShaderMaterial, Vector3 } from "three";
import { decodeChunk, decodeNormal } from "../src/scene/chunk.ts";
import { colorParts, distinct } from "../src/scene/colors.ts";
import { Culling } from "../src/scene/culling.ts";
import { Loader, worthOf } from "../src/scene/loader.ts";
import type { Pipeline } from "../src/scene/pipeline.ts";
import { Navigation } from "../src/scene/navigation.ts";
import { Pace } from "../src/scene/pace.ts";
import { Plant } from "../src/scene/plant.ts";
import { clearWay } from "../src/scene/sightline.ts";
import type { Source } from "../src/api.ts";
import type { Content, Manifest, Point } from "../src/types.ts";

/** A chunk with one triangle, as the packer writes it. */
function chunkOf(shape = 3, level = 1): ArrayBuffer {
  const bytes = new ArrayBuffer(8 + 48 + 20 + 8 + 8);
  const view = new DataView(bytes);
  [0x43474348, 1, shape, level, 3, 3, 56, 0].forEach((value, i) => view.setUint32(4 * i, value, true));
  [-1, 0, 2, 0.5, 0.25, 1].forEach((value, i) => view.setFloat32(32 + 4 * i, value, true));
  [0, 0, 0, 4, 0, 0, 0, 8, 0].forEach((value, i) => view.setUint16(56 + 2 * i, value, true));
  [0, 0, 127, 0, 0, -127].forEach((value, i) => view.setInt8(76 + i, value));
  [0, 1, 2].forEach((value, i) => view.setUint16(84 + 2 * i, value, true));
  return bytes;
}

test("a chunk gives its shapes, on their grid", () => {
  const [form] = decodeChunk(chunkOf());
  assert.equal(form.shape, 3);
  assert.equal(form.level, 1);
  assert.deepEqual([...form.positions], [0, 0, 0, 4, 0, 0, 0, 8, 0]);
  assert.deepEqual([...form.indices], [0, 1, 2]);
  assert.deepEqual([form.low, form.step], [[-1, 0, 2], [0.5, 0.25, 1]]);
});

test("what is no chunk, or cut off, is refused", () => {
  assert.throws(() => decodeChunk(new ArrayBuffer(4)), /no chunk/);
  assert.throws(() => decodeChunk(new ArrayBuffer(64)), /no chunk/);
  assert.throws(() => decodeChunk(chunkOf().slice(0, 80)), /cut off/);
});

test("normals come back from their octahedral form", () => {
  for (const [a, b, x, y, z] of [[0, 0, 0, 0, 1], [127, 0, 1, 0, 0], [0, -127, 0, -1, 0], [127, 127, 0, 0, -1]]) {
    const found = decodeNormal(a, b);
    [x, y, z].forEach((value, k) => assert.ok(Math.abs(found[k] - value) < 1e-9, `${found}`));
  }
});

const parts = {
  id: ["part-0", "part-1", "part-2"], group: [0, 1, -1], name: ["Pipe", "Bolt", null], confidence: [0.99, 0.6, null],
  state: ["sure", "likely", "open"], source: ["embedded", "human", null], unit: [-1, 0, -1], cluster: [0, 0, -1],
  ground: [false, false, false],
};
const content = {
  groups: [{ name: "Pipe assembly", color: "#8a45e6" }, { name: "Connection assembly", color: "#0f7f7c" }],
  meshes: { path: ["/a", "/b", "/c"], part: [0, 1, 2] }, parts,
  network: { units: [{ id: "unit-0", tag: "V-001", system: -1, parts: [1] }], systems: [], connections: [], lines: [], clusters: [{ id: "cluster-0" }] },
} as unknown as Content;

test("colours are those of the groups, and what nobody is sure of is hatched", () => {
  const coloring = colorParts(content, "group");
  assert.deepEqual(coloring.entries.map((entry) => [entry.label, entry.color, entry.parts.length]).slice(0, 2),
    [["Connection assembly", "#0f7f7c", 1], ["Pipe assembly", "#8a45e6", 1]]);
  assert.deepEqual([...coloring.hatched], [0, 1, 1]);
  assert.equal(coloring.entries.at(-1)!.label, "No label");
});

test("the legend of each kind names every part once", () => {
  for (const by of ["group", "name", "unit", "system", "cluster", "confidence", "source"] as const) {
    const rows = colorParts(content, by).entries.flatMap((entry) => entry.parts).sort();
    assert.deepEqual(rows, [0, 1, 2], by);
  }
  assert.equal(colorParts(content, "original").entries.length, 0);
});

test("the first distinct colours differ", () => {
  assert.equal(new Set(Array.from({ length: 24 }, (_, i) => distinct(i))).size, 24);
});

test("a mesh stands where its quaternion and shift put it", () => {
  const bytes = new ArrayBuffer(3 * 36);
  const view = new DataView(bytes);
  const half = Math.SQRT1_2;
  for (let i = 0; i < 3; i++) {
    view.setUint32(36 * i, i === 2 ? 0xffffffff : 0, true);
    [0, 0, half, half, 10, 20, 30].forEach((value, k) => view.setFloat32(36 * i + 8 + 4 * k, value, true));
  }
  const manifest = { n_meshes: 3, n_shapes: 1 } as Manifest;
  const plant = new Plant(manifest, bytes, content);
  const at = new Vector3(1, 0, 0).applyMatrix4(plant.matrixOf(0, new Matrix4()));
  assert.ok(at.distanceTo(new Vector3(10, 21, 30)) < 1e-5);
  assert.deepEqual([...plant.meshesOfShape.of(0)], [0, 1]);
  assert.equal(plant.shapeOf[2], -1);
  plant.setBounds(0, [0, 0, 0], [2, 0, 0]);
  assert.deepEqual([...plant.center.subarray(0, 3)].map((v) => Math.round(v * 1e4) / 1e4), [10, 21, 30]);
  assert.equal(plant.radius[2], 0);
});

test("chunks near the eye come first", () => {
  const near = { low: [0, 0, 0] as Point, high: [1, 1, 1] as Point };
  const far = { low: [50, 0, 0] as Point, high: [51, 1, 1] as Point };
  assert.ok(worthOf(near, [2, 0, 0]) > worthOf(far, [2, 0, 0]));
});

test("a plant is looked at from where nothing stands before it", () => {
  const boxes = { center: [0, 0, 0, 5, 0, 0], size: [1, 1, 1, 1, 4, 4] };
  const from = (row: number) => clearWay([0, 0, 0], 12, [1, 0, 0], boxes, new Set([row]), () => true);
  assert.ok(from(0)[0] < 0.9, "not through the wall");
  const hidden = clearWay([0, 0, 0], 12, [1, 0, 0], boxes, new Set([0]), (row) => row !== 1);
  assert.deepEqual(hidden, [1, 0, 0]);
});

test("a fit shows all corners, in the middle", () => {
  const navigation = new Navigation(() => {});
  navigation.setBounds({ center: [0, 0, 0], radius: 20 });
  navigation.setAspect(16 / 9);
  const points = new Float32Array([-8, -1, 0, 8, -1, 0, -8, 1, 0, 8, 1, 3]);
  navigation.set({ eye: [3, -9, 4], target: [0, 0, 0], orthographic: false });
  const { target, distance } = navigation.fit(points, new Vector3(0.3, -0.8, 0.4).normalize(), 1);
  const eye = target.clone().addScaledVector(new Vector3(0.3, -0.8, 0.4).normalize(), distance);
  navigation.set({ eye: eye.toArray(), target: target.toArray(), orthographic: false });
  const camera = navigation.camera as PerspectiveCamera;
  const seen = [0, 3, 6, 9].map((i) => new Vector3().fromArray(points, i).project(camera));
  const most = Math.max(...seen.flatMap((p) => [Math.abs(p.x), Math.abs(p.y)]));
  assert.ok(most <= 1.02 && most > 0.9, `${most}`);
});

test("frames that take long make less to draw, quick ones more", () => {
  const pace = new Pace(false);
  const before = pace.budget;
  for (let i = 1; i < 20; i++) pace.frame(200 * i, true);
  assert.ok(pace.budget < before / 3);
  const slow = pace.budget;
  for (let i = 1; i < 60; i++) pace.frame(4000 + 10 * i, true);
  assert.ok(pace.budget > slow);
});

test("pictures that take long are averaged of fewer", () => {
  const pace = new Pace(true);
  assert.equal(pace.samples, 4);
  for (let i = 1; i < 8; i++) pace.frame(700 * i, false);
  assert.equal(pace.samples, 2);
});

test("full forms stay within the memory, those near the eye first, and give way when the eye moves", async () => {
  const chunks = [0, 1, 2, 3].map((k) => ({
    file: `full-${k}`, bytes: 110, level: 0 as const, n_shapes: 1, low: [100 * k, 0, 0] as Point, high: [100 * k + 1, 1, 1] as Point,
  }));
  const manifest = { n_meshes: 4, n_shapes: 4, chunks } as unknown as Manifest;
  const instances = new ArrayBuffer(4 * 36);
  for (let i = 0; i < 4; i++) {
    new DataView(instances).setUint32(36 * i, i, true);
    new DataView(instances).setFloat32(36 * i + 20, 1, true);
  }
  const plant = new Plant(manifest, instances, content);
  const pipeline = { plant: new Scene(), material: new ShaderMaterial() } as unknown as Pipeline;
  const source = { file: async (name: string) => chunkOf(Number(name.at(-1)), 0) } as unknown as Source;
  const loader = new Loader(source, manifest, plant, new Culling(plant), pipeline, () => {}, 500);
  await loader.loadCoarse();
  const shown = () => pipeline.plant.children.length;
  await loader.fill([0, 0, 0]);
  assert.ok(shown() >= 1 && shown() < 4, `${shown()}`);
  assert.ok(loader.bytes <= 500);
  assert.ok(plant.radius[0] > 0 && plant.radius[3] === 0);
  await loader.fill([300, 0, 0]);
  assert.ok(plant.radius[3] > 0, "what is near now has come");
  assert.ok(loader.bytes <= 500);
});
