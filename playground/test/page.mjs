// What tests do with the playground's page, as its users do: through what is on it.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";

/** Where screenshots are kept, to be looked at. */
const RESULTS = new URL("../test-results/", import.meta.url);
mkdirSync(RESULTS, { recursive: true });

export async function screenshot(page, name) {
  await page.screenshot({ path: new URL(`${name}.png`, RESULTS).pathname });
}

/** Waits until a scene is there. */
export async function ready(page) {
  await page.waitForFunction(() => window.playground?.opened !== undefined);
}

/** Opens a named scene, standing still. */
export async function open(page, name, values = {}) {
  const opened = await page.evaluate(
    ([name, values]) => {
      window.playground.setPlaying(false);
      return window.playground.open({ kind: "named", name, values, settings: {} }, true);
    },
    [name, values],
  );
  assert.ok(opened, `${name} opens`);
}

export const step = (page, count) => page.evaluate((count) => window.playground.step(count), count);
export const hash = (page) => page.evaluate(() => window.playground.hash());
export const time = (page) => page.evaluate(() => window.playground.frame.time);

/** How the picture on the stage differs from its background: the share of pixels that are not of its most frequent
 * colours, and how many colours there are. */
export function picture(page) {
  return page.evaluate(async () => {
    const bitmap = await createImageBitmap(await window.playground.stage.picture());
    const canvas = new OffscreenCanvas(160, 100);
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0, 160, 100);
    const { data } = context.getImageData(0, 0, 160, 100);
    const counts = new Map();
    for (let k = 0; k < data.length; k += 4) {
      const color = (data[k] >> 3) * 1024 + (data[k + 1] >> 3) * 32 + (data[k + 2] >> 3);
      counts.set(color, (counts.get(color) ?? 0) + 1);
    }
    const most = Math.max(...counts.values());
    return { drawn: 1 - most / 16000, colors: counts.size, text: Array.from(data.slice(0, 64)).join() };
  });
}

/** Where the middle of the first movable body is, m, and on the screen, px. */
export function placeOf(page) {
  return page.evaluate(() => {
    const { stage, parts, frame } = window.playground;
    const part = parts.find((part) => !part.fixed && part.look !== "wall");
    const at = [0, 0, 0];
    for (let k = 0; k < part.particleCount; k++) {
      for (const axis of [0, 1, 2]) at[axis] += frame.positions[3 * (part.firstParticle + k) + axis] / part.particleCount;
    }
    const point = stage.camera.position.clone().fromArray(at).project(stage.camera);
    const box = stage.canvas.getBoundingClientRect();
    return { at, x: box.left + ((point.x + 1) / 2) * box.width, y: box.top + ((1 - point.y) / 2) * box.height };
  });
}

/** The message that is shown and says so, once there is one; older ones may still be there. */
export async function notice(page, words = /./) {
  const element = page.locator(".notice", { hasText: words }).last();
  await element.waitFor({ timeout: 20_000 });
  return element.innerText();
}
