import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, FrontSide, Group, InstancedMesh,
  type Intersection, type Material, Matrix4, Mesh, MeshStandardMaterial, Quaternion, Vector3,
} from "three";
import type { BodyView } from "../body.js";
import type { BodyHandle } from "../handles.js";
import type { World } from "../world.js";
import { cornerCount, linesOf, particlesOfCorners, tubeIndices, writeTubes } from "./tube.js";

/** How a world is shown. */
export interface WorldViewOptions {
  /** Whether bodies cast and receive shadows; they do if absent. */
  readonly shadows?: boolean;
  /** Whether half-spaces are shown; they are if absent. */
  readonly walls?: boolean;
  /** The material of a kind of body. It is asked once for each mesh and each sheet; colours of instances are multiplied. */
  readonly material?: (body: BodyView) => Material;
}

/** Bodies of one surface, drawn at once. */
interface Solids {
  readonly mesh: InstancedMesh;
  readonly bodies: readonly BodyView[];
}

/** A sheet or rope. */
interface Soft {
  readonly mesh: Mesh<BufferGeometry, Material>;
  readonly body: BodyView;
  triangles: Uint32Array;
  readonly lines: readonly Uint32Array[];
  /** For each vertex its particle; of sheets they are the same. */
  readonly particles: Uint32Array | undefined;
}

const HIGHLIGHT = new Color(1.6, 1.6, 1.6);
const WHITE = new Color(1, 1, 1);

/**
 * A world as a group: solids of one shape as instances, sheets smooth, ropes as tubes. Call `update` after steps.
 */
export class WorldView extends Group {
  private solids: Solids[] = [];
  private softs: Soft[] = [];
  private walls: Mesh[] = [];
  private shown: readonly BodyView[] | undefined;
  private highlighted: BodyHandle | undefined;
  private readonly matrixOf = new Matrix4();
  private readonly place = new Vector3();
  private readonly turn = new Quaternion();

  constructor(
    private world: World,
    private readonly options: WorldViewOptions = {},
  ) {
    super();
    this.update();
  }

  /** Shows another world. */
  setWorld(world: World): void {
    this.world = world;
    this.update();
  }

  /** Shows the world as it is now; bodies that came, went or tore are followed. */
  update(): void {
    if (this.shown !== this.world.bodies) this.rebuild();
    const { poses } = this.world;
    for (const { mesh, bodies } of this.solids) {
      bodies.forEach((body, i) => mesh.setMatrixAt(i, this.poseOf(poses, body.index)));
      mesh.instanceMatrix.needsUpdate = true;
      // Rays and the view's frustum are tested against it.
      mesh.boundingSphere = null;
    }
    for (const soft of this.softs) this.updateSoft(soft);
  }

  /** The body of an intersection that a raycaster found. */
  bodyOf({ object, instanceId }: Pick<Intersection, "object" | "instanceId">): BodyView | undefined {
    const solids = this.solids.find(({ mesh }) => mesh === object);
    if (solids !== undefined) return instanceId === undefined ? undefined : solids.bodies[instanceId];
    return this.softs.find(({ mesh }) => mesh === object)?.body;
  }

  /** Colours of a sheet's or rope's particles, three numbers from 0 to 1 each; `null` = its own again. */
  setParticleColors(body: BodyHandle, colors: Float32Array | null): void {
    const soft = this.softs.find((one) => one.body.handle === body);
    if (soft === undefined) return;
    const { geometry, material } = soft.mesh;
    if (colors === null) geometry.deleteAttribute("color");
    else geometry.setAttribute("color", new BufferAttribute(spread(colors, soft.particles), 3));
    if (material instanceof MeshStandardMaterial) {
      material.color.setHex(colors === null ? soft.body.color : 0xffffff);
      material.vertexColors = colors !== null;
      material.needsUpdate = true;
    }
  }

  /** Lets a body shine; `undefined` = none. */
  highlight(body: BodyHandle | undefined): void {
    for (const handle of [this.highlighted, body]) {
      const factor = handle === body ? HIGHLIGHT : WHITE;
      for (const { mesh, bodies } of this.solids) {
        const index = bodies.findIndex((one) => one.handle === handle);
        if (index < 0) continue;
        mesh.setColorAt(index, new Color(bodies[index]?.color).multiply(factor));
        if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
      }
    }
    this.highlighted = body;
  }

