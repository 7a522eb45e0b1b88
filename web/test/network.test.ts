import assert from "node:assert/strict";
import { test } from "node:test";
import { fitted, showing, zoomed } from "../src/network/camera2d.ts";
import { isSet } from "../src/network/flow.ts";
import { connectionsOf, markOf } from "../src/network/pieces.ts";
import { arrowsAlong, piecesOf, pointAt, wayOf } from "../src/network/path.ts";
import { leaderEnd, placeLabels, type Placed, type Wish } from "../src/network/placement.ts";
import { planOf, partsOfLine, walk } from "../src/network/plan.ts";
import { cleanCopy, isAllowed, type Maker, type ReadNode } from "../src/network/sanitize.ts";
import { type Palette, strokesOf } from "../src/network/style.ts";
import { columns, pieces } from "../src/network/told.ts";
import { networkWarnings } from "../src/network/warnings.ts";
import type { Connection, Content, End, Unit } from "../src/types.ts";

function wishes(n: number, spread: number): Wish[] {
  let seed = 7;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  return Array.from({ length: n }, (_, i) => ({
    key: `k${i}`, x: 20 + random() * spread, y: 20 + random() * spread, width: 30 + random() * 60, height: 20,
    rank: Math.floor(random() * 9), slot: -1,
  }));
}

function overlap(a: Placed, b: Placed): boolean {
  return a.left < b.left + b.wish.width && b.left < a.left + a.wish.width
    && a.top < b.top + b.wish.height && b.top < a.top + a.wish.height;
}

const FRAME = { width: 1280, height: 720, taken: [[0, 0, 300, 60]] as [number, number, number, number][] };

test("labels never overlap, stay in the picture and off what is taken", () => {
  const placed = placeLabels(wishes(700, 680), FRAME, 400);
  assert.ok(placed.length > 60, `only ${placed.length}`);
  placed.forEach((a, i) => placed.slice(0, i).forEach((b) => assert.ok(!overlap(a, b), `${a.wish.key} over ${b.wish.key}`)));
  for (const { left, top, wish } of placed) {
    assert.ok(left >= 0 && top >= 0 && left + wish.width <= 1280 && top + wish.height <= 720);
    assert.ok(left >= 300 || top >= 60);
  }
});

test("the most important labels are kept, and a label stays where it was", () => {
  const crowd = wishes(200, 60).map((wish, i) => ({ ...wish, x: wish.x + 400, y: wish.y + 300, rank: i === 150 ? 99 : wish.rank }));
  const first = placeLabels(crowd, FRAME, 10);
  assert.equal(first.length, 10);
  assert.ok(first.some(({ wish }) => wish.key === "k150"));
  const wish = { key: "a", x: 600, y: 300, width: 40, height: 20, rank: 1, slot: 5 };
  assert.equal(placeLabels([wish], FRAME, 1)[0].slot, 5);
  assert.notDeepEqual(leaderEnd(placeLabels([wish], FRAME, 1)[0]), { x: 600, y: 300 });
});

const L_SHAPE = [0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 1];

test("a way keeps its corners and drops points that say nothing", () => {
  const way = wayOf(L_SHAPE);
  assert.deepEqual(way.points, [[0, 0, 0], [2, 0, 0], [2, 0, 1]]);
  assert.equal(way.length, 3);
  assert.deepEqual(pointAt(way, 2.5), { point: [2, 0, 0.5], direction: [0, 0, 1] });
});

test("the distance that dashes are drawn by runs on from piece to piece", () => {
  const drawn = piecesOf(wayOf(L_SHAPE));
  assert.deepEqual(drawn.map(({ start, end }) => [start, end]), [[0, 2], [2, 3]]);
});

