// The address follows what is shown, and the other way round; copying it for somebody else.

import { openDialog } from "./dialog.ts";
import { el } from "../dom.ts";
import { decode, encode } from "./link.ts";
import type { Page } from "./page.ts";
import { button } from "./pieces.ts";

const SHOWN = ["camera", "selection", "place", "colorBy", "hidden", "isolated", "ghost", "section", "leftTab"] as const;

export class Address {
  private readonly page: Page;
  private due = 0;
  private written = "";

  constructor(page: Page) {
    this.page = page;
  }

  /** What the address asks for is shown; then it follows. The content must be there. */
  start(): void {
    if (location.hash.length > 1) this.read(location.hash);
    this.page.store.watch([...SHOWN], () => {
      clearTimeout(this.due);
      this.due = window.setTimeout(() => this.write(), 300);
    });
    addEventListener("hashchange", () => {
      if (location.hash.slice(1) !== this.written) this.read(location.hash);
    });
  }

  /** Shows what a link asks for, in one change. */
  read(fragment: string): void {
    const { store } = this.page;
    if (store.content) store.set(decode(fragment, store.content));
  }

  private write(): void {
    const { fragment } = encode(this.page.store.shown);
    if (fragment === this.written) return;
    this.written = fragment;
    try {
      history.replaceState(history.state, "", `#${fragment}`);
    } catch {
      // Browsers limit how often the address may change; the next change writes it.
    }
  }

  /** A window with this view's link: for a colleague, for this computer, and a field to go to one. */
  open(): void {
    const { store, source } = this.page;
    if (this.page.view) store.set({ camera: this.page.view.getCamera() });
    const { fragment, left } = encode(store.shown);
    const folder = store.state?.folder || "the folder";
    const title = store.content?.title ?? "the plant";
    const place = source.live ? `View of ${title}. Run: cadgraph view ${folder}\nThen press k there and paste this link:\n#${fragment}` : `${location.href.split("#")[0]}#${fragment}`;
    const input = el(
      "input",
      {
        type: "text", class: "wide", placeholder: "Paste a link: #at=…", "aria-label": "Link to go to",
        "data-test": "link-input"
      }
    );
    const text = el(
      "textarea", { readonly: true, rows: 5, class: "wide", "aria-label": "Link", "data-test": "link-text" }, place
    );
    const go = () => {
      const at = input.value.indexOf("#");
      if (at < 0) return void (trouble.textContent = "A link has a “#”, and what is shown after it.");
      dialog.close();
      this.read(input.value.slice(at).split(/\s/)[0]);
    };
    const trouble = el("p", { class: "trouble", role: "alert" });
    input.addEventListener("keydown", (event) => event.key === "Enter" && go());
    const dialog = openDialog("Link to this view", [
      el("p", {}, source.live
        ? "For a colleague who has the folder: camera, selection, colours, section and what is hidden go with it. It holds no key to this page."
        : "This file and what is shown of it: send the file along."),
      text,
      left ? el(
        "p", { class: "trouble", "data-test": "link-left" }, `Too many parts for a link: ${left} did not go into it.`
      ) : null,
      el("div", { class: "buttons" }, button("Copy", "Copy the link", () => void this.copy(place), "link-copy", "main"),
        source.live ? button(
          "Copy this page's address",
          "Works on this computer while this server runs; it holds the key to the plant, so don't send it",
          () => void this.copy(`${location.href.split("#")[0]}#${fragment}`), "address-copy"
        ) : null),
      el("h3", {}, "Go to a link"), el(
        "div", { class: "spread" }, input, button("Go", "Show what the link shows", go, "link-go")
      ), trouble,
    ].filter((node) => node !== null), "link");
    dialog.querySelector<HTMLElement>("[data-test=link-copy]")?.focus();
  }

  private async copy(text: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      this.page.say("Copied.", "good");
    } catch {
      this.page.say("The browser does not let the page copy: select the text and press Ctrl+C.", "bad");
    }
  }
}
