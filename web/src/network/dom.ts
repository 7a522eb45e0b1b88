// Elements made from code: text is always text, never markup.

type Props = Record<string, string | boolean | ((event: Event) => void) | undefined>;
type Child = Node | string | null | undefined | false;

/** An element with attributes, listeners (`onclick: ...`) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  name: K, props: Props = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(props)) {
    if (typeof value === "function") element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value !== undefined) element.setAttribute(key, value);
  }
  for (const child of children) if (child !== null && child !== undefined && child !== false) element.append(child);
  return element;
}

/** What is pressed in an element is not pressed on what lies below it. */
export function keepPresses(element: HTMLElement): void {
  for (const name of ["pointerdown", "click", "dblclick"]) element.addEventListener(name, (event) => event.stopPropagation());
  // A drag that began elsewhere goes on over it.
  element.addEventListener("pointermove", (event) => {
    if (!event.buttons) event.stopPropagation();
  });
}

const SVG = "http://www.w3.org/2000/svg";

export function svg<K extends keyof SVGElementTagNameMap>(
  name: K, attributes: Record<string, string>, ...children: Node[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}
