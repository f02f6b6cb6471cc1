// A scene as the part of an address after #, and back. Links are written by anyone: nothing in them is trusted.

import type { Settings } from "tautline";

import type { Source } from "../engine/protocol";

/** The longest link, characters: some programs cut longer ones. */
const MOST_CHARACTERS = 30_000;
/** The longest document in a link, bytes: a small one may unpack to anything. */
const MOST_BYTES = 1 << 20;
/** What can be named in a link. */
const NAME = /^[a-z0-9_-]{1,64}$/;

/** The link to a source; `undefined` if it would be too long. */
export async function toLink(source: Source): Promise<string | undefined> {
  const fields = new URLSearchParams();
  if (source.kind === "named") {
    fields.set("scene", source.name);
    for (const [name, value] of Object.entries(source.values)) fields.set(name, String(value));
    if (Object.keys(source.settings).length > 0) fields.set("settings", JSON.stringify(source.settings));
  } else {
    fields.set("document", await pack(source.text));
  }
  const link = `#${fields}`;
  return link.length <= MOST_CHARACTERS ? link : undefined;
}

/** The source that a link names; `undefined` if it names none. Throws an error for the user if it is damaged. */
export async function fromLink(hash: string): Promise<Source | undefined> {
  if (hash.length > MOST_CHARACTERS) throw new Error("The link is too long to be one of this page's.");
  const fields = new URLSearchParams(hash.replace(/^#/, ""));
  if (fields.has("served")) return { kind: "text", text: await served() };
  const packed = fields.get("document");
  if (packed !== null) return { kind: "text", text: await unpack(packed) };
  const name = fields.get("scene");
  if (name === null) return undefined;
  if (!NAME.test(name)) throw new Error("The link names no scene: a name has small letters, digits and dashes.");
  const values: Record<string, number> = {};
  for (const [field, text] of fields) {
    if (field === "scene" || field === "settings") continue;
    const value = Number(text);
    if (!NAME.test(field) || text.trim() === "" || !Number.isFinite(value)) {
      throw new Error("The link is damaged: a parameter in it is no number.");
    }
    values[field] = value;
  }
  return { kind: "named", name, values, settings: settingsOf(fields.get("settings")) };
}

/** The document that `tautline view FILE` serves beside the page. */
async function served(): Promise<string> {
  const response = await fetch("./scene.json");
  if (!response.ok) throw new Error("There is no scene beside this page.");
  return response.text();
}

/** Settings are judged by the engine; here they only have to be an object. */
function settingsOf(text: string | null): Settings {
  if (text === null) return {};
  try {
    const value: unknown = JSON.parse(text);
    if (typeof value === "object" && value !== null && !Array.isArray(value)) return value as Settings;
  } catch {
    // As below.
  }
  throw new Error("The link is damaged: the settings in it cannot be read.");
}

async function pack(text: string): Promise<string> {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const binary = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpack(packed: string): Promise<string> {
  try {
    const binary = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    return new TextDecoder("utf-8", { fatal: true }).decode(await inflated(bytes));
  } catch (error) {
    if (error instanceof RangeError) throw error;
    throw new Error("The link is damaged: the document in it cannot be read.");
  }
}

/** Unpacks piece by piece, and stops where it gets too much. */
async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const pieces: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > MOST_BYTES) {
      await reader.cancel();
      throw new RangeError("The document in the link is larger than 1 MB.");
    }
    pieces.push(value);
  }
  const whole = new Uint8Array(length);
  let offset = 0;
  for (const piece of pieces) {
    whole.set(piece, offset);
    offset += piece.length;
  }
  return whole;
}
