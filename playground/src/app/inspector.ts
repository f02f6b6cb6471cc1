// Keeps what is drawn of how it works in step with the worlds.

import * as THREE from "three";

import type { Iteration } from "../panels/inside";
import { STAGE } from "../stage/palette";
import { Overlay } from "../stage/overlay/draw";
import { onDifference } from "../stage/overlay/gjk";
import { clear } from "../stage/overlay/lines";
import type { View } from "../stage/view";
import type { Playground } from "./playground";

export function inspector(playground: Playground, iteration: Iteration): void {
  const overlays = new Map<View, Overlay>();
  const inset = new THREE.Scene();
  let drawn = false;
  const draw = () => {
    const asked = playground.query !== undefined;
    if (!asked && !drawn) return;
    drawn = asked;
    for (const { view, frame, inspection } of playground.sessions) {
      const overlay = overlays.get(view) ?? new Overlay(view);
      overlays.set(view, overlay);
      overlay.draw(asked ? inspection : undefined, frame, iteration.value);
    }
    playground.stage.inset = asked ? insetOf(playground, inset, iteration.value) : undefined;
    playground.stage.invalidate();
  };
  iteration.changed = draw;
  playground.on("frame", draw);
}

/** The difference of two bodies that GJK looks at. */
function insetOf(playground: Playground, scene: THREE.Scene, iteration: number): { scene: THREE.Scene; radius: number } | undefined {
  const { inspection } = playground.frame ?? {};
  clear(scene);
  if (inspection?.kind !== "gjk" || !inspection.trace) return undefined;
  scene.background = new THREE.Color(STAGE[playground.stage.theme].ground);
  const light = new THREE.HemisphereLight(0xffffff, 0x777777, 2.5);
  scene.add(light, ...onDifference(inspection.trace, iteration));
  const positions = inspection.trace.difference?.positions ?? [];
  let squared = 1e-4;
  for (let k = 0; k < positions.length; k += 3) {
    squared = Math.max(squared, positions[k]! ** 2 + positions[k + 1]! ** 2 + positions[k + 2]! ** 2);
  }
  return { scene, radius: Math.sqrt(squared) };
}
