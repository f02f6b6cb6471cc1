import { guarded } from "./errors.js";
import { handle, type Vec3 } from "./checks.js";
import type { Session } from "./engine/engine.js";
import type { BodyHandle } from "./handles.js";

/** Bounding spheres of a body. */
export interface SphereTree {
  /** x, y, z, radius of each, in m. */
  readonly spheres: Float32Array;
  /** The level of each, 0 being the root. */
  readonly levels: Uint16Array;
  readonly levelCount: number;
}

/** A vertex of the difference A ⊖ B: a vertex of A minus one of B. */
export interface CsoVertex {
  readonly point: Vec3;
  readonly onA: Vec3;
  readonly onB: Vec3;
}

/** What an iteration of GJK did. */
export interface GjkIteration {
  /** Where the support point was sought. */
  readonly direction: Vec3;
  /** What was found there. */
  readonly support: CsoVertex;
  /** The simplex after it was taken in and reduced, with the weights of its point closest to the origin. */
  readonly simplex: readonly (CsoVertex & { readonly weight: number })[];
  /** That point. */
  readonly closest: Vec3;
  /** Of it from the origin, in m. */
  readonly distance: number;
}

/** A vertex (one point), edge (two) or face (three), with the weights of a point of it. */
export interface Feature {
  readonly points: readonly Vec3[];
  readonly weights: readonly number[];
}

/** Where two bodies that overlap are hit. */
export interface HitFace {
  /** Its corners: those of the face of A ⊖ B that is nearest to the origin. */
  readonly vertices: readonly [CsoVertex, CsoVertex, CsoVertex];
  /** Unit, from A to B. */
  readonly normal: Vec3;
  /** In m. */
  readonly depth: number;
  readonly featureA: Feature;
  readonly featureB: Feature;
}

/** How GJK finds out how two bodies lie. */
export interface GjkTrace {
  /** A ⊖ B as a mesh; `null` where it is too large to draw. */
  readonly difference: { readonly positions: Float32Array; readonly indices: Uint32Array } | null;
  readonly iterations: readonly GjkIteration[];
  readonly result: "separated" | "intersecting" | "unresolved";
  /** The closest points, or those that separation would move. */
  readonly points: readonly [Vec3, Vec3];
  /** In m; below 0 how deep they are in each other. */
  readonly distance: number;
  /** `null` if they are apart. */
  readonly hitFace: HitFace | null;
}

/** A place where two bodies touch. */
export interface ContactPoint {
  readonly a: BodyHandle;
  readonly b: BodyHandle;
  /** On the surface of either, in m. */
  readonly pointA: Vec3;
  readonly pointB: Vec3;
  /** Unit, from a to b. */
  readonly normal: Vec3;
  /** In m; below 0 they are apart. */
  readonly depth: number;
  /** Along the normal in the last substep, in N s; 0 where particles are moved apart instead. */
  readonly impulse: number;
  /** What touches, where particles are moved apart; `null` elsewhere and for half-spaces. */
  readonly featureA: Feature | null;
  readonly featureB: Feature | null;
}

/** A pair of rigid bodies in contact. Pairs of one colour share no body that moves, and are solved at once. */
export interface ContactColor {
  readonly a: BodyHandle;
  readonly b: BodyHandle;
  readonly color: number;
}

/** How it works, for pictures: copies of what a step has left. Nothing here changes the world. */
export class Inspect {
  /** Worlds make them. */
  constructor(private readonly session: () => Session) {}

  /** The sphere tree of a truss, cloth or rope; `undefined` for what has none. */
  sphereTree(body: BodyHandle): SphereTree | undefined {
    const rows = this.ask((session) => session.spheres(handle(body)));
    const count = rows.length / 5;
    if (count === 0) return undefined;
    const [spheres, levels] = [new Float32Array(4 * count), new Uint16Array(count)];
    for (let i = 0; i < count; i++) {
      spheres.set(rows.subarray(5 * i, 5 * i + 4), 4 * i);
      levels[i] = rows[5 * i + 4] ?? 0;
    }
    return { spheres, levels, levelCount: levels.reduce((most, level) => Math.max(most, level), 0) + 1 };
  }

  /** The lowest and the highest corner of the box around each body in their order, 6 numbers; infinite for half-spaces. */
  boxes(): Float32Array {
    return this.ask((session) => session.boxes());
  }

  /** GJK between the convex hulls of two rigid bodies or trusses, from nothing, and the hit face if they overlap. */
  gjk(a: BodyHandle, b: BodyHandle): GjkTrace {
    const trace = JSON.parse(this.ask((session) => session.gjk(handle(a), handle(b)))) as GjkTrace & {
      difference: { positions: number[]; indices: number[] } | null;
    };
    if (trace.difference === null) return trace;
    const { positions, indices } = trace.difference;
    return { ...trace, difference: { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) } };
  }

  /** Where bodies touch, but for cloth and rope that move in small steps. */
  contacts(): ContactPoint[] {
    return JSON.parse(this.ask((session) => session.contact_points())) as ContactPoint[];
  }

  /**
   * For each of a body's segments its colour: those of one are relaxed side by side, colour after colour. Empty where
   * they are relaxed one after another.
   */
  stickColors(body: BodyHandle): Uint32Array {
    return this.ask((session) => session.stick_colors(handle(body)));
  }

  /** Pairs of rigid bodies in contact by what is solved at once. */
  contactColors(): ContactColor[] {
    const rows = this.ask((session) => session.contact_colors());
    const pairs: ContactColor[] = [];
    for (let i = 0; i + 2 < rows.length; i += 3) {
      pairs.push({ a: rows[i] as BodyHandle, b: rows[i + 1] as BodyHandle, color: rows[i + 2] ?? 0 });
    }
    return pairs;
  }

  /** The paper's list for a particle of a truss: its segments in the order of relaxation, the near ones repeated. */
  orderedList(truss: BodyHandle, particle: number): Uint32Array {
    return this.ask((session) => session.ordered_list(handle(truss), handle(particle)));
  }

  /** By which share of its rest length each of a body's segments is too long. */
  strain(body: BodyHandle): Float32Array {
    return this.ask((session) => session.strains(handle(body)));
  }

  private ask<T>(question: (session: Session) => T): T {
    return guarded(() => question(this.session()));
  }
}
