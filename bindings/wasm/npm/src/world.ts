import { Session } from "./engine/engine.js";
import { BodyView, type Described, type Mesh } from "./body.js";
import { handle, number, quat, text, triple, vec3, type Quat, type Vec3 } from "./checks.js";
import type { Attachment, Body, Bounds, Camera, Joint, Scene, Settings, Shape } from "./document.js";
import { guarded, invalid, TautlineError } from "./errors.js";
import type { AttachmentHandle, BodyHandle, GrabHandle, JointHandle } from "./handles.js";
import { ready } from "./init.js";
import { Inspect } from "./inspect.js";
import { NO_REPORT, reportOf, type StepReport } from "./report.js";
import type { Format } from "./scenes.js";
import { bytes, floats } from "./views.js";

/** How a world is made. */
export interface WorldOptions {
  /** The notation of a scene that is given as a text; `json` if absent. */
  readonly format?: Format;
  /** Whether its motion is recorded from the start. */
  readonly record?: boolean;
}

/** Which bodies a question is about; all if absent. */
export interface QueryOptions {
  /** But not this one. */
  readonly exclude?: BodyHandle;
  /** Whether bodies that never move are found. */
  readonly fixed?: boolean;
  /** Whether bodies that can move are found. */
  readonly movable?: boolean;
  /** How far is looked, in m; 1000 if absent. */
  readonly max?: number;
}

/** Where a ray enters a body, or the place of a body that is closest to a point. */
export interface Hit {
  readonly body: BodyHandle;
  /** In m. */
  readonly point: Vec3;
  /** Unit, out of the body. */
  readonly normal: Vec3;
  /** In m; of the closest point negative inside. */
  readonly distance: number;
}

/** Where a moving shape touches a body first. */
export interface CastHit {
  readonly body: BodyHandle;
  readonly point: Vec3;
  readonly normal: Vec3;
  /** Of its way, 0 to 1. */
  readonly fraction: number;
}

/** Two bodies of which one reports its contacts. */
export interface ContactEvent {
  readonly kind: "began" | "persists" | "ended";
  readonly a: BodyHandle;
  readonly b: BodyHandle;
  readonly point: Vec3;
  /** From a to b. */
  readonly normal: Vec3;
  /** In the last step, in N s. */
  readonly impulse: number;
  /** When it began, in m/s. */
  readonly approachSpeed: number;
}

/** A joint as it is now. */
export interface JointView {
  readonly handle: JointHandle;
  readonly kind: "ball" | "hinge" | "fixed" | "slider" | "distance";
  readonly body: BodyHandle;
  /** `null` = the world. */
  readonly base: BodyHandle | null;
  /** On the body and on the base, in m. */
  readonly anchors: readonly [Vec3, Vec3];
  /** Of a hinge, in rad. */
  readonly angle: number | null;
  /** Of a slider, or the length of a distance joint, in m. */
  readonly translation: number | null;
  /** Mean force in the last step, in N. */
  readonly force: Vec3;
  readonly isBroken: boolean;
}

/** An attachment as it is now. */
export interface AttachmentView {
  readonly handle: AttachmentHandle;
  /** `null` = the world. */
  readonly bodies: readonly [BodyHandle | null, BodyHandle | null];
  /** In m. */
  readonly ends: readonly [Vec3, Vec3];
  /** Mean force in the last step, in N. */
  readonly force: Vec3;
  readonly isBroken: boolean;
}

/** A hand on a body. */
export interface Grab {
  readonly handle: GrabHandle;
  readonly body: BodyHandle;
  /** Where it holds, in m. */
  readonly point: Vec3;
  /** Where it draws to, in m. */
  readonly target: Vec3;
}

const EMPTY = new Float32Array();
/** A world with nothing in it. */
const NOTHING: Scene = { tautline: 1 };

/** Everything that is simulated together: rigid bodies, cloth, rope and what holds them. */
export class World {
  /** The document's name. */
  readonly name: string;
  readonly description: string;
  /** The document's time step, in s. */
  readonly dt: number;
  /** How long the document says it runs, in s. */
  readonly seconds: number;
  /** Where the document wants it to be seen from. */
  readonly camera: Camera | undefined;
  /** The box that the document says bodies belong in. */
  readonly bounds: Bounds | undefined;
  /** How it works, for pictures. */
  readonly inspect: Inspect = new Inspect(() => this.engine());
  /** The last step's. */
  report: StepReport = NO_REPORT;

