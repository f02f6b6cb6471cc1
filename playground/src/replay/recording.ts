// A recording out of the page that it was written into: a description, and its numbers.

import type { Camera, Part } from "../engine/protocol";
import type { Places } from "../stage/view";

interface Bounds {
  low: [number, number, number];
  extent: [number, number, number];
}

interface Track {
  name: string;
  color: number;
  surface: "solid" | "sheet" | "round" | "wall";
  mesh: number;
  motion: "still" | { rigid: Bounds } | { deforming: Bounds };
}

interface Description {
  name: string;
  frameRate: number;
  frames: number;
  camera: Camera | null;
  /** Vertices and triangles of each. */
  meshes: [vertices: number, triangles: number][];
  tracks: Track[];
}

interface Mesh {
  id: number;
  positions: Float32Array;
  indices: Uint32Array;
}

/** Where a track is at a frame. */
type Motion = (frame: number, places: Places) => void;

export interface Recording {
  name: string;
  frameRate: number;
  frames: number;
  camera: Camera | undefined;
  parts: Part[];
  /** Everything at a frame. */
  at(frame: number): Places;
}

export async function readRecording(): Promise<Recording> {
  const description = JSON.parse(text("recording")) as Description;
  const numbers = new Reader(await unpack(text("numbers")));
  const meshes = description.meshes.map(([vertices, triangles], id): Mesh => {
    return { id, positions: numbers.floats(3 * vertices), indices: numbers.indices(3 * triangles) };
  });
  const parts: Part[] = [];
  const motions: Motion[] = [];
  let particles = 0;
  for (const track of description.tracks) {
    const mesh = meshes[track.mesh]!;
    const part = partOf(track, mesh, parts.length, particles);
    particles += part.particleCount;
    parts.push(part);
    motions.push(motionOf(track, part, mesh, numbers, description.frames));
  }
  const places = { poses: new Float32Array(7 * parts.length), positions: new Float32Array(3 * particles) };
  const at = (frame: number) => {
    for (const motion of motions) motion(frame, places);
    return places;
  };
  const { name, frameRate, frames, camera } = description;
  return { name, frameRate, frames, camera: camera ?? undefined, parts, at };
}

function text(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

async function unpack(packed: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}

function partOf(track: Track, mesh: Mesh, index: number, firstParticle: number): Part {
  const deforms = typeof track.motion === "object" && "deforming" in track.motion;
  return {
    handle: index,
    index,
    kind: deforms ? "cloth" : "rigid",
    name: track.name,
    color: track.color,
    look: deforms ? "sheet" : track.surface === "sheet" ? "round" : track.surface,
    mesh: deforms ? undefined : mesh,
    radius: 0,
    firstParticle,
    particleCount: deforms ? mesh.positions.length / 3 : 0,
    triangles: deforms ? mesh.indices : new Uint32Array(),
    segments: new Uint32Array(),
    fixed: true,
  };
}

function motionOf(track: Track, part: Part, mesh: Mesh, numbers: Reader, frames: number): Motion {
  const { motion } = track;
  if (motion === "still") return (_frame, places) => places.poses.set([0, 0, 0, 0, 0, 0, 1], 7 * part.index);
  if ("rigid" in motion) {
    const rows = numbers.rows(7, frames);
    return (frame, places) => {
      const row = rows[frame]!;
      const pose = places.poses.subarray(7 * part.index, 7 * part.index + 7);
      spread(row.subarray(0, 3), motion.rigid, pose);
      for (let k = 3; k < 7; k++) pose[k] = ((row[k]! << 16) >> 16) / 32767;
    };
  }
  const rows = numbers.rows(mesh.positions.length, frames);
  return (frame, places) => spread(rows[frame]!, motion.deforming, places.positions.subarray(3 * part.firstParticle));
}

/** Steps of a box as places in it, m. */
function spread(row: Uint16Array, { low, extent }: Bounds, places: Float32Array): void {
  row.forEach((step, index) => (places[index] = low[index % 3]! + (extent[index % 3]! * step) / 65535));
}

/** Reads numbers one after the other. */
class Reader {
  private readonly buffer: ArrayBuffer;
  private offset = 0;

  constructor(buffer: ArrayBuffer) {
    this.buffer = buffer;
  }

  floats(count: number): Float32Array {
    return new Float32Array(this.take(4 * count));
  }

  indices(count: number): Uint32Array {
    return new Uint32Array(this.take(4 * count));
  }

  /** Rows that were written as differences to the row before: all low bytes of a row, then all high ones. */
  rows(width: number, count: number): Uint16Array[] {
    let before = new Uint16Array(width);
    return Array.from({ length: count }, () => {
      const bytes = new Uint8Array(this.take(2 * width));
      before = before.map((value, index) => value + bytes[index]! + (bytes[width + index]! << 8));
      return before;
    });
  }

  private take(length: number): ArrayBuffer {
    this.offset += length;
    return this.buffer.slice(this.offset - length, this.offset);
  }
}
