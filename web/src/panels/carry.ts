// Corrections that were meant for a plant that has changed since: the same parts, by the names that they have now.

import type { Content, Edit } from "../types.ts";
import { meshesOf } from "./words.ts";

/** Edits for the content as it is now; null where one of their parts is no more. Parts are known by their meshes. */
export function carry(edits: Edit[], before: Content, now: Content): Edit[] | null {
  const rows = new Map(before.parts.id.map((id, row) => [id, row]));
  const meshes = new Map(now.meshes.path.map((path, mesh) => [path, mesh]));
  let lost = false;
  const part = (id: string): string => {
    const row = rows.get(id);
    const mesh = row === undefined ? undefined : meshesOf(before, row)[0];
    const found = mesh === undefined ? undefined : now.meshes.part[meshes.get(before.meshes.path[mesh]) ?? -1];
    if (found === undefined || found < 0) lost = true;
    return now.parts.id[found ?? -1] ?? id;
  };
  const carried = edits.map((edit): Edit => {
    switch (edit.kind) {
      case "label": case "forget": case "ground": return { ...edit, part: part(edit.part) };
      case "merge": case "split": return { ...edit, parts: edit.parts.map(part) };
      case "join": case "cut": return { ...edit, first: part(edit.first), second: part(edit.second) };
      case "direction": return { ...edit, via: edit.via.map(part) };
      case "tag": case "device": return edit;
    }
  });
  return lost ? null : carried;
}
