// Bundles the page into the Python package: node build.mjs [FOLDER]. The same sources give the same bytes.
import { build } from "esbuild";
import { copyFile, mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { dirname, join, resolve } from "node:path";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ? resolve(process.argv[2]) : join(here, "../src/cadgraph/draw/web/page");

await mkdir(target, { recursive: true });
await build({
  absWorkingDir: here,
  entryPoints: { viewer: "src/main.ts" },
  outdir: target,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  legalComments: "none",
  banner: { js: "/* cadgraph viewer, Apache-2.0; with three.js and three-mesh-bvh, both MIT: see THIRD_PARTY.txt */" },
  charset: "ascii",
  logLevel: "warning",
});
await copyFile(join(here, "index.html"), join(target, "index.html"));
await copyFile(join(here, "THIRD_PARTY.txt"), join(target, "THIRD_PARTY.txt"));