test("arrows lie on the way, point with the flow, and the first one has most room", () => {
  const way = wayOf([0, 0, 0, 4, 0, 0]);
  const back = arrowsAlong(way, "backward", 1);
  assert.deepEqual(back[0], { point: [2, 0, 0], direction: [-1, -0, -0], room: 4 });
  const xs = back.map(({ point }) => point[0]).sort((a, b) => a - b);
  assert.equal(new Set(xs).size, xs.length);
  for (let i = 1; i < xs.length; i++) assert.ok(xs[i] - xs[i - 1] >= 0.25);
  assert.ok(back.slice(1).every(({ room }) => room < 4));
  assert.deepEqual(arrowsAlong(way, "unknown", 1), []);
  assert.deepEqual(arrowsAlong(wayOf([1, 1, 1]), "forward", 1), []);
});

function unit(id: string, tag: string, parts: number[], missing = 0): Unit {
  return {
    id, tag, type: "valve", kind: "gate valve", kind_guesses: [], handling: "", parts, system: 0, point: [0, 0, 0], size: [1, 1, 1], ports: [],
    missing, facts: [],
  };
}

function connection(source: string, target: string, via: number[], flow: Connection["flow"], confidence = 0.99): Connection {
  return {
    source, target, source_name: source, target_name: target, via, path: [0, 0, 0, 1, 0, 0], length: 1, size: 80, diameter: 0.08,
    flow, reason: null, confidence, line: 0,
  };
}

function content(): Content {
  const end: End = { id: "e", name: "terminal-000", kind: "open", point: [1, 0, 0], parts: [5], system: 0 };
  const network = {
    units: [unit("u1", "V-001", [0]), unit("u2", "V-4711/A", [1, 2], 1)], ends: [end],
    connections: [connection("u1", "u2", [3], "forward"), connection("e", "u2", [4], "unknown")],
    lines: [{ tag: "L-1", start: "u1", end: "e", size: "80", length: 2, flow: "forward", connections: [0, 1], system: 0 }],
    systems: [{ id: "system-000", units: [0, 1], length: 2, sizes: [80] }], clusters: [],
    joints: [
      { first: 0, second: 6, kind: "face", point: [0, 0, 0], gap: 0.004, score: 0.4, made: false, reasons: [] },
      { first: 0, second: 5, kind: "face", point: [0, 0, 0], gap: 0.4, score: 0.05, made: false, reasons: [] },
      { first: 0, second: 3, kind: "face", point: [0, 0, 0], gap: 0, score: 0.99, made: true, reasons: [] },
    ],
  } satisfies Content["network"];
  const n = 7;
  const parts = { id: Array.from({ length: n }, (_, i) => `part-${i}`), name: Array(n).fill("pipe"), group: Array(n).fill(0) };
  return {
    version: 1, title: "", origin: [0, 0, 0], groups: [], meshes: { path: [], part: [] }, diagnostics: [], network,
    parts: parts as unknown as Content["parts"],
  };
}

test("warnings: units short of lines first, likely joints next, open ends last; the unlikely and the made are none", () => {
  const found = networkWarnings(content());
  assert.deepEqual(found.map((w) => w.kind), ["missing", "joint", "open"]);
  assert.equal(found[0].title, "V-4711/A lacks one line");
  assert.deepEqual(found[1].parts, [0, 6]);
  assert.match(found[1].text, /40 %.*gap of 4\.0 mm/);
  assert.equal(found[2].title, "Open end beside u2, DN 80");
  assert.equal(found[2].place, "e");
});

test("a line has the parts of its connections and of the units that stand in it", () => {
  const plan = planOf(content());
  const line = plan.content.network.lines[0];
  assert.deepEqual(partsOfLine(plan, line).sort(), [1, 2, 3, 4]);
  assert.deepEqual(walk(plan, line), [{ row: 0, along: true }, { row: 1, along: false }]);
});

test("tags in a text can be clicked, parts of other words can't", () => {
  const plan = planOf(content());
  assert.deepEqual(pieces("1.2 m to V-001, then V-4711/A.", plan).filter((p) => p.place), [
    { text: "V-001", place: "u1" }, { text: "V-4711/A", place: "u2" },
  ]);
  assert.deepEqual(pieces("V-0012 and XV-001", plan).filter((p) => p.place), []);
});

