// Taking hold of what is on the stage, with mouse, pen or finger: it is led in the plane that faces the eye.

import * as THREE from "three";

import type { Vec3 } from "tautline";

import type { Hit, View } from "./view";
import type { Stage } from "./stage";

/** Who moves the world under the hand. */
export interface Holder {
  grab(view: View, hit: Hit): void;
  move(view: View, target: Vec3): void;
  release(view: View): void;
  /** Bodies that have been clicked, not dragged. */
  choose(view: View, hit: Hit | undefined): void;
}

/** A pointer that moves less than this has clicked, px. */
const CLICK = 5;
/** The plane's part, m, that a hand reaches: further away the picture's edge would throw things to the horizon. */
const REACH = 200;

export class Hand {
  private readonly stage: Stage;
  private readonly holder: Holder;
  private held: { pointer: number; view: View; plane: THREE.Plane; hit: Hit; moved: boolean; x: number; y: number } | undefined;
  private readonly mark = new THREE.Mesh(
    new THREE.SphereGeometry(1, 16, 12),
    new THREE.MeshBasicMaterial({ color: 0xe0a458, depthTest: false, transparent: true }),
  );

  constructor(stage: Stage, holder: Holder) {
    this.stage = stage;
    this.holder = holder;
    this.mark.renderOrder = 10;
    const { canvas } = stage;
    // Before the camera's own controls, which must not turn while something is held.
    canvas.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event));
  }

  /** Lets go, for example because the scene is another one. */
  drop(): void {
    if (!this.held) return;
    this.mark.removeFromParent();
    this.held = undefined;
    this.stage.controls.enabled = true;
    this.stage.canvas.classList.remove("holding");
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || this.held) return;
    const ray = this.stage.rayAt(event.clientX, event.clientY);
    const hit = ray?.view.pick(ray.raycaster);
    if (!ray || !hit || hit.part.fixed) {
      if (ray) this.holder.choose(ray.view, undefined);
      return;
    }
    const forward = this.stage.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(forward, hit.point);
    this.held = { pointer: event.pointerId, view: ray.view, plane, hit, moved: false, x: event.clientX, y: event.clientY };
    this.stage.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.stage.canvas.classList.add("holding");
    this.holder.grab(ray.view, hit);
    this.show(hit.point);
    ray.view.overlay.add(this.mark);
  }

  private move(event: PointerEvent): void {
    const held = this.held;
    if (!held || event.pointerId !== held.pointer) return;
    held.moved ||= Math.hypot(event.clientX - held.x, event.clientY - held.y) > CLICK;
    const target = this.stage
      .rayAt(event.clientX, event.clientY, held.view)
      ?.raycaster.ray.intersectPlane(held.plane, new THREE.Vector3());
    if (!target || target.distanceTo(held.hit.point) > REACH) return;
    this.show(target);
    this.holder.move(held.view, target.toArray());
  }

  private up(event: PointerEvent): void {
    const held = this.held;
    if (!held || event.pointerId !== held.pointer) return;
    this.drop();
    this.holder.release(held.view);
    if (!held.moved) this.holder.choose(held.view, held.hit);
    this.stage.invalidate();
  }

  /** The mark is as large as a fingertip at any distance. */
  private show(point: THREE.Vector3): void {
    this.mark.position.copy(point);
    this.mark.scale.setScalar(0.006 * this.stage.camera.position.distanceTo(point));
    this.stage.invalidate();
  }
}
