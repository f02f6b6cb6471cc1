// The playground's page.

import { Playground } from "./app/playground";
import type { Source } from "./engine/protocol";
import { fromLink } from "./share/link";
import "./style/base.css";
import "./style/layout.css";
import "./style/panels.css";
import { el, fill } from "./ui/dom";
import { listenToKeys } from "./ui/keys";
import { shell } from "./ui/shell";
import { missing } from "./ui/support";
import { initialTheme } from "./ui/theme";

/** What there is to see first. */
const FIRST: Source = { kind: "named", name: "hammock", values: {}, settings: {} };

declare global {
  interface Window {
    /** For the console: `playground.step(300)`, `await playground.hash()`. */
    playground?: Playground;
  }
}

async function start(app: HTMLElement): Promise<void> {
  const theme = initialTheme();
  const problem = missing();
  if (problem) return refuse(app, problem);
  const canvas = el("canvas", {
    tabIndex: 0,
    attributes: { "aria-label": "The scene: drag a body to throw it, drag beside it to turn the view, arrow keys turn it too." },
  });
  const playground = new Playground(canvas, theme);
  fill(app, el("p", { className: "loading" }, "Loading the engine…"));
  const hello = await playground.start();
  window.playground = playground;
  shell(app, playground, hello);
  listenToKeys(playground, canvas);
  await openLink(playground, true);
  addEventListener("hashchange", () => void openLink(playground, false));
}

/** Opens what the address names. On the first visit there is always something to see, whatever is wrong with it. */
async function openLink(playground: Playground, first: boolean): Promise<void> {
  try {
    const source = (await fromLink(location.hash)) ?? (first ? FIRST : undefined);
    if (source) await playground.build(source, true);
  } catch (error) {
    if (first) await playground.open(FIRST, true);
    playground.report(error);
  }
}

/** Says why the page cannot work here. */
function refuse(app: HTMLElement, problem: string): void {
  fill(app, el("div", { className: "refusal" }, el("h1", {}, "tautline"), el("p", {}, problem)));
}

const app = document.querySelector<HTMLElement>("#app");
if (app) start(app).catch((error: unknown) => refuse(app, error instanceof Error ? error.message : String(error)));
