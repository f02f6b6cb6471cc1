// GJK, an iteration at a time: on the bodies themselves, and on their difference, where it looks for the origin.

import * as THREE from "three";

import type { CsoVertex, GjkTrace, Vec3 } from "tautline";

import { linear } from "../palette";
import { Lines, Points } from "./lines";

const SIMPLEX = linear(0xe0a458);
const SUPPORT = linear(0xd4708a);
const CLOSEST = linear(0x5fb08a);
const FACE = linear(0x4e9bd1);
const ORIGIN: Vec3 = [0, 0, 0];

/** Between which iterations: the last one shows the result as well. */
function isLast(trace: GjkTrace, iteration: number): boolean {
  return iteration >= trace.iterations.length - 1;
}

/** What GJK knows of the two bodies after an iteration. */
export function onBodies(trace: GjkTrace, iteration: number): THREE.Object3D[] {
  const lines = new Lines();
  const points = new Points(9);
  const step = trace.iterations[Math.min(iteration, trace.iterations.length - 1)];
  if (step) {
    for (const vertex of step.simplex) {
      lines.line(vertex.onA, vertex.onB, SIMPLEX);
      points.point(vertex.onA, SIMPLEX).point(vertex.onB, SIMPLEX);
    }
    points.point(step.support.onA, SUPPORT).point(step.support.onB, SUPPORT);
  }
  if (isLast(trace, iteration)) {
    const [a, b] = trace.points ?? [];
    if (a && b) {
      lines.line(a, b, CLOSEST);
      points.point(a, CLOSEST).point(b, CLOSEST);
    }
    if (trace.hitFace) {
      outline(lines, trace.hitFace.featureA.points, FACE);
      outline(lines, trace.hitFace.featureB.points, FACE);
    }
  }
  return [lines.build(), points.build()];
}

/** The difference of the bodies with the simplex in it. */
export function onDifference(trace: GjkTrace, iteration: number): THREE.Object3D[] {
  const things: THREE.Object3D[] = [];
  if (trace.difference) things.push(...differenceOf(trace.difference));
  const lines = new Lines();
  const points = new Points(9);
  points.point(ORIGIN, [1, 1, 1]);
  const step = trace.iterations[Math.min(iteration, trace.iterations.length - 1)];
  if (step) {
    drawSimplex(lines, points, step.simplex);
    lines.line(ORIGIN, step.closest, CLOSEST);
    points.point(step.closest, CLOSEST).point(step.support.point, SUPPORT);
  }
  if (isLast(trace, iteration) && trace.hitFace) {
    const [a, b, c] = trace.hitFace.vertices;
    lines.triangle(a.point, b.point, c.point, FACE);
  }
  things.push(lines.build(), points.build());
  return things;
}

function drawSimplex(lines: Lines, points: Points, simplex: readonly CsoVertex[]): void {
  simplex.forEach((vertex, index) => {
    points.point(vertex.point, SIMPLEX);
    for (const other of simplex.slice(index + 1)) lines.line(vertex.point, other.point, SIMPLEX);
  });
}

function differenceOf({ positions, indices }: { positions: Float32Array; indices: Uint32Array }): THREE.Object3D[] {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  const material = new THREE.MeshLambertMaterial({ color: 0x8fa3b8, transparent: true, opacity: 0.28, side: THREE.DoubleSide, depthWrite: false });
  const edges = new THREE.LineSegments(
    new THREE.EdgesGeometry(geometry, 1),
    new THREE.LineBasicMaterial({ color: 0x8fa3b8, transparent: true, opacity: 0.5 }),
  );
  geometry.dispose();
  return [new THREE.Mesh(flat, material), edges];
}

/** A vertex, an edge or a face of a body. */
function outline(lines: Lines, points: readonly Vec3[], color: readonly [number, number, number]): void {
  points.forEach((point, index) => {
    const next = points[(index + 1) % points.length];
    if (next && points.length > 1) lines.line(point, next, color);
  });
}
