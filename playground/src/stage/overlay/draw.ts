// What there is to see of how it works, drawn over a view.

import * as THREE from "three";

import type { ContactPoint, Feature, Vec3 } from "tautline";

import type { Inspection, Part, StickValues } from "../../engine/protocol";
import { classColor, heat, linear } from "../palette";
import type { Places, View } from "../view";
import { onBodies } from "./gjk";
import { Lines, Points, clear } from "./lines";

/** Strain at which a stick is drawn in the hottest colour. */
const HOTTEST_STRAIN = 0.03;
/** Length of a contact's normal, m. */
const NORMAL = 0.12;
const UNKNOWN = linear(0x8a929c);
/** Of contacts: their points on either body, their normals, and the features that meet. */
const [ON_A, ON_B, NORMAL_COLOR, FEATURE] = [linear(0x4e9bd1), linear(0xe0a458), linear(0xd4708a), linear(0x5fb08a)];

type Rgb = readonly [number, number, number];

/** The overlay of one view. */
export class Overlay {
  private readonly group = new THREE.Group();
  private readonly view: View;

  constructor(view: View) {
    this.view = view;
    view.overlay.add(this.group);
  }

  /** Draws an inspection; `undefined` takes it away. `iteration` is GJK's. */
  draw(inspection: Inspection | undefined, places: Places | undefined, iteration: number): void {
    clear(this.group);
    this.view.unpaint();
    const hides = inspection !== undefined && ["spheres", "gjk", "contacts"].includes(inspection.kind);
    this.view.setGhostly(hides);
    if (inspection && places) this.group.add(...this.objectsOf(inspection, places, iteration));
  }

  private objectsOf(inspection: Inspection, places: Places, iteration: number): THREE.Object3D[] {
    switch (inspection.kind) {
      case "spheres":
        return [spheres(inspection.spheres)];
      case "boxes":
        return [boxes(inspection.boxes)];
      case "gjk":
        return inspection.trace ? onBodies(inspection.trace, iteration) : [];
      case "contacts":
        return contacts(inspection.contacts);
      case "colors":
        return [...this.sticks(inspection.sticks, places, (value) => (value < 0 ? UNKNOWN : classColor(value))), pairs(inspection.pairs, this.view.parts, places)];
      case "order":
        return this.sticks(inspection.sticks, places, (value) => (value < 0 ? undefined : heat(1 - value)));
      case "strain":
        return this.strains(inspection.sticks, places);
    }
  }

  /** Sheets and threads by their strain; what has no surface of its own by lines. */
  private strains(sticks: readonly StickValues[], places: Places): THREE.Object3D[] {
    const color = (value: number) => heat(0.5 + value / (2 * HOTTEST_STRAIN));
    return sticks.flatMap((stick) => {
      const part = this.partOf(stick.body);
      if (!part) return [];
      const sheet = this.view.sheetOf(part.handle);
      const thread = this.view.threadOf(part.handle);
      if (sheet) sheet.paint(byParticle(part, stick.values, color));
      else if (thread) thread.paint(Float32Array.from([...stick.values].flatMap(color)));
      else return this.sticks([stick], places, color);
      return [];
    });
  }

  private sticks(sticks: readonly StickValues[], places: Places, color: (value: number) => Rgb | undefined): THREE.Object3D[] {
    const lines = new Lines();
    for (const { body, values } of sticks) {
      const part = this.partOf(body);
      if (!part) continue;
      values.forEach((value, stick) => {
        const own = color(value);
        if (!own) return;
        const [from, to] = [part.segments[2 * stick]!, part.segments[2 * stick + 1]!];
        lines.line(particle(places, part, from), particle(places, part, to), own);
      });
    }
    return [lines.build()];
  }

  private partOf(handle: number): Part | undefined {
    return this.view.parts.find((part) => part.handle === handle);
  }
}

function particle(places: Places, part: Part, index: number): Vec3 {
  const at = 3 * (part.firstParticle + index);
  return [places.positions[at]!, places.positions[at + 1]!, places.positions[at + 2]!];
}

