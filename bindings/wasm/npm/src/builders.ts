// Bodies and shapes of documents, for `world.add`: plain functions, so that what is not used is left out.
import type { Body, Cloth, HalfSpace, MeshSource, Rigid, Room, Rope, Shape, SoftSolid } from "./document.js";
import type { Vec3 } from "./checks.js";

/** A solid that keeps its shape: a cube of 1 m unless it says otherwise. */
export const rigid = (fields: Rigid = {}): Body => ({ rigid: fields });
/** A sheet: 20 × 20 particles over 1 m × 1 m unless it says otherwise. */
export const cloth = (fields: Cloth = {}): Body => ({ cloth: fields });
/** A rope: 50 segments over 2 m unless it says otherwise. */
export const rope = (fields: Rope = {}): Body => ({ rope: fields });
/** A solid that gives: a jelly cube of 1 m unless it says otherwise. */
export const softSolid = (fields: SoftSolid = {}): Body => ({ soft_solid: fields });
/** An unmoving plane with everything behind it solid: the floor y = 0 unless it says otherwise. */
export const halfSpace = (fields: HalfSpace = {}): Body => ({ half_space: fields });
/** The inside of an unmoving box: six half-spaces. */
export const room = (fields: Room = {}): Body => ({ room: fields });

/** A box with these lengths of its edges, in m. */
export const box = (x: number, y: number, z: number): Shape => ({ box: { size: [x, y, z] } });
/** A ball; radius in m. */
export const sphere = (radius: number): Shape => ({ sphere: { radius } });
/** A cylinder along Y with half balls for ends; `height` is without them, in m. */
export const capsule = (radius: number, height: number): Shape => ({ capsule: { radius, height } });
/** A cylinder along Y, in m. */
export const cylinder = (radius: number, height: number): Shape => ({ cylinder: { radius, height } });
/** The convex hull of points. */
export const hull = (points: readonly Vec3[]): Shape => ({ hull: { points: points.map(([x, y, z]) => [x, y, z]) } });
/** A closed surface, such as `readMesh` returns. */
export const mesh = (source: MeshSource): Shape => ({ mesh: source });
