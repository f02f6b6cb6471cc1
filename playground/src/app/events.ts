// What happens in the playground, for whoever wants to know.

import type { Problem } from "../engine/protocol";

/** A message for the user. */
export interface Notice {
  kind: "error" | "info";
  text: string;
  problems?: Problem[];
}

export interface Events {
  /** A scene has been built: another one, or the same from its start. */
  opened: { fresh: boolean };
  /** The main world has moved. */
  frame: undefined;
  /** Playing, speed, comparison, recording or theme has changed. */
  state: undefined;
  /** Something else is to be shown of how it works. */
  query: undefined;
  notice: Notice;
  /** The engine has not answered for so long, s; 0: it has. */
  busy: number;
}

type Listener<K extends keyof Events> = (event: Events[K]) => void;

export class Emitter {
  private readonly listeners: { [K in keyof Events]?: Listener<K>[] } = {};

  on<K extends keyof Events>(name: K, listener: Listener<K>): void {
    const known = (this.listeners[name] ?? []) as Listener<K>[];
    known.push(listener);
    (this.listeners as Record<K, Listener<K>[]>)[name] = known;
  }

  emit<K extends keyof Events>(name: K, event: Events[K]): void {
    for (const listener of (this.listeners[name] ?? []) as Listener<K>[]) listener(event);
  }
}
