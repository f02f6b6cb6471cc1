// Messages: what went wrong stays until it is put away or the next scene opens, all else goes by itself.

import type { Notice } from "../app/events";
import type { Playground } from "../app/playground";
import { el } from "./dom";
import { icon } from "./icons";

/** How long a message is shown that needs no answer, ms. */
const SHOWN = 5000;
/** Problems listed one by one. */
const MOST_PROBLEMS = 6;
/** Of a message: a hostile document can make the engine quote a great deal. */
const MOST_CHARACTERS = 600;

export function notices(playground: Playground): HTMLElement {
  const list = el("div", { className: "notices", attributes: { "aria-live": "polite" } });
  playground.on("opened", () => list.querySelectorAll(".error").forEach((notice) => notice.remove()));
  playground.on("notice", (notice) => {
    const element = elementOf(notice);
    list.replaceChildren(element);
    if (notice.kind === "info") setTimeout(() => element.remove(), SHOWN);
  });
  return list;
}

function elementOf({ kind, text, problems = [] }: Notice): HTMLElement {
  const close = el("button", { type: "button", className: "round", attributes: { "aria-label": "Close" } }, icon("close"));
  const items = problems.slice(0, MOST_PROBLEMS).map(({ path, message, line }) => {
    const place = line === undefined ? path : `line ${line}`;
    return el("li", {}, place ? el("code", {}, cut(place)) : null, ` ${cut(message)}`);
  });
  const hidden = problems.length - items.length;
  if (hidden > 0) items.push(el("li", {}, `and ${hidden} more`));
  const body = items.length > 0 ? el("ul", {}, ...items) : el("p", {}, cut(text));
  const role = kind === "error" ? "alert" : "status";
  const element = el("div", { className: `notice ${kind}`, attributes: { role } }, body, close);
  close.addEventListener("click", () => element.remove());
  return element;
}

function cut(text: string): string {
  return text.length > MOST_CHARACTERS ? `${text.slice(0, MOST_CHARACTERS)}…` : text;
}

/** Says that the engine is still at work, and lets the user end it. */
export function busyBanner(playground: Playground): HTMLElement {
  const text = el("span");
  const stop = el("button", { type: "button", onclick: () => void playground.stop() }, "Stop it");
  const banner = el("div", { className: "busy", hidden: true, attributes: { role: "status" } }, text, stop);
  playground.on("busy", (seconds) => {
    banner.hidden = seconds === 0;
    const words = `The engine is still working: ${Math.floor(seconds)} s.`;
    if (seconds > 0 && text.textContent !== words) text.textContent = words;
  });
  return banner;
}
