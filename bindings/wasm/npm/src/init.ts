import load, { initSync, type InitInput, type InitOutput } from "./engine/engine.js";
import { TautlineError } from "./errors.js";

/** Where the engine comes from: its module or bytes, a response to a request for it, or its address. */
export type Source = WebAssembly.Module | BufferSource | Response | PromiseLike<Response> | URL | string;

let loading: Promise<void> | undefined;
let exports: InitOutput | undefined;

/**
 * Loads the engine: call it once before all else. Later calls return the first one's promise, unless that failed.
 * Without a source the file beside the package's own is fetched; Node reads it from disk.
 */
export function init(source?: Source): Promise<void> {
  loading ??= start(source).catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

async function start(source?: Source): Promise<void> {
  if (!isSupported()) {
    const message = "this platform has no WebAssembly with SIMD (128 bits), which the engine needs";
    throw new TautlineError("unsupported", [{ path: "", message }]);
  }
  if (source instanceof WebAssembly.Module) {
    exports = initSync({ module: source });
    return;
  }
  const input = source ?? (await fileOfNode());
  exports = await load(input === undefined ? undefined : { module_or_path: input as InitInput });
}

/** Node's `fetch` reads no files. */
async function fileOfNode(): Promise<BufferSource | undefined> {
  const url = new URL("./engine/engine_bg.wasm", import.meta.url);
  if (url.protocol !== "file:" || typeof process === "undefined") return undefined;
  // A name that bundlers for browsers do not follow.
  const files = "node:fs/promises";
  const { readFile } = (await import(/* @vite-ignore */ files)) as typeof import("node:fs/promises");
  return readFile(url);
}

/** Whether the platform has WebAssembly with SIMD. Needs no `init`. */
export function isSupported(): boolean {
  // A module with one function: i32.const 0, i8x16.splat, i8x16.popcnt, drop.
  const probe = [
    0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 11, 1, 9, 0, 65, 0, 253, 15, 253, 98, 26, 11,
  ];
  return typeof WebAssembly === "object" && WebAssembly.validate(new Uint8Array(probe));
}

/** The engine's memory, which may have another buffer after every call. */
export function memory(): WebAssembly.Memory {
  if (exports === undefined) throw notReady();
  return exports.memory;
}

/** Refuses calls before the engine is loaded. */
export function ready(): void {
  if (exports === undefined) throw notReady();
}

function notReady(): TautlineError {
  return new TautlineError("invalid", [{ path: "", message: "the engine is not loaded: await init() first" }]);
}
