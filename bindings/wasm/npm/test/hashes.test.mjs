// A scene of each kind has the same bits here as natively, after 300 steps. The playground's tests go through all that
// there are, in a browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { test } from "node:test";
import { World, document, init, scenes } from "../dist/index.js";

const STEPS = 300;
const SCENES = ["icosahedra", "hammock", "ragdoll", "jelly", "tear", "tower"];
const program = process.env.TAUTLINE;

/** What `tautline run` says of a scene after so many steps. */
function native(name, seconds) {
  const summary = execFileSync(program, ["run", name, "--seconds", String(seconds), "--threads", "1", "--json"]);
  return JSON.parse(summary.toString()).state_hash;
}

await init();
test("the scenes are there", () => {
  const names = scenes().map((scene) => scene.name);
  assert.deepEqual(SCENES.filter((name) => !names.includes(name)), []);
});

for (const name of SCENES) {
  test(name, { skip: program === undefined && "TAUTLINE names no program" }, () => {
    const world = new World(document(name));
    for (let i = 0; i < STEPS; i++) world.step();
    assert.equal(world.stateHash(), native(name, STEPS * world.dt));
    world.dispose();
  });
}
