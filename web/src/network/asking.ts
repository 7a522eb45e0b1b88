// Asking the graph: what lies upstream or downstream, and what must be closed. The answer marks both views.

import { Refused, type Source } from "../api.ts";
import { placeAgain } from "../kept.ts";
import type { Panels } from "../panels/panels.ts";
import type { Marks, Store } from "../store.ts";
import type { Content, Isolated, Traced } from "../types.ts";
import { partsOf, type Plan } from "./plan.ts";

export type Direction = "upstream" | "downstream";

export interface Query {
  kind: "trace" | "isolate";
  /** Id of the place that it starts at. */
  at: string;
  direction: Direction;
  /** Id of the place that the way is sought to. */
  to: string | null;
}

export interface Answer {
  query: Query;
  result: Traced | Isolated;
  /** Valves that the person has ticked off as closed. */
  ticked: Set<string>;
  /** What the ids are of: in another content they may be another's. */
  content: Content;
}

export class Asking {
  answer: Answer | null = null;
  /** The place that a way is to begin at, while the person picks where it leads. */
  picking: string | null = null;
  busy = false;
  /** Why the last question got no answer, in one line. */
  refusal: string | null = null;
  private turn = 0;
  private readonly listeners = new Set<() => void>();
  private readonly store: Store;
  private readonly source: Source;
  private readonly panels: Panels;
  private readonly planNow: () => Plan;

  constructor(store: Store, source: Source, panels: Panels, planNow: () => Plan) {
    this.store = store;
    this.source = source;
    this.panels = panels;
    this.planNow = planNow;
    store.watch(["place", "selection"], () => this.picked());
    // Whoever takes the marks away ends the answer, too; not so a change of the content, after which is asked again.
    store.watch(["marks"], () => queueMicrotask(() => {
      if (this.answer && !this.busy && store.shown.marks === null) this.clear();
    }));
  }

  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }

  trace(at: string, direction: Direction): Promise<void> {
    return this.ask({ kind: "trace", at, direction, to: null });
  }

  isolate(at: string): Promise<void> {
    return this.ask({ kind: "isolate", at, direction: "downstream", to: null });
  }

  /** Waits for a second place to be selected, and seeks the way there. */
  startPick(at: string): void {
    this.picking = this.picking === at ? null : at;
    this.tell();
  }

  tick(id: string, yes: boolean): void {
    if (yes) this.answer?.ticked.add(id);
    else this.answer?.ticked.delete(id);
    this.tell();
  }

  clear(): void {
    this.turn++;
    this.answer = null;
    this.picking = null;
    this.busy = false;
    this.refusal = null;
    this.store.set({ marks: null });
    this.tell();
  }

  /** The network has changed: what was answered may be wrong now. */
  again(before: Content): void {
    if (this.picking !== null) this.picking = placeAgain(before, this.picking, this.planNow().content)?.id ?? null;
    if (!this.answer) return;
    const { query, ticked, content } = this.answer;
    const again = (id: string) => placeAgain(content, id, this.planNow().content)?.id;
    const at = again(query.at);
    const to = query.to === null ? null : again(query.to);
    if (at === undefined || to === undefined) {
      this.clear();
      this.panels.say("What was traced is no longer in the network.");
      return;
    }
    void this.ask({ ...query, at, to }, new Set([...ticked].flatMap((id) => again(id) ?? [])));
  }

  private picked(): void {
    const to = this.store.shown.place ?? this.planNow().placeOfPart.get(this.store.shown.selection[0]) ?? null;
    if (this.picking === null || to === null || to === this.picking) return;
    const at = this.picking;
    this.picking = null;
    void this.ask({ kind: "trace", at, direction: "downstream", to });
  }

  private async ask(query: Query, ticked = new Set<string>()): Promise<void> {
    const turn = ++this.turn;
    this.busy = true;
    this.refusal = null;
    this.tell();
    const { content } = this.planNow();
    try {
      const result = await this.result(query);
      if (turn !== this.turn) return;
      this.answer = { query, result, ticked: new Set([...ticked].filter((id) => closeOf(result).includes(id))), content };
      if (content === this.planNow().content) this.store.set({ marks: this.marksOf(this.answer) });
      else this.again(content);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (turn !== this.turn) return;
      // An old answer must not stay where a new one was asked for.
      this.answer = null;
      this.refusal = error.message;
      this.store.set({ marks: null });
      this.panels.say(error.message, "bad");
    } finally {
      if (turn === this.turn) {
        this.busy = false;
        this.tell();
      }
    }
  }

  private async result(query: Query): Promise<Traced | Isolated> {
    const at = this.nameOf(query.at);
    if (query.kind === "isolate") return this.source.isolate(at);
    if (query.to === null) return this.source.trace(at, query.direction);
    // With the flow where there is such a way; else against it.
    const to = this.nameOf(query.to);
    const along = await this.source.trace(at, "downstream", to);
    if (along.places.includes(query.to)) return along;
    const against = await this.source.trace(at, "upstream", to);
    return against.places.includes(query.to) ? against : along;
  }

  /** What a place is asked for by: its tag, which the answer then speaks of; its id where others have the same tag. */
  private nameOf(id: string): string {
    const { places, named } = this.planNow();
    const name = places.get(id)?.name ?? id;
    return named.get(name) === id ? name : id;
  }

  private marksOf({ query, result }: Answer): Marks {
    const close = closeOf(result);
    const places = new Set([query.at, ...result.places, ...close]);
    const connections = new Set(result.connections);
    return {
      kind: query.kind, result, places, connections, parts: partsOf(this.planNow(), places, connections),
      close: new Set(close),
    };
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}

/** The valves to be closed; none for a trace. */
export function closeOf(result: Traced | Isolated): string[] {
  return "close" in result ? result.close : [];
}

/** Whether an isolation is certain: it says so, and leaves nothing open. */
export function isCertain(result: Isolated): boolean {
  return result.sure && result.doubts.length === 0;
}
