// Time in a recording: play, pause, and the place in it.

import { el } from "../ui/dom";
import { icon, setIcon } from "../ui/icons";
import type { Recording } from "./recording";

export class Player {
  readonly element: HTMLElement;
  private readonly recording: Recording;
  private readonly show: (frame: number) => void;
  private readonly place: HTMLInputElement;
  private readonly clock = el("output", { className: "clock" });
  private readonly picture = icon("pause");
  private readonly button: HTMLButtonElement;
  private playing = true;
  /** In frames. */
  private time = 0;
  private shown = -1;

  constructor(recording: Recording, show: (frame: number) => void) {
    this.recording = recording;
    this.show = show;
    const last = String(recording.frames - 1);
    this.place = el("input", { type: "range", min: "0", max: last, value: "0", attributes: { "aria-label": "Time" } });
    this.place.addEventListener("input", () => this.seek(Number(this.place.value)));
    this.button = el("button", { type: "button", className: "round primary", onclick: () => this.toggle() }, this.picture);
    this.element = el("div", { className: "transport replay" }, this.button, this.place, this.clock);
    addEventListener("keydown", (event) => {
      if (event.key !== " " || event.target === this.button) return;
      event.preventDefault();
      this.toggle();
    });
    this.name();
  }

  /** Lets time go on by so many seconds; at the end it begins anew. */
  tick(seconds: number): void {
    // The first picture's time may lie before the clock was first read.
    if (this.playing && seconds > 0) this.time = (this.time + seconds * this.recording.frameRate) % this.recording.frames;
    const frame = Math.min(this.recording.frames - 1, Math.floor(this.time));
    if (frame === this.shown) return;
    this.shown = frame;
    this.place.value = String(frame);
    this.clock.textContent = `${(frame / this.recording.frameRate).toFixed(2)} s`;
    this.show(frame);
  }

  private toggle(): void {
    this.playing = !this.playing;
    this.name();
  }

  private seek(frame: number): void {
    this.playing = false;
    this.time = frame;
    this.name();
    this.tick(0);
  }

  private name(): void {
    setIcon(this.picture, this.playing ? "pause" : "play");
    this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }
}
