// What the inspector says of the network: of the selected place, line or piece of pipe, with what can be asked and corrected.

import type { Panels } from "../panels/panels.ts";
import type { Connection, Edit, Flow, Joint, Line } from "../types.ts";
import { el } from "../dom.ts";
import { flowState, isSet, lengthText, lineSizeText, opposite, shareText, sizeText, wayText } from "./flow.ts";
import { otherSide, type Place, walk } from "./plan.ts";
import { answerCard, counted, placeLink, type Shower } from "./result.ts";
import { LIKELY } from "./warnings.ts";

export interface SlotContext extends Shower {
  panels: Panels;
  /** Whether there is a server that can be asked. */
  live: boolean;
  /** Whether corrections are taken now. */
  editable: boolean;
}

const SHOWN = 12; // connections of a selection that are listed

/** All there is to say, as elements for the slot. */
export function slotContent(context: SlotContext): HTMLElement[] {
  const { asking, focus } = context;
  const found: HTMLElement[] = [];
  if (asking.busy) found.push(el("p", { class: "net-soft", role: "status" }, "Following the pipes…"));
  if (asking.refusal) found.push(el("p", { class: "net-refusal", role: "alert" }, asking.refusal));
  if (asking.answer) found.push(answerCard(asking.answer, context));
  const { place } = focus;
  if (focus.selectedLine >= 0) found.push(lineCard(context, focus.selectedLine));
  else if (place) found.push(placeCard(context, place));
  else found.push(...[...focus.connections].slice(0, 3).map((row) => connectionCard(context, row)));
  const joints = jointList(context);
  if (joints) found.push(joints);
  return found;
}

function placeCard(context: SlotContext, place: Place): HTMLElement {
  const rows = place.connections;
  const list = el("ul", { class: "net-connections" }, ...rows.slice(0, SHOWN).map((row) => {
    const connection = context.plan.content.network.connections[row];
    const other = otherSide(connection, place.id);
    return el("li", {},
      el("span", { class: "net-arrow", title: arrowTitle(connection, place.id) }, arrowOf(connection, place.id)),
      placeLink(other.id, other.name, context),
      el("span", { class: "net-soft" }, `${sizeText(connection)}, ${lengthText(connection.length)}`));
  }));
  return el("section", { class: "net-card", "data-test": "net-place", "aria-label": "On the network" },
    el("h3", {}, "On the network"),
    rows.length ? list : el("p", { class: "net-soft" }, "No pipe was found that leads here."),
    rows.length > SHOWN ? el("p", { class: "net-soft" }, `and ${rows.length - SHOWN} more`) : null,
    rows.length && context.live ? askButtons(context, place) : null,
    rows.length && !context.live ? el("p", { class: "net-soft" }, "Tracing and isolating need 'cadgraph view'.") : null);
}

function askButtons({ asking }: SlotContext, place: Place): HTMLElement {
  const picking = asking.picking === place.id;
  const button = (test: string, text: string, title: string, run: () => void, pressed?: boolean) => el("button", {
    type: "button", "data-test": test, title, disabled: asking.busy, onclick: run,
    "aria-pressed": pressed === undefined ? undefined : String(pressed),
  }, text);
  return el("div", {},
    el("div", { class: "net-buttons" },
      button("net-upstream", "Upstream", "Trace what leads here (Shift+Up)", () => void asking.trace(place.id, "upstream")),
      button("net-downstream", "Downstream", "Trace where it leads (Shift+Down)", () => void asking.trace(place.id, "downstream")),
      button("net-trace-to", "Way to…", "Trace the way to a second one (Shift+Right)", () => asking.startPick(place.id), picking),
      place.unit && button("net-isolate", "Valves to close", "Isolate: which valves must be closed to cut it off (v)", () => void asking.isolate(place.id))),
    picking ? el("p", { class: "net-verdict", role: "status" }, `Click where the way from ${place.name} should lead.`) : null);
}

function connectionCard(context: SlotContext, row: number): HTMLElement {
  const { plan, editable } = context;
  const connection = plan.content.network.connections[row];
  const line = plan.content.network.lines[connection.line];
  return el("section", { class: "net-card", "data-test": "net-connection", "aria-label": "Connection" },
    el("h3", {}, "Connection ",
      placeLink(connection.source, connection.source_name, context), " – ",
      placeLink(connection.target, connection.target_name, context)),
    el("p", { class: "net-soft" }, `${sizeText(connection)}, ${lengthText(connection.length)}`),
    line ? lineLink(context, connection.line, line) : null,
    flowText(connection),
    editable ? directionButtons(connection.flow, connection.source_name, connection.target_name, isSet(connection, plan), (flow) =>
      context.panels.edit([directionEdit(context, connection, flow)])) : null);
}

function lineCard(context: SlotContext, row: number): HTMLElement {
  const { plan, editable } = context;
  const line = plan.content.network.lines[row];
  const steps = walk(plan, line);
  const connections = steps.map((step) => plan.content.network.connections[step.row]);
  const doubtful = connections.filter((connection) => flowState(connection) !== "known").length;
  const start = plan.places.get(line.start)?.name ?? line.start;
  const end = plan.places.get(line.end)?.name ?? line.end;
  const set = connections.map((connection) => isSet(connection, plan));
  const edits = (flow: Flow) => steps.flatMap(({ along }, i) =>
    (flow === "unknown" && !set[i] ? [] : [directionEdit(context, connections[i], along ? flow : opposite(flow))]));
  const words: Record<string, string> = {
    forward: `Flows from ${start} to ${end}`, backward: `Flows from ${end} to ${start}`, unknown: "Direction of flow unknown",
    none: "No flow: it ends at a closed end", contradictory: "The directions found along it contradict each other",
  };
  return el("section", { class: "net-card", "data-test": "net-line-card", "aria-label": `Line ${line.tag}` },
    el("h3", {}, `Line ${line.tag}`),
    el("p", { class: "net-soft" }, `${lineSizeText(line.size)}, ${lengthText(line.length)}, ${counted(connections.length, "piece")}`),
    el("p", {}, placeLink(line.start, start, context), " – ", placeLink(line.end, end, context)),
    el("p", {}, words[line.flow] ?? `Flow: ${line.flow}`,
      reasonOf(connections) ? el("span", { class: "net-soft" }, `: ${reasonOf(connections)}`) : null),
    doubtful ? el("p", { class: "net-verdict is-unsure" }, `Not certain in ${doubtful} of ${counted(connections.length, "piece")}.`) : null,
    editable ? directionButtons(line.flow as Flow, start, end, set.includes(true), (flow) => context.panels.edit(edits(flow))) : null);
}

