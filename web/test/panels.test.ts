import assert from "node:assert/strict";
import { test } from "node:test";
import { carry } from "../src/panels/carry.ts";
import { csv } from "../src/panels/csv.ts";
import { decode, encode, packRows, unpackRows } from "../src/panels/link.ts";
import { matching } from "../src/panels/picker.ts";
import { namesIn } from "../src/panels/mentions.ts";
import { narrower } from "../src/panels/narrow.ts";
import { Queue, type Choice, type Sent } from "../src/panels/queue.ts";
import { Index, understand } from "../src/panels/search.ts";
import { elapsed, finding, length, moment, percent, volume, whole } from "../src/panels/words.ts";
import { listed, type Wish } from "../src/panels/rows.ts";
import { START, Store, type Shown } from "../src/store.ts";
import type { Content, Question } from "../src/types.ts";

function plant(n = 4): Content {
  const all = <T>(value: T): T[] => Array.from({ length: n }, () => value);
  return {
    version: 1, title: "plant.usd", origin: [0, 0, 0],
    groups: [
      { name: "Pipe assembly", color: "#8040e0", unit: null, names: ["pipe", "flange"] },
      { name: "Valve assembly", color: "#2080f0", unit: "valve", names: ["valve body", "handwheel"] },
    ],
    meshes: { path: Array.from({ length: n }, (_, i) => `/World/Geo_${i}`), part: Array.from({ length: n }, (_, i) => i) },
    parts: {
      id: Array.from({ length: n }, (_, i) => `part-${String(i).padStart(5, "0")}`), group: all(0), name: all<string | null>("pipe"),
      confidence: all<number | null>(0.9), state: all<"sure">("sure"), source: all<string | null>("geometry"), unit: all(-1),
      cluster: all(0), shape: all(0), ground: all(false), inside: all(-1), center: all(0).concat(all(0), all(0)),
      size: all(1).concat(all(1), all(1)), extents: all(1).concat(all(1), all(1)), n_triangles: all(12), area: all(1),
      volume: all<number | null>(1), guesses: all([]), facts: all([]),
    },
    network: {
      units: [{ id: "unit-1", tag: "V-4711", type: "valve", kind: "gate valve", kind_guesses: [], handling: "", parts: [1], system: 0,
        point: [0, 0, 0], size: [0.2, 0.2, 0.4], ports: [], missing: 0, facts: [] }],
      ends: [], connections: [{ source: "unit-1", target: "x", source_name: "V-4711", target_name: "x", via: [2], path: [],
        length: 1, size: 80, diameter: 0.08, flow: "unknown", reason: null, confidence: null, line: 0 }],
      lines: [{ tag: "L-0080", start: "unit-1", end: "x", size: "80", length: 1, flow: "none", connections: [0], system: 0 }],
      systems: [], clusters: [], joints: [],
    },
    diagnostics: [],
  };
}

test("a link brings back what was shown", () => {
  const shown: Shown = {
    ...START, camera: { eye: [1.2342, -2, 3], target: [0, 0, 0.5], orthographic: true }, place: null, selection: [3, 1],
    colorBy: "confidence", hidden: new Set([0, 2]), isolated: new Set([1, 2, 3]), ghost: false,
    section: { axis: "y", at: -0.25, flipped: true }, leftTab: "review",
  };
  const { fragment, left } = encode(shown);
  const back = decode(`#${fragment}`, plant());
  assert.equal(left, "");
  assert.deepEqual(back.camera, { eye: [1.234, -2, 3], target: [0, 0, 0.5], orthographic: true });
  assert.deepEqual(back.selection, [1, 3]);
  assert.deepEqual([...back.hidden!], [0, 2]);
  assert.deepEqual([...back.isolated!], [1, 2, 3]);
  assert.deepEqual(back.section, shown.section);
  assert.deepEqual([back.colorBy, back.leftTab, back.ghost], ["confidence", "review", false]);
});

test("rows that don't fit a link are left out and named", () => {
  const hidden = new Set(Array.from({ length: 5000 }, (_, i) => 2 * i));
  const { fragment, left } = encode({ ...START, hidden, selection: [7] });
  assert.ok(fragment.length < 2000);
  assert.equal(left, "which parts are hidden");
  assert.deepEqual(decode(fragment, plant(10)).selection, [7]);
});

