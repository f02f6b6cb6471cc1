// Makes the gallery's pictures anew: `npm run thumbnails`, after a build.

import { mkdirSync, writeFileSync } from "node:fs";

import { launch, openPage, serve } from "./browser.mjs";
import { open, ready, step } from "./page.mjs";

const OUT = new URL("../public/thumbnails/", import.meta.url);
/** The step at which a scene shows best what it is about; 90 for others. */
const STEPS = {
  arch: 30, bullets: 12, "card-house": 10, "curtain-self-collision": 40, "hung-cloth": 35, catenary: 60, chain: 45,
  curtains: 200, dominoes: 150, garments: 200, hammock: 150, icosahedra: 70, knot: 150, marbles: 200,
  "mixed-pile": 150, net: 150, ragdoll: 70, tablecloth: 60, trampoline: 60, whip: 25,
};

mkdirSync(OUT, { recursive: true });
const browser = await launch();
const server = await serve(new URL("../dist", import.meta.url).pathname);
const { page } = await openPage(browser, server.address, { width: 900, height: 520, colorScheme: "light" });
await page.goto(server.address);
await ready(page);
const names = await page.evaluate(() => window.playground.hello.scenes.map((scene) => scene.name));
for (const name of names) {
  await open(page, name);
  await step(page, STEPS[name] ?? 90);
  const bytes = await page.evaluate(async () => {
    if (!window.playground.opened.camera) window.playground.lookAtAll();
    const bitmap = await createImageBitmap(await window.playground.stage.picture());
    const canvas = new OffscreenCanvas(320, 200);
    const context = canvas.getContext("2d");
    context.imageSmoothingQuality = "high";
    // The middle of the stage, as wide as it is high times 1.6.
    const height = Math.min(bitmap.height, bitmap.width / 1.6);
    const width = 1.6 * height;
    context.drawImage(bitmap, (bitmap.width - width) / 2, (bitmap.height - height) / 2, width, height, 0, 0, 320, 200);
    const blob = await canvas.convertToBlob({ type: "image/webp", quality: 0.8 });
    return [...new Uint8Array(await blob.arrayBuffer())];
  });
  writeFileSync(new URL(`${name}.webp`, OUT), Buffer.from(bytes));
  console.log(`${name}: ${bytes.length} bytes`);
}
await browser.close();
server.close();
