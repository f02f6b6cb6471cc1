import type { BodyView, Mesh } from "../body.js";
import type { ErrorKind, Problem } from "../errors.js";
import type { StepReport } from "../report.js";
import type { World } from "../world.js";

/** What can be asked of a world in a worker, besides steps. */
export type Method =
  | "grab" | "moveGrab" | "release" | "add" | "remove" | "addJoint" | "removeJoint" | "setVelocity" | "applyImpulse"
  | "rayCast" | "stateHash" | "snapshot" | "restore" | "reset" | "settings" | "setSettings" | "energy" | "exportGlb";

/** What a method takes; of a property nothing. */
export type Arguments<K extends Method> = World[K] extends (...values: infer A) => unknown ? A : [];
/** What a method gives. */
export type Result<K extends Method> = World[K] extends (...values: never[]) => infer R ? R : World[K];

/** A body as it can be sent. */
export type BodyDescription = Pick<
  BodyView,
  "handle" | "index" | "kind" | "name" | "color" | "look" | "radius" | "firstParticle" | "particleCount" | "segments"
> & { readonly mesh: Mesh | undefined; readonly triangles: Uint32Array };

/** A world after steps. The arrays are copies. */
export interface WorkerFrame {
  readonly time: number;
  readonly stepCount: number;
  readonly positions: Float32Array;
  readonly poses: Float32Array;
  readonly flags: Uint8Array;
  readonly report: StepReport;
  /** All bodies, if one has come, gone or torn since the last frame. */
  readonly bodies: readonly BodyDescription[] | undefined;
}

/** From the page. */
export type Request =
  | { readonly id: number; readonly kind: "create"; readonly scene: unknown; readonly wasm: string | undefined }
  | { readonly id: number; readonly kind: "step"; readonly count: number }
  | { readonly id: number; readonly kind: "call"; readonly method: Method; readonly values: readonly unknown[] };

/** To the page. */
export type Answer =
  | { readonly id: number; readonly value: unknown }
  | { readonly id: number; readonly error: { readonly kind: ErrorKind; readonly problems: readonly Problem[] } };
