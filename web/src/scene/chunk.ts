// The binary form of shapes, as draw/web/packing.py writes it.

const MAGIC = 0x43474348;
const HEAD = 8;
const ROW = 48;

/** One form of a shape; the arrays are views into the chunk. */
export interface ShapeForm {
  shape: number;
  level: 0 | 1;
  /** Three per vertex; a vertex lies at low + step * value. */
  positions: Uint16Array;
  /** Two per vertex: octahedral unit normals. */
  normals: Int8Array;
  indices: Uint16Array | Uint32Array;
  low: [number, number, number];
  step: [number, number, number];
}

/** The shapes of a chunk; throws where it is none or is cut off. */
export function decodeChunk(buffer: ArrayBuffer): ShapeForm[] {
  const view = new DataView(buffer);
  if (buffer.byteLength < HEAD || view.getUint32(0, true) !== MAGIC) throw new Error("this is no chunk of shapes");
  const n = view.getUint32(4, true);
  if (HEAD + n * ROW > buffer.byteLength) throw new Error("a chunk of shapes is cut off");
  const found: ShapeForm[] = [];
  for (let i = 0; i < n; i++) found.push(decodeRow(buffer, view, HEAD + i * ROW));
  return found;
}

function decodeRow(buffer: ArrayBuffer, view: DataView, at: number): ShapeForm {
  const [shape, level, vertices, count, offset, flags] = [0, 4, 8, 12, 16, 20].map((k) => view.getUint32(at + k, true));
  const wide = (flags & 1) !== 0;
  const normalsAt = offset + padded(6 * vertices);
  const indicesAt = normalsAt + padded(2 * vertices);
  if (indicesAt + (wide ? 4 : 2) * count > buffer.byteLength) throw new Error("a chunk of shapes is cut off");
  return {
    shape,
    level: level === 0 ? 0 : 1,
    positions: new Uint16Array(buffer, offset, 3 * vertices),
    normals: new Int8Array(buffer, normalsAt, 2 * vertices),
    indices: wide ? new Uint32Array(buffer, indicesAt, count) : new Uint16Array(buffer, indicesAt, count),
    low: triple(view, at + 24),
    step: triple(view, at + 36),
  };
}

function triple(view: DataView, at: number): [number, number, number] {
  return [view.getFloat32(at, true), view.getFloat32(at + 4, true), view.getFloat32(at + 8, true)];
}

function padded(bytes: number): number {
  return (bytes + 3) & ~3;
}

/** A unit vector from its octahedral form. */
export function decodeNormal(a: number, b: number): [number, number, number] {
  let x = Math.max(a / 127, -1);
  let y = Math.max(b / 127, -1);
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const turned = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - Math.abs(x)) * (y < 0 ? -1 : 1);
    x = turned;
  }
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}
