// The playground: which scene there is, whether it runs, and what is asked of it. Panels call it and listen to it.

import type { Settings, Vec3 } from "tautline";

import { EngineError } from "../engine/client";
import { indented } from "../engine/json";
import type { Frame, Hello, Opened, Part, Problem, Query, Source } from "../engine/protocol";
import { Hand, type Holder } from "../stage/hand";
import type { Theme } from "../stage/palette";
import { Stage } from "../stage/stage";
import type { Hit, View } from "../stage/view";
import { Emitter } from "./events";
import { Session } from "./session";

/** The engine is given up on after so many seconds only if the user says so; then it is asked. */
const PATIENCE = 2;

export class Playground extends Emitter implements Holder {
  readonly stage: Stage;
  hello: Hello | undefined;
  source: Source | undefined;
  playing = true;
  speed = 1;
  recording = false;
  query: Query | undefined;
  /** The bodies clicked last: the pair that is looked into. */
  chosen: number[] = [];
  private readonly main: Session;
  private other: Session | undefined;
  private readonly hand: Hand;
  private readonly grabs = new Map<View, Promise<number | undefined>>();
  private last = 0;
  private opening = 0;

  constructor(canvas: HTMLCanvasElement, theme: Theme) {
    super();
    this.stage = new Stage(canvas, theme);
    this.main = new Session(this.stage, undefined);
    this.hand = new Hand(this.stage, this);
  }

  /** Loads the engine and begins to draw. */
  async start(): Promise<Hello> {
    this.hello = await this.main.client.call("hello");
    requestAnimationFrame((now) => this.tick(now));
    return this.hello;
  }

  get opened(): Opened | undefined {
    return this.main.opened;
  }

  get frame(): Frame | undefined {
    return this.main.frame;
  }

  /** The bodies of the main world. */
  get parts(): readonly Part[] {
    return this.main.view.parts;
  }

  get comparing(): boolean {
    return this.other !== undefined;
  }

  /** Every world there is, the scene's own first. */
  get sessions(): Session[] {
    return this.other ? [this.main, this.other] : [this.main];
  }

  /** Builds a scene; what is wrong with it is told, and the one there was stays. `fresh`: it is another one, to be
   * looked at from its own place. */
  async open(source: Source, fresh: boolean): Promise<boolean> {
    return (await this.attempt(() => this.build(source, fresh))) ?? false;
  }

  /** As `open`, but what is wrong is thrown. Returns whether no later scene has overtaken it. */
  async build(source: Source, fresh: boolean): Promise<boolean> {
    this.opening += 1;
    const opening = this.opening;
    this.letGo();
    await this.main.open(source, this.query);
    if (opening !== this.opening) return false;
    this.source = source;
    this.recording = false;
    if (fresh) this.chosen = [];
    await this.openOther();
    const bounds = this.main.view.bounds();
    for (const session of this.sessions) session.view.fit(bounds);
    if (fresh) this.stage.frame(bounds, this.main.opened?.camera);
    this.emit("opened", { fresh });
    this.emit("state", undefined);
    this.emit("frame", undefined);
    return true;
  }

  /** The scene from its start. */
  async reset(): Promise<void> {
    if (this.source) await this.open(this.source, false);
  }

  /** Looks at all there is, wherever it has got to. */
  lookAtAll(): void {
    this.stage.frame(this.main.view.bounds(), undefined);
  }

  setPlaying(playing: boolean): void {
    this.playing = playing;
    this.emit("state", undefined);
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.emit("state", undefined);
  }

  setTheme(theme: Theme): void {
    this.stage.paint(theme);
    this.emit("state", undefined);
  }

  /** Takes steps one after another, whatever time they need. */
  async step(count = 1): Promise<void> {
    this.setPlaying(false);
    const advance = (session: Session) => (session.opened ? session.advance(count, Infinity) : undefined);
    await this.attempt(() => Promise.all(this.sessions.map(advance)));
    this.emit("frame", undefined);
  }

  /** Shows the scene on the paper's solver beside the default one, or no longer. */
  async setComparing(comparing: boolean): Promise<void> {
    if (comparing === this.comparing) return;
    if (this.other) {
      this.other.dispose();
      this.other = undefined;
    } else {
      const own = this.opened?.settings.solver ?? "default";
      this.other = new Session(this.stage, own === "paper" ? "default" : "paper");
    }
    await this.reset();
    this.stage.reframe();
    this.emit("state", undefined);
  }

  /** Why the world beside the main one is not there, if it is not. */
  get otherRefusal(): string | undefined {
    return this.other?.refusal;
  }

  /** A named scene with other values of its parameters. */
  async setParameter(name: string, value: number): Promise<boolean> {
    if (this.source?.kind !== "named") return false;
    return this.open({ ...this.source, values: { ...this.source.values, [name]: value } }, false);
  }

  /** Changes how the scene is simulated: at once, and from its start on. */
  async setSettings(changes: Settings): Promise<boolean> {
    const source = this.source && withSettings(this.source, changes);
    if (!source) {
      this.emit("notice", { kind: "error", text: "This document is not plain JSON: change its settings in the editor." });
      return false;
    }
    if (changes.solver !== undefined) return this.open(source, false);
    const settings = await this.attempt(() => this.main.client.call("changeSettings", changes));
    if (!settings || !this.main.opened) return false;
    this.source = source;
    this.main.opened.settings = settings;
    if (source.kind === "text") this.main.opened.text = source.text;
    if (this.other?.opened) await this.attempt(() => this.other?.client.call("changeSettings", changes));
    this.emit("opened", { fresh: false });
    return true;
  }

