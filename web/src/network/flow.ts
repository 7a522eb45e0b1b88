// What is known of the flow in a connection, in words and as a way of drawing.

import type { Connection, Flow } from "../types.ts";
import type { Plan } from "./plan.ts";

/** Below this a connection is drawn dashed: the same limit as in the schematic. */
export const SURE = 0.7;

/** known: drawn solid with arrows; doubtful: dashed with arrows; unknown: dashed, no arrows. */
export type FlowState = "known" | "doubtful" | "unknown";

export function flowState(connection: Connection): FlowState {
  if (connection.flow === "unknown") return "unknown";
  return connection.confidence !== null && connection.confidence < SURE ? "doubtful" : "known";
}

export function opposite(flow: Flow): Flow {
  return flow === "forward" ? "backward" : flow === "backward" ? "forward" : "unknown";
}

/** "V-001 → P-001", in the direction of flow where that is known. */
export function wayText(connection: Connection): string {
  const { source_name: source, target_name: target, flow } = connection;
  if (flow === "unknown") return `${source} – ${target}`;
  return flow === "forward" ? `${source} → ${target}` : `${target} → ${source}`;
}

export function lengthText(metres: number | null): string {
  if (metres === null) return "length unknown";
  if (metres < 1) return `${Math.round(metres * 1000)} mm`;
  return `${metres < 100 ? metres.toFixed(2) : Math.round(metres)} m`;
}

export function sizeText(connection: Connection): string {
  if (connection.size !== null) return `DN ${connection.size}`;
  return connection.diameter === null ? "size unknown" : `⌀ ${lengthText(connection.diameter)}`;
}

/** The size of a line as its record has it: "80", "50-80" or words. */
export function lineSizeText(size: string): string {
  return /^\d/.test(size) ? `DN ${size}` : size;
}

export function shareText(share: number | null): string {
  return share === null ? "unknown" : `${Math.round(100 * share)} %`;
}

const SET = "set by a user: ";
const KINDS: Record<string, string> = { open: "open end", blind: "blind end", unknown: "end" };

/** Whether somebody set the direction of this very connection; others that follow from it have the same reason. */
export function isSet({ source, target, reason }: Connection, plan: Plan): boolean {
  if (!reason?.startsWith(SET)) return false;
  const names = [source, target].map((id) => {
    const place = plan.places.get(id);
    return place ? KINDS[place.type] ?? place.name : id;
  });
  return [names, [...names].reverse()].some((pair) => reason === `${SET}${pair.join(" -> ")}`);
}
