// What a step costs, and what it finds.

import type { Playground } from "../app/playground";
import type { Frame } from "../engine/protocol";
import { Chart } from "../ui/chart";
import { el, fill } from "../ui/dom";

/** Charts are drawn so often, ms. */
const EVERY = 120;

export function measurePanel(playground: Playground): HTMLElement {
  const phases = ["broad phase", "narrow phase", "rigid bodies", "cloth and rope", "all"];
  const time = new Chart("Time of a step", "ms", phases.map((name, index) => ({ name, color: `--line-${index + 1}` })));
  const contacts = new Chart("Found", "", [
    { name: "pairs", color: "--line-2" },
    { name: "contacts", color: "--line-1" },
    { name: "awake bodies", color: "--line-3" },
  ]);
  const energy = new Chart("Energy", "J", [
    { name: "kinetic", color: "--line-1" },
    { name: "potential", color: "--line-2" },
    { name: "sum", color: "--line-5" },
  ]);
  const charts = [time, contacts, energy];
  const facts = el("dl", { className: "facts" });
  const panel = el(
    "section",
    { className: "panel" },
    el("p", { className: "hint" }, "Measured in your browser, on one thread, step by step."),
    ...charts.map((chart) => chart.element),
    facts,
  );
  let drawn = 0;
  playground.on("opened", ({ fresh }) => fresh && charts.forEach((chart) => chart.clear()));
  playground.on("frame", () => {
    const { frame } = playground;
    if (!frame) return;
    if (frame.stepsDone > 0) {
      time.add(timesOf(frame));
      contacts.add([frame.report.pairs, frame.report.contacts, frame.report.awakeBodies]);
      const { kinetic, potential } = frame.energy;
      energy.add([kinetic, potential, kinetic + potential]);
    }
    const now = performance.now();
    if (panel.offsetParent === null || (playground.playing && now - drawn < EVERY)) return;
    drawn = now;
    for (const chart of charts) chart.draw();
    void showFacts(playground, frame, facts);
  });
  return panel;
}

function timesOf({ report: { milliseconds } }: Frame): number[] {
  const { broadPhase, narrowPhase, integrate, separate, relax, solve, soft, total } = milliseconds;
  return [broadPhase, narrowPhase, solve, integrate + separate + relax + soft, total];
}

/** The numbers that do not change every step; the hash is computed only while time stands still. */
async function showFacts(playground: Playground, frame: Frame, facts: HTMLElement): Promise<void> {
  const hash = playground.playing ? "shown when paused" : await playground.hash().catch(() => "–");
  const rows: [string, string][] = [
    ["bodies", String(frame.poses.length / 7)],
    ["particles", String(frame.positions.length / 3)],
    ["steps", String(frame.stepCount)],
    ["state hash", hash],
  ];
  fill(facts, ...rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
}