  private session: Session | undefined;
  private known: BodyView[] | undefined;
  private readonly meshes = new Map<number, Mesh>();
  private readonly positionView = floats();
  private readonly poseView = floats();
  private readonly flagView = bytes();

  /** A world of a document, given as an object or as a text; an empty one without. */
  constructor(scene: Scene | string = NOTHING, { format = "json", record = false }: WorldOptions = {}) {
    ready();
    const source = text(scene, "scene");
    this.session = guarded(() => new Session(source, format));
    const about = JSON.parse(this.ask((session) => session.about())) as Required<Scene>;
    this.name = about.name;
    this.description = about.description;
    this.dt = about.dt;
    this.seconds = about.seconds;
    this.camera = about.camera ?? undefined;
    this.bounds = about.bounds ?? undefined;
    if (record) this.startRecording();
  }

  /** Frees its memory. It cannot be used any more. */
  dispose(): void {
    this.session?.free();
    this.session = undefined;
    this.forget();
  }

  /** Simulated time, in s. */
  get time(): number {
    return this.ask((session) => session.time());
  }

  /** How many steps it has taken since it was built. */
  get stepCount(): number {
    return this.ask((session) => session.steps());
  }

  /** Takes a step, of the document's `dt` unless another is given, in s: 1e-7 to 1. Cues of the document are followed. */
  step(dt: number = this.dt): StepReport {
    const seconds = number(dt, "dt");
    const row = this.ask((session) => session.step(seconds));
    this.report = reportOf(row, () => this.ask((session) => session.faults()));
    return this.report;
  }

  /** Everything as it was built. What was added since is gone; handles of the document's bodies stay good. */
  reset(): void {
    this.ask((session) => session.reset());
    this.meshes.clear();
    this.forget();
  }

  /** All bodies, in their order; another array once one has come or gone. */
  get bodies(): readonly BodyView[] {
    if (this.known === undefined) {
      const described = JSON.parse(this.ask((session) => session.bodies())) as Described[];
      const source = {
        session: () => this.engine(),
        world: this,
        get positions() {
          return this.world.positions;
        },
        get poses() {
          return this.world.poses;
        },
        get flags() {
          return this.world.flags;
        },
        mesh: (id: number) => this.mesh(id),
      };
      this.known = described.map((body, index) => new BodyView(source, index, body));
    }
    return this.known;
  }

  /** A body of a handle. */
  body(body: BodyHandle): BodyView {
    const found = this.bodies.find(({ handle }) => handle === body);
    if (found !== undefined) return found;
    throw new TautlineError("stale", [{ path: "", message: "this handle names no body, or none any more" }]);
  }

  /** The body of a name. */
  bodyNamed(name: string): BodyView | undefined {
    return this.bodies.find((body) => body.name === name);
  }

  /** Adds a body of a document. Of a room, which is six half-spaces, the handle is the first one's. */
  add(body: Body): BodyHandle {
    const source = text(body, "body");
    const added = this.ask((session) => session.add(source)) as BodyHandle;
    this.known = undefined;
    return added;
  }

  /** Removes a body with its joints and attachments. */
  remove(body: BodyHandle): void {
    this.ask((session) => session.remove(handle(body)));
    this.known = undefined;
  }

  /** Adds a joint of a document, whose bodies are named by their names or handles. */
  addJoint(joint: Joint): JointHandle {
    const source = text(joint, "joint");
    return this.ask((session) => session.add_joint(source)) as JointHandle;
  }

  removeJoint(joint: JointHandle): void {
    this.ask((session) => session.remove_joint(handle(joint)));
  }

  /** Adds an attachment of a document, whose bodies are named by their names or handles. */
  addAttachment(attachment: Attachment): AttachmentHandle {
    const source = text(attachment, "attachment");
    return this.ask((session) => session.attach(source)) as AttachmentHandle;
  }

