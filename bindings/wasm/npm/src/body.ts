import type { Session } from "./engine/engine.js";
import { triple, type Quat, type Vec3 } from "./checks.js";
import { guarded } from "./errors.js";
import type { BodyHandle } from "./handles.js";

/** What a body is. */
export type BodyKind = "rigid" | "truss" | "cloth" | "rope" | "soft-solid" | "half-space";

/** A surface to draw. */
export interface Mesh {
  /** The same for bodies that share it. */
  readonly id: number;
  /** x, y, z of each vertex, in m. */
  readonly positions: Float32Array;
  /** Three vertices for each triangle, counter-clockwise seen from outside. */
  readonly indices: Uint32Array;
}

/** What the engine says of a body, once. */
export interface Described {
  readonly numbers: readonly [handle: number, mesh: number | null, first: number, count: number];
  readonly kind: BodyKind;
  readonly name: string;
  readonly color: number;
  readonly look: BodyView["look"];
  readonly radius: number;
}

/** What a body reads from its world. */
export interface BodySource {
  session(): Session;
  readonly positions: Float32Array;
  readonly poses: Float32Array;
  readonly flags: Uint8Array;
  mesh(id: number): Mesh;
}

/** A body of a world, as it is whenever it is asked. */
export class BodyView {
  readonly handle: BodyHandle;
  readonly kind: BodyKind;
  /** Unique in the world. It may be any text: do not put it into HTML as it is. */
  readonly name: string;
  /** 0xrrggbb, sRGB. */
  readonly color: number;
  /**
   * How it is to be drawn: `solid` flat shaded, `round` smooth, `sheet` smooth and from both sides, `tube` along its
   * segments, `wall` only where it faces the camera.
   */
  readonly look: "solid" | "round" | "sheet" | "tube" | "wall";
  /** Radius of a tube, in m; 0 for all else. */
  readonly radius: number;
  /** Its place in `world.bodies`, `world.poses` and `world.flags`. */
  readonly index: number;
  /** Where its particles begin among those of the world. */
  readonly firstParticle: number;
  readonly particleCount: number;
  private readonly meshId: number | null;
  private sheet: Uint32Array | undefined;
  private sticks: Uint32Array | undefined;

  /** Worlds make them. */
  constructor(
    private readonly source: BodySource,
    index: number,
    { numbers, kind, name, color, look, radius }: Described,
  ) {
    const [handle, mesh, first, count] = numbers;
    this.handle = handle as BodyHandle;
    this.index = index;
    this.kind = kind;
    this.name = name;
    this.color = color;
    this.look = look;
    this.radius = radius;
    this.meshId = mesh;
    this.firstParticle = first;
    this.particleCount = count;
  }

  /** The surface of a solid, in the frame of its pose, or of a wall, in the world; bodies of one shape have the same. */
  get mesh(): Mesh | undefined {
    return this.meshId === null ? undefined : this.source.mesh(this.meshId);
  }

  /** The part of `world.positions` that is its own, in the engine's memory: see there. */
  get positions(): Float32Array {
    return this.source.positions.subarray(3 * this.firstParticle, 3 * (this.firstParticle + this.particleCount));
  }

  /** Three particles of its own for each triangle of a sheet. It is another array once the sheet has torn. */
  get triangles(): Uint32Array {
    const count = this.ask((session) => session.triangle_count(this.handle));
    const known = this.sheet;
    if (known?.length === 3 * count) return known;
    return (this.sheet = this.ask((session) => session.triangles(this.handle)));
  }

  /** Two particles of its own for each of its sticks; of a rope its segments. */
  get segments(): Uint32Array {
    return (this.sticks ??= this.ask((session) => session.segments(this.handle)));
  }

  /** Where the frame of its mesh is, in m; of sheets, ropes and half-spaces `undefined`. */
  get position(): Vec3 | undefined {
    return this.hasPose() ? triple(this.source.poses, 7 * this.index) : undefined;
  }

  /** How that frame is turned. */
  get rotation(): Quat | undefined {
    if (!this.hasPose()) return undefined;
    const [x = 0, y = 0, z = 0, w = 1] = this.source.poses.subarray(7 * this.index + 3, 7 * this.index + 7);
    return [x, y, z, w];
  }

  /** In m. */
  get centerOfMass(): Vec3 {
    return triple(this.state(), 0);
  }

  /** Of its centre of mass, in m/s. */
  get velocity(): Vec3 {
    return triple(this.state(), 3);
  }

  /** Of a rigid body, in rad/s, in the world's frame; else 0. */
  get angularVelocity(): Vec3 {
    return triple(this.state(), 6);
  }

  /** In kg. */
  get mass(): number {
    return this.state()[9] ?? 0;
  }

  /** Of the gas in a closed sheet, over the surroundings, in Pa; `undefined` where there is none. */
  get pressure(): number | undefined {
    const pressure = this.state()[10] ?? Number.NaN;
    return Number.isNaN(pressure) ? undefined : pressure;
  }

  /** What moves it. */
  get motion(): "dynamic" | "kinematic" | "fixed" {
    return this.ask((session) => session.motion(this.handle)) as "dynamic" | "kinematic" | "fixed";
  }

  /** Whether it rests and is not moved until something wakes it. */
  get isAsleep(): boolean {
    return ((this.source.flags[this.index] ?? 0) & 1) === 0;
  }

  /** Its particles that do not move; none of a rigid body. */
  get pins(): Uint32Array {
    return this.ask((session) => session.pins(this.handle));
  }

  private hasPose(): boolean {
    return this.kind === "rigid" || this.kind === "truss";
  }

  private state(): Float32Array {
    return this.ask((session) => session.state(this.handle));
  }

  private ask<T>(question: (session: Session) => T): T {
    return guarded(() => question(this.source.session()));
  }
}
