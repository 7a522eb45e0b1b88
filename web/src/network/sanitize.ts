// The schematic comes as text that holds names from CAD files: only what our drawing uses is copied out of it.

const SVG = "http://www.w3.org/2000/svg";

/** What is needed of a parsed node; a browser's Node is one. */
export interface ReadNode {
  readonly nodeType: number;
  readonly nodeValue: string | null;
  readonly localName?: string;
  readonly namespaceURI?: string | null;
  readonly attributes?: ArrayLike<{ readonly name: string; readonly value: string }>;
  readonly childNodes: ArrayLike<ReadNode>;
}

/** What makes the copy; a browser's document is one. */
export interface Maker<E> {
  element(name: string): E;
  attribute(element: E, name: string, value: string): void;
  append(element: E, child: E | string): void;
}

const NUMBER = String.raw`[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?`;
const LENGTH = new RegExp(`^${NUMBER}%?$`, "i");
const NUMBERS = new RegExp(`^\\s*(?:${NUMBER}[\\s,]*)*$`, "i");
const PATH = /^[MLHVCSQTAZmlhvcsqtaz\d\s,.eE+-]*$/;
const TRANSFORM = new RegExp(`^\\s*(?:(?:translate|rotate|scale)\\(\\s*(?:${NUMBER}[\\s,]*)+\\)\\s*)*$`, "i");
const CLASSES = /^[a-z][a-z0-9 _-]*$/i;
const ANY = /^[^]*$/;

const EVERYWHERE: Record<string, RegExp> = {
  class: CLASSES, transform: TRANSFORM, "data-id": ANY, "data-line": ANY, "data-connection": /^\d+( \d+)*$/,
};
const ALLOWED: Record<string, Record<string, RegExp>> = {
  svg: { width: LENGTH, height: LENGTH, viewBox: NUMBERS },
  g: {},
  title: {},
  path: { d: PATH },
  circle: { cx: LENGTH, cy: LENGTH, r: LENGTH },
  rect: { x: LENGTH, y: LENGTH, width: LENGTH, height: LENGTH, rx: LENGTH },
  polygon: { points: NUMBERS },
  polyline: { points: NUMBERS },
  line: { x1: LENGTH, y1: LENGTH, x2: LENGTH, y2: LENGTH },
  text: { x: LENGTH, y: LENGTH, "font-size": LENGTH },
  tspan: { x: LENGTH, y: LENGTH },
};
const WITH_TEXT = new Set(["text", "tspan", "title"]);
const DEEPEST = 40;

/** Whether an element of our drawing may have an attribute with this value. */
export function isAllowed(element: string, name: string, value: string): boolean {
  const rules = Object.hasOwn(ALLOWED, element) ? ALLOWED[element] : null;
  if (!rules) return false;
  const rule = Object.hasOwn(rules, name) ? rules[name] : Object.hasOwn(EVERYWHERE, name) ? EVERYWHERE[name] : null;
  return rule !== null && rule.test(value);
}

/** A copy of an element with what is allowed in it; null for anything else. */
export function cleanCopy<E>(source: ReadNode, maker: Maker<E>, depth = 0): E | null {
  const name = source.localName ?? "";
  if (source.nodeType !== 1 || source.namespaceURI !== SVG || !Object.hasOwn(ALLOWED, name) || depth > DEEPEST) return null;
  const copy = maker.element(name);
  for (const { name: key, value } of Array.from(source.attributes ?? [])) {
    if (isAllowed(name, key, value)) maker.attribute(copy, key, value);
  }
  for (const child of Array.from(source.childNodes)) {
    if (child.nodeType === 1) {
      const inner = cleanCopy(child, maker, depth + 1);
      if (inner !== null) maker.append(copy, inner);
    } else if (child.nodeType === 3 && WITH_TEXT.has(name)) {
      maker.append(copy, child.nodeValue ?? "");
    }
  }
  return copy;
}

const inDocument: Maker<SVGElement> = {
  element: (name) => document.createElementNS(SVG, name) as SVGElement,
  attribute: (element, name, value) => element.setAttribute(name, value),
  append: (element, child) => element.append(child),
};

/** The drawing of an SVG text, safe to put into the page; null where the text is no drawing. */
export function readDrawing(text: string): SVGSVGElement | null {
  const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  if (root.localName !== "svg") return null;
  return cleanCopy(root as unknown as ReadNode, inDocument) as SVGSVGElement | null;
}