test("runs of rows pack to a few letters, and broken ones are left out", () => {
  const run = Array.from({ length: 9000 }, (_, i) => i + 5);
  assert.ok(packRows(run).length < 10);
  assert.deepEqual(unpackRows(packRows([9, 3, 4, 5]), 10), [3, 4, 5, 9]);
  assert.deepEqual(unpackRows("zz-zzzzzzzz.<img>.3", 5), []);
  assert.equal(decode("at=1,2&by=evil&cut=q1&place=nowhere&part=%00", plant()).place, null);
});

test("a place in a link selects its parts", () => {
  const back = decode("place=unit-1", plant());
  assert.deepEqual([back.place, back.selection], ["unit-1", [1]]);
});

test("search finds by tag, label, path, size and length", () => {
  const content = plant();
  content.parts.name[3] = "flange";
  content.parts.unit[1] = 0;
  content.parts.extents[6] = 0.35;
  const index = new Index(content);
  assert.deepEqual(index.find("v-47").units, [0]);
  assert.deepEqual(index.find("v-47").parts, [1]);
  assert.deepEqual(index.find("flan").parts, [3]);
  assert.deepEqual(index.find("geo_2").parts, [2]);
  assert.deepEqual(index.find("DN 80").parts, [2]);
  assert.deepEqual(index.find("DN80").lines, [0]);
  assert.deepEqual(index.find("350mm").parts, [2]);
  assert.deepEqual(index.find("pipe part-00002").parts, [2]);
  assert.equal(index.find("  ").totals.parts, 0);
  assert.deepEqual(understand("0,5 m valve").words, ["valve"]);
});

test("search over 100,000 parts is instant", () => {
  const index = new Index(plant(100_000));
  index.find("warm up");
  const start = performance.now();
  const found = index.find("pipe geo_9999");
  assert.ok(performance.now() - start < 250);
  assert.equal(found.totals.parts, 11);
});

test("a table as CSV is quoted and holds no formulas", () => {
  const text = csv(["tag", "n"], [['=HYPERLINK("x")', -5], ["@a,b", 1.5], ["-", null], ["line\nbreak", Number.NaN]]);
  assert.equal(text, 'tag,n\r\n"\'=HYPERLINK(""x"")",-5\r\n"\'@a,b",1.5\r\n\'-,\r\n"line\nbreak",\r\n');
});

test("numbers are said as a person would", () => {
  assert.deepEqual([percent(0.412), percent(0.9996), percent(1), percent(0.001), percent(null)], ["41 %", "over 99 %", "100 %", "below 1 %", "not known"]);
  assert.deepEqual([length(0.0032), length(0.25), length(1.5), length(12.345)], ["3.2 mm", "250 mm", "1.50 m", "12.3 m"]);
  assert.deepEqual([volume(0.0002), volume(0.5), volume(null)], ["200 cm³", "500.0 l", "not known (its surface is open)"]);
  assert.deepEqual([whole(1234567), whole(12), elapsed(125)], ["1,234,567", "12", "2 min 05 s"]);
  assert.equal(finding("unit-short-of-lines"), "Units with missing lines");
  assert.equal(finding("something-new"), "Something new");
  const now = new Date("2026-03-04T12:00:00Z");
  assert.equal(moment("2026-03-04T11:55:00Z", now), "5 min ago");
  assert.equal(moment("", now), "earlier");
});

function question(id: string, parts: number[], alike: number[] = []): Question {
  const options = ["a", "b"].map((text) => ({ text, confidence: null, edits: [] }));
  return { id, kind: "label", title: "What is this?", why: "", parts, alike, gain: 1, options };
}

/** A server with a list; it answers when told to. */
class Server {
  list: Question[];
  sent: [string, Choice][] = [];
  version = 1;
  refuse = false;
  taken: number[] = [];
  constructor(...list: Question[]) {
    this.list = list;
  }
  load = async () => [...this.list];
  send = async (asked: Question, choice: Choice): Promise<Sent> => {
    await Promise.resolve();
    if (this.refuse) return { ok: false, version: null };
    this.sent.push([asked.id, choice]);
    this.list = this.list.filter((other) => other.id !== asked.id);
    return { ok: true, version: choice === "skip" || choice === "unsure" ? null : ++this.version };
  };
  takeBack = async (version: number) => {
    this.taken.push(version);
    return version === this.version ? ++this.version : null;
  };
}

