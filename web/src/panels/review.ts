// The review tab: one question at a time, big; keys answer it.

import { addCommands } from "../commands.ts";
import type { Content, Option, Question } from "../types.ts";
import type { Corrector } from "./corrector.ts";
import { el, fill, put } from "../dom.ts";
import { bar, swatch } from "./widgets.ts";
import type { LabelChoice, Page } from "./page.ts";
import { button } from "./pieces.ts";
import { choiceWords, Queue, type Choice } from "./queue.ts";
import { uncovering } from "../seen.ts";
import { count, labelOf, meshName, percent, sentence, upper, whole } from "./words.ts";

const LIMIT = 50;
/** A key pressed right after the question was replaced was meant for the one before [ms]. */
const CALM = 500;
/** Below this share of the greatest gain a question is hardly worth its time. */
const LITTLE = 0.1;

export class Review {
  readonly element = el("div", { class: "review", "data-test": "review" });
  readonly queue: Queue;
  private readonly page: Page;
  private readonly told = el("p", { class: "only-read", role: "status", "aria-live": "polite" });
  private readonly card = el("div", {});
  private readonly changedCount: () => void;
  /** Whether the panel is unfolded: keys must not answer what nobody sees. */
  private readonly seen: () => boolean;
  private shownId = "";
  /** Whether the server had as many questions as were asked for. */
  private full = false;
  private trouble = "";

  constructor(page: Page, corrector: Corrector, changedCount: () => void, seen: () => boolean) {
    this.page = page;
    this.changedCount = changedCount;
    this.seen = seen;
    this.queue = new Queue({
      load: async () => {
        const listed = await page.source.review(LIMIT);
        this.full = listed.length >= LIMIT;
        return listed;
      },
      send: (question, choice) => corrector.answer(question, choice),
      takeBack: (version) => corrector.takeBack(version),
    }, () => this.changed());
    this.element.append(this.told, this.card);
    this.addKeys();
    // A change from elsewhere may settle questions, or raise new ones; own answers ask by themselves.
    page.store.on("content", () => {
      if (!this.queue.busy && page.store.shown.leftTab === "review") void this.load();
      else this.draw();
    });
    page.store.watch(["leftTab"], () => this.opened());
    let status = page.store.state?.status;
    page.store.on("state", (state) => {
      if (state.status === "ready" && status !== "ready") void this.load();
      status = state.status;
    });
  }

  /** The view is there now: what was asked before it is looked at. */
  viewed(): void {
    const { question } = this.page.store.shown;
    if (this.isOpen && question) this.look(question);
  }

  /** Wherever the camera was left, and whatever is hidden: who answers must see what is asked about. */
  private look(question: Question): void {
    const { content, shown } = this.page.store;
    if (content) this.page.store.set(uncovering(content, shown, question.parts));
    this.page.view?.flyTo(question.parts);
  }

  /** Asks for the list; a queue that can't be had is said in its place. */
  async load(): Promise<void> {
    if (this.page.store.state?.status !== "ready") return;
    try {
      await this.queue.load();
      this.trouble = "";
    } catch (error) {
      this.trouble = (error as Error).message;
    }
    this.changed();
  }

  /** How many are left, as the top bar says it; nothing while that is not known. */
  get left(): string {
    if (!this.queue.loaded) return "";
    // Where the list was full there are more than it holds, whatever was answered since.
    return this.full ? `${LIMIT}+` : String(this.queue.waiting.length);
  }

  private get isOpen(): boolean {
    return this.page.store.shown.leftTab === "review";
  }

  private opened(): void {
    if (!this.isOpen) {
      if (this.page.store.shown.question) this.page.store.set({ question: null });
      this.shownId = "";
      return;
    }
    void this.load();
  }

  private changed(): void {
    this.changedCount();
    this.draw();
    if (!this.isOpen) return;
    const question = this.queue.current;
    if ((question?.id ?? "") === this.shownId) {
      // The same question with newer rows is shown without moving the camera again.
      if (question && this.page.store.shown.question === null) this.show(question);
      return;
    }
    this.shownId = question?.id ?? "";
    this.show(question);
    if (!question) return;
    this.look(question);
    this.told.textContent = `${question.title} ${this.subject(question)}. ${question.options.map((option, i) => `${i + 1}: ${option.text}`).join(", ")}. ${this.left} left.`;
  }

  private show(question: Question | null): void {
    this.page.store.set({ question, ...(question ? { selection: question.parts, place: null } : {}) });
  }

  private again(question: Question): void {
    this.show(question);
    this.look(question);
  }

  private subject(question: Question): string {
    const content = this.page.store.content;
    if (!content || !question.parts.length) return "";
    const units = [
      ...new Set(question.parts.map((row) => content.network.units[content.parts.unit[row]]?.tag))
    ].filter(Boolean);
    const label = labelOf(content, question.parts[0]);
    if (!label.group && !units.length) return `No label (${meshName(content, question.parts[0])})`;
    return `${label.name}${units.length ? ` of ${units.slice(0, 3).join(", ")}` : ""}`;
  }

