// Rigid bodies, cloth and rope in one world. Metres, kilograms, seconds, radians; Y up, right-handed; quaternions are
// x, y, z, w. What belongs to a scene document is spelled as there, with underscores.
export { BodyView, type BodyKind, type Mesh } from "./body.js";
export * from "./builders.js";
export type { Quat, Vec3 } from "./checks.js";
export type * from "./document.js";
export { TautlineError, type ErrorKind, type Problem } from "./errors.js";
export type { AttachmentHandle, BodyHandle, GrabHandle, JointHandle } from "./handles.js";
export { init, isSupported, type Source } from "./init.js";
export type * from "./inspect.js";
export type { PhaseTimes, StepReport } from "./report.js";
export * from "./scenes.js";
export {
  World,
  type AttachmentView,
  type CastHit,
  type ContactEvent,
  type Grab,
  type Hit,
  type JointView,
  type QueryOptions,
  type WorldOptions,
} from "./world.js";
