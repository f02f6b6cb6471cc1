// The page's side of the engine: calls into the worker, and the worker's replacement when it no longer answers.

import type { Engine, Failure, Problem, Reply, Request } from "./protocol";

/** Why a call failed, in words for the user. */
export class EngineError extends Error {
  readonly problems: Problem[];
  readonly fatal: boolean;

  constructor({ message, problems, fatal }: Failure) {
    super(message);
    this.problems = problems;
    this.fatal = fatal;
  }
}

interface Waiting {
  resolve(value: never): void;
  reject(error: EngineError): void;
  since: number;
}

const STOPPED: Failure = { message: "The engine was stopped.", problems: [], fatal: true };

export class EngineClient {
  private worker: Worker;
  private readonly waiting = new Map<number, Waiting>();
  private next = 0;

  constructor() {
    this.worker = this.start();
  }

  /** Calls a method of the engine. */
  call<K extends keyof Engine>(method: K, ...values: Parameters<Engine[K]>): Promise<Awaited<ReturnType<Engine[K]>>> {
    const id = this.next++;
    const request: Request = { id, method, arguments: values };
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, since: performance.now() });
      this.worker.postMessage(request);
    });
  }

  /** How long the oldest call has been waiting for its answer, ms. */
  busyFor(): number {
    const oldest = this.waiting.values().next().value;
    return oldest === undefined ? 0 : performance.now() - oldest.since;
  }

  /** Ends whatever the engine is doing and starts it anew, without a scene. */
  restart(): void {
    this.dispose();
    this.worker = this.start();
  }

  dispose(): void {
    this.worker.terminate();
    this.failAll(STOPPED);
  }

  private start(): Worker {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.addEventListener("message", (event: MessageEvent<Reply>) => this.receive(event.data));
    worker.addEventListener("error", (event) => {
      const message = `The engine did not start: ${event.message || "its files were not found"}.`;
      this.failAll({ message, problems: [], fatal: true });
    });
    return worker;
  }

  private receive(reply: Reply): void {
    const waiting = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    if ("failure" in reply) waiting?.reject(new EngineError(reply.failure));
    else waiting?.resolve(reply.value as never);
  }

  private failAll(failure: Failure): void {
    const all = [...this.waiting.values()];
    this.waiting.clear();
    for (const waiting of all) waiting.reject(new EngineError(failure));
  }
}
