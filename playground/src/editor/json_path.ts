// Where one is in a JSON text, and where a path of the engine's, such as `bodies[2].rigid.mass`, is.

import { ensureSyntaxTree, syntaxTree } from "@codemirror/language";
import type { EditorState } from "@codemirror/state";
import type { SyntaxNode } from "@lezer/common";

export type Step = string | number;

/** The names and indices that lead to a node from the root. */
export function pathOf(state: EditorState, node: SyntaxNode): Step[] {
  const path: Step[] = [];
  for (let inner = node, outer = node.parent; outer; inner = outer, outer = outer.parent) {
    if (outer.name === "Property" && inner.name !== "PropertyName") path.unshift(nameOf(state, outer));
    if (outer.name === "Array") path.unshift(children(outer).findIndex((child) => child.from === inner.from));
  }
  return path;
}

/** The name of a property. */
export function nameOf(state: EditorState, property: SyntaxNode): string {
  const name = property.getChild("PropertyName");
  const text = name ? state.sliceDoc(name.from, name.to) : '""';
  try {
    return String(JSON.parse(text));
  } catch {
    return text;
  }
}

/** The values of an array, without its brackets and commas. */
function children(array: SyntaxNode): SyntaxNode[] {
  const found: SyntaxNode[] = [];
  for (let child = array.firstChild; child; child = child.nextSibling) {
    if (!/^[[\],⚠]$/.test(child.name)) found.push(child);
  }
  return found;
}

/** The part of the text that a path leads to: as far as it can be followed. */
export function rangeOf(state: EditorState, path: string): { from: number; to: number } {
  let node = (ensureSyntaxTree(state, state.doc.length, 200) ?? syntaxTree(state)).topNode.firstChild;
  let best = node;
  for (const step of stepsOf(path)) {
    if (!node) break;
    node = typeof step === "number" ? (children(node)[step] ?? null) : propertyValue(state, node, step);
    best = node ?? best;
  }
  const from = best?.from ?? 0;
  // A long value is marked by its first line.
  return { from, to: Math.min(best?.to ?? 0, state.doc.lineAt(from).to) };
}

function propertyValue(state: EditorState, object: SyntaxNode, name: string): SyntaxNode | null {
  const property = object.getChildren("Property").find((child) => nameOf(state, child) === name);
  return property?.lastChild ?? null;
}

/** `a.b[2]` as ["a", "b", 2]. */
function stepsOf(path: string): Step[] {
  return [...path.matchAll(/\[(\d+)\]|[^.[\]]+/g)].map((match) => (match[1] === undefined ? match[0] : Number(match[1])));
}
