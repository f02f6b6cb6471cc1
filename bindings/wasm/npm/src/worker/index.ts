// A world in a Web Worker, for scenes whose steps take longer than a frame of the page.
import type { Scene } from "../document.js";
import { TautlineError } from "../errors.js";
import type { Answer, Arguments, BodyDescription, Method, Request, Result, WorkerFrame } from "./messages.js";

export type { Arguments, BodyDescription, Method, Result, WorkerFrame } from "./messages.js";

/** How a worker is started. */
export interface WorkerOptions {
  /** The address of the engine; beside the package's files if absent. */
  readonly wasm?: URL | string;
  /** Starts the worker where a bundler cannot do it from the package: one that runs `tautline`'s `worker/host.js`. */
  readonly worker?: () => Worker;
}

type Unnumbered = Request extends infer R ? (R extends Request ? Omit<R, "id"> : never) : never;

/** A world in a worker. What is asked of it is done in order. */
export class WorkerWorld {
  /** The last frame. */
  frame!: WorkerFrame;
  /** All bodies, as of the last frame. */
  bodies: readonly BodyDescription[] = [];

  private readonly waiting = new Map<number, { resolve(value: unknown): void; reject(error: unknown): void }>();
  private next = 0;

  private constructor(private readonly worker: Worker) {
    worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => this.hear(data));
    worker.addEventListener("error", ({ message }) => this.fail(message));
  }

  /** Starts a worker and builds a scene in it. */
  static async create(scene: Scene | string, { wasm, worker }: WorkerOptions = {}): Promise<WorkerWorld> {
    const start = worker ?? (() => new Worker(new URL("./host.js", import.meta.url), { type: "module" }));
    const world = new WorkerWorld(start());
    await world.show(scene, wasm);
    return world;
  }

  /** Builds another scene in its place. */
  async show(scene: Scene | string, wasm?: URL | string): Promise<WorkerFrame> {
    return this.note(this.ask({ kind: "create", scene, wasm: wasm === undefined ? undefined : String(wasm) }));
  }

  /** Takes steps and shows what is then. */
  async step(count = 1): Promise<WorkerFrame> {
    return this.note(this.ask({ kind: "step", count }));
  }

  /** Calls a method of the world, or reads a property. */
  async call<K extends Method>(method: K, ...values: Arguments<K>): Promise<Result<K>> {
    return (await this.ask({ kind: "call", method, values })) as Result<K>;
  }

  /** Stops it at once, whatever it is doing. */
  terminate(): void {
    this.worker.terminate();
    this.fail("the worker has been terminated");
  }

  private async note(answer: Promise<unknown>): Promise<WorkerFrame> {
    this.frame = (await answer) as WorkerFrame;
    this.bodies = this.frame.bodies ?? this.bodies;
    return this.frame;
  }

  private ask(request: Unnumbered): Promise<unknown> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ ...request, id });
    });
  }

  private hear(answer: Answer): void {
    const waiting = this.waiting.get(answer.id);
    this.waiting.delete(answer.id);
    if ("error" in answer) waiting?.reject(new TautlineError(answer.error.kind, answer.error.problems));
    else waiting?.resolve(answer.value);
  }

  private fail(message: string): void {
    const error = new TautlineError("fault", [{ path: "", message }]);
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }
}
