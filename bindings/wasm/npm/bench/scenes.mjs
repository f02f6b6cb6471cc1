// What is measured: the same on a page, in Node and natively.

/** A scene of the engine, and how often it is stepped. */
export function scenesOf({ cloth, document }) {
  const icosahedra = document("icosahedra", { n: 200 });
  const sheet = document("cloth-on-cube", { n: 40 });
  const together = document("icosahedra", { n: 500 });
  const surface = { grid: { columns: 40, rows: 40, width: 2, depth: 2 } };
  together.bodies.push(cloth({ surface, position: [0, 6, 0] }));
  return [
    ["200 icosahedra", icosahedra],
    ["cloth of 40 × 40 on a cube", sheet],
    ["500 icosahedra and a cloth of 40 × 40", together],
  ];
}

/** The mean time of a step over `steps` steps from the start, in ms. */
export function measure(World, document, steps) {
  const world = new World(document);
  const begin = performance.now();
  for (let i = 0; i < steps; i++) world.step();
  const time = (performance.now() - begin) / steps;
  const hash = world.stateHash();
  world.dispose();
  return { time, hash };
}

export const STEPS = 180;
