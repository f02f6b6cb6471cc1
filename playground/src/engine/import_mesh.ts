// A mesh file becomes a body: a rigid one if its surface is closed, else a cloth.

import type { Body, MeshSource, Scene, World } from "tautline";
import { meshInfo, parse, readMesh } from "tautline";

import { indented } from "./json";
import type { Imported } from "./protocol";

/** Files drawn in millimetres, inches or feet become things that a scene has room for, m. */
const SMALLEST = 0.2;
const LARGEST = 2;
/** A mesh of more triangles stays out of the document: no editor would be quick with it. */
const MOST_EDITABLE = 5000;

/** Adds a mesh to the world, and to its document unless it is large. */
export function importMesh(world: World, bytes: Uint8Array, fileName: string, text: string): Omit<Imported, "frame"> {
  const scale = scaleOf(readMesh(bytes, fileName));
  const source = readMesh(bytes, fileName, scale);
  const info = meshInfo(source);
  const body = bodyOf(source, info.closed, world, info.min);
  world.add(body);
  const kind = info.closed ? "a rigid body" : "a cloth, since its surface is open";
  const scaled = scale === 1 ? "" : `, scaled by ${Number(scale.toPrecision(3))}`;
  const message = `${fileName}: ${info.triangles} triangles, ${kind}${scaled}.`;
  if (info.triangles > MOST_EDITABLE) {
    return { text: undefined, message: `${message} It is too large for the document: a reset takes it out.` };
  }
  const scene: Scene = parse(text);
  return { text: indented({ ...scene, bodies: [...(scene.bodies ?? []), body] }), message };
}

function scaleOf(source: MeshSource): number {
  const { min, max } = meshInfo(source);
  const extent = Math.max(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  if (!(extent > 0) || (extent >= SMALLEST && extent <= LARGEST)) return 1;
  return 1 / extent;
}

/** Above everything there is, so that it falls into the scene. */
function bodyOf(mesh: MeshSource, closed: boolean, world: World, min: readonly number[]): Body {
  const top = world.positions.reduce((most, value, index) => (index % 3 === 1 ? Math.max(most, value) : most), 0);
  const position: [number, number, number] = [0, top + 0.3 - (min[1] ?? 0), 0];
  if (closed) return { rigid: { shape: { mesh }, position, mass: 1 } } as Body;
  return { cloth: { surface: { mesh }, position } } as Body;
}
