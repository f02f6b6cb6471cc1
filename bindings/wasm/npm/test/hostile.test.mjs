// Bad input is refused by a TautlineError that names the field, and the engine goes on.
import assert from "node:assert/strict";
import { afterEach, before, test } from "node:test";
import * as tautline from "../dist/index.js";
import { World, cloth, init, rigid, sphere, TautlineError } from "../dist/index.js";

before(() => init());

// Whatever was refused, everything works afterwards.
afterEach(() => {
  const world = new World({ tautline: 1, bodies: [rigid()] });
  world.step();
  assert.ok(world.body(world.bodies[0].handle).velocity[1] < 0);
  world.dispose();
});

function refused(call, kind, path) {
  const start = performance.now();
  let error;
  assert.throws(call, (thrown) => (error = thrown) instanceof TautlineError);
  assert.deepEqual([error.kind, error.path], [kind, path], error.message);
  assert.ok(performance.now() - start < 2000, "it is refused soon");
  return error;
}

test("numbers that are none", () => {
  const world = new World();
  const ball = world.add(rigid({ shape: sphere(1) }));
  refused(() => world.add(rigid({ mass: Number.NaN, position: [0, Infinity, 0] })), "parse", "rigid.position[1]");
  refused(() => world.add(rigid({ mass: -1 })), "invalid", "rigid.mass");
  refused(() => world.add(rigid({ shape: sphere(-1) })), "invalid", "rigid.shape.sphere.radius");
  refused(() => world.add({ rigidd: {} }), "parse", "");
  for (const dt of [0, -1, Number.NaN, 1e9]) refused(() => world.step(dt), "invalid", "dt");
  refused(() => world.step("1"), "invalid", "dt");
  refused(() => world.setVelocity(ball, [0, Number.NaN, 0]), "invalid", "velocity.y");
  refused(() => world.setVelocity(ball, [0, 1e300, 0]), "invalid", "velocity.y");
  refused(() => world.setVelocity(ball, [0, 0]), "invalid", "velocity");
  refused(() => world.setVelocity(ball, null), "invalid", "velocity");
  refused(() => world.setParticleVelocity(ball, 0, [0, Number.NaN, 0]), "invalid", "velocity.y");
  refused(() => world.setPose(ball, [0, 0, 0], [0, 0, 0, 0]), "invalid", "rotation");
  refused(() => world.grab(ball, [0, 0, 0], { frequency: -1 }), "invalid", "grip.frequency");
  refused(() => world.rayCast([0, 0, 0], [0, 0, 0]), "invalid", "direction");
  for (const handle of [-1, 1.5, 99, Number.NaN, 2 ** 40, undefined]) {
    refused(() => world.setVelocity(handle, [0, 0, 0]), "stale", "");
  }
});

test("documents of millions of bodies, and ones without end", () => {
  refused(() => new World(`{"tautline":1,"bodies":[${"{\"rigid\":{}},".repeat(200_000)}{}]}`), "parse", "bodies");
  const sheet = cloth({ surface: { grid: { columns: 1e6, rows: 1e6, width: 1, depth: 1 } } });
  const { problems } = refused(() => new World({ tautline: 1, bodies: [sheet] }), "invalid", "bodies[0].cloth.surface.grid.columns");
  assert.match(problems.at(-1).message, /1000000000000 particles, more than/);
  const endless = cloth({ surface: { grid: { columns: 1e300, rows: 2, width: 1, depth: 1 } } });
  refused(() => new World({ tautline: 1, bodies: [endless] }), "parse", "bodies[0].cloth.surface.grid.columns");
  refused(() => tautline.document("icosahedra", { n: 1e7 }), "invalid", "parameters.n");
  refused(() => tautline.document("icosahedra", { endless: 1 }), "invalid", "parameters.endless");
  refused(() => tautline.document("<img onerror=alert(1)>"), "invalid", "");
});

test("texts that nest without end", () => {
  for (const [open, format, path] of [["[", "json", "[0]"], ["[", "json5", ""], ["{\"a\":", "json", "a"], ["{a:", "json5", ""]]) {
    const text = open.repeat(100_000);
    refused(() => new World(text, { format }), "parse", path);
    assert.equal(tautline.validate(text, format).length, 1);
  }
  const deep = `{"compound":{"parts":[{"shape":`;
  const shape = `${deep.repeat(20_000)}{}${"}]}}".repeat(20_000)}`;
  assert.throws(() => new World(`{"tautline":1,"bodies":[{"rigid":{"shape":${shape}}}]}`), /recursion limit exceeded/);
  let nested = {};
  for (let i = 0; i < 1e5; i++) nested = { nested };
  refused(() => new World(nested), "invalid", "scene");
  const loop = {};
  loop.loop = loop;
  refused(() => new World(loop), "invalid", "scene");
});

test("what is wrong is shown at its line", () => {
  const text = `{
  // a comment
  "tautline": 1,
  "bodies": [
    { "rigid": { "mass": -1 } },
    { "cloth": { "mass": 1, "friction": -2 } },
  ],
}`;
  const problems = tautline.validate(text, "json5");
  assert.deepEqual(problems.map(({ path, line, column }) => [path, line, column]), [
    ["bodies[0].rigid.mass", 5, 26],
    ["bodies[1].cloth.friction", 6, 41],
  ]);
  const [{ message, ...place }, ...others] = tautline.validate("{\n]");
  assert.deepEqual([place, others], [{ path: "", line: 2, column: 1 }, []]);
  assert.ok(message.length > 10, message);
  assert.deepEqual(tautline.validate(JSON.stringify(tautline.document("net"))), []);
});

test("names are kept as they are, and refused where they become file names", () => {
  const name = "<img src=x onerror=alert(1)>";
  const world = new World({ tautline: 1, bodies: [rigid({ name })] });
  assert.equal(world.bodies[0].name, name);
  refused(() => new World({ tautline: 1, name }), "invalid", "name");
  refused(() => world.add(rigid({ name })), "invalid", "rigid.name");
});

test("mesh files that are too large, empty, or none", () => {
  const bytes = (text) => new TextEncoder().encode(text);
  refused(() => tautline.readMesh(new Uint8Array(100 * 2 ** 20), "a.stl"), "invalid", "bytes");
  refused(() => tautline.readMesh(bytes("v 0 0 nan\n"), "a.obj"), "parse", "");
  refused(() => tautline.readMesh(bytes(""), "a.stl"), "parse", "");
  refused(() => tautline.readMesh(bytes("x"), "a.exe"), "parse", "");
  refused(() => tautline.readMesh("x", "a.obj"), "invalid", "bytes");
  const cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const mesh = tautline.readMesh(bytes(cube), "a.obj", 2);
  assert.deepEqual(tautline.meshInfo(mesh), { vertices: 4, triangles: 4, closed: true, min: [0, 0, 0], max: [2, 2, 2] });
  const world = new World();
  assert.ok(Math.abs(world.body(world.add(rigid({ shape: { mesh } }))).mass - 8000 / 6) < 0.1);
  const open = { ...mesh, triangles: mesh.triangles.slice(1) };
  assert.match(refused(() => world.add(rigid({ shape: { mesh: open } })), "invalid", "rigid.shape").message, /open/);
  refused(() => world.add(rigid({ shape: { file: { path: "../../etc/passwd" } } })), "invalid", "rigid.shape");
});
