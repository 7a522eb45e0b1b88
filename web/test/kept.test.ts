import assert from "node:assert/strict";
import { test } from "node:test";
import { lineAgain, placeAgain } from "../src/kept.ts";
import { Focus } from "../src/network/focus.ts";
import { planOf } from "../src/network/plan.ts";
import { Store } from "../src/store.ts";
import type { Connection, Content, End, Line, Point, Unit } from "../src/types.ts";

const N = 8;
const all = <T>(value: T): T[] => Array.from({ length: N }, () => value);
const MESHES = { path: Array.from({ length: N }, (_, i) => `/Geo_${i}`), part: Array.from({ length: N }, (_, i) => i) };

function unit(id: string, parts: number[]): Unit {
  return {
    id, tag: id.toUpperCase(), type: "valve", kind: null, kind_guesses: [], handling: "", parts, system: 0, point: [0, 0, 0], size: [1, 1, 1],
    ports: [], missing: 0, facts: [],
  };
}

function end(id: string, point: Point, parts: number[], kind: End["kind"] = "open"): End {
  return { id, name: id, kind, point, parts, system: 0 };
}

function connection(source: string, target: string, via: number[], line: number): Connection {
  return {
    source, target, source_name: source, target_name: target, via, path: [], length: 1, size: 80, diameter: 0.08, flow: "unknown",
    reason: null, confidence: null, line,
  };
}

function line(tag: string, start: string, end: string, connections: number[]): Line {
  return { tag, start, end, size: "80", length: 1, flow: "unknown", connections, system: 0 };
}

function content(version: number, units: Unit[], ends: End[], connections: Connection[] = [], lines: Line[] = []): Content {
  return {
    version, title: "", origin: [0, 0, 0], groups: [], meshes: MESHES,
    parts: {
      id: all("p"), group: all(0), name: all(null), confidence: all(null), state: all("open" as const), source: all(null),
      unit: all(-1), cluster: all(-1), shape: all(0), ground: all(false), inside: all(-1), center: all(0), size: all(1), extents: all(1),
      n_triangles: all(1), area: all(1), volume: all(null), guesses: all([]), facts: all([]),
    },
    network: { units, ends, connections, lines, systems: [], clusters: [], joints: [] }, diagnostics: [],
  };
}

const BEFORE = content(
  1, [unit("v-1", [0]), unit("v-2", [1]), unit("v-3", [2])], [],
  [connection("v-1", "v-2", [3], 0), connection("v-2", "v-3", [4], 1)],
  [line("L-1", "v-1", "v-2", [0]), line("L-2", "v-2", "v-3", [1])],
);
/** The same with the lines, and the ids of the units, the other way round. */
const TURNED = content(
  2, [unit("v-1", [2]), unit("v-2", [1]), unit("v-3", [0])], [],
  [connection("v-1", "v-2", [4], 0), connection("v-2", "v-3", [3], 1)],
  [line("L-1", "v-1", "v-2", [0]), line("L-2", "v-2", "v-3", [1])],
);

test("the selected line stays the same line where the list is sorted anew", () => {
  const store = new Store();
  store.setContent(BEFORE);
  let plan = planOf(store.content!);
  const focus = new Focus(store, () => plan);
  focus.selectLine(0);
  store.setContent(TURNED);
  plan = planOf(store.content!);
  assert.equal(focus.keepLine(BEFORE), true);
  assert.equal(focus.selectedLine, 1);
  assert.deepEqual(store.shown.selection, [3]);
});

test("a line that is gone is not another one", () => {
  const cut = content(2, BEFORE.network.units, [], [connection("v-2", "v-3", [4], 0)], [line("L-1", "v-2", "v-3", [0])]);
  assert.equal(lineAgain(BEFORE, 0, cut), -1);
  const store = new Store();
  store.setContent(BEFORE);
  let plan = planOf(store.content!);
  const focus = new Focus(store, () => plan);
  focus.selectLine(0);
  store.setContent(cut);
  plan = planOf(store.content!);
  assert.equal(focus.keepLine(BEFORE), false);
  assert.deepEqual([focus.selectedLine, store.shown.selection], [-1, []]);
});

test("a line with another piece in it is the same one", () => {
  const longer = content(
    2, BEFORE.network.units, [end("j", [0, 0, 0], [6], "junction")],
    [connection("v-2", "v-3", [4], 0), connection("v-1", "j", [3], 1), connection("j", "v-2", [], 1)],
    [line("L-1", "v-2", "v-3", [0]), line("L-2", "v-1", "v-2", [1, 2])],
  );
  assert.equal(lineAgain(BEFORE, 0, longer), 1);
});

test("a unit is known by its parts, not by an id that is another's now", () => {
  assert.equal(placeAgain(BEFORE, "v-1", TURNED)?.id, "v-3");
  const merged = content(2, [unit("v-1", [1]), unit("v-2", [0, 2])], []);
  assert.equal(placeAgain(BEFORE, "v-3", merged)?.id, "v-2");
  assert.equal(placeAgain(BEFORE, "v-1", content(2, [unit("v-1", [5])], [])), null);
});

test("an end is the one in its place; of two ends of one pipe the other one is never taken for it", () => {
  const two = content(1, [], [end("e-0", [0, 0, 0], [0]), end("e-1", [1, 0, 0], [0]), end("e-2", [5, 0, 0], [])]);
  const one = content(2, [], [end("e-0", [1, 0, 0], [0]), end("e-1", [5, 0, 0], [])]);
  assert.equal(placeAgain(two, "e-0", one), null);
  assert.equal(placeAgain(two, "e-1", one)?.id, "e-0");
  assert.equal(placeAgain(two, "e-2", one)?.id, "e-1");
});

test("where what was selected is gone, nothing is selected, and it is said", () => {
  const store = new Store();
  const said: string[] = [];
  store.on("gone", (name) => said.push(name));
  store.setContent(content(1, [], [end("e-0", [0, 0, 0], [0]), end("e-1", [1, 0, 0], [0])]));
  store.selectPlace("e-0");
  store.setContent(content(2, [], [end("e-0", [1, 0, 0], [0])]));
  assert.deepEqual([store.shown.selection, store.shown.place, said], [[], null, ["e-0"]]);
});
