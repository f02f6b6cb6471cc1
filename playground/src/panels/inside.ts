// How it works: what is drawn over the scene, and in what order GJK does what it does.

import type { Playground } from "../app/playground";
import type { Inspection, Query, QueryKind } from "../engine/protocol";
import { el, fill } from "../ui/dom";

const CHOICES: readonly { kind: QueryKind | "none"; label: string; line: string }[] = [
  { kind: "none", label: "Nothing", line: "Only the scene." },
  {
    kind: "spheres",
    label: "Sphere trees",
    line: "Spheres around triangles, spheres around those: what does not touch is ruled out early.",
  },
  { kind: "boxes", label: "Boxes", line: "Bodies whose boxes overlap may touch; all other pairs are never looked at." },
  { kind: "gjk", label: "GJK", line: "Two convex bodies touch if their difference holds the origin; a simplex in it walks there." },
  { kind: "contacts", label: "Contacts", line: "Where bodies touch: a point on each, the normal, and the faces and edges that meet." },
  { kind: "colors", label: "Colours", line: "Sticks and contacts of one colour share nothing: they are solved side by side." },
  { kind: "order", label: "Ordered lists", line: "The paper's solver relaxes sticks from the particle that was hit outwards: red first." },
  { kind: "strain", label: "Strain", line: "Red is stretched by 3 %, blue is pushed together by as much." },
];

/** Which iteration of GJK is shown, and who is told when it is another one. */
export class Iteration {
  value = 0;
  changed: () => void = () => {};
}

export function insidePanel(playground: Playground, iteration: Iteration): HTMLElement {
  const details = el("div", { className: "fields" });
  const radios = CHOICES.map(({ kind, label, line }) => {
    const input = el("input", { type: "radio", name: "inside", value: kind, checked: kind === "none" });
    input.addEventListener("change", () => void playground.setQuery(queryOf(kind, playground)));
    return el("label", { className: "choice" }, input, el("span", {}, el("b", {}, label), el("small", {}, line)));
  });
  let shown = "";
  const refresh = () => {
    const { frame, query } = playground;
    const inspection = frame?.inspection?.kind === query?.kind ? frame?.inspection : undefined;
    const key = inspection ? keyOf(inspection) : "";
    if (key === shown) return;
    shown = key;
    fill(details, ...(inspection ? detailsOf(playground, inspection, iteration) : []));
  };
  playground.on("frame", refresh);
  playground.on("query", () => void follow(playground));
  return el(
    "section",
    { className: "panel" },
    el("p", { className: "hint" }, "See how it works: pause, then step, to see it move by move."),
    details,
    el("fieldset", {}, el("legend", {}, "Show"), ...radios),
  );
}

function queryOf(kind: QueryKind | "none", playground: Playground): Query | undefined {
  switch (kind) {
    case "none":
      return undefined;
    case "spheres":
      return { kind, level: 2 };
    case "gjk":
      return { kind, pair: pairOf(playground) };
    case "order":
      return { kind, grabbed: undefined };
    default:
      return { kind };
  }
}

function pairOf({ chosen: [a, b] }: Playground): [number, number] | undefined {
  return a !== undefined && b !== undefined ? [a, b] : undefined;
}

/** Bodies that are clicked are what is looked into from then on. */
async function follow(playground: Playground): Promise<void> {
  const { query, chosen } = playground;
  const pair = pairOf(playground);
  if (query?.kind === "gjk" && pair && String(pair) !== String(query.pair)) return playground.setQuery({ kind: "gjk", pair });
  const last = chosen.at(-1);
  if (query?.kind === "order" && last !== undefined && query.grabbed?.body !== last) {
    return playground.setQuery({ kind: "order", grabbed: { body: last, particle: 0 } });
  }
}

/** What the details depend on. */
function keyOf(inspection: Inspection): string {
  switch (inspection.kind) {
    case "spheres":
      return `spheres ${inspection.levels}`;
    case "gjk":
      return `gjk ${inspection.pair} ${inspection.trace?.iterations.length} ${inspection.trace?.result}`;
    case "contacts":
      return `contacts ${inspection.contacts.length}`;
    case "order":
      return `order ${inspection.body}`;
    case "colors":
      return `colors ${inspection.count}`;
    case "strain":
      return `strain ${inspection.max.toPrecision(2)} ${inspection.mean.toPrecision(2)}`;
    case "boxes":
      return `boxes ${inspection.boxes.length}`;
  }
}

function detailsOf(playground: Playground, inspection: Inspection, iteration: Iteration): HTMLElement[] {
  switch (inspection.kind) {
    case "spheres":
      return sphereDetails(playground, inspection.levels);
    case "gjk":
      return gjkDetails(playground, inspection, iteration);
    case "boxes":
      return [note(`${inspection.boxes.length / 6} boxes`)];
    case "contacts":
      return [note(`${inspection.contacts.length} points of contact`)];
    case "colors":
      return [note(inspection.count > 0 ? `${inspection.count} colours` : "No colours here: all is solved one after another.")];
    case "order":
      return [
        note(
          inspection.body === undefined
            ? "Only trusses have such lists: choose the paper's solver."
            : "Click another body to see its list.",
        ),
      ];
    case "strain":
      return [note(`mean ${percent(inspection.mean)}, greatest ${percent(inspection.max)}`)];
  }
}

function sphereDetails(playground: Playground, levels: number): HTMLElement[] {
  if (levels === 0) return [note("No trees here: bodies of the default solver use boxes. The paper's solver has them.")];
  const level = playground.query?.kind === "spheres" ? playground.query.level : 0;
  const show = (value: number) => void playground.setQuery({ kind: "spheres", level: value });
  return [slider("Level", Math.min(level, levels - 1), levels - 1, show)];
}

function gjkDetails(
  playground: Playground,
  { trace, pair }: Extract<Inspection, { kind: "gjk" }>,
  iteration: Iteration,
): HTMLElement[] {
  if (!trace || !pair) return [note("GJK needs two rigid bodies: this scene has none.")];
  const last = Math.max(0, trace.iterations.length - 1);
  iteration.value = Math.min(iteration.value, last);
  const text = note("");
  const show = (value: number) => {
    iteration.value = value;
    const step = trace.iterations[value];
    const corners = step?.simplex.length ?? 0;
    const end = value === last ? `: ${trace.result}` : "";
    text.textContent = step
      ? `Iteration ${value + 1} of ${last + 1}: a simplex of ${corners}, ${millimetres(step.distance)} from the origin${end}.`
      : `No iterations: ${trace.result}.`;
    iteration.changed();
  };
  show(iteration.value);
  const names = pair.map((handle) => playground.opened && nameOf(playground, handle)).join(" and ");
  return [note(`${names}. Click two bodies to choose others.`), slider("Iteration", iteration.value, last, show), text];
}

function nameOf(playground: Playground, handle: number): string {
  return playground.parts.find((part) => part.handle === handle)?.name ?? "a body";
}

function slider(label: string, value: number, max: number, change: (value: number) => void): HTMLElement {
  const input = el("input", { type: "range", min: "0", max: String(max), step: "1", value: String(value) });
  input.addEventListener("input", () => change(Number(input.value)));
  return el("label", { className: "field" }, label, input);
}

function note(text: string): HTMLElement {
  return el("p", { className: "note" }, text);
}

function percent(share: number): string {
  return `${(100 * share).toFixed(2)} %`;
}

function millimetres(metres: number): string {
  return `${(1000 * metres).toPrecision(3)} mm`;
}