  removeAttachment(attachment: AttachmentHandle): void {
    this.ask((session) => session.detach(handle(attachment)));
  }

  get joints(): readonly JointView[] {
    return JSON.parse(this.ask((session) => session.joints())) as JointView[];
  }

  get attachments(): readonly AttachmentView[] {
    return JSON.parse(this.ask((session) => session.attachments())) as AttachmentView[];
  }

  /** Drives a hinge (rad/s, N m) or slider (m/s, N); `null` lets it go. */
  setMotor(joint: JointHandle, motor: { readonly speed: number; readonly strength: number } | null): void {
    const list = motor === null ? [] : [number(motor.speed, "motor.speed"), number(motor.strength, "motor.strength")];
    this.ask((session) => session.set_motor(handle(joint), Float32Array.from(list)));
  }

  /** The lowest and the highest angle (rad), shift or length (m); `null` takes them away. */
  setLimits(joint: JointHandle, limits: readonly [number, number] | null): void {
    const list = limits === null ? [] : [number(limits[0], "limits[0]"), number(limits[1], "limits[1]")];
    this.ask((session) => session.set_limits(handle(joint), Float32Array.from(list)));
  }

  /**
   * x, y, z of all particles, body after body, in m: a view into the engine's memory, without a copy. It is good until
   * the next call of any world: read it from here anew each time, and copy what is to be kept.
   */
  get positions(): Float32Array {
    return this.positionView.at(this.ask((session) => session.positions()));
  }

  /** x, y, z and the quaternion x, y, z, w of each body in their order; a view as `positions`. */
  get poses(): Float32Array {
    return this.poseView.at(this.ask((session) => session.poses()));
  }

  /** Bits of each body in their order, 1 = awake, 2 = never moves; a view as `positions`. */
  get flags(): Uint8Array {
    return this.flagView.at(this.ask((session) => session.flags()));
  }

  /**
   * Takes hold of a body at a point. It is drawn to where `moveGrab` says, by a spring of `frequency` (8 Hz if absent)
   * that accelerates it by at most `maxAcceleration` (500 m/s² if absent).
   */
  grab(
    body: BodyHandle,
    point: Vec3,
    { frequency = 8, maxAcceleration = 500 }: { readonly frequency?: number; readonly maxAcceleration?: number } = {},
  ): GrabHandle {
    const [at, hertz, most] = [vec3(point, "point"), number(frequency, "frequency"), number(maxAcceleration, "maxAcceleration")];
    return this.ask((session) => session.grab(handle(body), at, hertz, most)) as GrabHandle;
  }

  moveGrab(grab: GrabHandle, target: Vec3): void {
    const to = vec3(target, "target");
    this.ask((session) => session.move_grab(handle(grab), to));
  }

  /** Lets go: the body flies on as it moves. */
  release(grab: GrabHandle): void {
    this.ask((session) => session.release(handle(grab)));
  }

  /** What is held. */
  get grabs(): readonly Grab[] {
    return JSON.parse(this.ask((session) => session.grabs())) as Grab[];
  }

  setPose(body: BodyHandle, position: Vec3, rotation: Quat = [0, 0, 0, 1]): void {
    const [at, turned] = [vec3(position, "position"), quat(rotation, "rotation")];
    this.ask((session) => session.set_pose(handle(body), at, turned));
  }

  setVelocity(body: BodyHandle, velocity: Vec3): void {
    const value = vec3(velocity, "velocity");
    this.ask((session) => session.set_velocity(handle(body), value));
  }

  setAngularVelocity(body: BodyHandle, velocity: Vec3): void {
    const value = vec3(velocity, "velocity");
    this.ask((session) => session.set_angular_velocity(handle(body), value));
  }

  /** A force (N) during the next step, at the centre of mass or at a point of a rigid body (m, world). */
  applyForce(body: BodyHandle, force: Vec3, point?: Vec3): void {
    const [value, at] = [vec3(force, "force"), point === undefined ? EMPTY : vec3(point, "point")];
    this.ask((session) => session.apply_force(handle(body), value, at));
  }

