// A label that reached more parts than was meant: the same correction for fewer.

import type { Content, Edit } from "../types.ts";

export interface Narrower {
  text: string;
  edits: Edit[];
}

/** What may be meant instead of labels that others followed, the widest first; none where no other part did. */
export function narrower(edits: readonly Edit[], content: Content, changed: readonly number[]): Narrower[] {
  const { id, shape, source } = content.parts;
  const labels = edits.filter((edit) => edit.kind === "label");
  const [first] = labels;
  const wide = labels.length === edits.length && first && labels.some((edit) => !edit.this_only);
  if (!wide || labels.some((edit) => edit.group !== first.group || edit.name !== first.name)) return [];
  const named = new Set(labels.map((edit) => edit.part));
  const shapes = new Set(id.flatMap((part, row) => (named.has(part) ? [shape[row]] : [])));
  const followed = changed.filter((row) => !named.has(id[row]) && source[row] === "repeat");
  const exact = followed.filter((row) => shapes.has(shape[row]));
  const only = (parts: string[]): Edit[] => parts.map((part) => ({ ...first, part, this_only: true }));
  const one = named.size === 1;
  const found: Narrower[] = [];
  if (exact.length && exact.length < followed.length) {
    found.push({
      text: `Only those of ${one ? "its shape" : "their shapes"}`, edits: only([...named, ...exact.map((row) => id[row])]),
    });
  }
  if (followed.length) found.push({ text: one ? "This part only" : "These parts only", edits: only([...named]) });
  return found;
}
