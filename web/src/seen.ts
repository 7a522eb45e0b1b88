// What of the plant is to be seen: not hidden, not left out, not cut away.

import type { Shown } from "./store.ts";
import type { Content } from "./types.ts";

/** Whether all of a part lies beyond the section plane. */
export function isCut(content: Content, { section }: Pick<Shown, "section">, row: number): boolean {
  if (!section) return false;
  const { center, size } = content.parts;
  const at = 3 * row + "xyz".indexOf(section.axis);
  return section.flipped ? center[at] + size[at] / 2 < section.at : center[at] - size[at] / 2 > section.at;
}

/** What must be shown otherwise so that parts are to be seen; nothing where they are. */
export function uncovering(content: Content, shown: Readonly<Shown>, rows: readonly number[]): Partial<Shown> {
  const change: Partial<Shown> = {};
  if (rows.some((row) => shown.hidden.has(row))) {
    change.hidden = new Set([...shown.hidden].filter((row) => !rows.includes(row)));
  }
  const { isolated } = shown;
  if (isolated && !rows.every((row) => isolated.has(row))) change.isolated = null;
  if (rows.some((row) => isCut(content, shown, row))) change.section = null;
  return change;
}
