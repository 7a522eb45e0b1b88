// Light or dark: as the system is, until the person chooses.

import type { Store } from "../store.ts";
import { remember, remembered } from "./page.ts";

export function followTheme(store: Store): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const chosen = remembered("theme");
  const apply = () => (document.documentElement.dataset.theme = store.shown.theme);
  store.watch(["theme"], apply);
  store.set({ theme: chosen === "dark" || chosen === "light" ? chosen : dark.matches ? "dark" : "light" });
  apply();
  dark.addEventListener("change", () => {
    if (!remembered("theme")) store.set({ theme: dark.matches ? "dark" : "light" });
  });
}

export function switchTheme(store: Store): void {
  const theme = store.shown.theme === "dark" ? "light" : "dark";
  remember("theme", theme);
  store.set({ theme });
}
