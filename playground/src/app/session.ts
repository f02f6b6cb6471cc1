// One world: its engine, its view, and how far it has come.

import { EngineClient } from "../engine/client";
import type { Frame, Inspection, Opened, Query, Solver, Source } from "../engine/protocol";
import type { Stage } from "../stage/stage";
import type { View } from "../stage/view";

/** How long the engine may work on one picture, ms: what takes longer runs in slow motion, and the page stays quick. */
const BUDGET = 30;
/** Steps that are caught up at most, after the page was hidden or slow. */
const MOST_BEHIND = 4;

export class Session {
  readonly client = new EngineClient();
  readonly view: View;
  /** The solver that this world has instead of the scene's own. */
  readonly solver: Solver | undefined;
  opened: Opened | undefined;
  frame: Frame | undefined;
  /** Why there is no world, in words. */
  refusal: string | undefined;
  private before: Frame | undefined;
  private readonly stage: Stage;
  /** Time that is still to be simulated, s. */
  private debt = 0;
  private advancing = false;
  /** Counts scenes: what belongs to an earlier one is dropped. */
  private generation = 0;

  constructor(stage: Stage, solver: Solver | undefined) {
    this.stage = stage;
    this.view = stage.addView();
    this.solver = solver;
  }

  /** Builds a scene and shows it. */
  async open(source: Source, query: Query | undefined): Promise<Opened> {
    this.generation += 1;
    const generation = this.generation;
    this.refusal = undefined;
    const opened = await this.client.call("open", source, this.solver);
    if (generation !== this.generation) return opened;
    this.opened = opened;
    this.debt = 0;
    this.take(opened.frame);
    if (query) this.take(await this.client.call("inspect", query));
    return opened;
  }

  /** Takes over a frame, and draws it. */
  take(frame: Frame): void {
    this.before = frame.parts ? undefined : this.frame;
    this.frame = frame;
    if (frame.parts) this.view.setParts(frame.parts, this.stage.theme);
    this.view.update(frame);
    this.stage.invalidate();
  }

  get inspection(): Inspection | undefined {
    return this.frame?.inspection;
  }

  /** Lets time go on by so many seconds of the scene's; returns the steps that it asks for, if any. */
  tick(seconds: number): Promise<Frame> | undefined {
    if (!this.opened) return undefined;
    const { dt } = this.opened;
    this.debt = Math.min(this.debt + seconds, MOST_BEHIND * dt);
    const steps = Math.floor(this.debt / dt + 1e-6);
    if (this.advancing || steps === 0) {
      this.show(this.debt / dt);
      return undefined;
    }
    this.debt -= steps * dt;
    return this.advance(steps, BUDGET);
  }

  /** Takes steps at once, within a time (ms). */
  async advance(steps: number, budget: number): Promise<Frame> {
    const generation = this.generation;
    this.advancing = true;
    try {
      const frame = await this.client.call("advance", steps, budget);
      if (generation === this.generation) this.take(frame);
      return frame;
    } finally {
      this.advancing = false;
    }
  }

  /** Ends whatever its engine is doing. */
  restart(): void {
    this.generation += 1;
    this.opened = undefined;
    this.client.restart();
  }

  dispose(): void {
    this.generation += 1;
    this.client.dispose();
    this.stage.removeView(this.view);
  }

  /** In slow motion, shows what is between the last two steps. */
  private show(share: number): void {
    const { before, frame } = this;
    if (!before || !frame || frame.stepsDone !== 1 || share >= 1) return;
    const mixed = (from: Float32Array, to: Float32Array) => to.map((value, index) => from[index]! + (value - from[index]!) * share);
    if (before.positions.length !== frame.positions.length) return;
    this.view.update({ positions: mixed(before.positions, frame.positions), poses: mixedPoses(before.poses, frame.poses, share) });
    this.stage.invalidate();
  }
}

/** Poses between two, with unit rotations the short way round. */
function mixedPoses(from: Float32Array, to: Float32Array, share: number): Float32Array {
  const mixed = new Float32Array(to.length);
  for (let pose = 0; pose < to.length; pose += 7) {
    let dot = 0;
    for (let k = pose + 3; k < pose + 7; k++) dot += from[k]! * to[k]!;
    let squared = 0;
    for (let k = pose; k < pose + 7; k++) {
      const start = k >= pose + 3 && dot < 0 ? -from[k]! : from[k]!;
      mixed[k] = start + (to[k]! - start) * share;
      if (k >= pose + 3) squared += mixed[k]! * mixed[k]!;
    }
    const length = Math.sqrt(squared) || 1;
    for (let k = pose + 3; k < pose + 7; k++) mixed[k]! /= length;
  }
  return mixed;
}