/** The mean of the sticks about each particle, as colours. */
function byParticle(part: Part, values: Float32Array, color: (value: number) => Rgb): Float32Array {
  const sums = new Float32Array(part.particleCount);
  const counts = new Float32Array(part.particleCount);
  values.forEach((value, stick) => {
    for (const end of [part.segments[2 * stick]!, part.segments[2 * stick + 1]!]) {
      sums[end]! += value;
      counts[end]! += 1;
    }
  });
  const colors = new Float32Array(3 * part.particleCount);
  sums.forEach((sum, index) => colors.set(color(sum / (counts[index] || 1)), 3 * index));
  return colors;
}

function spheres(numbers: Float32Array): THREE.Object3D {
  const material = new THREE.MeshLambertMaterial({ color: 0x5fa8c4, transparent: true, opacity: 0.28, depthWrite: false });
  const mesh = new THREE.InstancedMesh(new THREE.SphereGeometry(1, 20, 14), material, numbers.length / 4);
  const matrix = new THREE.Matrix4();
  for (let k = 0; k < numbers.length / 4; k++) {
    const [x, y, z, r] = numbers.subarray(4 * k, 4 * k + 4);
    mesh.setMatrixAt(k, matrix.makeScale(r!, r!, r!).setPosition(x!, y!, z!));
  }
  mesh.frustumCulled = false;
  return mesh;
}

/** The twelve edges of a box, by its corners: bit 0 is x, bit 1 y, bit 2 z. */
const EDGES = [0, 1, 0, 2, 0, 4, 1, 3, 1, 5, 2, 3, 2, 6, 3, 7, 4, 5, 4, 6, 5, 7, 6, 7];

function boxes(numbers: Float32Array): THREE.Object3D {
  const lines = new Lines();
  const color = linear(0xe0a458);
  for (let k = 0; k < numbers.length; k += 6) {
    const box = numbers.subarray(k, k + 6);
    if (!box.every(Number.isFinite) || box[0]! > box[3]!) continue;
    const corner = (bits: number): Vec3 => [box[bits & 1 ? 3 : 0]!, box[bits & 2 ? 4 : 1]!, box[bits & 4 ? 5 : 2]!];
    for (let edge = 0; edge < EDGES.length; edge += 2) lines.line(corner(EDGES[edge]!), corner(EDGES[edge + 1]!), color);
  }
  return lines.build();
}

function contacts(found: readonly ContactPoint[]): THREE.Object3D[] {
  const lines = new Lines();
  const points = new Points(7);
  for (const { pointA, pointB, normal: n, featureA, featureB } of found) {
    points.point(pointA, ON_A).point(pointB, ON_B);
    const tip: Vec3 = [pointB[0] + n[0] * NORMAL, pointB[1] + n[1] * NORMAL, pointB[2] + n[2] * NORMAL];
    lines.line(pointB, tip, NORMAL_COLOR).line(pointA, pointB, NORMAL_COLOR);
    for (const side of [featureA, featureB]) if (side) outline(lines, side, FEATURE);
  }
  return [lines.build(), points.build()];
}

function outline(lines: Lines, { points }: Feature, color: Rgb): void {
  if (points.length < 2) return;
  points.forEach((point, index) => lines.line(point, points[(index + 1) % points.length]!, color));
}

/** A line between the middles of two bodies that are solved together. */
function pairs(found: readonly { a: number; b: number; color: number }[], parts: readonly Part[], places: Places): THREE.Object3D {
  const lines = new Lines();
  const middle = (handle: number): Vec3 | undefined => {
    const part = parts.find((known) => known.handle === handle);
    if (!part || part.look === "wall") return undefined;
    const at = 7 * part.index;
    return [places.poses[at]!, places.poses[at + 1]!, places.poses[at + 2]!];
  };
  for (const { a, b, color } of found) {
    const [from, to] = [middle(a), middle(b)];
    if (from && to) lines.line(from, to, classColor(color));
  }
  return lines.build();
}
