import * as engine from "./engine/engine.js";
import { number, text } from "./checks.js";
import type { MeshSource, Scene } from "./document.js";
import { guarded, invalid, TautlineError, type Problem } from "./errors.js";
import { ready } from "./init.js";

/** A notation of documents; `json5` reads JSON too. */
export type Format = "json" | "json5";

/** A scene with a name and parameters. */
export interface NamedScene {
  readonly name: string;
  /** What there is to see, in a sentence. */
  readonly description: string;
  readonly parameters: readonly Parameter[];
}

/** Something that can be chosen about a named scene. */
export interface Parameter {
  readonly name: string;
  /** What it is, with its unit. */
  readonly description: string;
  readonly default: number;
  readonly min: number;
  readonly max: number;
  /** Whether it is a whole number. */
  readonly integer: boolean;
}

function asked<T>(call: () => T): T {
  ready();
  return guarded(call);
}

/** The engine's version. */
export function version(): string {
  return asked(() => engine.version());
}

/** All named scenes. */
export function scenes(): readonly NamedScene[] {
  return JSON.parse(asked(() => engine.scenes())) as NamedScene[];
}

/** The document of a named scene. Parameters that are not given have their defaults. */
export function document(name: string, parameters: Readonly<Record<string, number>> = {}): Scene {
  const names = Object.keys(parameters);
  const values = Object.entries(parameters).map(([name, value]) => number(value, `parameters.${name}`));
  return JSON.parse(asked(() => engine.document(String(name), names, Float64Array.from(values)))) as Scene;
}

/** The JSON schema of documents: a file beside the engine, which is loaded when it is asked for. */
export async function schema(): Promise<object> {
  return (await import("./schema.js")).SCHEMA;
}

/**
 * What is wrong with a text, `[]` if it is a scene; it throws for nothing that a text can hold. No world is built, so
 * what only shows then, such as an open mesh, is left for `new World` to say.
 */
export function validate(source: string, format: Format = "json"): Problem[] {
  return JSON.parse(asked(() => engine.validate(String(source), format))) as Problem[];
}

/** A text as a document, with every default filled in. Its values are not judged. */
export function parse(source: string, format: Format = "json"): Scene {
  return JSON.parse(asked(() => engine.parse(String(source), format))) as Scene;
}

/** The same scene for another solver, with that solver's own substeps, sweeps and tolerance. */
export function withSolver(scene: Scene, solver: "default" | "paper"): Scene {
  const source = text(scene, "scene");
  return JSON.parse(asked(() => engine.with_solver(source, solver))) as Scene;
}

/** The most bytes of a file. */
const FILE_BYTES = 64 * 2 ** 20;

/**
 * Reads a mesh file, told apart by its name: OBJ or STL. `scale` is what a unit of the file is in metres. Use it as
 * the shape `{ mesh }` of a rigid body or as the surface `{ mesh }` of a cloth.
 */
export function readMesh(bytes: Uint8Array, fileName: string, scale = 1): MeshSource {
  if (!(bytes instanceof Uint8Array)) throw invalid("bytes", "it is not a Uint8Array");
  // Before it is copied into the engine's memory.
  if (bytes.length > FILE_BYTES) {
    throw new TautlineError("invalid", [{ path: "bytes", message: `${bytes.length} bytes are more than ${FILE_BYTES}` }]);
  }
  const metres = number(scale, "scale");
  return JSON.parse(asked(() => engine.read_mesh(bytes, String(fileName), metres))) as MeshSource;
}

/** What a mesh is like. */
export interface MeshInfo {
  readonly vertices: number;
  readonly triangles: number;
  /** Whether it encloses something, as a solid has to. */
  readonly closed: boolean;
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** What a mesh is like. */
export function meshInfo(mesh: MeshSource): MeshInfo {
  const source = text(mesh, "mesh");
  return JSON.parse(asked(() => engine.mesh_info(source))) as MeshInfo;
}