const GREY: Palette = {
  known: [0, 0, 0], unknown: [1, 1, 1], selected: [0, 0, 1], mark: [1, 0, 0], faint: [0.5, 0.5, 0.5], casing: [1, 1, 1],
  several: [[0, 1, 0]], ramp: [[0, 0, 0], [1, 1, 1]],
};

test("lines without direction or of low confidence are dashed; what isn't marked is dim", () => {
  const made = content();
  made.network.connections.push(connection("u1", "e", [], "forward", 0.4));
  const plan = planOf(made);
  const looks = { by: "flow" as const, marks: null, selected: new Set<number>(), hovered: new Set<number>(), isShown: () => true };
  assert.deepEqual(strokesOf(plan, looks, GREY).map(({ dashed, arrows }) => [dashed, arrows]), [[false, true], [true, false], [true, true]]);
  const marks = {
    kind: "trace" as const, result: { title: "", lines: [], places: [], connections: [0], doubts: [] }, places: new Set<string>(),
    connections: new Set([0]), parts: new Set<number>(), close: new Set<string>(),
  };
  const marked = strokesOf(plan, { ...looks, marks, isShown: () => false }, GREY);
  assert.deepEqual(marked.map(({ dim, shown }) => [dim, shown]), [[false, true], [true, false], [true, false]]);
});

const SVG = "http://www.w3.org/2000/svg";

function node(name: string, attributes: Record<string, string> = {}, children: (ReadNode | string)[] = [], ns: string = SVG): ReadNode {
  return {
    nodeType: 1, nodeValue: null, localName: name, namespaceURI: ns,
    attributes: Object.entries(attributes).map(([key, value]) => ({ name: key, value })),
    childNodes: children.map((child) => (typeof child === "string" ? { nodeType: 3, nodeValue: child, childNodes: [] } : child)),
  };
}

interface Copied { name: string; attributes: Record<string, string>; children: (Copied | string)[] }
const maker: Maker<Copied> = {
  element: (name) => ({ name, attributes: {}, children: [] }),
  attribute: (element, name, value) => { element.attributes[name] = value; },
  append: (element, child) => { element.children.push(child); },
};

test("a hostile drawing loses everything that isn't ours, and names stay text", () => {
  const hostile = node("svg", { onload: "alert(1)", width: "10", viewBox: "0 0 10 10", style: "x", "xlink:href": "#", filter: "url(#f)" }, [
    node("script", {}, ["alert(1)"]), node("style", {}, ["*{background:url(http://x)}"]), node("a", { href: "javascript:x" }, [node("path")]),
    node("foreignObject", {}, [node("img", { onerror: "x" }, [], "http://www.w3.org/1999/xhtml")]), node("image", { href: "http://x" }),
    node("use", { href: "#x" }), node("animate", { attributeName: "href" }), node("path", {}, [], "http://www.w3.org/1999/xhtml"),
    node("g", { "data-id": "unit-<img>", transform: "translate(1 -2.5) rotate(-90)", class: "a b" }, [
      node("text", { x: "1", fill: "url(#a)", "font-size": "8" }, ["<img src=x onerror=alert(1)>"]), "stray",
    ]),
  ]);
  assert.deepEqual(cleanCopy(hostile, maker), {
    name: "svg", attributes: { width: "10", viewBox: "0 0 10 10" }, children: [{
      name: "g", attributes: { "data-id": "unit-<img>", transform: "translate(1 -2.5) rotate(-90)", class: "a b" },
      children: [{ name: "text", attributes: { x: "1", "font-size": "8" }, children: ["<img src=x onerror=alert(1)>"] }],
    }],
  });
  assert.equal(cleanCopy(node("html", {}, [], "http://www.w3.org/1999/xhtml"), maker), null);
});

