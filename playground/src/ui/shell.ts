// The page around the stage: header, gallery, panels.

import { inspector } from "../app/inspector";
import type { Playground } from "../app/playground";
import { adjustPanel } from "../panels/adjust";
import { EditPanel } from "../panels/edit";
import { gallery } from "../panels/gallery";
import { Iteration, insidePanel } from "../panels/inside";
import { measurePanel } from "../panels/measure";
import { transport } from "../panels/transport";
import { acceptDrops } from "../share/files";
import type { Hello } from "../engine/protocol";
import { actions } from "./actions";
import { el } from "./dom";
import { busyBanner, notices } from "./notices";
import { tabs } from "./tabs";

/** Builds the page about the canvas. */
export function shell(app: HTMLElement, playground: Playground, hello: Hello): void {
  const title = el("h1");
  const description = el("p");
  const iteration = new Iteration();
  const edit = new EditPanel(playground);
  const scenes = gallery(playground, hello.scenes);
  const adjust = adjustPanel(playground);
  const measure = measurePanel(playground);
  const inside = insidePanel(playground, iteration);
  const { bar, show } = tabs(
    [
      { name: "scenes", label: "Scenes", panel: scenes },
      { name: "adjust", label: "Adjust", panel: adjust },
      { name: "edit", label: "Edit", panel: edit.element, shown: () => void edit.load() },
      { name: "measure", label: "Measure", panel: measure },
      { name: "inside", label: "Inside", panel: inside },
    ],
    (name) => (app.dataset.tab = name),
  );
  const drop = el("div", { className: "drop", hidden: true }, el("p", {}, "Drop a mesh, and it falls into the scene. Drop a document, and it is the scene."));
  const header = el(
    "header",
    {},
    el("span", { className: "brand", title: `tautline ${hello.version}` }, "tautline"),
    el("div", { className: "scene" }, title, description),
    actions(playground),
  );
  const stage = el("section", { className: "stage", attributes: { "aria-label": "Stage" } });
  stage.append(playground.stage.canvas, sides(playground), busyBanner(playground), notices(playground), transport(playground));
  const side = el("aside", { className: "side" }, bar, el("div", { className: "panels" }, adjust, edit.element, measure, inside));
  app.replaceChildren(header, scenes, stage, side, drop);
  playground.on("opened", () => {
    title.textContent = playground.opened?.name ?? "";
    description.textContent = playground.opened?.description ?? "";
    description.title = description.textContent;
    document.title = `${title.textContent} – tautline`;
  });
  inspector(playground, iteration);
  acceptDrops(playground, drop);
  show(matchMedia("(max-width: 760px)").matches ? "scenes" : "adjust");
}

/** Which solver is on which side, where there are two. */
function sides(playground: Playground): HTMLElement {
  const [left, right] = [el("span"), el("span")];
  const refusal = el("p");
  const labels = el("div", { className: "sides", hidden: true }, left, right, refusal);
  const refresh = () => {
    labels.hidden = !playground.comparing;
    const own = playground.opened?.settings.solver === "paper";
    left.textContent = own ? "paper's solver" : "default solver";
    right.textContent = own ? "default solver" : "paper's solver";
    refusal.textContent = playground.otherRefusal ? `This solver refuses the scene: ${playground.otherRefusal}` : "";
  };
  playground.on("state", refresh);
  playground.on("opened", refresh);
  return labels;
}