test("the next question is shown before the server has answered, in order", async () => {
  const server = new Server(question("a", [0]), question("b", [1]), question("c", [2]));
  const queue = new Queue(server, () => {});
  await queue.load();
  const first = queue.answer(1);
  assert.equal(queue.current!.id, "b");
  const second = queue.answer("skip");
  assert.equal(queue.current!.id, "c");
  await Promise.all([first, second]);
  assert.deepEqual(server.sent, [["a", 1], ["b", "skip"]]);
  assert.equal(queue.decided, 1);
  await queue.answer(7);
  assert.equal(queue.current!.id, "c");
});

test("a refused answer brings its question back", async () => {
  const server = new Server(question("a", [0]), question("b", [1]));
  const queue = new Queue(server, () => {});
  await queue.load();
  server.refuse = true;
  const done = queue.answer(0);
  assert.equal(queue.current!.id, "b");
  await done;
  assert.equal(queue.current!.id, "a");
  assert.equal(queue.past.length, 0);
});

test("an answer to a shape settles the other questions about it", async () => {
  const server = new Server(question("a", [0], [1, 2]), question("b", [1]), question("c", [3]));
  const queue = new Queue(server, () => {});
  await queue.load();
  const done = queue.answer(0);
  assert.equal(queue.current!.id, "c");
  await done;
});

test("back takes the last correction back and shows its question again", async () => {
  const server = new Server(question("a", [0]), question("b", [1]));
  const queue = new Queue(server, () => {});
  await queue.load();
  await queue.answer(0);
  assert.ok(await queue.back());
  assert.deepEqual(server.taken, [2]);
  assert.equal(queue.current!.id, "a");
  await queue.answer("skip");
  assert.ok(await queue.back());
  assert.equal(server.taken.length, 1);
  await queue.answer(1);
  server.version++;
  assert.ok(!(await queue.back()));
  assert.equal(queue.past.length, 1);
});

test("back takes one correction after the other back", async () => {
  const server = new Server(question("a", [0]), question("b", [1]), question("c", [2]));
  const queue = new Queue(server, () => {});
  await queue.load();
  await queue.answer(0);
  await queue.answer("skip");
  await queue.answer(0);
  assert.deepEqual([await queue.back(), await queue.back(), await queue.back()], [true, true, true]);
  assert.equal(queue.past.length, 0);
  assert.equal(queue.current!.id, "a");
});

test("back stops at what something else came after", async () => {
  const server = new Server(question("a", [0]), question("b", [1]));
  const queue = new Queue(server, () => {});
  await queue.load();
  await queue.answer(0);
  server.version++;
  await queue.answer(0);
  assert.ok(await queue.back());
  assert.ok(!(await queue.back()));
  assert.equal(queue.past.length, 1);
});

test("the question shown stays while the list is asked for anew", async () => {
  const server = new Server(question("a", [0]), question("b", [1]));
  const queue = new Queue(server, () => {});
  await queue.load();
  server.list = [question("z", [5]), ...server.list];
  await queue.load();
  assert.deepEqual(queue.waiting.map((q) => q.id), ["a", "z", "b"]);
});

test("a list asked for before an answer is not shown, and what was skipped may come again", async () => {
  const server = new Server(question("a", [0]));
  const queue = new Queue(server, () => {});
  await queue.load();
  const stale = queue.load();
  server.send = async () => ({ ok: true, version: null });
  await Promise.all([stale, queue.answer("skip")]);
  await queue.load();
  assert.equal(queue.current!.id, "a");
});

test("the table lists what is seen, sorted, empty cells last", () => {
  const content = plant();
  content.parts.name = ["pipe", null, "Flange", "elbow"];
  content.parts.confidence = [0.5, null, 0.9, 0.1];
  content.parts.center = [0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0];
  const wish: Wish = { kind: "parts", scope: "all", text: "", sort: "name", descending: false };
  assert.deepEqual(listed(content, START, wish), [3, 2, 0, 1]);
  assert.deepEqual(listed(content, START, { ...wish, descending: true }), [0, 2, 3, 1]);
  assert.deepEqual(listed(content, START, { ...wish, sort: "confidence" }), [3, 0, 2, 1]);
  assert.deepEqual(listed(content, START, { ...wish, text: "flan geo_2" }), [2]);
  const seen = { ...wish, scope: "seen" as const, sort: null };
  const section = { axis: "z" as const, at: 1, flipped: false };
  assert.deepEqual(listed(content, { ...START, hidden: new Set([0]), section }, seen), [1, 3]);
  assert.deepEqual(listed(content, { ...START, isolated: new Set([2]) }, seen), [2]);
  assert.deepEqual(listed(content, { ...START, selection: [1] }, { ...wish, kind: "units", scope: "selected", sort: "tag" }), [0]);
});

