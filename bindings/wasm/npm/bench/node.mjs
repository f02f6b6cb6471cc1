// Times of steps in Node beside those of the native program on one thread, which TAUTLINE names.
import { execFileSync } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import * as tautline from "../dist/index.js";
import { measure, scenesOf, STEPS } from "./scenes.mjs";

await tautline.init();
const folder = mkdtempSync(join(tmpdir(), "tautline-"));
const best = (times) => Math.min(...times);

for (const [name, scene] of scenesOf(tautline)) {
  const file = join(folder, "scene.json");
  writeFileSync(file, JSON.stringify(scene));
  const options = ["run", file, "--seconds", String(STEPS * scene.dt), "--threads", "1", "--json"];
  const [here, native] = [[], []];
  // In turn, so that both have the machine as it is.
  for (let i = 0; i < 5; i++) {
    here.push(measure(tautline.World, scene, STEPS).time);
    if (process.env.TAUTLINE !== undefined) {
      const summary = JSON.parse(execFileSync(process.env.TAUTLINE, options).toString());
      native.push(summary.ms_per_step);
    }
  }
  const ratio = native.length === 0 ? "" : `, native ${best(native).toFixed(3)} ms: ${(best(here) / best(native)).toFixed(2)} ×`;
  console.log(`${name}: ${best(here).toFixed(3)} ms${ratio}`);
}
