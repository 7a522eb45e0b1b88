// Online3DViewer with plant.glb, as its documentation embeds it.
import * as OV from "online-3d-viewer";

const element = document.getElementById("view");
const viewer = new OV.EmbeddedViewer(element, {
  backgroundColor: new OV.RGBAColor(255, 255, 255, 255),
  onModelLoaded: () => { window.loaded = performance.now(); },
});
viewer.LoadModelFromUrlList(["plant.glb"]);
window.pickAt = (x, y) => {
  const start = performance.now();
  const hit = viewer.GetViewer().GetMeshIntersectionUnderMouse(OV.IntersectionMode.MeshOnly, { x, y });
  return { ms: performance.now() - start, hit: hit !== null };
};
