import { Plane, Raycaster, Vector2, Vector3, type Camera } from "three";
import type { BodyView } from "../body.js";
import { TautlineError } from "../errors.js";
import type { GrabHandle } from "../handles.js";
import type { World } from "../world.js";

/** What to tell of a drag. */
export interface DragOptions {
  onStart?(body: BodyView): void;
  onEnd?(): void;
}

/** Grabs bodies with a mouse, pen or finger: they are led in the plane that faces the camera, and thrown by letting go. */
export class DragControls {
  private readonly ray = new Raycaster();
  private readonly plane = new Plane();
  private readonly pointer = new Vector2();
  private readonly target = new Vector3();
  private grab: GrabHandle | undefined;
  private pointerId = -1;

  constructor(
    private world: World,
    private readonly camera: Camera,
    private readonly element: HTMLElement,
    private readonly options: DragOptions = {},
  ) {
    // Before controls of the camera hear of it, which then leave what has been grabbed alone.
    element.addEventListener("pointerdown", this.down, { capture: true });
    element.addEventListener("pointermove", this.move);
    element.addEventListener("pointerup", this.up);
    element.addEventListener("pointercancel", this.up);
  }

  /** Whether something is held. */
  get isDragging(): boolean {
    return this.grab !== undefined;
  }

  /** Works on another world from now on. */
  setWorld(world: World): void {
    this.letGo();
    this.world = world;
  }

  dispose(): void {
    this.letGo();
    this.element.removeEventListener("pointerdown", this.down, { capture: true });
    this.element.removeEventListener("pointermove", this.move);
    this.element.removeEventListener("pointerup", this.up);
    this.element.removeEventListener("pointercancel", this.up);
  }

  private readonly down = (event: PointerEvent): void => {
    if (event.button !== 0 || this.isDragging) return;
    this.aim(event);
    const { origin, direction } = this.ray.ray;
    const hit = this.world.rayCast(origin.toArray(), direction.toArray());
    if (hit === undefined) return;
    const body = this.world.body(hit.body);
    try {
      this.grab = this.world.grab(hit.body, hit.point);
    } catch (error) {
      // What is fixed cannot be grabbed.
      if (error instanceof TautlineError && error.kind === "invalid") return;
      throw error;
    }
    const [x, y, z] = hit.point;
    this.plane.setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), new Vector3(x, y, z));
    this.pointerId = event.pointerId;
    this.element.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
    this.options.onStart?.(body);
  };

  private readonly move = (event: PointerEvent): void => {
    if (this.grab === undefined || event.pointerId !== this.pointerId) return;
    this.aim(event);
    if (this.ray.ray.intersectPlane(this.plane, this.target) === null) return;
    this.ifStillThere((grab) => this.world.moveGrab(grab, this.target.toArray()));
  };

  private readonly up = (event: PointerEvent): void => {
    if (event.pointerId === this.pointerId) this.letGo();
  };

  private letGo(): void {
    if (this.grab === undefined) return;
    this.ifStillThere((grab) => this.world.release(grab));
    this.grab = undefined;
    this.options.onEnd?.();
  }

  /** The body may have been removed, or the world reset, meanwhile. */
  private ifStillThere(act: (grab: GrabHandle) => void): void {
    try {
      if (this.grab !== undefined) act(this.grab);
    } catch (error) {
      if (!(error instanceof TautlineError) || error.kind !== "stale") throw error;
      this.grab = undefined;
    }
  }

  private aim(event: PointerEvent): void {
    const { left, top, width, height } = this.element.getBoundingClientRect();
    this.pointer.set((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    this.ray.setFromCamera(this.pointer, this.camera);
  }
}
