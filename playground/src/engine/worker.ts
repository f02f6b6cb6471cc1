// The engine's thread: answers the page's calls one after another.

import { TautlineError, init } from "tautline";
import wasm from "tautline/tautline.wasm?url";

import type { Failure, Reply, Request } from "./protocol";
import { Simulation } from "./simulation";

const ready = init(new URL(wasm, self.location.href));
const simulation = new Simulation(ready);

/** Calls wait for each other: the first one waits for the engine itself. */
let queue: Promise<unknown> = ready.catch(() => undefined);

self.addEventListener("message", (event: MessageEvent<Request>) => {
  queue = queue.then(() => answer(event.data));
});

async function answer({ id, method, arguments: values }: Request): Promise<void> {
  try {
    const call = simulation[method] as (...values: unknown[]) => unknown;
    const value = await call.apply(simulation, values);
    post({ id, value }, buffersOf(value));
  } catch (error) {
    post({ id, failure: failureOf(error) }, []);
  }
}

function post(reply: Reply, transfer: Transferable[]): void {
  postMessage(reply, { transfer });
}

/** What is large and is never used here again: the arrays of a frame. */
function buffersOf(value: unknown): Transferable[] {
  if (typeof value !== "object" || value === null) return [];
  if ("frame" in value) return buffersOf(value.frame);
  if (!("poses" in value && "positions" in value)) return [];
  return [value.poses, value.positions].flatMap((array) => (array instanceof Float32Array ? [array.buffer] : []));
}

function failureOf(error: unknown): Failure {
  if (error instanceof TautlineError) {
    const fatal = error.kind === "fault" || error.kind === "unsupported";
    return { message: error.message, problems: error.problems.map((problem) => ({ ...problem })), fatal };
  }
  // Out of memory, or of the stack: nothing is known of the engine's state any more.
  const message = error instanceof Error ? error.message : String(error);
  return { message: `The engine failed: ${message}`, problems: [], fatal: true };
}