test("attributes of our drawing pass, others of the same name with other values don't", () => {
  for (const [element, name, value] of [
    ["path", "d", "M-13 -7.5L13 7.5V-7.5L-13 7.5Z"], ["polygon", "points", "414.24,75 406.24,78 406.24,72"], ["rect", "width", "100%"],
    ["g", "transform", "translate(302.24 150)"], ["circle", "r", "1.8"], ["path", "d", "M-8 -14A8 8 0 0 1 8 -14Z"],
  ]) assert.ok(isAllowed(element, name, value), `${element} ${name}=${value}`);
  for (const [element, name, value] of [
    ["path", "d", "url(#x)"], ["g", "transform", "expression(1)"], ["g", "class", "a\"b"], ["rect", "width", "calc(1px)"],
    ["g", "onclick", "x"], ["constructor", "d", "M0"], ["g", "constructor", "x"], ["text", "style", "color:red"],
  ]) assert.ok(!isAllowed(element, name, value), `${element} ${name}=${value}`);
});

test("zooming keeps the point under the pointer; what is out of sight is brought to the middle", () => {
  const pane = { width: 800, height: 300 };
  const frame = fitted({ width: 1600, height: 400 }, pane);
  assert.equal(frame.x + (frame.zoom * 1600) / 2, 400);
  const closer = zoomed(frame, 2, 100, 50, 0.05);
  assert.ok(Math.abs((100 - closer.x) / closer.zoom - (100 - frame.x) / frame.zoom) < 1e-9);
  const seen = { x: 0, y: 0, zoom: 1 };
  const sheet = { width: 1600, height: 800 };
  assert.equal(showing(seen, { x: 100, y: 100, width: 40, height: 40 }, sheet, pane, false), seen);
  const moved = showing(seen, { x: 900, y: 350, width: 40, height: 20 }, sheet, pane, false);
  assert.equal(moved.x + moved.zoom * 920, 400);
  assert.equal(moved.y + moved.zoom * 360, 150);
  // At its edge no empty paper is shown beside the drawing.
  assert.equal(showing(seen, { x: 1560, y: 350, width: 40, height: 20 }, sheet, pane, false).x, -800);
});

test("what the drawing can't show apart is marked as neither cut off nor live", () => {
  const made = content();
  const plan = planOf(made);
  const element = (attributes: Record<string, string>) => ({ getAttribute: (name: string) => attributes[name] ?? null });
  assert.deepEqual(connectionsOf(element({ "data-line": made.network.lines[0].tag, "data-connection": "3 14" }), plan), [3, 14]);
  assert.deepEqual(connectionsOf(element({ "data-line": made.network.lines[0].tag }), plan), made.network.lines[0].connections);
  assert.deepEqual(connectionsOf(element({}), plan), []);
  assert.equal(markOf([3, 14], new Set([3])), "partly");
  assert.equal(markOf([3, 14], new Set([3, 14, 5])), "all");
  assert.equal(markOf([3], new Set([14])), "none");
  assert.equal(markOf([], new Set([14])), "none");
});

test("a direction can be taken back only where it was set, not where it only follows from that", () => {
  const plan = planOf(content());
  const set = { ...plan.content.network.connections[0] };
  const [a, b] = [set.source, set.target].map((id) => {
    const place = plan.places.get(id)!;
    return place.type === "open" ? "open end" : place.name;
  });
  assert.equal(isSet({ ...set, reason: `set by a user: ${a} -> ${b}` }, plan), true);
  assert.equal(isSet({ ...set, reason: `set by a user: ${b} -> ${a}` }, plan), true);
  assert.equal(isSet({ ...set, reason: `set by a user: ${a} -> X-9` }, plan), false);
  assert.equal(isSet({ ...set, reason: "from pump P-001" }, plan), false);
  assert.equal(isSet({ ...set, reason: null }, plan), false);
});

test("columns of the command line are told apart", () => {
  assert.deepEqual(columns("  V-004  gate valve  by N1   0.92 m"), { indent: 2, cells: ["V-004", "gate valve", "by N1", "0.92 m"] });
  assert.deepEqual(columns("shut off with it: G-004, G-002"), { indent: 0, cells: ["shut off with it: G-004, G-002"] });
  assert.deepEqual(columns(""), { indent: 0, cells: [""] });
});
