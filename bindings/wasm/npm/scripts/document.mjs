// Writes the schema of scene documents as a module, and their types from it.
import { readFile, writeFile } from "node:fs/promises";
import { compile } from "json-schema-to-typescript";

const path = "../../../crates/tautline-scene/schema/scene.schema.json";
const schema = JSON.parse(await readFile(path, "utf8"));
await writeFile("src/schema.ts", `export const SCHEMA: object = ${JSON.stringify(schema)};\n`);

/** What stands beside a reference would make another type of it: it goes around it. */
function wrapReferences(node) {
  if (node === null || typeof node !== "object") return;
  Object.values(node).forEach(wrapReferences);
  if (node.$ref !== undefined && Object.keys(node).length > 1) {
    node.allOf = [{ $ref: node.$ref }];
    delete node.$ref;
  }
}
wrapReferences(schema);
schema.title = "Scene";
const types = await compile(schema, "Scene", {
  additionalProperties: false,
  bannerComment: "// Made of the schema of scene documents by `npm run document`: every field has a default.",
  format: true,
  style: { printWidth: 120 },
});
const readable = types
  .replaceAll(/^ *\* @(min|max)Items \d+\n/gm, "")
  .replaceAll(/\n *\*(?=\n *\*\/)/g, "")
  .replaceAll(/^ *\/\*\*\n *\*\/\n/gm, "")
  .replaceAll(/: (\[number(, number)+\]( \||;))/g, ": readonly $1");
await writeFile("src/document.ts", readable);