  /** An impulse (N s) at once, at the centre of mass or at a point of a rigid body (m, world). */
  applyImpulse(body: BodyHandle, impulse: Vec3, point?: Vec3): void {
    const [value, at] = [vec3(impulse, "impulse"), point === undefined ? EMPTY : vec3(point, "point")];
    this.ask((session) => session.apply_impulse(handle(body), value, at));
  }

  /** A torque (N m) on a rigid body during the next step. */
  applyTorque(body: BodyHandle, torque: Vec3): void {
    const value = vec3(torque, "torque");
    this.ask((session) => session.apply_torque(handle(body), value));
  }

  /** Pins a particle of a sheet or rope where it is. */
  pin(body: BodyHandle, particle: number): void {
    this.ask((session) => session.pin(handle(body), handle(particle)));
  }

  unpin(body: BodyHandle, particle: number): void {
    this.ask((session) => session.unpin(handle(body), handle(particle)));
  }

  /** Puts a particle somewhere, in m; this is how pinned ones are moved. */
  setParticlePosition(body: BodyHandle, particle: number, position: Vec3): void {
    const at = vec3(position, "position");
    this.ask((session) => session.set_particle_position(handle(body), handle(particle), at));
  }

  /** The velocity of a particle of a sheet, rope or soft solid, in m/s. */
  setParticleVelocity(body: BodyHandle, particle: number, velocity: Vec3): void {
    const value = vec3(velocity, "velocity");
    this.ask((session) => session.set_particle_velocity(handle(body), handle(particle), value));
  }

  /** The length of a rope at rest, in m. */
  ropeLength(rope: BodyHandle): number {
    return this.ask((session) => session.rope_length(handle(rope)));
  }

  /** Winds a rope in or out, in m. */
  setRopeLength(rope: BodyHandle, length: number): void {
    const metres = number(length, "length");
    this.ask((session) => session.set_rope_length(handle(rope), metres));
  }

  /** The velocity of the air, in m/s. */
  setWind(wind: Vec3): void {
    const value = vec3(wind, "wind");
    this.ask((session) => session.set_wind(value));
  }

  wake(body: BodyHandle): void {
    this.ask((session) => session.wake(handle(body)));
  }

  /** The first body that a ray enters. */
  rayCast(origin: Vec3, direction: Vec3, options: QueryOptions = {}): Hit | undefined {
    const [from, along, max] = [vec3(origin, "origin"), vec3(direction, "direction"), reach(options)];
    const hit = this.ask((session) => session.ray_cast(from, along, max, which(options)));
    return (JSON.parse(hit) as Hit | null) ?? undefined;
  }

  /** All bodies that a ray enters, nearest first. */
  rayCastAll(origin: Vec3, direction: Vec3, options: QueryOptions = {}): Hit[] {
    const [from, along, max] = [vec3(origin, "origin"), vec3(direction, "direction"), reach(options)];
    return JSON.parse(this.ask((session) => session.ray_cast_all(from, along, max, which(options)))) as Hit[];
  }

  /** The place of a body that is closest to a point. */
  closestPoint(point: Vec3, options: QueryOptions = {}): Hit | undefined {
    const [at, max] = [vec3(point, "point"), reach(options)];
    const hit = this.ask((session) => session.closest_point(at, max, which(options)));
    return (JSON.parse(hit) as Hit | null) ?? undefined;
  }

  /** The bodies that a shape would overlap. */
  overlap(shape: Shape, position: Vec3, rotation: Quat = [0, 0, 0, 1], options: QueryOptions = {}): BodyHandle[] {
    const [made, at, turned] = [text(shape, "shape"), vec3(position, "position"), quat(rotation, "rotation")];
    return Array.from(this.ask((session) => session.overlap(made, at, turned, which(options)))) as BodyHandle[];
  }

  /** What a shape would touch first on its way. */
  shapeCast(shape: Shape, position: Vec3, rotation: Quat, motion: Vec3, options: QueryOptions = {}): CastHit | undefined {
    const [made, at] = [text(shape, "shape"), vec3(position, "position")];
    const [turned, way] = [quat(rotation, "rotation"), vec3(motion, "motion")];
    const hit = this.ask((session) => session.shape_cast(made, at, turned, way, which(options)));
    return (JSON.parse(hit) as CastHit | null) ?? undefined;
  }