  answer(choice: Choice): void {
    if (performance.now() - this.queue.replacedAt < CALM) return;
    void this.queue.answer(choice);
  }

  private other(): void {
    const question = this.queue.current;
    const { content } = this.page.store;
    if (!question?.parts.length || !content) return;
    const offered = question.options.flatMap((option) => option.edits).flatMap(
      (edit): LabelChoice[] => (edit.kind === "label" ? [{ group: edit.group, name: edit.name }] : [])
    );
    this.page.pickLabel(`${question.title} (${this.subject(question)})`, offered, (choice) => {
      if (this.queue.current?.id !== question.id) return;
      // As the options do: these parts and those alike, and no other.
      const rows = question.kind === "label" ? [...question.parts, ...question.alike] : question.parts.slice(0, 1);
      const edits = rows.map(
        (row) => ({ kind: "label" as const, part: content.parts.id[row], ...choice, this_only: true })
      );
      void this.queue.answer({ text: choice.name ?? choice.group, edits });
    });
  }

  private async back(): Promise<void> {
    if (!this.queue.past.length) this.page.say("There is no answer to take back.");
    else await this.queue.back();
  }

  private addKeys(): void {
    const when = () => this.isOpen && this.seen() && this.queue.current !== null && this.page.canEdit();
    for (const key of [1, 2, 3, 4, 5]) {
      addCommands(
        {
          id: `review-${key}`, key: String(key), title: "Take this answer", area: "Review",
          when: () => when() && this.queue.current!.options.length >= key, run: () => this.answer(key - 1)
        }
      );
    }
    addCommands(
      { id: "review-other", key: "o", title: "Another label", area: "Review", when, run: () => this.other() },
      {
        id: "review-unsure", key: "u", title: "I am not sure: leave it as it is", area: "Review", when,
        run: () => this.answer("unsure")
      },
      {
        id: "review-skip", key: "s", title: "Skip: ask me later", area: "Review", when, run: () => this.answer("skip")
      },
      {
        id: "review-back", key: "Backspace", title: "Back: take the last answer back", area: "Review",
        when: () => this.isOpen && this.seen() && this.page.canEdit() && this.queue.past.length > 0,
        run: () => void this.back()
      });
  }

  private draw(): void {
    const { content } = this.page.store;
    if (!content || !this.isOpen) return;
    const key = this.element.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset.key : undefined;
    const question = this.queue.current;
    if (this.trouble && !question) fill(
      this.card,
      el(
        "div", { class: "empty" }, el("p", {}, this.trouble),
        button("Ask again", "Ask for the queue again", () => void this.load())
      )
    );
    else if (!this.queue.loaded) fill(this.card, el("p", { class: "empty" }, "Looking for what is most worth a look…"));
    else if (question) fill(
      this.card, this.progress(), this.lastLine(), this.question(content, question), this.next(content)
    );
    else fill(this.card, this.done());
    if (key) this.element.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
  }

  private progress(): HTMLElement {
    const { decided, waiting } = this.queue;
    return el("div", { class: "spread review-progress" },
      el("b", { "data-test": "review-left" }, `${this.left} left`),
      el(
        "span", { class: "soft", "data-test": "review-done" },
        decided ? `${whole(decided)} answered` : "most worth a look first"
      ),
      bar(decided / Math.max(decided + waiting.length, 1), `${decided} answered, ${this.left} left`));
  }

  /** What became of the last answer. */
  private lastLine(): HTMLElement | null {
    const last = this.queue.past.at(-1);
    if (!last) return null;
    const words = last.message && typeof last.choice !== "string" ? last.message : `${upper(choiceWords(last.question, last.choice))}.`;
    return el("div", { class: "spread last-answer" },
      el("span", { class: "grow", "data-test": "review-last" }, `✓ ${words}`),
      this.page.canEdit() && button(
        "Back", "Take it back and ask again (Backspace)", () => void this.back(), "review-back", "quiet"
      ));
  }

