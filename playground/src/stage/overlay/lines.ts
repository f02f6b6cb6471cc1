// Lines and points that are drawn over everything.

import * as THREE from "three";

import type { Vec3 } from "tautline";

type Rgb = readonly [number, number, number];

/** Line segments in the making. */
export class Lines {
  private readonly positions: number[] = [];
  private readonly colors: number[] = [];

  line(from: Vec3, to: Vec3, color: Rgb): this {
    this.positions.push(...from, ...to);
    this.colors.push(...color, ...color);
    return this;
  }

  /** The edges of a triangle. */
  triangle(a: Vec3, b: Vec3, c: Vec3, color: Rgb): this {
    return this.line(a, b, color).line(b, c, color).line(c, a, color);
  }

  build(): THREE.LineSegments {
    const material = new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true });
    const lines = new THREE.LineSegments(colored(this.positions, this.colors), material);
    lines.renderOrder = 5;
    lines.frustumCulled = false;
    return lines;
  }
}

/** Points of one size on the screen (px), in the making. */
export class Points {
  private readonly positions: number[] = [];
  private readonly colors: number[] = [];
  private readonly size: number;

  constructor(size: number) {
    this.size = size;
  }

  point(at: Vec3, color: Rgb): this {
    this.positions.push(...at);
    this.colors.push(...color);
    return this;
  }

  build(): THREE.Points {
    const material = new THREE.PointsMaterial({
      size: this.size * Math.min(devicePixelRatio, 2),
      sizeAttenuation: false,
      vertexColors: true,
      depthTest: false,
      transparent: true,
    });
    const points = new THREE.Points(colored(this.positions, this.colors), material);
    points.renderOrder = 6;
    points.frustumCulled = false;
    return points;
  }
}

function colored(positions: number[], colors: number[]): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  return geometry;
}

/** Frees what a group holds, and empties it. */
export function clear(group: THREE.Object3D): void {
  group.traverse((object) => {
    if (object instanceof THREE.Mesh || object instanceof THREE.LineSegments || object instanceof THREE.Points) {
      object.geometry.dispose();
      object.material.dispose();
    }
  });
  group.clear();
}
