// What the package does, in Node: the same engine file that browsers load.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import * as tautline from "../dist/index.js";
import { World, box, cloth, halfSpace, init, rigid, rope, sphere, TautlineError } from "../dist/index.js";

before(async () => {
  assert.throws(() => new World(), /await init\(\) first/);
  await init();
});

/** A call that is refused, and the refusal. */
function refused(call, kind, path) {
  let error;
  assert.throws(call, (thrown) => (error = thrown) instanceof TautlineError, "it is refused by a TautlineError");
  assert.equal(error.kind, kind, error.message);
  assert.equal(error.path, path, error.message);
  return error;
}

const FLOOR = halfSpace();

test("a ball falls as far as ½ g t² and comes to rest on the floor", () => {
  const world = new World();
  world.add(FLOOR);
  const ball = world.add(rigid({ shape: sphere(0.5), position: [0, 10, 0] }));
  while (world.time < 0.999) world.step();
  const fallen = 10 - world.body(ball).centerOfMass[1];
  assert.ok(Math.abs(fallen - 9.81 / 2) < 0.06, `it fell ${fallen} m`);
  for (let i = 0; i < 240; i++) world.step();
  assert.ok(Math.abs(world.body(ball).position[1] - 0.5) < 0.01);
  assert.ok(world.body(ball).isAsleep);
  assert.equal(world.report.awakeBodies, 0);
});

test("views show the engine's memory, also after it has grown", () => {
  const world = new World();
  const sheet = world.add(cloth({ surface: { grid: { columns: 10, rows: 10, width: 1, depth: 1 } } }));
  const before = world.positions;
  assert.equal(world.positions, before, "no other view without a reason");
  assert.equal(before.length, 300);
  const others = Array.from({ length: 20 }, () => new World(tautline.document("hung-cloth")));
  assert.equal(before.length, 0, "20 worlds made the memory grow");
  assert.equal(world.positions.length, 300);
  const [first] = world.positions;
  world.step();
  assert.equal(world.positions[0], first);
  assert.ok(world.body(sheet).positions[1] < 0);
  others.forEach((other) => other.dispose());
  refused(() => others[0].step(), "stale", "");
});

test("bodies are described as they were asked for", () => {
  const world = new World();
  const cube = { shape: box(1, 2, 3), position: [1, 2, 3], color: "#102030" };
  const handles = [rigid({ ...cube, name: "a" }), rigid({ ...cube, position: [5, 2, 3] }), rope(), FLOOR].map((body) => world.add(body));
  const [a, b, line, floor] = world.bodies;
  assert.deepEqual(world.bodies.map(({ handle }) => handle), handles);
  assert.deepEqual([a.name, a.kind, a.look, a.color, a.motion], ["a", "rigid", "solid", 0x102030, "dynamic"]);
  assert.equal(a.mesh, b.mesh, "two boxes of one size share their mesh");
  assert.equal(a.mesh.indices.length, 36);
  assert.deepEqual(a.position, [1, 2, 3]);
  assert.deepEqual(a.rotation.map((part) => Math.abs(Math.round(part))), [0, 0, 0, 1], "a quaternion or its opposite");
  assert.ok(Math.abs(a.mass - 6000) < 0.01);
  assert.deepEqual([line.look, line.segments.length, line.particleCount], ["tube", 100, 51]);
  assert.deepEqual([floor.look, floor.position, floor.mesh.indices.length], ["wall", undefined, 6]);
  assert.equal(world.bodyNamed("a"), a);
  world.remove(handles[0]);
  refused(() => world.body(handles[0]), "stale", "");
  refused(() => world.setVelocity(handles[0], [0, 0, 0]), "stale", "");
  assert.equal(world.bodies.length, 3);
  assert.notEqual(world.add(rigid()), handles[0], "a handle is not used again");
});

test("joints and attachments hold what was added by handle or name", () => {
  const world = new World();
  const hub = world.add(rigid({ name: "hub", motion: "fixed", position: [0, 3, 0] }));
  const arm = world.add(rigid({ position: [1.5, 3, 0] }));
  const hinge = world.addJoint({ body: arm, base: "hub", anchor: [0.5, 3, 0], kind: { hinge: { axis: [0, 0, 1] } } });
  const line = world.add(rope({ path: { line: { from: [0, 2.5, 0], to: [0, 1, 0], segments: 10 } } }));
  world.addAttachment({ a: { body: line, at: { end: "first" } }, b: { body: hub, at: { point: [0, 2.5, 0] } } });
  for (let i = 0; i < 30; i++) world.step();
  const [joint] = world.joints;
  assert.deepEqual([joint.handle, joint.kind, joint.body, joint.base], [hinge, "hinge", arm, hub]);
  assert.ok(joint.angle < -0.3, "it swings down");
  assert.ok(world.body(line).positions[1] > 2.49, "the rope hangs");
  world.setMotor(hinge, { speed: 1, strength: 1e6 });
  world.setMotor(hinge, null);
  world.removeJoint(hinge);
  assert.equal(world.joints.length, 0);
  refused(() => world.removeJoint(hinge), "stale", "");
});

