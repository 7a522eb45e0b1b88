// Sends corrections one after the other and lays the answers over what is shown; follows what others change.

import { Refused, type Source } from "../api.ts";
import type { Store } from "../store.ts";
import type { Edit, Question, ServerState, Update } from "../types.ts";
import { carry } from "./carry.ts";
import { narrower } from "./narrow.ts";
import type { Action, Page } from "./page.ts";
import type { Choice, Sent } from "./queue.ts";
import { sentence } from "./words.ts";

type Say = Page["say"];

const SLOW = 2500; // [ms] without an answer after which the page says that it waits

interface Sending {
  /** How to send the same once more, where another window was quicker. */
  repeat?: () => void;
  /** What takes it back. */
  back?: "Undo" | "Redo";
  /** Nothing is said if it is taken. */
  quiet?: boolean;
  /** What else is offered once it is taken. */
  offer?: (update: Update) => Action[];
}

export class Corrector {
  private readonly store: Store;
  private readonly source: Source;
  private readonly say: Say;
  private chain: Promise<unknown> = Promise.resolve();
  /** After a break the server may be another one that counts anew. */
  private anew = true;
  /** Why the last correction was not taken; "" where it was. */
  refusal = "";

  constructor(store: Store, source: Source, say: Say) {
    this.store = store;
    this.source = source;
    this.say = say;
  }

  async edit(edits: Edit[], why = ""): Promise<boolean> {
    if (!edits.length) return true;
    const send = (version: number) => this.source.edit(version, edits, why);
    const before = this.store.content;
    const repeat = () => {
      const carried = before && this.store.content && carry(edits, before, this.store.content);
      if (carried) void this.edit(carried, why);
      else this.say("What you corrected is no more in the plant as it is now.", "bad");
    };
    const offer = (update: Update) => narrower(edits, this.store.content!, update.changed).map(
      (way) => ({ text: way.text, run: () => void this.instead(update.version, way.edits, why) })
    );
    return (await this.send(send, { repeat, offer })) !== null;
  }

  /** Another correction in the place of the one that led to a version, if nothing came after it. */
  private async instead(version: number, edits: Edit[], why: string): Promise<void> {
    if (await this.revert("Undo", version, true)) await this.edit(edits, why);
  }

  async undo(quiet = false): Promise<boolean> {
    return (await this.send((version) => this.source.undo(version), { back: "Redo", quiet })) !== null;
  }

  async redo(): Promise<boolean> {
    return (await this.send((version) => this.source.redo(version))) !== null;
  }

  /** Answers a question of the queue. Options are sent as what they say, as the list may be another one by then. */
  async answer(question: Question, choice: Choice): Promise<Sent> {
    const edits = typeof choice === "object" ? choice.edits : typeof choice === "number" ? question.options[choice].edits : [];
    const before = this.store.content?.version;
    const update = await this.send((version) =>
      edits.length
        ? this.source.edit(version, edits, question.title)
        : this.source.answer(version, question.id, typeof choice === "object" ? "unsure" : choice), { quiet: true });
    const version = update && update.version !== before ? update.version : null;
    return { ok: update !== null, version, message: update === null ? undefined : sentence(update.message) };
  }

  /** Undoes the correction that led to a version, if nothing came after it: the version then, null where it isn't. */
  async takeBack(version: number): Promise<number | null> {
    return (await this.revert("Undo", version)) ? this.store.content!.version : null;
  }

  private async revert(back: "Undo" | "Redo", version: number, quiet = false): Promise<boolean> {
    if (this.store.state?.version === version) return back === "Undo" ? this.undo(quiet) : this.redo();
    this.say(
      "Something else was corrected since; the buttons above and the list under History go back step by step.", "bad"
    );
    return false;
  }

  /** The state that the server tells of by itself: where another window has changed the plant, it is fetched anew. */
  heard(state: ServerState): void {
    const now = this.store.state;
    if (!this.anew && now && state.version < now.version) return;
    this.anew = false;
    // While it is made ready, the server itself brings what is shown up to date with the corrections.
    const worked = now?.status === "ready" && state.status === "ready";
    this.store.setState(state);
    if (state.status === "failed" || !this.store.content) return;
    void this.inTurn(async () => {
      const { content, state: latest } = this.store;
      if (!content || !latest || latest.version === content.version || latest.status === "failed") return;
      await this.fetch();
      if (worked) this.say(
        `Changed in another window${latest.message ? `: ${latest.message}` : ""}. The plant is shown as it is now.`
      );
    }).catch((error: unknown) => this.told(error));
  }

  lost(): void {
    this.anew = true;
  }

  /** The content as the server has it now. */
  async fetch(): Promise<void> {
    this.store.setContent(await this.source.content());
  }

  private inTurn<T>(work: () => Promise<T>): Promise<T> {
    const done = this.chain.then(work);
    this.chain = done.catch(() => undefined);
    return done;
  }

  private send(
    run: (version: number) => Promise<Update>, { repeat, back = "Undo", quiet = false, offer }: Sending = {}
  ): Promise<Update | null> {
    return this.inTurn(async () => {
      this.refusal = "";
      const slow = setTimeout(() => this.say("The server is still at work on your correction."), SLOW);
      try {
        // The version that the person has seen, not the newest that was heard of.
        const update = await run(this.store.content?.version ?? 0);
        const changed = update.version !== this.store.content?.version;
        if (!this.store.apply(update)) await this.fetch();
        if (update.message && !quiet) {
          const can = back === "Undo" ? update.state.can_undo : update.state.can_redo;
          const action = { text: back, run: () => void this.revert(back, update.version) };
          this.say(sentence(update.message), "good", changed && can ? [action, ...(offer?.(update) ?? [])] : []);
        }
        return update;
      } catch (error) {
        await this.refused(error, repeat);
        return null;
      } finally {
        clearTimeout(slow);
      }
    });
  }

  private async refused(error: unknown, repeat?: () => void): Promise<void> {
    if (!(error instanceof Refused) || error.status !== 409) {
      this.told(error);
      return;
    }
    const actions = repeat ? [{ text: "Do mine as well", run: repeat }] : [];
    if (error.state) this.store.setState(error.state);
    try {
      await this.fetch();
      this.say("Another window was quicker: its correction is shown now, yours was not taken.", "bad", actions);
    } catch (failed) {
      this.told(failed);
    }
  }

  private told(error: unknown): void {
    if (!(error instanceof Refused)) throw error;
    this.refusal = sentence(error.message);
    const lead = { 423: "Still building: ", 507: "Nothing was changed: " }[error.status] ?? "";
    this.say(lead + (lead ? error.message : this.refusal), "bad");
    if (error.state) this.store.setState(error.state);
  }
}