  /** Whether a rigid body's contacts are among `contactEvents` from the next step on. */
  reportContacts(body: BodyHandle, on: boolean): void {
    this.ask((session) => session.report_contacts(handle(body), on === true));
  }

  /** What began to touch, still touched and parted in the last step. */
  get contactEvents(): readonly ContactEvent[] {
    return JSON.parse(this.ask((session) => session.contact_events())) as ContactEvent[];
  }

  /** Joints that broke in the last step. */
  get jointEvents(): readonly { readonly kind: "broke"; readonly joint: JointHandle }[] {
    const broken = Array.from(this.ask((session) => session.broken_joints())) as JointHandle[];
    return broken.map((joint) => ({ kind: "broke", joint }));
  }

  /** In J. */
  energy(): { kinetic: number; potential: number } {
    const [kinetic = 0, potential = 0] = this.ask((session) => session.energy());
    return { kinetic, potential };
  }

  /** In N s. */
  momentum(): Vec3 {
    return triple(this.ask((session) => session.measures()), 2);
  }

  /** How far sticks are from their lengths, as a share of them. */
  strain(): { mean: number; max: number } {
    const measures = this.ask((session) => session.measures());
    return { mean: measures[5] ?? 0, max: measures[6] ?? 0 };
  }

  /** How deep bodies are in each other, in m. */
  penetration(): { deepest: number; mean: number; count: number } {
    const measures = this.ask((session) => session.measures());
    return { deepest: measures[7] ?? 0, mean: measures[8] ?? 0, count: measures[9] ?? 0 };
  }

  /** 16 hexadecimal digits, the same on every platform for the same scene and steps. */
  stateHash(): string {
    return this.ask((session) => session.state_hash());
  }

  /** The whole world as bytes. */
  snapshot(): Uint8Array {
    return this.ask((session) => session.snapshot());
  }

  /** Goes back, or on, to a snapshot: the same steps give the same bits from there. It ends a recording. */
  restore(snapshot: Uint8Array): void {
    if (!(snapshot instanceof Uint8Array)) throw invalid("snapshot", "it is not a Uint8Array");
    this.ask((session) => session.restore(snapshot));
    this.forget();
  }

  /** The settings in force, every one of them. */
  get settings(): Settings {
    return JSON.parse(this.ask((session) => session.settings())) as Settings;
  }

  /** Changes settings from the next step on, but for the solver: that takes another world, see `withSolver`. */
  setSettings(changes: Settings): void {
    const source = text({ ...this.settings, ...changes }, "settings");
    this.ask((session) => session.set_settings(source));
  }

  /** Records from now on; what was recorded before is thrown away. */
  startRecording(): void {
    this.ask((session) => session.start_recording());
  }

  get isRecording(): boolean {
    return this.ask((session) => session.recorded_frames()) >= 0;
  }

  get recordedFrames(): number {
    return Math.max(0, this.ask((session) => session.recorded_frames()));
  }

  /** The recording as a GLB file; of a world that is not recorded, as it is now. */
  exportGlb(): Uint8Array {
    return this.ask((session) => session.glb());
  }

  private forget(): void {
    this.known = undefined;
    this.report = NO_REPORT;
  }

  private mesh(id: number): Mesh {
    let mesh = this.meshes.get(id);
    if (mesh === undefined) {
      const [positions, indices] = this.ask((session) => [session.mesh_positions(id), session.mesh_indices(id)]);
      mesh = { id, positions, indices };
      this.meshes.set(id, mesh);
    }
    return mesh;
  }

  private engine(): Session {
    if (this.session !== undefined) return this.session;
    throw new TautlineError("stale", [{ path: "", message: "this world has been disposed of" }]);
  }

  private ask<T>(question: (session: Session) => T): T {
    return guarded(() => question(this.engine()));
  }
}

function reach({ max = 1000 }: QueryOptions): number {
  return number(max, "max");
}

function which({ exclude, fixed = true, movable = true }: QueryOptions): Int32Array {
  return Int32Array.of(exclude === undefined ? -1 : Math.min(handle(exclude), 0x7fffffff), Number(fixed), Number(movable));
}
