// A world to look at: made from its parts, moved by its frames.

import * as THREE from "three";

import type { Part } from "../engine/protocol";
import { Ground } from "./ground";
import { STAGE, type Theme } from "./palette";
import { Sheet } from "./sheet";
import { Solids, geometryOf } from "./solids";
import { Thread } from "./thread";

/** Where everything is. */
export interface Places {
  /** x y z qx qy qz qw of each body. */
  poses: Float32Array;
  /** xyz of all particles. */
  positions: Float32Array;
}

/** A floor that is further below a thing than this many times its size is not looked at with it. */
const FALL = 2;

/** What a ray has met. */
export interface Hit {
  part: Part;
  point: THREE.Vector3;
  distance: number;
}

export class View {
  readonly scene = new THREE.Scene();
  /** What is drawn over the world, such as what is held. */
  readonly overlay = new THREE.Group();
  parts: readonly Part[] = [];
  private readonly world = new THREE.Group();
  private readonly ground = new Ground();
  private readonly sky = new THREE.HemisphereLight();
  private readonly sun = new THREE.DirectionalLight();
  private solids: Solids[] = [];
  private sheets: Sheet[] = [];
  private threads: Thread[] = [];
  private walls: THREE.Mesh<THREE.BufferGeometry, THREE.MeshLambertMaterial>[] = [];

  constructor(theme: Theme) {
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1536, 1536);
    this.sun.shadow.radius = 6;
    this.scene.add(this.sky, this.sun, this.sun.target, this.ground.object, this.world, this.overlay);
    this.paint(theme);
  }

  paint(theme: Theme): void {
    const colors = STAGE[theme];
    this.scene.background = new THREE.Color(colors.background);
    this.ground.paint(colors.ground, colors.grid);
    this.sky.color.setHex(colors.sky);
    this.sky.groundColor.setHex(colors.bounce);
    this.sky.intensity = colors.skylight;
    this.sun.color.setHex(colors.sun);
    this.sun.intensity = colors.sunlight;
    for (const wall of this.walls) wall.material.color.setHex(colors.ground);
  }

  /** Shows other bodies. */
  setParts(parts: readonly Part[], theme: Theme): void {
    this.clear();
    this.parts = parts;
    const floor = lowestFloor(parts);
    this.ground.object.visible = floor !== undefined;
    for (const part of parts) {
      if (part.look === "sheet") this.sheets.push(new Sheet(part, THREE.DoubleSide));
      else if (part.look === "tube") this.threads.push(new Thread(part));
      else if (part.look === "wall" && part !== floor?.part) this.addWall(part, theme);
    }
    for (const group of byShape(parts)) {
      const [first] = group;
      if (first?.mesh) this.solids.push(new Solids(first.mesh, group, first.look));
    }
    this.world.add(...[...this.solids, ...this.sheets, ...this.threads].map((thing) => thing.object));
  }

  update(places: Places): void {
    for (const solid of this.solids) solid.update(places.poses);
    for (const sheet of this.sheets) sheet.update(places.positions);
    for (const thread of this.threads) thread.update(places.positions);
  }

  /** Fits the floor, the light and its shadows to what there is. */
  fit(bounds: THREE.Box3): void {
    const center = bounds.getCenter(new THREE.Vector3());
    const radius = Math.max(0.5, bounds.getSize(new THREE.Vector3()).length() / 2);
    const floor = lowestFloor(this.parts);
    this.ground.place(floor?.height ?? 0, center, Math.max(12, 8 * radius));
    const reach = 1.35 * radius;
    this.sun.target.position.copy(center);
    this.sun.position.copy(center).addScaledVector(new THREE.Vector3(0.45, 1, 0.35).normalize(), 3 * reach);
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 6 * reach });
    this.sun.shadow.camera.updateProjectionMatrix();
    // A shadow's edge is as soft in a large scene as in a small one.
    this.sun.shadow.normalBias = 0.008 * reach;
  }

  /** The box of all that is not a wall, m. */
  bounds(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const solid of this.solids) {
      solid.object.computeBoundingBox();
      if (solid.object.boundingBox) box.union(solid.object.boundingBox);
    }
    for (const sheet of this.sheets) box.union(new THREE.Box3().setFromObject(sheet.object));
    for (const thread of this.threads) box.union(new THREE.Box3().setFromObject(thread.object));
    if (box.isEmpty()) return new THREE.Box3(new THREE.Vector3(-1, 0, -1), new THREE.Vector3(1, 1, 1));
    // What is above a floor will fall on it.
    const floor = lowestFloor(this.parts)?.height ?? box.min.y;
    const size = box.getSize(new THREE.Vector3());
    if (box.min.y - floor < FALL * Math.max(size.x, size.y, size.z)) box.min.y = Math.min(box.min.y, floor);
    return box;
  }

  /** The first body that a ray meets. */
  pick(raycaster: THREE.Raycaster): Hit | undefined {
    const [hit] = raycaster.intersectObject(this.world, true);
    const part = hit && this.partOf(hit);
    return part && { part, point: hit.point, distance: hit.distance };
  }

  sheetOf(handle: number): Sheet | undefined {
    return this.sheets.find((sheet) => sheet.part.handle === handle);
  }

  threadOf(handle: number): Thread | undefined {
    return this.threads.find((thread) => thread.part.handle === handle);
  }

  /** Lets one see through all bodies, or not. */
  setGhostly(ghostly: boolean): void {
    const things = [...this.solids, ...this.sheets].map((thing) => thing.object);
    for (const { material } of things) {
      const own = material as THREE.Material;
      own.transparent = ghostly;
      own.opacity = ghostly ? 0.3 : 1;
      own.depthWrite = !ghostly;
      own.needsUpdate = true;
    }
  }

  /** Gives all sheets and threads their own colours back. */
  unpaint(): void {
    for (const thing of [...this.sheets, ...this.threads]) thing.paint(undefined);
  }

  dispose(): void {
    this.clear();
    this.ground.dispose();
    this.sun.dispose();
  }

  private partOf(hit: THREE.Intersection): Part | undefined {
    for (const solid of this.solids) if (solid.object === hit.object) return solid.parts[hit.instanceId ?? -1];
    for (const sheet of this.sheets) if (sheet.object === hit.object) return sheet.part;
    return this.threads.find((thread) => thread.object === hit.object.parent)?.part;
  }

  private addWall(part: Part, theme: Theme): void {
    if (!part.mesh) return;
    const material = new THREE.MeshLambertMaterial({ color: STAGE[theme].ground, transparent: true, opacity: 0.55 });
    const wall = new THREE.Mesh(geometryOf(part.mesh, "wall"), material);
    wall.receiveShadow = true;
    this.walls.push(wall);
    this.scene.add(wall);
  }

  private clear(): void {
    this.world.clear();
    for (const thing of [...this.solids, ...this.sheets, ...this.threads]) thing.dispose();
    for (const wall of this.walls) {
      wall.geometry.dispose();
      wall.material.dispose();
      this.scene.remove(wall);
    }
    [this.solids, this.sheets, this.threads, this.walls] = [[], [], [], []];
  }
}

