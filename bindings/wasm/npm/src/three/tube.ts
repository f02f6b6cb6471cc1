/** Corners around a tube. */
const SIDES = 8;

/** Lines of particles that a rope's tubes go along: one of a chain, one for each segment of a net. */
export function linesOf(segments: Uint32Array): Uint32Array[] {
  const isChain = segments.every((end, i) => end === (i >> 1) + (i & 1));
  if (isChain) return [Uint32Array.from({ length: segments.length / 2 + 1 }, (_, i) => i)];
  return Array.from({ length: segments.length / 2 }, (_, i) => segments.slice(2 * i, 2 * i + 2));
}

/** Triangles of tubes along lines, over `SIDES` corners for each of their particles. */
export function tubeIndices(lines: readonly Uint32Array[]): Uint32Array {
  const indices: number[] = [];
  let first = 0;
  for (const line of lines) {
    for (let i = 0; i + 1 < line.length; i++, first += SIDES) {
      for (let k = 0; k < SIDES; k++) {
        const [a, b] = [first + k, first + ((k + 1) % SIDES)];
        indices.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
      }
    }
    first += SIDES;
  }
  return Uint32Array.from(indices);
}

/** How many corners there are. */
export function cornerCount(lines: readonly Uint32Array[]): number {
  return lines.reduce((count, line) => count + SIDES * line.length, 0);
}

/** For each corner the particle that it is around. */
export function particlesOfCorners(lines: readonly Uint32Array[]): Uint32Array {
  return Uint32Array.from(lines.flatMap((line) => Array.from(line).flatMap((particle) => Array(SIDES).fill(particle))));
}

/** Places of the corners, and their normals, for particles that are where they are. The frame does not twist on its way. */
export function writeTubes(
  lines: readonly Uint32Array[],
  particles: Float32Array,
  radius: number,
  places: Float32Array,
  normals: Float32Array,
): void {
  let corner = 0;
  for (const line of lines) {
    let [ux, uy, uz] = [0, 0, 0];
    for (let i = 0; i < line.length; i++) {
      const [before, after] = [3 * (line[Math.max(i - 1, 0)] ?? 0), 3 * (line[Math.min(i + 1, line.length - 1)] ?? 0)];
      const [tx, ty, tz] = unit(at(particles, after) - at(particles, before), at(particles, after + 1) - at(particles, before + 1), at(particles, after + 2) - at(particles, before + 2));
      if (i === 0) [ux, uy, uz] = Math.abs(ty) < 0.9 ? [0, 1, 0] : [1, 0, 0];
      const along = ux * tx + uy * ty + uz * tz;
      [ux, uy, uz] = unit(ux - along * tx, uy - along * ty, uz - along * tz);
      const [vx, vy, vz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
      const here = 3 * (line[i] ?? 0);
      for (let k = 0; k < SIDES; k++, corner += 3) {
        const [c, s] = [Math.cos((2 * Math.PI * k) / SIDES), Math.sin((2 * Math.PI * k) / SIDES)];
        const [nx, ny, nz] = [c * ux + s * vx, c * uy + s * vy, c * uz + s * vz];
        normals[corner] = nx;
        normals[corner + 1] = ny;
        normals[corner + 2] = nz;
        places[corner] = at(particles, here) + radius * nx;
        places[corner + 1] = at(particles, here + 1) + radius * ny;
        places[corner + 2] = at(particles, here + 2) + radius * nz;
      }
    }
  }
}

function at(list: Float32Array, index: number): number {
  return list[index] ?? 0;
}

function unit(x: number, y: number, z: number): [number, number, number] {
  const length = Math.hypot(x, y, z);
  return length > 0 ? [x / length, y / length, z / length] : [1, 0, 0];
}
