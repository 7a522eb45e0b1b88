// The review queue: one question after the other, the next one at once while the server still works on the last.

import type { Edit, Question } from "../types.ts";

export type Choice = number | "skip" | "unsure" | { text: string; edits: Edit[] };

export interface Sent {
  ok: boolean;
  /** The version of the plant after it; null where nothing was changed (skipped). */
  version: number | null;
  /** What came of it, in words. */
  message?: string;
}

export interface QueueIo {
  load(): Promise<Question[]>;
  send(question: Question, choice: Choice): Promise<Sent>;
  /** Takes back the correction that led to this version: the version after it, null where it can't be done any more. */
  takeBack(version: number): Promise<number | null>;
}

export interface Answered {
  question: Question;
  choice: Choice;
  version: number | null;
  message?: string;
}

/** What an option or another choice says, in words. */
export function choiceWords(question: Question, choice: Choice): string {
  if (choice === "skip") return "skipped";
  if (choice === "unsure") return "left as unsure";
  return typeof choice === "number" ? (question.options[choice]?.text ?? "") : choice.text;
}

export class Queue {
  waiting: Question[] = [];
  past: Answered[] = [];
  loaded = false;
  /** The greatest gain that was ever to be had; what is left is measured by it. */
  peak = 0;
  /** When the question shown became another one without the person's doing [ms]; keys are not taken right after. */
  replacedAt = -Infinity;
  /** Answers on their way; the server still lists their questions. */
  private readonly settled = new Set<string>();
  /** Grows with each answer: a list that was asked for before it is stale. */
  private turn = 0;
  private readonly io: QueueIo;
  private readonly changed: () => void;
  private sending = 0;
  private chain: Promise<unknown> = Promise.resolve();
  private loading: Promise<void> | null = null;
  private again = false;

  constructor(io: QueueIo, changed: () => void) {
    this.io = io;
    this.changed = changed;
  }

  get current(): Question | null {
    return this.waiting[0] ?? null;
  }

  /** How many were decided, without those skipped. */
  get decided(): number {
    return this.past.filter((past) => past.choice !== "skip").length;
  }

  get busy(): boolean {
    return this.sending > 0;
  }

  /** Asks for the list anew; the question that is shown stays the first as long as it is still one. */
  load(): Promise<void> {
    if (this.loading) {
      this.again = true;
      return this.loading;
    }
    this.loading = this.fetch().finally(() => {
      this.loading = null;
      if (this.again) {
        this.again = false;
        void this.load();
      }
    });
    return this.loading;
  }

  /** Answers the question shown; the next one is shown at once. A refused one comes back to the front. */
  answer(choice: Choice): Promise<void> {
    const question = this.current;
    if (!question) return Promise.resolve();
    if (typeof choice === "number" && !question.options[choice]) return Promise.resolve();
    const told: Answered = { question, choice, version: null };
    this.settled.add(question.id);
    this.turn++;
    this.past.push(told);
    this.waiting = this.waiting.slice(1).filter((other) => !answersToo(question, choice, other));
    this.sending++;
    this.changed();
    const done = this.chain.then(async () => {
      const sent = await this.io.send(question, choice).catch((): Sent => ({ ok: false, version: null }));
      this.sending--;
      this.settled.delete(question.id);
      if (sent.ok) Object.assign(told, { version: sent.version, message: sent.message });
      else this.restore(told);
      if (!this.sending) await this.load().catch(() => undefined);
      this.changed();
    });
    this.chain = done;
    return done;
  }

  /** Takes the last answer back and shows its question again; false where there is none or it can't be taken back. */
  async back(): Promise<boolean> {
    await this.chain;
    const last = this.past.at(-1);
    if (!last) return false;
    if (last.version !== null) {
      const version = await this.io.takeBack(last.version);
      if (version === null) return false;
      // The plant is again as it was before it: where that was the answer before, it can be taken back in turn.
      const before = this.past.filter((told) => told !== last && told.version !== null).at(-1);
      if (before?.version === last.version - 1) before.version = version;
    }
    this.restore(last);
    this.changed();
    return true;
  }

  /** Shows another one of the list first. */
  show(id: string): void {
    const at = this.waiting.findIndex((question) => question.id === id);
    if (at <= 0) return;
    this.waiting = [this.waiting[at], ...this.waiting.slice(0, at), ...this.waiting.slice(at + 1)];
    this.changed();
  }

  private restore(told: Answered): void {
    this.past = this.past.filter((past) => past !== told);
    this.turn++;
    this.waiting = [told.question, ...this.waiting.filter((question) => question.id !== told.question.id)];
    this.replacedAt = now();
  }

  private async fetch(): Promise<void> {
    const { turn } = this;
    const listed = await this.io.load();
    if (turn !== this.turn) {
      // An answer was given meanwhile; when it is through, the list is asked for again.
      this.again = !this.sending;
      return;
    }
    const asked = listed.filter((question) => !this.settled.has(question.id));
    const shown = this.current;
    const still = shown && asked.find((question) => question.id === shown.id);
    this.waiting = still ? [still, ...asked.filter((question) => question !== still)] : asked;
    if (shown && !still) this.replacedAt = now();
    this.peak = asked.reduce((most, question) => Math.max(most, question.gain), this.peak);
    this.loaded = true;
    this.changed();
  }
}

const now = () => performance.now();

/** Whether an answer about labels settles another question about labels: all of its parts are among those alike. */
function answersToo(question: Question, choice: Choice, other: Question): boolean {
  if (question.kind !== "label" || other.kind !== "label" || choice === "skip" || choice === "unsure") return false;
  const changed = new Set([...question.parts, ...question.alike]);
  return other.parts.every((part) => changed.has(part));
}
