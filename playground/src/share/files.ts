// Files out of the page and into it.

import type { Playground } from "../app/playground";

const MESHES = ["obj", "stl", "ply", "glb"];
const DOCUMENTS = ["json"];
/** What the engine reads at most, bytes; told before the file is. */
const MOST_BYTES = 64 << 20;
/** What the editor shows at most, bytes. */
const MOST_DOCUMENT_BYTES = 4 << 20;

/** Endings of all files that can be opened, for a file chooser. */
export const ACCEPTED = [...MESHES, ...DOCUMENTS].map((ending) => `.${ending}`).join(",");

/** Gives the user a file. */
export function save(content: BlobPart, name: string, type: string): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** A name for a file, out of a scene's, which may be any text. */
export function fileName(scene: string, ending: string): string {
  const plain = scene.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "").slice(0, 60);
  return `${plain || "scene"}.${ending}`;
}

/** Opens a file: a mesh falls into the scene, a document replaces it. */
export async function openFile(playground: Playground, file: File): Promise<void> {
  const ending = file.name.split(".").at(-1)?.toLowerCase() ?? "";
  const refuse = (text: string) => playground.emit("notice", { kind: "error", text: `${file.name}: ${text}` });
  if (MESHES.includes(ending)) {
    if (file.size > MOST_BYTES) return refuse(`${megabytes(file.size)} are too many; a mesh may have 64 MB.`);
    return playground.importMesh(file);
  }
  if (DOCUMENTS.includes(ending)) {
    if (file.size > MOST_DOCUMENT_BYTES) return refuse(`${megabytes(file.size)} are too many; a document may have 4 MB.`);
    await playground.open({ kind: "text", text: await file.text() }, true);
    return;
  }
  return refuse("no known ending: meshes are .obj, .stl, .ply or .glb, scenes .json.");
}

function megabytes(bytes: number): string {
  return `${(bytes / 2 ** 20).toFixed(0)} MB`;
}

/** Lets files be dropped anywhere on the page; `target` is shown meanwhile. */
export function acceptDrops(playground: Playground, target: HTMLElement): void {
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    target.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) target.hidden = true;
  });
  addEventListener("drop", (event) => {
    target.hidden = true;
    if (!hasFiles(event)) return;
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    if (file) void openFile(playground, file);
  });
}
