// The scene's parameters, and how it is solved.

import type { Settings } from "tautline";

import type { Playground } from "../app/playground";
import { el, fill } from "../ui/dom";
import { choiceField, numberField } from "../ui/field";

export function adjustPanel(playground: Playground): HTMLElement {
  const parameters = el("div", { className: "fields" });
  const settings = el("div", { className: "fields" });
  const refresh = () => {
    const focused = document.activeElement?.id;
    fill(parameters, ...parameterFields(playground));
    fill(settings, ...settingFields(playground));
    if (focused?.startsWith("field-")) document.getElementById(focused)?.focus();
  };
  playground.on("opened", refresh);
  return el(
    "section",
    { className: "panel" },
    el("p", { className: "hint" }, "Parameters build the scene anew; settings act at once, except the solver."),
    el("h2", {}, "Scene"),
    parameters,
    el("h2", {}, "Settings"),
    settings,
  );
}

function parameterFields(playground: Playground): HTMLElement[] {
  const { source } = playground;
  if (source?.kind !== "named") {
    return [el("p", { className: "empty" }, "A document of your own has no parameters: change it in the editor.")];
  }
  const scene = playground.hello?.scenes.find((known) => known.name === source.name);
  const fields = (scene?.parameters ?? []).map((parameter) =>
    numberField({
      ...parameter,
      label: parameter.name,
      value: source.values[parameter.name] ?? parameter.default,
      change: (value) => void playground.setParameter(parameter.name, value),
    }),
  );
  return fields.length > 0 ? fields : [el("p", { className: "empty" }, "This scene has no parameters.")];
}

/** Settings that are numbers: what they are called, and in which range they are offered. */
const NUMBERS = [
  { key: "substeps", label: "substeps", min: 1, max: 32, integer: true, description: "parts of a step; more are more exact, and cost more" },
  { key: "damping", label: "damping", min: 0, max: 5, integer: false, description: "rate at which motion dies out, 1/s" },
  { key: "air_density", label: "air density", min: 0, max: 20, integer: false, description: "kg/m³, for cloth that feels the air" },
] as const;

/** Those of the paper's solver. */
const PAPER_NUMBERS = [
  { key: "sweeps", label: "sweeps", min: 1, max: 60, integer: true, description: "passes over all sticks in a substep" },
  { key: "tolerance", label: "tolerance", min: 0, max: 0.1, integer: false, description: "how far off a stick may be: 0.01 is 1 %" },
] as const;

function settingFields(playground: Playground): HTMLElement[] {
  const { opened } = playground;
  if (!opened) return [];
  const { settings } = opened;
  const change = (changes: Settings) => void playground.setSettings(changes);
  const solver = settings.solver ?? "default";
  const paper = solver === "paper" ? PAPER_NUMBERS : [];
  const numbers = [...NUMBERS, ...paper].map(({ key, ...field }) =>
    numberField({ ...field, value: settings[key] ?? 0, change: (value) => change({ [key]: value }) }),
  );
  const vector = (label: string, description: string, key: "gravity" | "wind", axis: 0 | 1, reach: number) => {
    const now = settings[key] ?? [0, 0, 0];
    const change3 = (value: number) => {
      const changed: [number, number, number] = [now[0], now[1], now[2]];
      changed[axis] = value;
      change({ [key]: changed });
    };
    return numberField({ label, description, value: now[axis], min: -reach, max: reach, integer: false, change: change3 });
  };
  const asleep = settings.sleep === "never" ? "never" : "yes";
  const sleep = (value: "yes" | "never") => change({ sleep: value === "never" ? value : { after: { speed: 0.03, seconds: 0.5 } } });
  return [
    choiceField("solver", "four-particle bodies in substeps, or the paper's trusses", ["default", "paper"] as const, solver, (value) =>
      change({ solver: value }),
    ),
    vector("gravity", "along Y, m/s²", "gravity", 1, 20),
    vector("wind", "along X, m/s, for cloth that feels the air", "wind", 0, 20),
    ...numbers,
    choiceField("sleep", "what rests is no longer moved", ["yes", "never"] as const, asleep, sleep),
  ];
}