test("a label is found by the beginnings of its words first", () => {
  const rows = ["level gauge gauge assembly", "valve body valve assembly", "check valve valve assembly"].map((text) => ({ text }));
  assert.deepEqual(matching(rows, "valve").map((row) => row.text.split(" ")[0]), ["valve", "check"]);
  assert.deepEqual(matching(rows, "ass ga").length, 1);
});

test("what was selected is found again by its meshes when the parts are others", () => {
  const store = new Store();
  store.setContent(plant());
  store.set({ selection: [2], hidden: new Set([0, 3]) });
  const now = plant();
  now.meshes = { path: now.meshes.path, part: [3, 2, 1, -1] };
  store.setContent(now);
  assert.deepEqual(store.shown.selection, [1]);
  assert.deepEqual([...store.shown.hidden], [3]);
});

test("a unit that got another tag, and with it another id, stays selected", () => {
  const store = new Store();
  store.setContent(plant());
  store.selectPlace("unit-1");
  const now = plant();
  now.network.units[0].id = "unit-2";
  now.meshes = store.content!.meshes;
  store.setContent(now);
  assert.deepEqual([store.shown.place, store.shown.selection], ["unit-2", [1]]);
});

test("a correction that is repeated goes to the same meshes, whatever their part is called now", () => {
  const before = plant();
  const now = plant();
  now.meshes = { path: now.meshes.path, part: [3, 2, 1, -1] };
  const label = { kind: "label", part: "part-00000", group: "Pipe assembly", name: null, this_only: true } as const;
  assert.deepEqual(carry([label, { kind: "merge", parts: ["part-00001", "part-00002"] }], before, now),
    [{ ...label, part: "part-00003" }, { kind: "merge", parts: ["part-00002", "part-00001"] }]);
  assert.equal(carry([{ ...label, part: "part-00003" }], before, now), null);
});

test("a label that others followed can be narrowed to its shape, or to the part alone", () => {
  const content = plant(5);
  content.parts.shape = [7, 7, 8, 9, 7];
  content.parts.source = ["human", "repeat", "repeat", "network", "geometry"];
  const edit = { kind: "label" as const, part: content.parts.id[0], group: "Pipe assembly", name: "flange", this_only: false };
  const alone = { ...edit, this_only: true };
  const ways = narrower([edit], content, [0, 1, 2, 3]);
  assert.deepEqual(ways.map((way) => way.text), ["Only those of its shape", "This part only"]);
  assert.deepEqual(ways.map((way) => way.edits), [[alone, { ...alone, part: content.parts.id[1] }], [alone]]);
  assert.deepEqual(narrower([edit], content, [0, 2]).map((way) => way.text), ["This part only"]);
  assert.deepEqual(narrower([edit], content, [0]), []);
  assert.deepEqual(narrower([alone], content, [0, 1]), []);
});

test("a nominal size finds the units at lines of that size, whatever their ports measure", () => {
  const content = plant();
  const [unit] = content.network.units;
  unit.ports = [{ name: "N1", point: [0, 0, 0], direction: null, diameter: 0.1 }];
  assert.deepEqual(new Index(content).find("DN80").units, [0]);
  assert.deepEqual(new Index(content).find("DN100").units, []);
  content.network.connections[0].size = null;
  assert.deepEqual(new Index(content).find("dn 100").units, [0]);
});

test("a line of the history leads to the parts and units that it names", () => {
  const content = plant();
  const found = namesIn("pipe part-00002 (V-4711) is flange; V-1 to V-9 are now V-2.", content);
  assert.deepEqual(found.filter(({ parts }) => parts).map(({ text, parts, place }) => [text, parts, place]), [
    ["part-00002", [2], null], ["V-4711", [1], "unit-1"],
  ]);
  assert.equal(found.map(({ text }) => text).join(""), "pipe part-00002 (V-4711) is flange; V-1 to V-9 are now V-2.");
});
