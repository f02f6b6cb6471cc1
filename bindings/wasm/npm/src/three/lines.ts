import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, LineBasicMaterial, LineSegments } from "three";
import type { Vec3 } from "../checks.js";

/** Lines that are drawn anew whenever they change, such as what holds what. */
export class DebugLines extends LineSegments<BufferGeometry, LineBasicMaterial> {
  private readonly shade = new Color();
  private corners = 0;
  private room = 256;
  private places = new Float32Array(3 * this.room);
  private colors = new Float32Array(3 * this.room);

  constructor() {
    super(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true }));
    this.frustumCulled = false;
    this.renderOrder = 1;
    this.show();
  }

  /** Takes all lines away. */
  override clear(): this {
    this.corners = 0;
    return this;
  }

  /** Adds a line; the colour is 0xrrggbb, sRGB. */
  line(a: Vec3, b: Vec3, color: number): void {
    this.shade.setHex(color);
    for (const [x, y, z] of [a, b]) {
      this.grow();
      this.places.set([x, y, z], 3 * this.corners);
      this.shade.toArray(this.colors, 3 * this.corners);
      this.corners += 1;
    }
  }

  /** Adds a cross of three lines; size in m. */
  point([x, y, z]: Vec3, size: number, color: number): void {
    const half = size / 2;
    this.line([x - half, y, z], [x + half, y, z], color);
    this.line([x, y - half, z], [x, y + half, z], color);
    this.line([x, y, z - half], [x, y, z + half], color);
  }

  /** Shows what was added since `clear`. */
  commit(): void {
    this.geometry.setDrawRange(0, this.corners);
    for (const name of ["position", "color"]) this.geometry.getAttribute(name).needsUpdate = true;
  }

  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }

  private grow(): void {
    if (this.corners < this.room) return;
    this.room *= 2;
    const [places, colors] = [new Float32Array(3 * this.room), new Float32Array(3 * this.room)];
    places.set(this.places);
    colors.set(this.colors);
    [this.places, this.colors] = [places, colors];
    // Attributes cannot grow: what the graphics card has of the old ones is let go.
    this.geometry.dispose();
    this.show();
  }

  private show(): void {
    this.geometry.setAttribute("position", new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
    this.geometry.setAttribute("color", new BufferAttribute(this.colors, 3).setUsage(DynamicDrawUsage));
  }
}
