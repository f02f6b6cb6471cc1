// What the pictures of how it works are made from, against what it has to be.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { World, box, cloth, document, halfSpace, init, rigid, rope, withSolver } from "../dist/index.js";

before(() => init());

test("every sphere of a tree holds the spheres below it, and the root all particles", () => {
  const world = new World();
  const sheet = world.add(cloth());
  const { spheres, levels, levelCount } = world.inspect.sphereTree(sheet);
  assert.equal(spheres.length, 4 * levels.length);
  assert.equal(levels.filter((level) => level === 0).length, 1);
  assert.ok(levelCount > 5);
  const { positions } = world.body(sheet);
  for (let i = 0; i < positions.length; i += 3) {
    const away = Math.hypot(positions[i] - spheres[0], positions[i + 1] - spheres[1], positions[i + 2] - spheres[2]);
    assert.ok(away <= spheres[3] * 1.0001);
  }
  assert.equal(world.inspect.sphereTree(world.add(rigid())), undefined);
});

test("GJK comes nearer with every iteration and ends at the distance of two boxes", () => {
  const world = new World();
  const [a, b] = [world.add(rigid()), world.add(rigid({ position: [2.5, 0.3, 0.2] }))];
  const apart = world.inspect.gjk(a, b);
  assert.equal(apart.result, "separated");
  assert.ok(Math.abs(apart.distance - 1.5) < 1e-6 && apart.hitFace === null);
  const distances = apart.iterations.map(({ distance }) => distance);
  assert.deepEqual(distances, distances.toSorted((x, y) => y - x));
  assert.ok(apart.difference.indices.length >= 36, "a box minus a box is a box");
  world.setPose(b, [0.8, 0.1, 0]);
  const hit = world.inspect.gjk(a, b);
  assert.equal(hit.result, "intersecting");
  assert.ok(Math.abs(hit.distance + 0.2) < 1e-6 && Math.abs(hit.hitFace.normal[0] - 1) < 1e-6);
  for (const { simplex } of hit.iterations) assert.ok(simplex.length >= 1 && simplex.length <= 4);
  assert.throws(() => world.inspect.gjk(a, world.add(halfSpace())), /b: is not a rigid body/);
});

test("a box on the floor has four contacts that carry its weight", () => {
  const world = new World();
  world.add(halfSpace());
  const cube = world.add(rigid({ position: [0, 0.5, 0], mass: 2 }));
  world.setSettings({ sleep: "never" });
  for (let i = 0; i < 60; i++) world.step();
  const contacts = world.inspect.contacts();
  assert.equal(contacts.length, 4);
  const h = world.dt / world.settings.substeps;
  const force = contacts.reduce((sum, { impulse }) => sum + impulse, 0) / h;
  assert.ok(Math.abs(force - 2 * 9.81) < 0.5, `they carry ${force} N`);
  for (const contact of contacts) {
    assert.ok([contact.a, contact.b].includes(cube));
    assert.ok(Math.abs(contact.pointA[1]) < 0.01 && Math.abs(contact.pointB[1]) < 0.01);
  }
  assert.equal(world.inspect.contactColors().length, 1);
});

test("contacts of the paper's solver have features", () => {
  const world = new World(withSolver(document("icosahedra", { n: 10 }), "paper"));
  let seen = 0;
  for (let i = 0; i < 120; i++) {
    world.step();
    for (const { featureA, featureB, a, b } of world.inspect.contacts()) {
      assert.ok(a !== b && featureA.points.length === featureA.weights.length);
      const sum = featureA.weights.reduce((total, weight) => total + weight, 0);
      assert.ok(Math.abs(sum - 1) < 1e-5);
      seen += featureB === null ? 0 : 1;
    }
  }
  assert.ok(seen > 0, "icosahedra met");
});

for (const [name, surface] of [
  ["a grid", { grid: { columns: 7, rows: 6, width: 1, depth: 1 } }],
  ["a mesh", { mesh: { positions: [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], triangles: [[0, 2, 1], [0, 3, 2]] } }],
]) {
  test(`sticks of one colour of ${name} share no particle`, () => {
    const world = new World();
    const body = world.body(world.add(cloth({ surface })));
    const colors = world.inspect.stickColors(body.handle);
    assert.equal(colors.length, body.segments.length / 2);
    const seen = new Set();
    colors.forEach((color, i) => {
      for (const end of body.segments.subarray(2 * i, 2 * i + 2)) {
        assert.ok(!seen.has(`${color} ${end}`));
        seen.add(`${color} ${end}`);
      }
    });
  });
}

test("a rope that hangs is strained, and has no colours", () => {
  const world = new World();
  const line = world.add(rope({ path: { line: { from: [0, 0, 0], to: [1, 0, 0], segments: 4 } }, length: 2 }));
  const strain = world.inspect.strain(line);
  assert.equal(strain.length, 4);
  for (const share of strain) assert.ok(Math.abs(share + 0.5) < 1e-6, "it is laid out at half its length");
  assert.equal(world.inspect.stickColors(line).length, 0);
});

test("the paper's list of a particle begins with its own sticks and has all of them", () => {
  const world = new World({ tautline: 1, settings: { solver: "paper" }, bodies: [rigid({ shape: box(1, 1, 1) })] });
  const [body] = world.bodies;
  const list = world.inspect.orderedList(body.handle, 3);
  const first = body.segments.subarray(2 * list[0], 2 * list[0] + 2);
  assert.ok(first.includes(3));
  assert.equal(new Set(list).size, body.segments.length / 2);
  assert.ok(list.length > new Set(list).size, "near ones are repeated");
});
