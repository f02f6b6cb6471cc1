// Every scene of the gallery: it runs without a complaint, is seen, and ends with the same bits as the program's.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { after, before, test } from "node:test";
import { promisify } from "node:util";

import { launch, openPage, serve } from "./browser.mjs";
import { hash, open, picture, ready, screenshot, step } from "./page.mjs";

const DIST = new URL("../dist", import.meta.url).pathname;
/** The command line, built with optimisation. */
const TAUTLINE = process.env.TAUTLINE ?? new URL("../../target/release/tautline", import.meta.url).pathname;
const STEPS = 300;

let browser, server, page, complaints;

before(async () => {
  [browser, server] = await Promise.all([launch(), serve(DIST)]);
  ({ page, complaints } = await openPage(browser, server.address, { width: 800, height: 420 }));
  await page.goto(server.address);
  await ready(page);
});

after(async () => {
  await browser.close();
  server.close();
});

/** The state after so many steps of the program. */
async function native(name, dt) {
  const seconds = String(Math.fround(STEPS * dt));
  const { stdout } = await promisify(execFile)(TAUTLINE, ["run", name, "--seconds", seconds, "--threads", "1", "--json"]);
  const summary = JSON.parse(stdout);
  assert.equal(summary.steps, STEPS, name);
  return summary.state_hash;
}

test("every scene runs, is seen, and has the program's bits after 300 steps", async (t) => {
  const scenes = await page.evaluate(() => window.playground.hello.scenes.map((scene) => scene.name));
  assert.ok(scenes.length >= 27, "the whole registry");
  for (const name of scenes) {
    await t.test(name, async () => {
      await open(page, name);
      const dt = await page.evaluate(() => window.playground.opened.dt);
      const expected = existsSync(TAUTLINE) ? native(name, dt) : undefined;
      await step(page, 120);
      const { drawn, colors } = await picture(page);
      assert.ok(drawn > 0.02 && colors > 12, `${name}: ${drawn} of the picture, ${colors} colours`);
      await screenshot(page, `scene-${name}`);
      await step(page, STEPS - 120);
      if (expected) assert.equal(await hash(page), await expected, `${name}: the state after ${STEPS} steps`);
      assert.deepEqual(complaints.splice(0), []);
      const thumbnail = page.locator(`.card[data-scene="${name}"] img`);
      await thumbnail.scrollIntoViewIfNeeded();
      await page.waitForFunction((image) => image.complete && image.naturalWidth > 0, await thumbnail.elementHandle());
    });
  }
});
