// What the page and the engine's worker say to each other: plain values that can be copied from one to the other.

import type { ContactPoint, GjkTrace, NamedScene, Settings, StepReport, Vec3 } from "tautline";

/** Where a scene comes from. */
export type Source =
  | { kind: "named"; name: string; values: Record<string, number>; settings: Settings }
  | { kind: "text"; text: string };

export type Solver = "default" | "paper";

/** What is wrong, as it is said to the user. */
export interface Problem {
  path: string;
  message: string;
  line?: number;
  column?: number;
}

/** A failure that crosses from the worker to the page. */
export interface Failure {
  message: string;
  problems: Problem[];
  /** The engine itself has stopped: it has to be started anew. */
  fatal: boolean;
}

/** What the page asks once. */
export interface Hello {
  version: string;
  scenes: readonly NamedScene[];
  schema: object;
}

/** A surface in its body's frame, or in the world; bodies of one shape have the same object. */
export interface Mesh {
  id: number;
  positions: Float32Array;
  indices: Uint32Array;
}

/** A body, as far as it has to be known to be drawn and taken hold of. */
export interface Part {
  handle: number;
  index: number;
  kind: "rigid" | "truss" | "cloth" | "rope" | "soft-solid" | "half-space";
  name: string;
  /** 0xrrggbb, sRGB. */
  color: number;
  look: "solid" | "round" | "sheet" | "tube" | "wall";
  mesh: Mesh | undefined;
  /** Of a tube, m. */
  radius: number;
  firstParticle: number;
  particleCount: number;
  triangles: Uint32Array;
  segments: Uint32Array;
  fixed: boolean;
}

export interface Camera {
  eye: Vec3;
  target: Vec3;
  fov: number;
}

/** A scene that has been built. */
export interface Opened {
  name: string;
  description: string;
  /** Its document, indented. */
  text: string;
  dt: number;
  seconds: number;
  camera: Camera | undefined;
  settings: Settings;
  frame: Frame;
}

/** The world after some steps. */
export interface Frame {
  time: number;
  stepCount: number;
  /** xyz of all particles. */
  positions: Float32Array;
  /** x y z qx qy qz qw of each body. */
  poses: Float32Array;
  /** Of each body: 1 = awake, 2 = never moves. */
  flags: Uint8Array;
  report: StepReport;
  energy: { kinetic: number; potential: number };
  /** Steps taken for this frame: fewer than asked for if they took too long. */
  stepsDone: number;
  /** The bodies, if they are not those of the frame before. */
  parts: Part[] | undefined;
  inspection: Inspection | undefined;
}

/** What is to be shown of how it works. */
export type Query =
  | { kind: "spheres"; level: number }
  | { kind: "boxes" }
  | { kind: "gjk"; pair: [number, number] | undefined }
  | { kind: "contacts" }
  | { kind: "colors" }
  | { kind: "order"; grabbed: { body: number; particle: number } | undefined }
  | { kind: "strain" };

export type QueryKind = Query["kind"];

/** A number for each stick of a body. */
export interface StickValues {
  body: number;
  values: Float32Array;
}

/** What there is to show. */
export type Inspection =
  | { kind: "spheres"; /** x y z r of each. */ spheres: Float32Array; levels: number }
  | { kind: "boxes"; /** Min xyz, max xyz of each body. */ boxes: Float32Array }
  | { kind: "gjk"; pair: [number, number] | undefined; trace: GjkTrace | undefined }
  | { kind: "contacts"; contacts: ContactPoint[] }
  | {
      kind: "colors";
      /** The colour of each stick; -1: in a row of their own. */
      sticks: StickValues[];
      pairs: { a: number; b: number; color: number }[];
      count: number;
    }
  | { kind: "order"; body: number | undefined; /** Place in the list, 0 to 1; -1: not in it. */ sticks: StickValues[] }
  | { kind: "strain"; sticks: StickValues[]; mean: number; max: number };

/** A mesh file that has become a body of the scene. */
export interface Imported {
  /** The scene's document with the body in it; `undefined` if it is too large to be edited. */
  text: string | undefined;
  message: string;
  frame: Frame;
}

/** What the worker does. Every call is answered in order. */
export interface Engine {
  hello(): Promise<Hello>;
  open(source: Source, solver: Solver | undefined): Opened;
  /** Takes up to `steps` steps, and stops once `budget` (ms) is used up. */
  advance(steps: number, budget: number): Frame;
  /** What there is to see of how it works from the next frame on. */
  inspect(query: Query | undefined): Frame;
  grab(body: number, point: Vec3): number;
  moveGrab(grab: number, target: Vec3): void;
  release(grab: number): void;
  changeSettings(changes: Settings): Settings;
  check(text: string): Problem[];
  importMesh(bytes: Uint8Array, fileName: string, text: string): Imported;
  startRecording(): void;
  exportGlb(): Uint8Array;
  hash(): string;
}

export interface Request {
  id: number;
  method: keyof Engine;
  arguments: unknown[];
}

export type Reply = { id: number; value: unknown } | { id: number; failure: Failure };
