// What the worker gathers of how a step works, for the page to draw over the scene.

import type { BodyHandle, BodyView, World } from "tautline";

import type { Inspection, Query, StickValues } from "./protocol";

/** What `query` asks of a world as it is now. */
export function inspect(world: World, query: Query): Inspection {
  switch (query.kind) {
    case "spheres":
      return spheres(world, query.level);
    case "boxes":
      return { kind: "boxes", boxes: world.inspect.boxes() };
    case "gjk":
      return gjk(world, query.pair);
    case "contacts":
      return { kind: "contacts", contacts: world.inspect.contacts() };
    case "colors":
      return colors(world);
    case "order":
      return order(world, query.grabbed);
    case "strain":
      return strain(world);
  }
}

/** The spheres of one level of all trees; of a shallower tree its deepest level. */
function spheres(world: World, level: number): Inspection {
  const chosen: number[] = [];
  let levels = 0;
  for (const body of world.bodies) {
    const tree = world.inspect.sphereTree(body.handle);
    if (tree === undefined) continue;
    levels = Math.max(levels, tree.levelCount);
    const wanted = Math.min(level, tree.levelCount - 1);
    tree.levels.forEach((own, index) => {
      if (own === wanted) chosen.push(...tree.spheres.subarray(4 * index, 4 * index + 4));
    });
  }
  return { kind: "spheres", spheres: new Float32Array(chosen), levels };
}

/** GJK of a pair of rigid bodies: the given one while it is there, else the closest. */
function gjk(world: World, given: [number, number] | undefined): Inspection {
  const known = new Set<number>(world.bodies.filter(isHull).map((body) => body.handle));
  const pair = given?.every((handle) => known.has(handle)) ? given : closestPair(world);
  if (pair === undefined) return { kind: "gjk", pair, trace: undefined };
  return { kind: "gjk", pair, trace: world.inspect.gjk(pair[0] as BodyHandle, pair[1] as BodyHandle) };
}

/** Bodies that GJK can look at. */
function isHull(body: BodyView): boolean {
  return body.kind === "rigid" || body.kind === "truss";
}

/** Of more bodies than this the closest pair is sought among the first ones only. */
const MOST_SEARCHED = 200;

/** The two rigid bodies, one of them movable, whose boxes' middles are closest. */
function closestPair(world: World): [number, number] | undefined {
  const bodies = world.bodies.filter(isHull).slice(0, MOST_SEARCHED);
  const middles = bodies.map((body) => body.centerOfMass);
  let best: [number, number] | undefined;
  let least = Infinity;
  bodies.forEach((a, i) => {
    for (let j = i + 1; j < bodies.length; j++) {
      const b = bodies[j];
      const [p, q] = [middles[i], middles[j]];
      if (b === undefined || p === undefined || q === undefined) continue;
      if (a.motion !== "dynamic" && b.motion !== "dynamic") continue;
      const squared = (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2;
      if (squared < least) [least, best] = [squared, [a.handle, b.handle]];
    }
  });
  return best;
}

function colors(world: World): Inspection {
  const sticks: StickValues[] = [];
  let count = 0;
  for (const body of world.bodies) {
    if (body.segments.length === 0) continue;
    const found = world.inspect.stickColors(body.handle);
    const values = found.length > 0 ? Float32Array.from(found) : new Float32Array(body.segments.length / 2).fill(-1);
    count = values.reduce((most, value) => Math.max(most, value + 1), count);
    sticks.push({ body: body.handle, values });
  }
  const pairs = world.inspect.contactColors();
  count = pairs.reduce((most, pair) => Math.max(most, pair.color + 1), count);
  return { kind: "colors", sticks, pairs: pairs.map((pair) => ({ ...pair })), count };
}

/** The list of the truss that is held, or of the first one. */
function order(world: World, grabbed: { body: number; particle: number } | undefined): Inspection {
  const trusses = world.bodies.filter((body) => body.kind === "truss");
  const truss = trusses.find((body) => body.handle === grabbed?.body) ?? trusses[0];
  if (truss === undefined) return { kind: "order", body: undefined, sticks: [] };
  const particle = grabbed?.body === truss.handle ? grabbed.particle : 0;
  const list = world.inspect.orderedList(truss.handle, Math.min(particle, truss.particleCount - 1));
  const values = new Float32Array(truss.segments.length / 2).fill(-1);
  list.forEach((stick, place) => {
    // Near ones are repeated: where a stick stands first is what it is shown by.
    if (values[stick] === -1) values[stick] = place / Math.max(1, list.length - 1);
  });
  return { kind: "order", body: truss.handle, sticks: [{ body: truss.handle, values }] };
}

function strain(world: World): Inspection {
  const stretched = world.bodies.filter((body) => body.segments.length > 0);
  const sticks = stretched.map((body) => ({ body: body.handle, values: world.inspect.strain(body.handle) }));
  return { kind: "strain", sticks, ...world.strain() };
}
