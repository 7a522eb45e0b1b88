import assert from "node:assert/strict";
import { test } from "node:test";
import { isCut, uncovering } from "../src/seen.ts";
import { START, type Shown } from "../src/store.ts";
import type { Content } from "../src/types.ts";

const CONTENT = { parts: { center: [0, 0, 0, 5, 0, 0], size: [1, 1, 1, 1, 1, 1] } } as unknown as Content;
const shown = (patch: Partial<Shown>): Shown => ({ ...START, ...patch });

test("a part is cut away where all of it lies beyond the plane", () => {
  const section = { axis: "x" as const, at: 2, flipped: false };
  assert.deepEqual([0, 1].map((row) => isCut(CONTENT, { section }, row)), [false, true]);
  assert.deepEqual([0, 1].map((row) => isCut(CONTENT, { section: { ...section, flipped: true } }, row)), [true, false]);
});

test("what is asked about is uncovered, and no more than that", () => {
  assert.deepEqual(uncovering(CONTENT, shown({}), [1]), {});
  assert.deepEqual(uncovering(CONTENT, shown({ hidden: new Set([0, 1]) }), [1]), { hidden: new Set([0]) });
  assert.deepEqual(uncovering(CONTENT, shown({ isolated: new Set([0]) }), [1]), { isolated: null });
  assert.deepEqual(uncovering(CONTENT, shown({ isolated: new Set([0, 1]) }), [1]), {});
  const section = { axis: "x" as const, at: 2, flipped: false };
  assert.deepEqual(uncovering(CONTENT, shown({ section }), [1]), { section: null });
  assert.deepEqual(uncovering(CONTENT, shown({ section }), [0]), {});
});
