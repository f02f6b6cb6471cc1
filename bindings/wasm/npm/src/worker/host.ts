// The worker's side: a world that does what the page asks, one thing after another.
import { TautlineError } from "../errors.js";
import { init } from "../init.js";
import { World } from "../world.js";
import type { Answer, BodyDescription, Request, WorkerFrame } from "./messages.js";

let world: World | undefined;
let sent: readonly unknown[] = [];

const scope = self as unknown as DedicatedWorkerGlobalScope;

scope.addEventListener("message", ({ data }: MessageEvent<Request>) => {
  void answer(data).then((message) => scope.postMessage(message, buffersOf(message)));
});

async function answer(request: Request): Promise<Answer> {
  const { id } = request;
  try {
    return { id, value: await perform(request) };
  } catch (error) {
    if (error instanceof TautlineError) return { id, error: { kind: error.kind, problems: error.problems } };
    return { id, error: { kind: "fault", problems: [{ path: "", message: String(error) }] } };
  }
}

async function perform(request: Request): Promise<unknown> {
  if (request.kind === "create") {
    await init(request.wasm);
    world?.dispose();
    world = new World(request.scene as string);
    sent = [];
    return frameOf(world);
  }
  if (world === undefined) throw new TautlineError("stale", [{ path: "", message: "there is no world yet" }]);
  if (request.kind === "step") {
    for (let i = 0; i < request.count; i++) world.step();
    return frameOf(world);
  }
  const member: unknown = world[request.method];
  return typeof member === "function" ? (member.apply(world, [...request.values]) as unknown) : member;
}

function frameOf(shown: World): WorkerFrame {
  // Arrays that are the same as long as nothing has come, gone or torn.
  const shapes = [shown.bodies, ...shown.bodies.map(({ triangles }) => triangles)];
  const isKnown = shapes.length === sent.length && shapes.every((shape, i) => shape === sent[i]);
  sent = shapes;
  return {
    time: shown.time,
    stepCount: shown.stepCount,
    positions: shown.positions.slice(),
    poses: shown.poses.slice(),
    flags: shown.flags.slice(),
    report: shown.report,
    bodies: isKnown ? undefined : shown.bodies.map(described),
  };
}

function described(body: World["bodies"][number]): BodyDescription {
  const { handle, index, kind, name, color, look, radius, firstParticle, particleCount, mesh, triangles, segments } = body;
  return { handle, index, kind, name, color, look, radius, firstParticle, particleCount, mesh, triangles, segments };
}

/** What is handed over instead of being copied once more. */
function buffersOf(answer: Answer): Transferable[] {
  const frame = "value" in answer ? (answer.value as Partial<WorkerFrame> | null) : null;
  const arrays = [frame?.positions, frame?.poses, frame?.flags];
  return arrays.flatMap((array) => (ArrayBuffer.isView(array) ? [array.buffer as ArrayBuffer] : []));
}
