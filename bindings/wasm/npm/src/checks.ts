import { invalid } from "./errors.js";

/** x, y, z. */
export type Vec3 = readonly [x: number, y: number, z: number];
/** A rotation, as a quaternion x, y, z, w. */
export type Quat = readonly [x: number, y: number, z: number, w: number];

/** As many numbers as there have to be, as the engine takes them. Whether they are finite is for the engine to say. */
function numbers(value: ArrayLike<number>, count: number, path: string): Float32Array {
  const is_list = typeof value === "object" && value !== null && value.length === count;
  if (!is_list || !Array.from(value).every((number) => typeof number === "number")) {
    throw invalid(path, `it is not a list of ${count} numbers`);
  }
  return Float32Array.from(value);
}

export function vec3(value: Vec3, path: string): Float32Array {
  return numbers(value, 3, path);
}

export function quat(value: Quat, path: string): Float32Array {
  return numbers(value, 4, path);
}

/** A number; the engine says whether it is in its range. */
export function number(value: number, path: string): number {
  if (typeof value !== "number") throw invalid(path, `${String(value)} is not a number`);
  return value;
}

/** A handle or an index: what is no whole number names nothing. */
export function handle(value: number): number {
  return Number.isInteger(value) && value >= 0 && value < 0xffffffff ? value : 0xffffffff;
}

/** A document or a part of one as a text; a text is one already. */
export function text(value: object | string, path: string): string {
  if (typeof value === "string") return value;
  try {
    const written = JSON.stringify(value) as string | undefined;
    if (written !== undefined) return written;
  } catch (error) {
    throw invalid(path, `it cannot be written as JSON: ${(error as Error).message}`);
  }
  throw invalid(path, "it is not an object");
}

/** Three numbers of a list. */
export function triple(list: ArrayLike<number>, at: number): Vec3 {
  return [list[at] ?? 0, list[at + 1] ?? 0, list[at + 2] ?? 0];
}
