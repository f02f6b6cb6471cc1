// The floor: it fades into the background, with a fine grid of metres for scale.

import * as THREE from "three";

const VERTEX = "#include <common>\nvarying vec3 vPlace;";
const FRAGMENT = "#include <common>\nvarying vec3 vPlace;\nuniform vec3 gridColor;\nuniform vec3 fadeCenter;\nuniform float fadeRadius;";

/** Distance of the lines, m, and how much of the grid's colour they have. */
const GRID = `
  vec2 place = vPlace.xz;
  vec2 width = fwidth(place);
  vec2 line = abs(fract(place - 0.5) - 0.5) / max(width, 1e-6);
  float strength = (1.0 - min(min(line.x, line.y), 1.0)) * (1.0 - smoothstep(0.06, 0.3, max(width.x, width.y)));
  diffuseColor.rgb = mix(diffuseColor.rgb, gridColor, 0.5 * strength);
  diffuseColor.a *= 1.0 - smoothstep(0.35, 1.0, distance(vPlace, fadeCenter) / fadeRadius);
`;

export class Ground {
  readonly object: THREE.Mesh<THREE.CircleGeometry, THREE.MeshLambertMaterial>;
  private readonly uniforms = {
    gridColor: { value: new THREE.Color() },
    fadeCenter: { value: new THREE.Vector3() },
    fadeRadius: { value: 10 },
  };

  constructor() {
    const material = new THREE.MeshLambertMaterial({ transparent: true });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", VERTEX)
        .replace("#include <project_vertex>", "#include <project_vertex>\nvPlace = (modelMatrix * vec4(transformed, 1.0)).xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", FRAGMENT)
        .replace("#include <color_fragment>", `#include <color_fragment>\n${GRID}`);
    };
    this.object = new THREE.Mesh(new THREE.CircleGeometry(1, 64).rotateX(-Math.PI / 2), material);
    this.object.receiveShadow = true;
    this.object.renderOrder = -1;
  }

  /** Lays it at a height about a point, m. */
  place(height: number, center: THREE.Vector3, radius: number): void {
    this.object.position.set(center.x, height, center.z);
    this.object.scale.setScalar(radius);
    this.uniforms.fadeCenter.value.set(center.x, height, center.z);
    this.uniforms.fadeRadius.value = radius;
  }

  paint(color: number, grid: number): void {
    this.object.material.color.setHex(color);
    this.uniforms.gridColor.value.setHex(grid);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
