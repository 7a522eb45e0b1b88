// What lies over the plant to work with it: toolbar, colours, section, measuring, directions.

import type { Store } from "../store.ts";
import { axesWidget } from "./axes.ts";
import { el } from "../dom.ts";
import { explodePanel } from "./explode_panel.ts";
import { legendPanel } from "./legend.ts";
import { MeasureTool } from "./measure_tool.ts";
import type { PlantView } from "./plant_view.ts";
import { sectionPanel } from "./section.ts";
import { toolbar } from "./toolbar.ts";
import { addViewCommands } from "./view_commands.ts";

export interface Tools {
  /** A click that a tool takes; false where it is none of its business. */
  clicked(x: number, y: number): boolean;
  hovered(x: number, y: number): boolean;
}

export function addTools(view: PlantView, store: Store): Tools {
  const measuring = new MeasureTool(view, store);
  addViewCommands(view, store, measuring);
  const cards = el("div", { class: "scene-cards" }, measuring.panel, explodePanel(view, store), sectionPanel(view, store));
  const foot = el("div", { class: "scene-foot" }, cards, toolbar(view, store));
  view.element.append(measuring.overlay, legendPanel(view, store), axesWidget(view), foot);
  return measuring;
}
