// Play, pause, step, reset, and how fast time goes.

import type { Playground } from "../app/playground";
import { el } from "../ui/dom";
import { type Icon, icon, setIcon } from "../ui/icons";

/** The slowest and fastest, as powers of 2. */
const SLOWEST = -5;
const FASTEST = 2;

export function transport(playground: Playground): HTMLElement {
  const button = (name: Icon, label: string, key: string, action: () => void) => {
    const picture = icon(name);
    const title = `${label} (${key})`;
    const element = el("button", { type: "button", className: "round", title, onclick: action, attributes: { "aria-label": label } }, picture);
    return { element, picture };
  };
  const play = button("pause", "Pause", "space", () => playground.setPlaying(!playground.playing));
  play.element.classList.add("primary");
  const speed = el("input", {
    type: "range",
    min: String(SLOWEST),
    max: String(FASTEST),
    step: "0.5",
    value: "0",
    title: "Speed (S: slow motion)",
    attributes: { "aria-label": "Speed" },
  });
  const factor = el("output", {}, "1×");
  const clock = el("output", { className: "clock", attributes: { "aria-label": "Simulated time" } }, "0.00 s");
  speed.addEventListener("input", () => playground.setSpeed(2 ** Number(speed.value)));
  playground.on("state", () => {
    setIcon(play.picture, playground.playing ? "pause" : "play");
    const label = playground.playing ? "Pause" : "Play";
    play.element.title = `${label} (space)`;
    play.element.setAttribute("aria-label", label);
    speed.value = String(Math.log2(playground.speed));
    factor.textContent = `${Number(playground.speed.toPrecision(2))}×`;
  });
  playground.on("frame", () => (clock.textContent = `${(playground.frame?.time ?? 0).toFixed(2)} s`));
  return el(
    "div",
    { className: "transport", attributes: { role: "toolbar", "aria-label": "Time" } },
    button("reset", "Reset", "R", () => void playground.reset()).element,
    play.element,
    button("step", "Step", ".", () => void playground.step()).element,
    el("span", { className: "speed" }, speed, factor),
    clock,
  );
}