  override dispose(): void {
    for (const mesh of [...this.solids.map((one) => one.mesh), ...this.softs.map((one) => one.mesh), ...this.walls]) {
      mesh.geometry.dispose();
      for (const material of [mesh.material].flat()) material.dispose();
      if (mesh instanceof InstancedMesh) mesh.dispose();
    }
    this.clear();
    [this.solids, this.softs, this.walls] = [[], [], []];
  }

  private rebuild(): void {
    this.dispose();
    const bodies = this.world.bodies;
    this.shown = bodies;
    const alike = new Map<string, BodyView[]>();
    for (const body of bodies) {
      if (body.look === "wall") this.addWall(body);
      else if (body.look === "sheet" || body.look === "tube") this.addSoft(body);
      else {
        const key = `${body.look} ${body.mesh?.id}`;
        alike.set(key, [...(alike.get(key) ?? []), body]);
      }
    }
    alike.forEach((group) => this.addSolids(group));
  }

  private addSolids(bodies: readonly BodyView[]): void {
    const [first] = bodies;
    if (first?.mesh === undefined) return;
    const geometry = geometryOf(first.mesh.positions, first.mesh.indices);
    if (first.look === "round") geometry.computeVertexNormals();
    const material = this.materialOf(first, { color: 0xffffff, flatShading: first.look === "solid" });
    const mesh = new InstancedMesh(geometry, material, bodies.length);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    bodies.forEach((body, i) => mesh.setColorAt(i, new Color(body.color)));
    this.solids.push({ mesh: this.shaded(mesh), bodies });
  }

  private addSoft(body: BodyView): void {
    const isTube = body.look === "tube";
    const lines = isTube ? linesOf(body.segments) : [];
    const triangles = isTube ? tubeIndices(lines) : body.triangles;
    const count = isTube ? cornerCount(lines) : body.particleCount;
    const geometry = geometryOf(new Float32Array(3 * count), triangles);
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage));
    const material = this.materialOf(body, { color: body.color, side: isTube ? FrontSide : DoubleSide });
    const mesh = this.shaded(new Mesh(geometry, material));
    mesh.frustumCulled = false;
    this.softs.push({ mesh, body, triangles, lines, particles: isTube ? particlesOfCorners(lines) : undefined });
  }

  private addWall(body: BodyView): void {
    if (this.options.walls === false || body.mesh === undefined) return;
    const geometry = geometryOf(body.mesh.positions, body.mesh.indices);
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, this.materialOf(body, { color: body.color }));
    mesh.receiveShadow = this.options.shadows !== false;
    this.walls.push(mesh);
    this.add(mesh);
  }

  private updateSoft(soft: Soft): void {
    const { mesh, body, lines } = soft;
    const { geometry } = mesh;
    const [places, normals] = [geometry.getAttribute("position"), geometry.getAttribute("normal")];
    if (body.look === "tube") {
      writeTubes(lines, body.positions, body.radius, places.array as Float32Array, normals.array as Float32Array);
    } else {
      (places.array as Float32Array).set(body.positions);
      const { triangles } = body;
      if (triangles !== soft.triangles) {
        geometry.setIndex(new BufferAttribute(triangles, 1));
        soft.triangles = triangles;
      }
      geometry.computeVertexNormals();
    }
    places.needsUpdate = true;
    normals.needsUpdate = true;
    geometry.boundingSphere = null;
  }

  private materialOf(
    body: BodyView,
    look: { color: number; flatShading?: boolean; side?: typeof FrontSide | typeof DoubleSide },
  ): Material {
    return this.options.material?.(body) ?? new MeshStandardMaterial({ roughness: 0.7, ...look });
  }

  private shaded<M extends Mesh>(mesh: M): M {
    mesh.castShadow = mesh.receiveShadow = this.options.shadows !== false;
    this.add(mesh);
    return mesh;
  }

  private poseOf(poses: Float32Array, index: number): Matrix4 {
    this.place.fromArray(poses, 7 * index);
    this.turn.fromArray(poses, 7 * index + 3);
    return this.matrixOf.makeRotationFromQuaternion(this.turn).setPosition(this.place);
  }
}

function geometryOf(positions: Float32Array, indices: Uint32Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}

/** Colours of particles as colours of vertices. */
function spread(colors: Float32Array, particles: Uint32Array | undefined): Float32Array {
  if (particles === undefined) return colors;
  const all = new Float32Array(3 * particles.length);
  particles.forEach((particle, i) => all.set(colors.subarray(3 * particle, 3 * particle + 3), 3 * i));
  return all;
}