function reasonOf(connections: readonly Connection[]): string | null {
  return connections.find((connection) => connection.reason !== null)?.reason ?? null;
}

function lineLink(context: SlotContext, row: number, line: Line): HTMLElement {
  return el("p", {}, "Line ", el("button", {
    type: "button", class: "net-link", onclick: () => context.focus.selectLine(row),
    onpointerenter: () => context.focus.hoverLine(row), onpointerleave: () => context.focus.hoverLine(-1),
  }, line.tag));
}

function flowText(connection: Connection): HTMLElement {
  if (connection.flow === "unknown") {
    return el("p", { class: "net-verdict is-unsure" }, "Direction of flow unknown: tracing halts here.");
  }
  const state = flowState(connection);
  return el("p", { class: state === "doubtful" ? "net-verdict is-unsure" : "" },
    `Flows ${wayText(connection)}`, connection.reason ? `: ${connection.reason}` : "",
    el("span", { class: "net-soft" }, `, ${state === "doubtful" ? "not certain: " : ""}likelihood ${shareText(connection.confidence)}`));
}

function directionButtons(
  flow: Flow, source: string, target: string, set: boolean, send: (flow: Flow) => Promise<boolean>,
): HTMLElement {
  const choice = (value: Flow, text: string, title: string) => el("button", {
    type: "button", "data-test": `net-flow-${value}`, title, "aria-pressed": value === "unknown" ? undefined : String(flow === value), onclick: () => void send(value),
  }, text);
  return el("div", { class: "net-buttons", role: "group", "aria-label": "Direction of flow" },
    choice("forward", `${source} → ${target}`, `Set: flows from ${source} to ${target}`),
    choice("backward", `${target} → ${source}`, `Set: flows from ${target} to ${source}`),
    set && choice("unknown", "Take back", "Takes a direction back that was set by hand"));
}

function button(test: string, text: string, title: string, run: () => void): HTMLElement {
  return el("button", { type: "button", "data-test": test, title, onclick: run }, text);
}

function directionEdit({ plan }: SlotContext, connection: Connection, flow: Flow): Edit {
  const via = connection.via.map((part) => plan.content.parts.id[part]);
  return { kind: "direction", source: connection.source, target: connection.target, via, flow };
}

/** Joints of the selected part, made and not made. */
function jointList(context: SlotContext): HTMLElement | null {
  const { plan, store } = context;
  const [part] = store.shown.selection;
  // A large unit has many parts: what is said of the first of them would be at random.
  if (store.shown.selection.length !== 1 || part === undefined) return null;
  const joints = plan.content.network.joints.filter((joint) =>
    (joint.first === part || joint.second === part) && (joint.made || joint.score >= LIKELY));
  if (!joints.length) return null;
  joints.sort((a, b) => Number(a.made) - Number(b.made) || b.score - a.score);
  return el("details", { class: "net-card", "data-test": "net-joints", open: joints.length <= 6 || joints.some((joint) => !joint.made) },
    el("summary", {}, `Joints of this part (${joints.length})`),
    el("ul", { class: "net-joints" }, ...joints.slice(0, 30).map((joint) => jointRow(context, joint, part))));
}

function jointRow(context: SlotContext, joint: Joint, part: number): HTMLElement {
  const { plan, panels, editable } = context;
  const { parts } = plan.content;
  const other = joint.first === part ? joint.second : joint.first;
  const owner = plan.placeOfPart.get(other);
  const name = parts.name[other] ?? plan.content.groups[parts.group[other]]?.name ?? "part";
  const text = owner ? `${name} of ${plan.places.get(owner)!.name}` : name;
  const ids = { first: parts.id[joint.first], second: parts.id[joint.second] };
  return el("li", { class: joint.made ? "" : "is-unsure", title: joint.reasons.join("; ") },
    el("button", { type: "button", class: "net-link", onclick: () => context.goParts([other]) }, text),
    el("span", { class: "net-soft" }, [
      joint.kind, `${(1000 * Math.abs(joint.gap)).toFixed(1)} mm`, shareText(joint.score), ...(joint.made ? [] : ["not joined"]),
    ].join(", ")),
    editable && (joint.made
      ? button("net-cut", "Cut here", "These two do not join", () => void panels.edit([{ kind: "cut", ...ids }]))
      : button("net-join", "Join", "These two join", () => void panels.edit([{ kind: "join", ...ids }]))));
}

/** Seen from a place: → leads away, ← comes here, – unknown. */
function arrowOf(connection: Connection, place: string): string {
  if (connection.flow === "unknown") return "–";
  return (connection.source === place) === (connection.flow === "forward") ? "→" : "←";
}

function arrowTitle(connection: Connection, place: string): string {
  return { "–": "direction unknown", "→": "flows away from it", "←": "flows to it" }[arrowOf(connection, place)]!;
}
