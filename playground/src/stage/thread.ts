// A rope or a net: a cylinder for each segment, and a ball where they meet.

import * as THREE from "three";

import type { Part } from "../engine/protocol";

const UP = new THREE.Vector3(0, 1, 0);
const AROUND = 10;

export class Thread {
  readonly object = new THREE.Group();
  readonly part: Part;
  private readonly material: THREE.MeshStandardMaterial;
  private readonly rods: THREE.InstancedMesh;
  private readonly balls: THREE.InstancedMesh;
  private readonly color: THREE.Color;

  constructor(part: Part) {
    this.part = part;
    this.color = new THREE.Color(part.color);
    this.material = new THREE.MeshStandardMaterial({ roughness: 0.8 });
    const rod = new THREE.CylinderGeometry(1, 1, 1, AROUND, 1, true);
    const ball = new THREE.SphereGeometry(1, AROUND, 6);
    this.rods = this.instances(rod, part.segments.length / 2);
    this.balls = this.instances(ball, part.particleCount);
    this.object.add(this.rods, this.balls);
    this.paint(undefined);
  }

  update(positions: Float32Array): void {
    const { firstParticle, particleCount, radius, segments } = this.part;
    const matrix = new THREE.Matrix4();
    const rotation = new THREE.Quaternion();
    const [from, to, along, middle, scale] = Array.from({ length: 5 }, () => new THREE.Vector3()) as Five;
    for (let k = 0; k < segments.length / 2; k++) {
      from.fromArray(positions, 3 * (firstParticle + segments[2 * k]!));
      to.fromArray(positions, 3 * (firstParticle + segments[2 * k + 1]!));
      along.subVectors(to, from);
      const length = along.length();
      rotation.setFromUnitVectors(UP, length > 0 ? along.divideScalar(length) : UP);
      middle.addVectors(from, to).multiplyScalar(0.5);
      this.rods.setMatrixAt(k, matrix.compose(middle, rotation, scale.set(radius, length, radius)));
    }
    rotation.identity();
    scale.setScalar(radius);
    for (let k = 0; k < particleCount; k++) {
      from.fromArray(positions, 3 * (firstParticle + k));
      this.balls.setMatrixAt(k, matrix.compose(from, rotation, scale));
    }
    for (const mesh of [this.rods, this.balls]) {
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }

  /** Colours its segments, rgb in 0 to 1 each; `undefined` gives it its own colour back. */
  paint(colors: Float32Array | undefined): void {
    const color = this.color.clone();
    for (let k = 0; k < this.rods.count; k++) {
      this.rods.setColorAt(k, colors ? color.fromArray(colors, 3 * k) : this.color);
    }
    for (let k = 0; k < this.balls.count; k++) this.balls.setColorAt(k, this.color);
    for (const mesh of [this.rods, this.balls]) {
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  dispose(): void {
    for (const mesh of [this.rods, this.balls]) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
    this.material.dispose();
  }

  private instances(geometry: THREE.BufferGeometry, count: number): THREE.InstancedMesh {
    const mesh = new THREE.InstancedMesh(geometry, this.material, count);
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    return mesh;
  }
}

type Five = [THREE.Vector3, THREE.Vector3, THREE.Vector3, THREE.Vector3, THREE.Vector3];
