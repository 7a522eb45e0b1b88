// xeokit with plant.xkt, as its documentation loads it.
import { Viewer, XKTLoaderPlugin } from "@xeokit/xeokit-sdk";

const viewer = new Viewer({ canvasId: "canvas", transparent: true });
const model = new XKTLoaderPlugin(viewer).load({ id: "plant", src: "plant.xkt", edges: true });
model.on("loaded", () => { viewer.cameraFlight.jumpTo(model); window.loaded = performance.now(); });
window.pickAt = (x, y) => {
  const start = performance.now();
  const hit = viewer.scene.pick({ canvasPos: [x, y] });
  return { ms: performance.now() - start, hit: !!(hit && hit.entity) };
};
