// The named scenes, as pictures to choose from.

import type { NamedScene } from "tautline";

import type { Playground } from "../app/playground";
import { el } from "../ui/dom";

export function gallery(playground: Playground, scenes: readonly NamedScene[]): HTMLElement {
  const cards = new Map(scenes.map((scene) => [scene.name, card(playground, scene)]));
  const mark = () => {
    const { source } = playground;
    const current = source?.kind === "named" ? source.name : undefined;
    for (const [name, button] of cards) button.setAttribute("aria-pressed", String(name === current));
  };
  playground.on("opened", mark);
  return el(
    "nav",
    { className: "gallery", attributes: { "aria-label": "Scenes" } },
    el("p", { className: "hint" }, `${scenes.length} scenes: choose one, then grab anything in it.`),
    el("div", { className: "cards" }, ...cards.values()),
  );
}

function card(playground: Playground, scene: NamedScene): HTMLButtonElement {
  const picture = el("img", {
    src: `./thumbnails/${encodeURIComponent(scene.name)}.webp`,
    alt: "",
    width: 192,
    height: 120,
    loading: "lazy",
    decoding: "async",
  });
  const open = () => void playground.open({ kind: "named", name: scene.name, values: {}, settings: {} }, true);
  return el(
    "button",
    { className: "card", type: "button", title: scene.description, onclick: open, data: { scene: scene.name } },
    picture,
    el("span", { className: "name" }, scene.name.replaceAll("-", " ")),
  );
}
