// The examples of the npm package, and the page that measures it, as somebody opens them who has just built it.

import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";

import { launch, openPage, serve } from "./browser.mjs";
import { screenshot } from "./page.mjs";

const PACKAGE = new URL("../../bindings/wasm/npm", import.meta.url).pathname;
const SIZE = { width: 700, height: 500 };

let browser, server, page, context, complaints;

before(async () => {
  [browser, server] = await Promise.all([launch(), serve(PACKAGE)]);
});

after(async () => {
  await browser.close();
  server.close();
});

/** Opens a page of the package. */
async function visit(file) {
  ({ page, context, complaints } = await openPage(browser, server.address, SIZE));
  // The browser asks for one by itself.
  await page.route("**/favicon.ico", (route) => route.fulfill({ status: 204 }));
  await page.goto(server.address + file);
}

afterEach(async () => {
  assert.deepEqual(complaints, [], "no errors, no warnings, no requests elsewhere");
  await context.close();
});

/** How many colours there are in what the page looks like. */
async function colors() {
  const shot = (await page.screenshot()).toString("base64");
  return page.evaluate(async (shot) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${shot}`)).blob());
    const context = new OffscreenCanvas(175, 125).getContext("2d");
    context.drawImage(bitmap, 0, 0, 175, 125);
    const { data } = context.getImageData(0, 0, 175, 125);
    const found = new Set();
    for (let k = 0; k < data.length; k += 4) found.add((data[k] >> 4) * 256 + (data[k + 1] >> 4) * 16 + (data[k + 2] >> 4));
    return found.size;
  }, shot);
}

test("hello writes down how a ball falls and bounces", async () => {
  await visit("examples/hello.html");
  await page.waitForFunction(() => document.getElementById("out").textContent.split("\n").length > 13);
  const lines = (await page.locator("#out").innerText()).trim().split("\n");
  const heights = lines.map((line) => Number(/([\d.]+) m$/.exec(line)[1]));
  assert.equal(heights[0], 5);
  assert.ok(Math.min(...heights) > 0.49, `${heights}: not into the ground`);
  assert.ok(heights.some((height, i) => i > 0 && height > heights[i - 1]), `${heights}: up again`);
});

test("a scene in a worker is drawn without a library", async () => {
  await visit("examples/scene.html");
  const drawn = () => page.evaluate(() => document.getElementById("canvas").toDataURL());
  await page.waitForFunction(() => document.getElementById("canvas").toDataURL().length > 20_000);
  const before = await drawn();
  await page.waitForFunction((before) => document.getElementById("canvas").toDataURL() !== before, before);
  await screenshot(page, "example-scene");
  assert.ok((await colors()) > 8);
});

test("bodies, cloth and rope are drawn by three.js, and dragged", async () => {
  await visit("examples/three.html");
  await page.locator("canvas").waitFor();
  await page.waitForTimeout(1500);
  const before = await page.screenshot();
  assert.ok((await colors()) > 20);
  // From the middle of the tower.
  const [x, y] = [SIZE.width / 2, SIZE.height * 0.5];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 120, y - 60, { steps: 6 });
  await page.waitForTimeout(1500);
  await screenshot(page, "example-three");
  await page.mouse.up();
  assert.notDeepEqual(await page.screenshot(), before);
});

test("the page of times says how long steps take", async (t) => {
  await visit("bench/index.html");
  await page.waitForFunction(() => document.body.dataset.done === "true", undefined, { timeout: 120_000 });
  const rows = await page.locator("#rows tr").allInnerTexts();
  for (const row of rows) t.diagnostic(row.replaceAll("\t", "  "));
  assert.equal(rows.length, 3);
  assert.ok(rows.every((row) => /\d\.\d{3}\s+[0-9a-f]{16}$/.test(row)), rows.join("\n"));
});
