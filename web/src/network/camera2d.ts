// Which part of a drawing a pane shows: zoom and pan as numbers.

export interface Sheet {
  width: number;
  height: number;
}

/** A point p of the drawing appears at x + zoom * p [px]. */
export interface Frame2d {
  x: number;
  y: number;
  zoom: number;
}

export interface Box2d {
  x: number;
  y: number;
  width: number;
  height: number;
}

const MARGIN = 12; // px
const MOST = 12;
const READABLE = 0.45; // tags of 8 px are smaller than 4 px below this

/** The whole drawing in the middle of the pane. */
export function fitted(sheet: Sheet, pane: Sheet): Frame2d {
  const room = { width: Math.max(1, pane.width - 2 * MARGIN), height: Math.max(1, pane.height - 2 * MARGIN) };
  const zoom = Math.min(room.width / sheet.width, room.height / sheet.height, 3);
  return { zoom, x: (pane.width - zoom * sheet.width) / 2, y: (pane.height - zoom * sheet.height) / 2 };
}

/** What is seen first: all of it, or where that would be too small to read, its upper part over the whole width. */
export function opened(sheet: Sheet, pane: Sheet): Frame2d {
  const whole = fitted(sheet, pane);
  const zoom = Math.min(1, (pane.width - 2 * MARGIN) / sheet.width);
  return whole.zoom >= READABLE || zoom <= whole.zoom ? whole : { zoom, x: (pane.width - zoom * sheet.width) / 2, y: 0 };
}

/** Larger or smaller by a factor, with the point under the pointer kept where it is. */
export function zoomed(frame: Frame2d, factor: number, x: number, y: number, least: number): Frame2d {
  const zoom = Math.min(MOST, Math.max(least, frame.zoom * factor));
  const share = zoom / frame.zoom;
  return { zoom, x: x - share * (x - frame.x), y: y - share * (y - frame.y) };
}

/** Shows a box: as it is where it is in sight already, else in the middle; never so near that its surroundings are lost. */
export function showing(frame: Frame2d, box: Box2d, sheet: Sheet, pane: Sheet, closer: boolean): Frame2d {
  const left = frame.x + frame.zoom * box.x;
  const top = frame.y + frame.zoom * box.y;
  const right = left + frame.zoom * box.width;
  const bottom = top + frame.zoom * box.height;
  const inside = left >= MARGIN && top >= MARGIN && right <= pane.width - MARGIN && bottom <= pane.height - MARGIN;
  if (!closer && inside && frame.zoom > 0.45) return frame;
  const largest = Math.min((0.8 * pane.width) / Math.max(box.width, 1), (0.8 * pane.height) / Math.max(box.height, 1));
  const zoom = Math.min(largest, closer ? Math.max(frame.zoom, 1.6) : Math.max(frame.zoom, 0.9));
  return {
    zoom,
    x: within(pane.width / 2 - zoom * (box.x + box.width / 2), zoom * sheet.width, pane.width),
    y: within(pane.height / 2 - zoom * (box.y + box.height / 2), zoom * sheet.height, pane.height),
  };
}

/** No empty paper beside a drawing that is larger than the pane; a smaller one stands in the middle. */
function within(at: number, size: number, room: number): number {
  return size <= room ? (room - size) / 2 : Math.min(0, Math.max(room - size, at));
}
