// What is doubtful in the network, one after the other. Pure; other areas may use it.

import type { Content, Joint, Point } from "../types.ts";
import { otherSide, type Place, type Plan, planOf } from "./plan.ts";

export interface NetworkWarning {
  /** The same for the same trouble, whatever else changes. */
  key: string;
  kind: "missing" | "joint" | "open";
  title: string;
  text: string;
  /** Id of the unit or end that it is about, if it is one. */
  place: string | null;
  parts: number[];
  point: Point;
}

/** Joints below this likelihood that were not made are no news. */
export const LIKELY = 0.1;

export const WARNING_TITLES: Record<NetworkWarning["kind"], string> = {
  missing: "Units that lack a line", joint: "Faces that may be joined", open: "Open ends",
};

/** Warnings of a network: what breaks it first, then what may be meant so. */
export function networkWarnings(content: Content, plan: Plan = planOf(content)): NetworkWarning[] {
  const found = [...missingLines(plan), ...openJoints(plan), ...openEnds(plan)];
  const order = ["missing", "joint", "open"];
  return found.sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind));
}

function missingLines(plan: Plan): NetworkWarning[] {
  const units = plan.content.network.units.filter((unit) => unit.missing > 0);
  return units.map((unit) => ({
    key: `missing:${unit.id}`,
    kind: "missing",
    title: `${unit.tag} lacks ${count(unit.missing, "line")}`,
    text: `A ${unit.kind ?? unit.type} needs ${count(unit.missing, "more line", "more lines")} than was found here. A part`
      + " beside it may have a wrong label, or pipes end in a gap. Until then tracing and isolating stop here.",
    place: unit.id, parts: unit.parts, point: unit.point,
  }));
}

function openJoints(plan: Plan): NetworkWarning[] {
  const joints = plan.content.network.joints.filter((joint) => !joint.made && joint.score >= LIKELY);
  joints.sort((a, b) => b.score - a.score);
  return joints.map((joint) => ({
    key: `joint:${plan.content.parts.id[joint.first]}:${plan.content.parts.id[joint.second]}`,
    kind: "joint",
    title: `${ownerOf(plan, joint.first)} and ${ownerOf(plan, joint.second)} may be joined`,
    text: `Likelihood ${Math.round(100 * joint.score)} %: ${reasonsOf(joint)}. It was not taken for a joint.`,
    place: null, parts: [joint.first, joint.second], point: joint.point,
  }));
}

function openEnds(plan: Plan): NetworkWarning[] {
  const ends = [...plan.places.values()].filter((place) => place.type === "open" || place.type === "unknown");
  return ends.map((place) => ({
    key: `open:${place.id}`,
    kind: "open",
    title: `${place.type === "open" ? "Open end" : "Pipe ends"}${besideText(plan, place)}`,
    text: place.type === "open"
      ? "The pipe ends here without a flange or cap that closes it: where the model ends, or where a piece is missing."
      : "The pipe ends here, and it can't be told whether it is closed.",
    place: place.id, parts: [...place.parts], point: place.point,
  }));
}

function besideText(plan: Plan, place: Place): string {
  const row = place.connections[0];
  if (row === undefined) return "";
  const connection = plan.content.network.connections[row];
  const size = connection.size === null ? "" : `, DN ${connection.size}`;
  return ` beside ${otherSide(connection, place.id).name}${size}`;
}

function ownerOf(plan: Plan, part: number): string {
  const id = plan.placeOfPart.get(part);
  const place = id === undefined ? undefined : plan.places.get(id);
  if (place) return place.name;
  return plan.content.parts.name[part] ?? plan.content.groups[plan.content.parts.group[part]]?.name ?? "a part";
}

function reasonsOf(joint: Joint): string {
  return joint.reasons.length ? joint.reasons.join("; ") : `a gap of ${(1000 * joint.gap).toFixed(1)} mm`;
}

function count(n: number, one: string, more = `${one}s`): string {
  return n === 1 ? `one ${one}` : `${n} ${more}`;
}
