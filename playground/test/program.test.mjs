// What the command line has to do with pages: recordings that play themselves, and the playground served by it.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

import { launch, openPage } from "./browser.mjs";
import { ready, screenshot, step } from "./page.mjs";

const DIST = new URL("../dist", import.meta.url).pathname;
/** The command line, built with optimisation. */
const TAUTLINE = process.env.TAUTLINE ?? new URL("../../target/release/tautline", import.meta.url).pathname;
const skip = existsSync(TAUTLINE) ? false : "the command line is not built";
const folder = mkdtempSync(join(tmpdir(), "tautline-"));

let browser;

before(async () => (browser = await launch()));

after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

test("a recording plays itself, without a server", { skip }, async () => {
  const file = join(folder, "hammock.html");
  execFileSync(TAUTLINE, ["run", "hammock", "--seconds", "2", "--out", file], { stdio: "ignore" });
  assert.ok(readFileSync(file).length < 5e6);
  const address = pathToFileURL(file).href;
  const { page, complaints, context } = await openPage(browser, address, { width: 640, height: 400, colorScheme: "dark" });
  await page.goto(address);
  const time = () => page.locator(".clock").innerText();
  await page.waitForFunction(() => document.querySelector(".clock")?.textContent > "0.00 s");
  await page.getByRole("button", { name: "Pause" }).dispatchEvent("click");
  const before = await page.locator("canvas").screenshot();
  // Frames are a thirtieth of a second apart.
  await page.getByLabel("Time").fill("50");
  assert.equal(await time(), "1.67 s");
  await page.waitForTimeout(300);
  assert.notDeepEqual(await page.locator("canvas").screenshot(), before, "something else is seen");
  await screenshot(page, "replay");
  assert.deepEqual(complaints.filter((complaint) => !complaint.includes(address)), []);
  await context.close();
});

/** `tautline view` with the address it has printed. */
async function view(...words) {
  const program = spawn(TAUTLINE, ["view", ...words, "--no-open", "--page", DIST], { stdio: ["ignore", "pipe", "inherit"] });
  const address = await new Promise((resolve) => program.stdout.once("data", (text) => resolve(String(text).split("\n")[0])));
  return { address, end: () => program.kill() };
}

test("the command line serves the playground with a named scene", { skip }, async () => {
  const { address, end } = await view("tower", "--set", "n=3");
  const { page, complaints, context } = await openPage(browser, address, { width: 640, height: 400 });
  await page.goto(address);
  await ready(page);
  assert.equal(await page.evaluate(() => window.playground.source.values.n), 3);
  assert.deepEqual(complaints, []);
  await context.close();
  end();
});

test("it serves a file's scene, its meshes in it", { skip }, async () => {
  writeFileSync(join(folder, "t.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const scene = { tautline: 1, name: "mine", bodies: [{ rigid: { shape: { file: { path: "t.obj" } } } }] };
  writeFileSync(join(folder, "mine.json"), JSON.stringify(scene));
  const { address, end } = await view(join(folder, "mine.json"));
  const { page, complaints, context } = await openPage(browser, address, { width: 640, height: 400 });
  await page.goto(address);
  await ready(page);
  await step(page, 2);
  assert.equal(await page.locator("h1").innerText(), "mine");
  assert.deepEqual(complaints, []);
  await context.close();
  end();
});

test("it gives nothing but its files, and those to this machine's own pages only", { skip }, async () => {
  const { address, end } = await view();
  const { port } = new URL(address);
  const status = (path, headers = {}, method = "GET") =>
    new Promise((resolve, reject) => {
      const options = { host: "127.0.0.1", port, path, method, headers };
      request(options, (response) => resolve(response.resume().statusCode)).on("error", reject).end();
    });
  assert.equal(await status("/"), 200);
  assert.equal(await status("/", {}, "HEAD"), 200);
  assert.equal(await status("/", {}, "POST"), 405);
  for (const path of ["/../package.json", "/..%2fpackage.json", "//etc/passwd", "/scene.json", "/assets"]) {
    assert.equal(await status(path), 404, path);
  }
  assert.equal(await status("/", { Host: "elsewhere.example" }), 403, "a name that leads here from elsewhere");
  end();
});
