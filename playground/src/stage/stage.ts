// The canvas: one view, or two side by side with one camera.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import type { Camera } from "../engine/protocol";
import type { Theme } from "./palette";
import { installToneMapping } from "./tone";
import { View } from "./view";

/** Where pictures are taken from unless a scene says otherwise. */
const THREE_QUARTER = new THREE.Vector3(0.5, 0.42, 0.8).normalize();
const FIELD_OF_VIEW = 35;

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 500);
  readonly controls: OrbitControls;
  views: View[] = [];
  theme: Theme;
  /** A small picture in the corner, of what is about the origin, seen from where the scene is. */
  inset: { scene: THREE.Scene; radius: number } | undefined;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly insetCamera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
  private stale = true;
  private framed: { bounds: THREE.Box3; camera: Camera | undefined } | undefined;

  constructor(canvas: HTMLCanvasElement, theme: Theme) {
    this.canvas = canvas;
    this.theme = theme;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.toneMapping = installToneMapping();
    this.renderer.setScissorTest(true);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxDistance = 300;
    this.controls.addEventListener("change", () => this.invalidate());
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Asks for a picture: something has changed. */
  invalidate(): void {
    this.stale = true;
  }

  addView(): View {
    const view = new View(this.theme);
    this.views.push(view);
    this.resize();
    return view;
  }

  removeView(view: View): void {
    view.dispose();
    this.views = this.views.filter((other) => other !== view);
    this.resize();
  }

  paint(theme: Theme): void {
    this.theme = theme;
    for (const view of this.views) view.paint(theme);
    this.invalidate();
  }

  /** Draws, if anything has changed since the last picture. */
  draw(): void {
    this.controls.update();
    if (!this.stale) return;
    this.stale = false;
    const width = this.canvas.clientWidth / Math.max(1, this.views.length);
    const height = this.canvas.clientHeight;
    this.views.forEach((view, index) => {
      this.renderer.setViewport(index * width, 0, width, height);
      this.renderer.setScissor(index * width, 0, width, height);
      this.renderer.render(view.scene, this.camera);
    });
    if (this.inset) this.drawInset(this.inset.scene, this.inset.radius, height);
  }

  private drawInset(scene: THREE.Scene, radius: number, height: number): void {
    const size = Math.round(Math.min(240, 0.42 * height));
    const towards = this.camera.getWorldDirection(new THREE.Vector3());
    this.insetCamera.position.copy(towards).multiplyScalar(-4.2 * radius);
    this.insetCamera.near = 0.1 * radius;
    this.insetCamera.far = 20 * radius;
    this.insetCamera.updateProjectionMatrix();
    this.insetCamera.lookAt(0, 0, 0);
    // Under what is said about it, and above the time's buttons.
    const [x, y] = [12, height - size - 12];
    this.renderer.setViewport(x, y, size, size);
    this.renderer.setScissor(x, y, size, size);
    this.renderer.render(scene, this.insetCamera);
  }

  /** Looks at all there is in the box, from where the scene wants to be seen if it says so. */
  frame(bounds: THREE.Box3, camera: Camera | undefined): void {
    this.framed = { bounds, camera };
    const center = bounds.getCenter(new THREE.Vector3());
    this.camera.fov = camera?.fov ?? FIELD_OF_VIEW;
    this.controls.target.copy(center);
    if (camera) {
      this.controls.target.fromArray(camera.target);
      this.camera.position.fromArray(camera.eye);
      this.stepBack();
    } else {
      this.camera.position.copy(center).addScaledVector(THREE_QUARTER, distanceOf(bounds, this.camera));
    }
    this.camera.updateProjectionMatrix();
    this.controls.update();
    // What is asked before the next picture is drawn is asked of where it is now.
    this.camera.updateMatrixWorld();
    this.invalidate();
  }

  /** Looks at it as at first. */
  reframe(): void {
    if (this.framed) this.frame(this.framed.bounds, this.framed.camera);
  }

  /** Turns the camera about what it looks at, and brings it nearer, in radians and as a factor. */
  turn(azimuth: number, polar: number, distance = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const spherical = new THREE.Spherical().setFromVector3(offset);
    spherical.theta += azimuth;
    spherical.phi += polar;
    spherical.radius *= distance;
    spherical.makeSafe();
    this.camera.position.setFromSpherical(spherical).add(this.controls.target);
    this.invalidate();
  }

  /** The view under a point of the window, or the given one, and a ray through that point. */
  rayAt(x: number, y: number, given?: View): { view: View; raycaster: THREE.Raycaster } | undefined {
    const box = this.canvas.getBoundingClientRect();
    const width = box.width / Math.max(1, this.views.length);
    const under = Math.min(this.views.length - 1, Math.max(0, Math.floor((x - box.left) / width)));
    const index = given ? this.views.indexOf(given) : under;
    const view = this.views[index];
    if (!view) return undefined;
    const point = new THREE.Vector2(
      (2 * (x - box.left - index * width)) / width - 1,
      1 - (2 * (y - box.top)) / box.height,
    );
    // Drawing does this too, but a hand may be faster than the next picture.
    this.camera.updateMatrixWorld();
    view.scene.updateMatrixWorld();
    const raycaster = new THREE.Raycaster();
    raycaster.setFromCamera(point, this.camera);
    return { view, raycaster };
  }

  /** The picture as it is now. */
  picture(): Promise<Blob | null> {
    this.stale = true;
    this.draw();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    const before = this.camera.aspect;
    this.camera.aspect = clientWidth / Math.max(1, this.views.length) / clientHeight;
    this.camera.updateProjectionMatrix();
    if (Math.min(1, before) !== Math.min(1, this.camera.aspect)) this.reframe();
    this.invalidate();
  }

  /** A scene's own view is meant for a wide picture: on a narrow one the eye has to be further away. */
  private stepBack(): void {
    const wide = 1.45;
    const factor = Math.max(1, wide / this.camera.aspect);
    const offset = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(offset, factor);
  }
}

/** How far away a camera has to be for the box to fit into its picture, m. */
function distanceOf(bounds: THREE.Box3, camera: THREE.PerspectiveCamera): number {
  const radius = bounds.getSize(new THREE.Vector3()).length() / 2;
  const narrow = Math.atan(Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) * Math.min(1, camera.aspect));
  return (1.05 * Math.max(0.3, radius)) / Math.sin(narrow);
}