  private question(content: Content, question: Question): HTMLElement {
    const share = question.gain / Math.max(this.queue.peak, 1e-9);
    const label = question.parts.length ? labelOf(content, question.parts[0]) : null;
    const row = question.parts[0];
    const can = this.page.canEdit();
    return el("section", {
      class: "question", "aria-label": "Question", "data-test": "question", "data-id": question.id
    },
      el("h2", { "data-test": "question-title" }, question.title),
      label && el(
        "p", { class: "subject" }, swatch(label.color, content.parts.state[row]),
        el("span", {}, `${question.kind === "label" ? "Now: " : ""}${this.subject(question)}`)
      ),
      el("p", { class: "why-line", "data-test": "question-why" }, sentence(question.why)),
      el("div", { class: "spread gain" }, el("span", { class: "soft" }, "Gain"),
        bar(share, `Gain ${percent(share)} of the greatest`),
        el(
          "span", { class: "soft", "data-test": "alike" },
          question.alike.length ? `settles ${whole(question.alike.length)} more like it` : "this one alone"
        )),
      share < LITTLE && el(
        "p", { class: "soft", "data-test": "little-gain" }, "What is left gains little; you can well stop here."
      ),
      can ? this.options(content, question) : el(
        "p", { class: "soft" }, "Answers can't be taken: the plant is for looking only."
      ),
      can && el("div", { class: "buttons", role: "group", "aria-label": "Other answers" },
        question.parts.length > 0 && keyed("o", "Other…", "Choose any label (o)", () => this.other(), "review-other"),
        keyed("u", "Not sure", "Leave it as it is, don't ask again (u)", () => this.answer("unsure"), "review-unsure"),
        keyed("s", "Skip", "Ask me later (s)", () => this.answer("skip"), "review-skip")),
      el(
        "button",
        { type: "button", class: "link", "data-key": "review-look", onclick: () => this.again(question) },
        "Show it again"
      ));
  }

  private options(content: Content, question: Question): HTMLElement {
    const list = el("div", { class: "options", role: "group", "aria-label": "Answers" });
    if (question.options.some((option) => option.confidence !== null)) {
      put(list, el("p", { class: "soft option-head" }, el("span", {}, "It is"), el("span", {}, "by all evidence")));
    }
    question.options.slice(0, 5).forEach((option, i) => {
      const edit = option.edits.find((edit) => edit.kind === "label");
      const color = edit?.kind === "label" ? (
        content.groups.find((group) => group.name === edit.group)?.color ?? null
      ) : null;
      put(list, el("button", {
        type: "button", class: "option-button", "data-test": `option-${i + 1}`, "data-key": `option-${i + 1}`,
        "aria-keyshortcuts": String(i + 1), onclick: () => this.answer(i)
      },
        el("kbd", {}, String(i + 1)), color && swatch(color, "sure"), optionText(option),
        option.confidence !== null && bar(option.confidence, percent(option.confidence)),
        option.confidence !== null && el("span", { class: "number" }, percent(option.confidence))));
    });
    return list;
  }

  private next(content: Content): HTMLElement | null {
    const next = this.queue.waiting.slice(1, 9);
    if (!next.length) return null;
    return el("section", { "aria-label": "Next" }, el("h3", {}, "Next"),
      el("ul", { class: "rows" }, ...next.map((question) => {
        const row = question.parts[0];
        return el("li", {}, el("button",
          {
            type: "button", class: "row", "data-test": "next-question", title: "Answer this one first",
            onclick: () => this.queue.show(question.id)
          },
          swatch(
            row === undefined ? null : labelOf(content, row).color,
            row === undefined ? "open" : content.parts.state[row]
          ),
          el(
            "span", { class: "grow" }, this.subject(question) || question.title
          ), question.alike.length > 0 && el("span", { class: "soft" }, `+${whole(question.alike.length)}`)));
      })));
  }

  private done(): HTMLElement {
    const { decided, past } = this.queue;
    const skipped = past.filter((past) => past.choice === "skip").length;
    return el("div", { class: "empty done", "data-test": "review-empty" },
      el("h2", {}, decided ? "All reviewed" : "Nothing to ask"),
      el(
        "p", {},
        decided ? `${count(decided, "answer")} given${skipped ? `, ${skipped} skipped` : ""}. Nothing in this plant is worth another look.` : "No label and no joint of this plant is worth a question."
      ),
      past.length > 0 && this.page.canEdit() && button(
        "Back to the last one", "Take the last answer back (Backspace)", () => void this.back(), "review-back"
      ),
      el(
        "p", { class: "soft" },
        "Corrections are kept in the plant's folder. The warnings tab lists what the network still lacks."
      ));
  }
}

/** "valve body (Valve assembly)" with the group beneath it. */
function optionText(option: Option): HTMLElement {
  const edit = option.edits.find((edit) => edit.kind === "label");
  const group = edit?.kind === "label" && edit.name !== null ? edit.group : "";
  const name = option.text.endsWith(` (${group})`) ? option.text.slice(0, -group.length - 3) : option.text;
  return el(
    "span", { class: "grow" }, upper(name), name !== option.text && el("span", { class: "soft small-line" }, group)
  );
}

function keyed(key: string, text: string, title: string, run: () => void, test: string): HTMLElement {
  return el(
    "button", { type: "button", title, "aria-keyshortcuts": key, "data-test": test, "data-key": test, onclick: run },
    el("kbd", {}, key.toUpperCase()), text
  );
}
