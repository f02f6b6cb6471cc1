// The page that plays a recording.

import "../style/base.css";
import "../style/panels.css";
import "./replay.css";
import type { Theme } from "../stage/palette";
import { Stage } from "../stage/stage";
import { el, fill } from "../ui/dom";
import { Player } from "./player";
import { readRecording } from "./recording";

async function start(app: HTMLElement): Promise<void> {
  const theme: Theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  document.documentElement.dataset.theme = theme;
  if (!document.createElement("canvas").getContext("webgl2")) {
    throw new Error("This browser shows no WebGL 2, which draws the scene.");
  }
  const recording = await readRecording();
  document.title = `${recording.name} – tautline`;
  const canvas = el("canvas", { attributes: { "aria-label": "The recorded scene: drag to turn it." } });
  const stage = new Stage(canvas, theme);
  const view = stage.addView();
  const player = new Player(recording, (frame) => {
    view.update(recording.at(frame));
    stage.invalidate();
  });
  fill(app, canvas, el("h1", {}, recording.name), player.element);
  view.setParts(recording.parts, theme);
  view.update(recording.at(0));
  const bounds = view.bounds();
  view.fit(bounds);
  stage.frame(bounds, recording.camera);
  let last = performance.now();
  const tick = (now: number) => {
    requestAnimationFrame(tick);
    player.tick((now - last) / 1000);
    last = now;
    stage.draw();
  };
  requestAnimationFrame(tick);
}

const app = document.querySelector<HTMLElement>("#app");
if (app) {
  start(app).catch((error: unknown) => fill(app, el("p", { className: "refusal" }, error instanceof Error ? error.message : String(error))));
}
