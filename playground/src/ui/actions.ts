// The buttons at the top: compare, share, export, theme.

import type { Playground } from "../app/playground";
import { toLink } from "../share/link";
import { fileName, save } from "../share/files";
import { el } from "./dom";
import { type Icon, icon } from "./icons";
import { toggleTheme } from "./theme";

export function actions(playground: Playground): HTMLElement {
  const button = (name: Icon, label: string, title: string, action: () => unknown) =>
    el(
      "button",
      { type: "button", title, onclick: () => void action(), attributes: { "aria-label": title } },
      icon(name),
      el("span", {}, label),
    );
  const compare = button("split", "Compare", "Default and paper's solver side by side", () =>
    playground.setComparing(!playground.comparing),
  );
  const record = button("download", "GLB", "Record the motion, then save it as GLB", () => exportGlb(playground));
  const label = record.querySelector("span");
  playground.on("state", () => {
    compare.setAttribute("aria-pressed", String(playground.comparing));
    record.classList.toggle("recording", playground.recording);
    if (label) label.textContent = playground.recording ? "Save GLB" : "GLB";
  });
  return el(
    "div",
    { className: "actions", attributes: { role: "toolbar", "aria-label": "Share and export" } },
    compare,
    button("share", "Share", "Copy a link to this scene", () => share(playground)),
    button("camera", "PNG", "Save a picture", () => exportPng(playground)),
    record,
    button("sun", "Theme", "Light or dark", () => toggleTheme(playground)),
  );
}

async function share(playground: Playground): Promise<void> {
  const link = playground.source && (await toLink(playground.source));
  if (link === undefined) {
    const text = "This document is too large for a link: save it in the editor, and send the file.";
    playground.emit("notice", { kind: "error", text });
    return;
  }
  history.replaceState(null, "", link);
  try {
    await navigator.clipboard.writeText(location.href);
    playground.emit("notice", { kind: "info", text: "The link to this scene is in the clipboard, and in the address bar." });
  } catch {
    playground.emit("notice", { kind: "info", text: "The link to this scene is in the address bar." });
  }
}

async function exportPng(playground: Playground): Promise<void> {
  const picture = await playground.stage.picture();
  if (picture) save(picture, fileName(playground.opened?.name ?? "", "png"), "image/png");
}

/** The first press records from now on, the second one saves. */
async function exportGlb(playground: Playground): Promise<void> {
  if (!playground.recording) {
    await playground.startRecording();
    if (!playground.recording) return;
    playground.setPlaying(true);
    playground.emit("notice", { kind: "info", text: "Recording: press again to save the motion as GLB." });
    return;
  }
  const bytes = await playground.exportGlb();
  if (bytes) save(bytes as Uint8Array<ArrayBuffer>, fileName(playground.opened?.name ?? "", "glb"), "model/gltf-binary");
}