/** The lowest of the walls that face upwards, and its height. */
function lowestFloor(parts: readonly Part[]): { part: Part; height: number } | undefined {
  let lowest: { part: Part; height: number } | undefined;
  for (const part of parts) {
    if (part.look !== "wall" || !part.mesh) continue;
    const { positions } = part.mesh;
    const height = positions[1] ?? 0;
    const isLevel = positions.every((value, index) => index % 3 !== 1 || Math.abs(value - height) < 1e-4);
    if (isLevel && facesUp(part) && height < (lowest?.height ?? Infinity)) lowest = { part, height };
  }
  return lowest;
}

function facesUp(part: Part): boolean {
  if (!part.mesh) return false;
  const [a, b, c] = [0, 1, 2].map((corner) => new THREE.Vector3().fromArray(part.mesh!.positions, 3 * part.mesh!.indices[corner]!));
  return b!.sub(a!).cross(c!.sub(a!)).y > 0;
}

/** Solids by their mesh and look. */
function byShape(parts: readonly Part[]): Part[][] {
  const groups = new Map<string, Part[]>();
  for (const part of parts) {
    if (!part.mesh || part.look === "wall") continue;
    const key = `${part.mesh.id} ${part.look}`;
    const group = groups.get(key);
    if (group) group.push(part);
    else groups.set(key, [part]);
  }
  return [...groups.values()];
}