  /** What is wrong with a document. */
  check(text: string): Promise<Problem[]> {
    return this.main.client.call("check", text);
  }

  /** Shows something of how it works; `undefined`: nothing. */
  async setQuery(query: Query | undefined): Promise<void> {
    this.query = query;
    this.emit("query", undefined);
    const ask = async (session: Session) => {
      if (session.opened) session.take(await session.client.call("inspect", query));
    };
    await this.attempt(() => Promise.all(this.sessions.map(ask)));
    this.emit("frame", undefined);
  }

  /** Adds a mesh file to the scene. */
  async importMesh(file: File): Promise<void> {
    const text = this.opened?.text;
    if (text === undefined) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    const imported = await this.attempt(() => this.main.client.call("importMesh", bytes, file.name, text));
    if (!imported) return;
    this.main.take(imported.frame);
    this.emit("notice", { kind: "info", text: imported.message });
    if (imported.text === undefined || !this.main.opened) return;
    this.source = { kind: "text", text: imported.text };
    this.main.opened.text = imported.text;
    this.emit("opened", { fresh: false });
  }

  async startRecording(): Promise<void> {
    await this.attempt(() => this.main.client.call("startRecording"));
    this.recording = true;
    this.emit("state", undefined);
  }

  /** The motion recorded so far, or the scene as it is now. */
  async exportGlb(): Promise<Uint8Array | undefined> {
    const bytes = await this.attempt(() => this.main.client.call("exportGlb"));
    this.recording = false;
    this.emit("state", undefined);
    return bytes;
  }

  /** The same on every machine for the same scene and steps. */
  hash(): Promise<string> {
    return this.main.client.call("hash");
  }

  /** Ends what the engine is doing. */
  async stop(): Promise<void> {
    this.setPlaying(false);
    for (const session of this.sessions) session.restart();
    this.emit("busy", 0);
    this.emit("notice", { kind: "info", text: "Stopped. Reset begins anew; the editor and the gallery have other scenes." });
  }

  grab(view: View, hit: Hit): void {
    const session = this.sessionOf(view);
    if (!session) return;
    const grabbing = session.client.call("grab", hit.part.handle, hit.point.toArray());
    this.grabs.set(view, grabbing.catch(() => undefined));
  }

  move(view: View, target: Vec3): void {
    void this.grabs.get(view)?.then((grab) => {
      if (grab === undefined) return;
      this.sessionOf(view)?.client.call("moveGrab", grab, target).catch(() => undefined);
    });
  }

  release(view: View): void {
    const grabbing = this.grabs.get(view);
    this.grabs.delete(view);
    void grabbing?.then((grab) => {
      // The body may be gone by now: then there is nothing to let go of.
      if (grab !== undefined) this.sessionOf(view)?.client.call("release", grab).catch(() => undefined);
    });
  }

  choose(view: View, hit: Hit | undefined): void {
    if (view !== this.main.view || !hit) return;
    this.chosen = [...this.chosen.filter((handle) => handle !== hit.part.handle), hit.part.handle].slice(-2);
    this.emit("query", undefined);
  }

  /** Tells the user what went wrong. */
  report(error: unknown): void {
    const problems = error instanceof EngineError ? error.problems : [];
    this.emit("notice", { kind: "error", text: error instanceof Error ? error.message : String(error), problems });
    if (error instanceof EngineError && error.fatal) {
      this.playing = false;
      for (const session of this.sessions) session.restart();
      this.emit("state", undefined);
    }
  }

  /** Does something with the engine; what goes wrong is told. */
  private async attempt<T>(action: () => Promise<T> | undefined): Promise<T | undefined> {
    try {
      return await action();
    } catch (error) {
      this.report(error);
      return undefined;
    }
  }

  private async openOther(): Promise<void> {
    if (!this.other || !this.source) return;
    try {
      await this.other.open(this.source, this.query);
    } catch (error) {
      this.other.opened = undefined;
      this.other.view.setParts([], this.stage.theme);
      this.other.refusal = error instanceof Error ? error.message : String(error);
    }
  }

  private tick(now: number): void {
    requestAnimationFrame((later) => this.tick(later));
    const seconds = Math.min(0.1, (now - this.last) / 1000) * this.speed;
    this.last = now;
    if (this.playing) for (const session of this.sessions) this.run(session, seconds);
    const busy = Math.max(...this.sessions.map((session) => session.client.busyFor())) / 1000;
    this.emit("busy", busy > PATIENCE ? busy : 0);
    this.stage.draw();
  }

  private run(session: Session, seconds: number): void {
    session.tick(seconds)?.then(
      () => session === this.main && this.emit("frame", undefined),
      (error: unknown) => {
        this.setPlaying(false);
        this.report(error);
      },
    );
  }

  private sessionOf(view: View): Session | undefined {
    return this.sessions.find((session) => session.view === view);
  }

  private letGo(): void {
    this.hand.drop();
    this.grabs.clear();
  }
}

/** A source with other settings; `undefined` where they cannot be written into its text. */
function withSettings(source: Source, changes: Settings): Source | undefined {
  if (source.kind === "named") return { ...source, settings: { ...source.settings, ...changes } };
  try {
    const scene = JSON.parse(source.text) as { settings?: Settings };
    return { kind: "text", text: indented({ ...scene, settings: { ...scene.settings, ...changes } }) };
  } catch {
    return undefined;
  }
}
