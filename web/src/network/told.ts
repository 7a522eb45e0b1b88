// Lines of text in which the tags can be clicked.

import type { Plan } from "./plan.ts";

/** A piece of a line: plain, or the name of a place. */
export interface Piece {
  text: string;
  place: string | null;
}

const WORD = /[\p{L}\p{N}][\p{L}\p{N}_./-]*/gu;

/** A text cut at the tags that one place alone has. */
export function pieces(text: string, plan: Plan): Piece[] {
  const found: Piece[] = [];
  let end = 0;
  for (const match of text.matchAll(WORD)) {
    const word = match[0].replace(/[./-]+$/, "");
    const place = plan.named.get(word);
    if (!place) continue;
    if (match.index > end) found.push({ text: text.slice(end, match.index), place: null });
    found.push({ text: word, place });
    end = match.index + word.length;
  }
  if (end < text.length) found.push({ text: text.slice(end), place: null });
  return found;
}

/** A line of columns, as the command line prints it: how far it is set in, and what stands in each column. */
export function columns(line: string): { indent: number; cells: string[] } {
  return { indent: line.length - line.trimStart().length, cells: line.trim().split(/ {2,}/) };
}
