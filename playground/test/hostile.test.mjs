// Input that means harm: it gives a message, and the page can be used afterwards.

import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { deflateRawSync } from "node:zlib";

import { launch, openPage, serve } from "./browser.mjs";
import { hash, notice, open, ready, step } from "./page.mjs";

const DIST = new URL("../dist", import.meta.url).pathname;

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

/** The page works: a scene opens and moves. */
afterEach(async () => {
  await open(page, "tower", { n: 2 });
  const begin = await hash(page);
  await step(page, 2);
  assert.notEqual(await hash(page), begin);
  assert.equal(await page.evaluate(() => window.harmed), undefined, "nothing was executed");
  assert.deepEqual(complaints.splice(0), []);
});

const openText = (text) => page.evaluate((text) => window.playground.open({ kind: "text", text }, true), text);

const DOCUMENTS = {
  "ten million particles": '{"tautline":1,"bodies":[{"cloth":{"surface":{"grid":{"columns":10000,"rows":1000}}}}]}',
  "a hundred thousand bodies": `{"tautline":1,"bodies":[${Array(100_000).fill('{"rigid":{}}').join()}]}`,
  "no number": '{"tautline":1,"bodies":[{"rigid":{"mass":NaN}}]}',
  "an endless number": '{"tautline":1,"bodies":[{"rigid":{"position":[1e999,0,0]}}]}',
  "brackets without end": "[".repeat(100_000),
  "objects without end": '{"a":'.repeat(100_000),
  "no scene": "<script>window.harmed = 1</script>",
};

for (const [name, text] of Object.entries(DOCUMENTS)) {
  test(`a document with ${name} is refused`, async () => {
    const begin = performance.now();
    assert.equal(await openText(text), false);
    assert.ok((await notice(page)).length > 10);
    assert.ok(performance.now() - begin < 5000, "soon");
  });
}

test("markup stays text", async () => {
  const markup = '<img src=x onerror="window.harmed=1"><script>window.harmed=1</script>';
  const bodies = [{ rigid: { name: markup } }, { rigid: { position: [2, 0, 0] } }];
  assert.ok(await openText(JSON.stringify({ tautline: 1, description: markup, bodies })));
  assert.equal(await page.locator(".scene p").innerText(), markup);
  await page.getByRole("tab", { name: "Inside" }).click();
  await page.locator(`input[value="gjk"]`).check();
  await page.locator(".panel .note").getByText("onerror").waitFor();
  await page.locator(`input[value="none"]`).check();
  for (const scene of [{ name: markup }, { bodies: [{ [markup]: {} }] }]) {
    assert.equal(await openText(JSON.stringify({ tautline: 1, ...scene })), false);
    await notice(page, /onerror/);
  }
});

test("endless parameters and values out of range are refused", async () => {
  const values = Object.fromEntries(Array.from({ length: 100_000 }, (_, k) => [`p${k}`, k]));
  for (const wrong of [values, { n: 1e7 }, { n: -1 }, { n: 2.5 }]) {
    const open = (values) => window.playground.open({ kind: "named", name: "tower", values, settings: {} }, true);
    const opened = await page.evaluate(open, wrong);
    assert.equal(opened, false);
    await notice(page);
  }
});

test("files that are too large or no meshes are refused", async () => {
  const drop = (name, make) =>
    page.evaluate(([name, make]) => {
      const data = new DataTransfer();
      data.items.add(new File([make === "large" ? new Uint8Array(100 << 20) : make], name));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    }, [name, make]);
  const cases = [
    ["large.stl", "large", /64 MB/],
    ["large.json", "large", /4 MB/],
    ["bad.obj", "f 1 2 99999999", /./],
    ["bad.glb", "glTF", /./],
    ["x.exe", "MZ", /ending/],
  ];
  for (const [name, content, words] of cases) {
    await page.evaluate(() => document.querySelector(".notices").replaceChildren());
    await drop(name, content);
    const text = await notice(page);
    assert.match(text, words, name);
  }
});

test("crafted links are refused, and the page has a scene all the same", async () => {
  const bomb = deflateRawSync(Buffer.alloc(20 << 20, 32)).toString("base64url");
  const links = [
    "#scene=../../etc/passwd",
    "#scene=tower&n=NaN",
    "#scene=nowhere",
    "#scene=tower&settings={",
    "#scene=tower&settings=%7B%22gravity%22:%22%3Cb%3E%22%7D",
    `#document=${bomb}`,
    "#document=%3Cscript%3E",
    `#document=${"A".repeat(40_000)}`,
    `#${"a=1&".repeat(20_000)}`,
  ];
  const other = await openPage(browser, server.address, { width: 400, height: 300 });
  await other.page.goto(server.address + links[0]);
  await ready(other.page);
  for (const link of links) {
    // The first one is what the page was opened with, the others are pasted into its address.
    if (link !== links[0]) await other.page.evaluate((link) => (location.hash = link), link);
    assert.ok((await notice(other.page)).length > 10, link.slice(0, 60));
    await other.page.evaluate(() => document.querySelector(".notices").replaceChildren());
  }
  assert.ok(await other.page.evaluate(() => window.playground.opened !== undefined));
  assert.deepEqual(other.complaints, []);
  await other.context.close();
});

test("a scene that is allowed but slow does not freeze the page, and can be stopped", async () => {
  const text = JSON.stringify({
    tautline: 1,
    bodies: [{ cloth: { surface: { grid: { columns: 400, rows: 400, width: 4, depth: 4 } }, self_collision: true } }],
  });
  const opening = page.evaluate((text) => {
    window.playground.setPlaying(true);
    void window.playground.open({ kind: "text", text }, true);
  }, text);
  await opening;
  const stop = page.getByRole("button", { name: "Stop it" });
  const appeared = await stop.waitFor({ timeout: 12_000 }).then(() => true, () => false);
  const pictures = await page.evaluate(
    () => new Promise((resolve) => {
      let count = 0;
      const end = performance.now() + 500;
      const tick = () => (count++, performance.now() < end ? requestAnimationFrame(tick) : resolve(count));
      tick();
    }),
  );
  assert.ok(pictures >= 2, `${pictures} pictures in half a second`);
  if (appeared) await stop.click({ timeout: 2000 }).catch(() => undefined);
});
