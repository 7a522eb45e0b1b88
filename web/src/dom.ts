// Elements made from code: text is always text, never markup.

export type Child = Node | string | number | null | undefined | false;
export type Handler = (event: any) => void;
export type Value = string | number | boolean | null | undefined | Handler;

/**
 * Makes an element: `on...` are listeners, true sets an attribute, false, null and undefined leave it out, `text` is its
 * text, `value` what an input holds.
 */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K, given: Record<string, Value> = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  const { text, value, ...rest } = given;
  assign(made, rest);
  if (text !== undefined) made.textContent = String(text ?? "");
  if (value !== undefined) (made as HTMLInputElement).value = String(value ?? "");
  put(made, ...children);
  return made;
}

/** The same for what is drawn. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K, given: Record<string, Value> = {}, ...children: Node[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  assign(made, given);
  made.append(...children);
  return made;
}

function assign(made: Element, given: Record<string, Value>): void {
  for (const [key, value] of Object.entries(given)) {
    if (typeof value === "function") made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, String(value));
  }
}

/** Appends what is something. */
export function put(to: Element, ...children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    to.append(child instanceof Node ? child : String(child));
  }
}

/** Puts these in the place of what was in it. */
export function fill(to: Element, ...children: Child[]): void {
  to.replaceChildren();
  put(to, ...children);
}
