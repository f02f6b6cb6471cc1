// What the schema of scene documents says about a place in one.

import type { Step } from "./json_path";

/** The part of JSON Schema that the engine's schema uses. */
export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  description?: string;
  properties?: Record<string, Schema>;
  items?: Schema;
  prefixItems?: Schema[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  allOf?: Schema[];
  enum?: unknown[];
  const?: unknown;
  type?: string | string[];
  default?: unknown;
}

/** All that may stand at a place, with references followed and alternatives side by side. */
export function schemasAt(root: Schema, path: readonly Step[]): Schema[] {
  let here = alternatives(root, root);
  for (const step of path) {
    const next = here.flatMap((schema) => childOf(schema, step));
    here = next.flatMap((schema) => alternatives(root, schema));
  }
  return here;
}

function childOf(schema: Schema, step: Step): Schema[] {
  if (typeof step === "number") {
    const item = schema.prefixItems?.[step] ?? schema.items;
    return item ? [item] : [];
  }
  const child = schema.properties?.[step];
  return child ? [child] : [];
}

/** References that lead nowhere, or round in a circle, end here. */
const DEEPEST = 20;

function alternatives(root: Schema, schema: Schema, depth = 0): Schema[] {
  if (depth > DEEPEST) return [];
  const { $ref, anyOf = [], oneOf = [], allOf = [], ...own } = schema;
  const target = $ref?.startsWith("#/$defs/") ? root.$defs?.[$ref.slice("#/$defs/".length)] : undefined;
  // What is said beside a reference is closer to the matter than what is said behind it.
  const referred = target ? [{ ...target, ...(own.description ? { description: own.description } : {}) }] : [];
  const nested = [...referred, ...anyOf, ...oneOf, ...allOf];
  return [own, ...nested.flatMap((inner) => alternatives(root, inner, depth + 1))];
}

/** A name that can stand in an object, with what it means. */
export interface Named {
  name: string;
  description: string;
  schema: Schema;
}

/** The names that an object at this place may have. */
export function namesAt(root: Schema, path: readonly Step[]): Named[] {
  const found = new Map<string, Named>();
  for (const schema of schemasAt(root, path)) {
    for (const [name, property] of Object.entries(schema.properties ?? {})) {
      const description = property.description ?? schema.description ?? "";
      if (!found.has(name)) found.set(name, { name, description, schema: property });
    }
  }
  return [...found.values()];
}

/** The words that may stand at this place. */
export function wordsAt(root: Schema, path: readonly Step[]): { word: unknown; description: string }[] {
  return schemasAt(root, path).flatMap((schema) => {
    const description = schema.description ?? "";
    const words = schema.enum ?? (schema.const === undefined ? [] : [schema.const]);
    const switches = schema.type === "boolean" ? [true, false] : [];
    return [...words, ...switches].map((word) => ({ word, description }));
  });
}

/** What a new value of this kind begins with: `{`, `[`, `"` or nothing. */
export function openingOf(root: Schema, schema: Schema): string {
  const types = alternatives(root, schema).flatMap(({ type, properties }) => (properties ? ["object"] : (type ?? [])));
  if (types.includes("object")) return "{}";
  if (types.includes("array")) return "[]";
  return types.length > 0 && types.every((type) => type === "string") ? '""' : "";
}
