// What is in the package.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";

test("the package has its files, and nothing else", () => {
  const [{ files }] = JSON.parse(execFileSync("npm", ["pack", "--dry-run", "--json"], { encoding: "utf8" }));
  const paths = files.map(({ path }) => path);
  const outside = paths.filter((path) => !path.startsWith("dist/"));
  assert.deepEqual(outside.sort(), ["LICENSE-APACHE", "LICENSE-MIT", "README.md", "package.json"]);
  for (const needed of ["index", "three/index", "worker/index", "worker/host", "document", "engine/engine"]) {
    assert.ok(paths.includes(`dist/${needed}.d.ts`), needed);
  }
  assert.ok(paths.includes("dist/engine/engine_bg.wasm"));
  assert.deepEqual(paths.filter((path) => !/\.(js|d\.ts|wasm|md|json)$|LICENSE/.test(path)), []);
});

test("what the package exports is there", () => {
  const { exports, dependencies } = JSON.parse(readFileSync("package.json", "utf8"));
  assert.equal(dependencies, undefined, "it needs nothing");
  for (const target of Object.values(exports).flatMap((one) => (typeof one === "string" ? [one] : Object.values(one)))) {
    assert.ok(readFileSync(target).length > 0, target);
  }
});

test("the glue makes no code of texts", () => {
  assert.doesNotMatch(readFileSync("dist/engine/engine.js", "utf8"), /\beval\b|new Function/);
});
