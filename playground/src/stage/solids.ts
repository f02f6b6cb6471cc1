// Bodies that keep their form: those of one shape are drawn together.

import * as THREE from "three";

import type { Mesh, Part } from "../engine/protocol";

/** All bodies of one shape and look. */
export class Solids {
  readonly object: THREE.InstancedMesh;
  /** In the order of the instances. */
  readonly parts: readonly Part[];
  private readonly matrix = new THREE.Matrix4();
  private readonly position = new THREE.Vector3();
  private readonly rotation = new THREE.Quaternion();

  constructor(mesh: Mesh, parts: readonly Part[], look: Part["look"]) {
    this.parts = parts;
    this.object = new THREE.InstancedMesh(geometryOf(mesh, look), materialOf(look), parts.length);
    this.object.castShadow = true;
    this.object.receiveShadow = true;
    // Instances go anywhere: the first bounds would soon be wrong.
    this.object.frustumCulled = false;
    const color = new THREE.Color();
    parts.forEach((part, index) => this.object.setColorAt(index, color.setHex(part.color)));
  }

  /** Moves the bodies to where they are: 7 numbers for each body of the world. */
  update(poses: Float32Array): void {
    const one = new THREE.Vector3(1, 1, 1);
    this.parts.forEach((part, index) => {
      this.position.fromArray(poses, 7 * part.index);
      this.rotation.fromArray(poses, 7 * part.index + 3);
      this.object.setMatrixAt(index, this.matrix.compose(this.position, this.rotation, one));
    });
    this.object.instanceMatrix.needsUpdate = true;
    // Rays are cast against bounds that are made anew.
    this.object.boundingSphere = null;
  }

  dispose(): void {
    this.object.geometry.dispose();
    (this.object.material as THREE.Material).dispose();
    this.object.dispose();
  }
}

/** A surface with the normals that its look asks for. */
export function geometryOf(mesh: Pick<Mesh, "positions" | "indices">, look: Part["look"]): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
  if (look === "round") {
    geometry.computeVertexNormals();
    return geometry;
  }
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  geometry.dispose();
  return flat;
}

function materialOf(look: Part["look"]): THREE.Material {
  return new THREE.MeshStandardMaterial({ roughness: look === "round" ? 0.45 : 0.6, metalness: 0 });
}