test("what is grabbed goes where the hand goes, and flies on", () => {
  const world = new World(undefined, {});
  world.setSettings({ gravity: [0, 0, 0] });
  const cube = world.add(rigid());
  const grab = world.grab(cube, [0, 0, 0]);
  for (let i = 1; i <= 60; i++) {
    world.moveGrab(grab, [i / 30, 0, 0]);
    world.step();
  }
  assert.ok(Math.abs(world.body(cube).centerOfMass[0] - 2) < 0.2);
  assert.equal(world.grabs[0].handle, grab);
  world.release(grab);
  assert.equal(world.grabs.length, 0);
  refused(() => world.moveGrab(grab, [0, 0, 0]), "stale", "");
  world.step();
  assert.ok(world.body(cube).velocity[0] > 1);
});

test("questions are answered", () => {
  const world = new World();
  world.add(FLOOR);
  const cube = world.add(rigid({ position: [0, 0.5, 0] }));
  const hit = world.rayCast([0, 5, 0], [0, -1, 0]);
  assert.deepEqual([hit.body, hit.distance, hit.normal], [cube, 4, [0, 1, 0]]);
  assert.equal(world.rayCast([0, 5, 0], [0, 1, 0]), undefined);
  assert.equal(world.rayCastAll([0, 5, 0], [0, -1, 0]).length, 2);
  assert.notEqual(world.rayCast([0, 5, 0], [0, -1, 0], { exclude: cube }).body, cube);
  assert.ok(Math.abs(world.closestPoint([2, 0.5, 0]).distance - 0.5) < 1e-6);
  assert.deepEqual(world.overlap(sphere(0.1), [0, 0.5, 0]), [cube]);
  const cast = world.shapeCast(sphere(0.5), [-3, 0.5, 0], [0, 0, 0, 1], [4, 0, 0], { movable: true, fixed: false });
  assert.ok(cast.body === cube && Math.abs(cast.fraction - 0.5) < 1e-3);
});

test("contacts are reported, with how fast they came", () => {
  const world = new World();
  const floor = world.add(FLOOR);
  const ball = world.add(rigid({ shape: sphere(0.1), position: [0, 1, 0] }));
  world.reportContacts(ball, true);
  const began = [];
  for (let i = 0; i < 60; i++) {
    world.step();
    began.push(...world.contactEvents.filter(({ kind }) => kind === "began"));
  }
  assert.equal(began.length, 1);
  assert.deepEqual([began[0].a, began[0].b], [floor, ball]);
  assert.ok(Math.abs(began[0].approachSpeed - Math.sqrt(2 * 9.81 * 0.9)) < 0.05);
});

test("a snapshot and a reset give the same bits again", () => {
  const world = new World(tautline.document("hammock"));
  const start = world.stateHash();
  for (let i = 0; i < 20; i++) world.step();
  const snapshot = world.snapshot();
  for (let i = 0; i < 20; i++) world.step();
  const end = world.stateHash();
  const body = world.bodies[0].handle;
  world.restore(snapshot);
  for (let i = 0; i < 20; i++) world.step();
  assert.equal(world.stateHash(), end);
  assert.equal(world.bodies[0].handle, body);
  world.add(rigid({ position: [0, 9, 0] }));
  world.reset();
  assert.deepEqual([world.stateHash(), world.stepCount], [start, 0]);
  refused(() => world.restore(snapshot.subarray(0, 100)), "invalid", "snapshot");
  assert.equal(world.stateHash(), start, "a snapshot that is refused changes nothing");
});

test("a recording is a GLB file with as many frames", () => {
  const world = new World({ ...tautline.document("cloth-on-cube"), record_every: 2 }, { record: true });
  for (let i = 0; i < 5; i++) world.step();
  assert.ok(world.isRecording && world.recordedFrames === 3);
  world.add(rigid({ position: [0, 5, 0] }));
  world.step();
  const glb = world.exportGlb();
  assert.equal(new TextDecoder().decode(glb.subarray(0, 4)), "glTF");
  assert.equal(new DataView(glb.buffer, glb.byteOffset).getUint32(8, true), glb.length);
  assert.ok(new World(tautline.document("tower")).exportGlb().length > 1000);
});

test("settings change but for the solver", () => {
  const world = new World(tautline.document("tower"));
  world.setSettings({ substeps: 3, sleep: "never" });
  assert.deepEqual([world.settings.substeps, world.settings.sleep, world.settings.solver], [3, "never", "default"]);
  refused(() => world.setSettings({ substeps: 0 }), "invalid", "settings.substeps");
  refused(() => world.setSettings({ solver: "paper" }), "invalid", "settings.solver");
  assert.equal(world.settings.substeps, 3);
  const paper = tautline.withSolver(tautline.document("icosahedra", { n: 5 }), "paper");
  assert.equal(new World(paper).bodies.find(({ look }) => look === "solid").kind, "truss");
});
