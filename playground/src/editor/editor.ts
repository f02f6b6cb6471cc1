// The editor of documents. It lives in a shadow root, where its styles need no leave from the content security policy.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import { HighlightStyle, bracketMatching, foldGutter, foldKeymap, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";

import type { Problem } from "../engine/protocol";
import { completeFrom, explain } from "./complete";
import { rangeOf } from "./json_path";
import type { Schema } from "./schema";

export interface Editor {
  text(): string;
  setText(text: string): void;
  /** Marks what is wrong, each at its line. */
  mark(problems: readonly Problem[]): void;
}

/** Puts an editor into an element. `changed` is called when somebody types. */
export function createEditor(parent: HTMLElement, schema: Schema, changed: () => void): Editor {
  const root = parent.attachShadow({ mode: "open" });
  let quiet = false;
  const listener = EditorView.updateListener.of((update) => {
    if (update.docChanged && !quiet) changed();
  });
  const view = new EditorView({
    root,
    parent: root as unknown as Element,
    state: EditorState.create({ doc: "", extensions: [...extensions(schema), listener] }),
  });
  return {
    text: () => view.state.doc.toString(),
    setText: (text) => {
      if (text === view.state.doc.toString()) return;
      quiet = true;
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
      quiet = false;
    },
    mark: (problems) => {
      const { state } = view;
      const diagnostics = problems.map((problem) => diagnosticOf(state, problem));
      view.dispatch(setDiagnostics(state, diagnostics.sort((a, b) => a.from - b.from)));
    },
  };
}

function diagnosticOf(state: EditorState, { path, message, line, column }: Problem): Diagnostic {
  const text = path === "" ? message : `${path}: ${message}`;
  if (line === undefined || line > state.doc.lines) return { ...rangeOf(state, path), severity: "error", message: text };
  const at = state.doc.line(Math.max(1, line));
  const from = Math.min(at.to, at.from + Math.max(0, (column ?? 1) - 1));
  return { from, to: at.to, severity: "error", message: text };
}

function extensions(schema: Schema) {
  return [
    lineNumbers(),
    highlightActiveLineGutter(),
    highlightActiveLine(),
    history(),
    foldGutter(),
    lintGutter(),
    drawSelection(),
    indentOnInput(),
    bracketMatching(),
    closeBrackets(),
    autocompletion({ override: [completeFrom(schema)] }),
    explain(schema),
    json(),
    syntaxHighlighting(COLORS),
    THEME,
    EditorView.lineWrapping,
    EditorView.contentAttributes.of({ "aria-label": "Scene document" }),
    // Escape, then Tab, leaves the editor by the keyboard.
    keymap.of([...closeBracketsKeymap, ...completionKeymap, ...lintKeymap, ...foldKeymap, ...historyKeymap, ...defaultKeymap, indentWithTab]),
  ];
}

const COLORS = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--code-name)" },
  { tag: tags.string, color: "var(--code-text)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--code-number)" },
]);

const THEME = EditorView.theme({
  "&": { height: "100%", fontSize: "12.5px", color: "var(--ink)", backgroundColor: "transparent" },
  ".cm-scroller": { fontFamily: "ui-monospace, SFMono-Regular, Menlo, Consolas, 'DejaVu Sans Mono', monospace", lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "transparent", color: "var(--quiet)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
  "&.cm-focused": { outline: "none" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selection) !important" },
  ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--rule)", borderRadius: "6px" },
  ".cm-tooltip .explanation, .cm-completionInfo": { padding: "6px 9px", maxWidth: "22rem" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--wrong)" },
  ".cm-foldPlaceholder": { backgroundColor: "var(--hover)", border: "none", color: "var(--quiet)" },
});
