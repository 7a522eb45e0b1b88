// The parts and units that a text names.

import type { Content } from "../types.ts";

export interface Mention {
  text: string;
  /** Rows of the parts that are meant; null for text that names nothing. */
  parts: readonly number[] | null;
  place: string | null;
}

const WORD = /[\p{L}\p{N}][\p{L}\p{N}_./-]*/gu;

/** A text cut at the ids of parts and the tags of units that the plant has; tags that are only told to have changed are none. */
export function namesIn(text: string, content: Content): Mention[] {
  return text.split(/(?<=; )/).flatMap((piece) =>
    (/ (is|are) now /.test(piece) ? [{ text: piece, parts: null, place: null }] : namesInPiece(piece, content)));
}

function namesInPiece(text: string, content: Content): Mention[] {
  const units = new Map(content.network.units.map((unit) => [unit.tag, unit]));
  const found: Mention[] = [];
  let end = 0;
  for (const match of text.matchAll(WORD)) {
    const word = match[0].replace(/[./-]+$/, "");
    const unit = units.get(word);
    const row = unit || !word.startsWith("part-") ? -1 : content.parts.id.indexOf(word);
    if (!unit && row < 0) continue;
    if (match.index > end) found.push({ text: text.slice(end, match.index), parts: null, place: null });
    found.push({ text: word, parts: unit?.parts ?? [row], place: unit?.id ?? null });
    end = match.index + word.length;
  }
  if (end < text.length) found.push({ text: text.slice(end), parts: null, place: null });
  return found;
}
