/** One thing that is wrong with a call or a document. */
export interface Problem {
  /** Path of the field, such as `bodies[3].cloth.mass`; empty if there is none. */
  readonly path: string;
  /** What was found there and what would be right. */
  readonly message: string;
  /** From 1, where a text was given and the field was found in it. */
  readonly line?: number;
  /** From 1. */
  readonly column?: number;
}

/**
 * What was wrong: `parse`: a text is no scene, or a file no mesh; `invalid`: a value is wrong; `stale`: a handle names
 * nothing any more; `unsupported`: the platform lacks something; `fault`: the engine stopped, and nothing of it can be
 * used any more until the page or worker is loaded anew.
 */
export type ErrorKind = "parse" | "invalid" | "stale" | "unsupported" | "fault";

/** Why a call was refused. Unless it is a fault, the world is as it was before the call. */
export class TautlineError extends Error {
  override readonly name = "TautlineError";
  /** All that is wrong; never empty. */
  readonly problems: readonly Problem[];

  constructor(
    readonly kind: ErrorKind,
    problems: readonly Problem[],
    options?: ErrorOptions,
  ) {
    super(problems.map(({ path, message }) => (path === "" ? message : `${path}: ${message}`)).join("\n"), options);
    this.problems = problems;
  }

  /** Path of the first field that is wrong, or empty. */
  get path(): string {
    return this.problems[0]?.path ?? "";
  }
}

/** A value that is wrong. */
export function invalid(path: string, message: string): TautlineError {
  return new TautlineError("invalid", [{ path, message }]);
}

let fault: TautlineError | undefined;

/** Calls the engine. What it throws becomes a TautlineError; once it has stopped, it is not called again. */
export function guarded<T>(call: () => T): T {
  if (fault !== undefined) throw fault;
  try {
    return call();
  } catch (thrown) {
    throw translated(thrown);
  }
}

function translated(thrown: unknown): unknown {
  if (typeof thrown === "string") {
    const { kind, problems } = JSON.parse(thrown) as { kind: ErrorKind; problems: Problem[] };
    return new TautlineError(kind, problems);
  }
  // A trap, or the stack is used up: the engine was stopped in the middle of something.
  if (thrown instanceof WebAssembly.RuntimeError || thrown instanceof RangeError) {
    const message = `the engine stopped (${thrown.message}), most likely for want of memory: load it anew`;
    fault = new TautlineError("fault", [{ path: "", message }], { cause: thrown });
    return fault;
  }
  return thrown;
}
