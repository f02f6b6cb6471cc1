// Every named scene has the same bits here as natively, after 300 steps.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { test } from "node:test";
import { World, document, init, scenes } from "../dist/index.js";

const STEPS = 300;
const program = process.env.TAUTLINE;

/** What `tautline run` says of a scene after so many steps. */
function native(name, seconds) {
  const summary = execFileSync(program, ["run", name, "--seconds", String(seconds), "--threads", "1", "--json"]);
  return JSON.parse(summary.toString()).state_hash;
}

await init();
for (const { name } of scenes()) {
  test(name, { skip: program === undefined && "TAUTLINE names no program" }, () => {
    const world = new World(document(name));
    for (let i = 0; i < STEPS; i++) world.step();
    assert.equal(world.stateHash(), native(name, STEPS * world.dt));
    world.dispose();
  });
}
