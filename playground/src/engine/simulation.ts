// The worker's world: built from a document, stepped within a budget of time, and described for the page.

import type { BodyHandle, BodyView, GrabHandle, Scene, Settings, StepReport, Vec3 } from "tautline";
import { World, document, parse, schema, scenes, validate, version, withSolver } from "tautline";

import { importMesh } from "./import_mesh";
import { inspect } from "./inspect";
import { indented } from "./json";
import type { Camera, Engine, Frame, Hello, Imported, Opened, Part, Problem, Query, Solver, Source } from "./protocol";

export class Simulation implements Engine {
  private readonly ready: Promise<void>;
  private world: World | undefined;
  private query: Query | undefined;
  /** What the page has been told of: the array is another one once bodies come or go. */
  private told: { bodies: readonly BodyView[]; triangles: number } | undefined;

  constructor(ready: Promise<void>) {
    this.ready = ready;
  }

  async hello(): Promise<Hello> {
    await this.ready;
    return { version: version(), scenes: scenes(), schema: await schema() };
  }

  open(source: Source, solver: Solver | undefined): Opened {
    let scene = read(source);
    if (solver !== undefined) scene = withSolver(scene, solver);
    const world = new World(scene);
    this.world?.dispose();
    this.world = world;
    this.told = undefined;
    return {
      name: world.name,
      description: world.description,
      text: source.kind === "text" ? source.text : indented(scene),
      dt: world.dt,
      seconds: world.seconds,
      // Complete: the engine has filled its defaults in.
      camera: world.camera as Required<Camera> | undefined,
      settings: world.settings,
      frame: this.frame(0),
    };
  }

  advance(steps: number, budget: number): Frame {
    const world = this.opened();
    const begin = performance.now();
    let done = 0;
    while (done < steps && (done === 0 || performance.now() - begin < budget)) {
      world.step();
      done += 1;
    }
    return this.frame(done);
  }

  inspect(query: Query | undefined): Frame {
    this.query = query;
    return this.frame(0);
  }

  grab(body: number, point: Vec3): number {
    return this.opened().grab(body as BodyHandle, point);
  }

  moveGrab(grab: number, target: Vec3): void {
    this.opened().moveGrab(grab as GrabHandle, target);
  }

  release(grab: number): void {
    this.opened().release(grab as GrabHandle);
  }

  changeSettings(changes: Settings): Settings {
    const world = this.opened();
    world.setSettings(changes);
    return world.settings;
  }

  check(text: string): Problem[] {
    return validate(text).map((problem) => ({ ...problem }));
  }

  importMesh(bytes: Uint8Array, fileName: string, text: string): Imported {
    const imported = importMesh(this.opened(), bytes, fileName, text);
    return { ...imported, frame: this.frame(0) };
  }

  startRecording(): void {
    this.opened().startRecording();
  }

  exportGlb(): Uint8Array {
    return this.opened().exportGlb();
  }

  hash(): string {
    return this.opened().stateHash();
  }

  private opened(): World {
    if (this.world === undefined) throw new Error("there is no scene yet");
    return this.world;
  }

  private frame(stepsDone: number): Frame {
    const world = this.opened();
    return {
      time: world.time,
      stepCount: world.stepCount,
      positions: world.positions.slice(),
      poses: world.poses.slice(),
      flags: world.flags.slice(),
      report: plain(world.report),
      energy: world.energy(),
      stepsDone,
      parts: this.news(world),
      inspection: this.query && inspect(world, this.query),
    };
  }

  /** The bodies, if the page does not know them as they are now: some are added or removed, or a cloth has torn. */
  private news(world: World): Part[] | undefined {
    const bodies = world.bodies;
    const triangles = bodies.reduce((sum, body) => sum + body.triangles.length, 0);
    if (this.told?.bodies === bodies && this.told.triangles === triangles) return undefined;
    this.told = { bodies, triangles };
    return bodies.map(describe);
  }
}

function read(source: Source): Scene {
  if (source.kind === "text") return parse(source.text);
  const scene = document(source.name, source.values);
  const { solver, ...settings } = source.settings;
  const solved = solver === undefined ? scene : withSolver(scene, solver);
  return { ...solved, settings: { ...solved.settings, ...settings } };
}

function describe(body: BodyView): Part {
  const { handle, index, kind, name, color, look, mesh, radius, firstParticle, particleCount } = body;
  return {
    handle,
    index,
    kind,
    name,
    color,
    look,
    mesh,
    radius,
    firstParticle,
    particleCount,
    triangles: body.triangles.slice(),
    segments: body.segments.slice(),
    fixed: body.motion !== "dynamic",
  };
}

/** A report that can be copied to the page, whatever it is made of. */
function plain(report: StepReport): StepReport {
  return { ...report, milliseconds: { ...report.milliseconds }, faults: [...report.faults] };
}
