// The scene's document, to be changed while it runs.

import type { Playground } from "../app/playground";
import type { Editor } from "../editor/editor";
import type { Schema } from "../editor/schema";
import type { Problem } from "../engine/protocol";
import { ACCEPTED, fileName, openFile, save } from "../share/files";
import { debounce, el, fill } from "../ui/dom";
import { icon } from "../ui/icons";

/** A pause in typing, ms, after which the document is run. */
const PAUSE = 500;
/** A document of more characters is not shown: it would be no pleasure to edit. */
const MOST_SHOWN = 1_500_000;

export class EditPanel {
  readonly element: HTMLElement;
  private readonly playground: Playground;
  private readonly host = el("div", { className: "editor" });
  private readonly status = el("p", { className: "status", attributes: { role: "status" } }, "Runs as you type.");
  private editor: Editor | undefined;
  private loading: Promise<void> | undefined;
  /** What has been typed is being built. */
  private running = false;

  constructor(playground: Playground) {
    this.playground = playground;
    const file = el("input", { type: "file", accept: ACCEPTED, hidden: true });
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      if (chosen) void openFile(playground, chosen);
      file.value = "";
    });
    const open = el("button", { type: "button", onclick: () => file.click() }, icon("upload"), "Open…");
    const keep = el("button", { type: "button", onclick: () => this.save() }, icon("download"), "Save");
    this.element = el(
      "section",
      { className: "panel edit" },
      el("p", { className: "hint" }, "The whole scene as JSON; Ctrl+Space completes. Drop or open a mesh, and it falls in."),
      el("div", { className: "row" }, open, keep, file),
      this.host,
      this.status,
    );
    playground.on("opened", () => this.show());
    playground.on("notice", ({ kind, problems }) => {
      if (kind === "error" && problems && this.running) this.mark(problems);
    });
  }

  /** Loads the editor: it is large, and not everybody needs it. */
  load(): Promise<void> {
    this.loading ??= import("../editor/editor").then(({ createEditor }) => {
      const schema = (this.playground.hello?.schema ?? {}) as Schema;
      this.editor = createEditor(this.host, schema, debounce(() => void this.run(), PAUSE));
      this.show();
    });
    return this.loading;
  }

  private show(): void {
    const text = this.playground.opened?.text ?? "";
    if (!this.editor) return;
    const tooLong = text.length > MOST_SHOWN;
    this.editor.setText(tooLong ? "" : text);
    this.mark([]);
    if (tooLong) this.status.textContent = "This document is too long to be edited here; save it instead.";
  }

  /** Runs what has been typed, if nothing is wrong with it. */
  private async run(): Promise<void> {
    const text = this.editor?.text() ?? "";
    // Another scene may have been opened since somebody typed.
    if (text === this.playground.opened?.text) return;
    const problems = await this.playground.check(text).catch(() => []);
    if (text !== this.editor?.text()) return;
    this.mark(problems);
    if (problems.length > 0) return;
    this.running = true;
    await this.playground.open({ kind: "text", text }, false);
    this.running = false;
  }

  private mark(problems: readonly Problem[]): void {
    this.editor?.mark(problems);
    this.status.classList.toggle("wrong", problems.length > 0);
    const [first] = problems;
    if (!first) return fill(this.status, "Runs as you type.");
    const line = first.line === undefined ? "" : `line ${first.line}`;
    const place = [line, first.path].filter(Boolean).join(", ");
    const more = problems.length > 1 ? ` (and ${problems.length - 1} more)` : "";
    fill(this.status, `${place ? `${place}: ` : ""}${first.message}${more}`);
  }

  private save(): void {
    const { opened } = this.playground;
    if (opened) save(opened.text, fileName(opened.name, "json"), "application/json");
  }
}
