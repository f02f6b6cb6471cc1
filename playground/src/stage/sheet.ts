// A surface that changes its form: cloth, soft solids, and tubes of recordings.

import * as THREE from "three";

import type { Part } from "../engine/protocol";
import { smoothNormals } from "./normals";

export class Sheet {
  readonly object: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  readonly part: Part;
  private readonly positions: THREE.BufferAttribute;
  private readonly normals: THREE.BufferAttribute;
  private readonly color: THREE.Color;

  constructor(part: Part, side: THREE.Side) {
    this.part = part;
    const geometry = new THREE.BufferGeometry();
    this.positions = dynamic(part.particleCount);
    this.normals = dynamic(part.particleCount);
    geometry.setAttribute("position", this.positions);
    geometry.setAttribute("normal", this.normals);
    geometry.setIndex(new THREE.BufferAttribute(part.triangles, 1));
    this.color = new THREE.Color(part.color);
    const material = new THREE.MeshStandardMaterial({ color: this.color, roughness: 0.85, side });
    // Thin sheets would shade themselves in stripes.
    material.shadowSide = THREE.DoubleSide;
    this.object = new THREE.Mesh(geometry, material);
    this.object.castShadow = true;
    this.object.receiveShadow = true;
    this.object.frustumCulled = false;
  }

  /** Takes over its particles' places from those of the world. */
  update(positions: Float32Array): void {
    const { firstParticle, particleCount, triangles } = this.part;
    const own = positions.subarray(3 * firstParticle, 3 * (firstParticle + particleCount));
    (this.positions.array as Float32Array).set(own);
    smoothNormals(own, triangles, this.normals.array as Float32Array);
    this.positions.needsUpdate = true;
    this.normals.needsUpdate = true;
    this.object.geometry.boundingSphere = null;
  }

  /** Colours its particles, rgb in 0 to 1 each; `undefined` gives it its own colour back. */
  paint(colors: Float32Array | undefined): void {
    const { geometry, material } = this.object;
    const painted = colors !== undefined;
    if (painted) geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    else geometry.deleteAttribute("color");
    material.color.copy(painted ? new THREE.Color(1, 1, 1) : this.color);
    if (material.vertexColors !== painted) {
      material.vertexColors = painted;
      material.needsUpdate = true;
    }
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

function dynamic(count: number): THREE.BufferAttribute {
  const attribute = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
  attribute.setUsage(THREE.DynamicDrawUsage);
  return attribute;
}
