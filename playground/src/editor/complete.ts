// Completion and explanations in the editor, out of the schema.

import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { syntaxTree } from "@codemirror/language";
import type { EditorState } from "@codemirror/state";
import { hoverTooltip } from "@codemirror/view";
import type { SyntaxNode } from "@lezer/common";

import { el } from "../ui/dom";
import { nameOf, pathOf } from "./json_path";
import { type Named, type Schema, namesAt, openingOf, wordsAt } from "./schema";

/** What is replaced. */
interface Range {
  from: number;
  to: number;
}

/** Completes the names of fields, and the words that may stand in them. */
export function completeFrom(schema: Schema): (context: CompletionContext) => CompletionResult | null {
  return (context) => {
    const { state, pos } = context;
    const node = syntaxTree(state).resolveInner(pos, -1);
    const property = ancestor(node, "Property");
    const isName = node.name === "PropertyName" || node.name === "Object" || (node.name === "⚠" && node.parent?.name === "Object");
    const word = context.matchBefore(/"?[\w$-]*/);
    const isWhole = node.name === "PropertyName" || node.name === "String";
    const from = isWhole ? node.from : (word?.from ?? pos);
    // A closing quote behind the cursor is replaced too.
    const to = isWhole ? node.to : pos;
    if (!context.explicit && from === pos) return null;
    if (isName) return names(schema, state, ancestor(node, "Object"), { from, to }, node);
    if (property && !["Object", "Array"].includes(node.name)) {
      return words(schema, [...pathOf(state, property), nameOf(state, property)], { from, to });
    }
    return null;
  };
}

function names(
  schema: Schema,
  state: EditorState,
  object: SyntaxNode | undefined,
  range: Range,
  node: SyntaxNode,
): CompletionResult | null {
  if (!object) return null;
  const others = object.getChildren("Property").filter((child) => child.from !== node.parent?.from);
  const known = new Set(others.map((child) => nameOf(state, child)));
  const hasColon = node.name === "PropertyName" && node.parent?.getChild(":") != null;
  const options = namesAt(schema, pathOf(state, object))
    .filter(({ name }) => !known.has(name))
    .map((named) => option(schema, named, hasColon));
  return options.length > 0 ? { ...range, options, validFor: /^"?[\w$-]*"?$/ } : null;
}

function option(schema: Schema, { name, description, schema: own }: Named, hasColon: boolean): Completion {
  const opening = openingOf(schema, own);
  const text = hasColon ? `"${name}"` : `"${name}": ${opening}`;
  return {
    label: `"${name}"`,
    displayLabel: name,
    info: () => el("div", {}, description),
    type: "property",
    apply: (view, _completion, from, to) => {
      // The cursor ends between the brackets.
      const anchor = from + text.length - (hasColon ? 0 : Math.floor(opening.length / 2));
      view.dispatch({ changes: { from, to, insert: text }, selection: { anchor } });
    },
  };
}

function words(schema: Schema, path: (string | number)[], range: Range): CompletionResult | null {
  const options = wordsAt(schema, path).map(({ word, description }) => ({
    label: JSON.stringify(word),
    info: () => el("div", {}, description),
    type: "enum",
  }));
  return options.length > 0 ? { ...range, options, validFor: /^"?[\w-]*"?$/ } : null;
}

function ancestor(node: SyntaxNode, name: string): SyntaxNode | undefined {
  for (let at: SyntaxNode | null = node; at; at = at.parent) if (at.name === name) return at;
  return undefined;
}

/** Says what a field means when the pointer rests on its name. */
export function explain(schema: Schema) {
  return hoverTooltip((view, pos, side) => {
    const node = syntaxTree(view.state).resolveInner(pos, side);
    const object = node.name === "PropertyName" ? ancestor(node, "Object") : undefined;
    if (!object || !node.parent) return null;
    const name = nameOf(view.state, node.parent);
    const found = namesAt(schema, pathOf(view.state, object)).find((named) => named.name === name);
    if (!found?.description) return null;
    return { pos: node.from, end: node.to, create: () => ({ dom: el("div", { className: "explanation" }, found.description) }) };
  });
}
