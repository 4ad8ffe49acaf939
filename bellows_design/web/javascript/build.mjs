/* Bundles source/ and three.js into ../assets/viewer.js, one file without imports. */

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { copyFileSync, readdirSync, readFileSync } from "node:fs";

const SOURCES = [
  "build.mjs",
  "package.json",
  "package-lock.json",
  ...readdirSync("source").sort().map((name) => `source/${name}`),
];

/* The test tests/bellows_design/web/test_bundle.py computes the same. */
const hash = createHash("sha256");
for (const name of SOURCES) hash.update(`${name}\n`).update(readFileSync(name)).update("\n");

await build({
  entryPoints: ["source/index.js"],
  outfile: "../assets/viewer.js",
  bundle: true,
  minify: true,
  format: "iife",
  globalName: "Bellows",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  banner: {
    js:
      `/* bellows-design viewer, MIT; contains three.js, MIT (LICENSE.three.txt):\n` +
      ` * Copyright 2010-2026 three.js authors. Built from javascript/ by npm run build.\n` +
      ` * sources sha256 ${hash.digest("hex")} */`,
  },
});
copyFileSync("node_modules/three/LICENSE", "../assets/LICENSE.three.txt");
