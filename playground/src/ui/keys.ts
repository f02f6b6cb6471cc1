// What the keyboard does, wherever the focus is but in a field.

import type { Playground } from "../app/playground";

/** How far an arrow key turns the camera, radians. */
const TURN = 0.12;
/** How slow slow motion is. */
const SLOW = 1 / 8;

export function listenToKeys(playground: Playground, canvas: HTMLElement): void {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isField(event)) return;
    const action = actionOf(playground, event.key) ?? (event.target === canvas ? turn(playground, event.key) : undefined);
    // Space presses the button that has the focus.
    if (!action || (event.key === " " && event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    action();
  });
}

function isField(event: KeyboardEvent): boolean {
  const [target] = event.composedPath();
  return target instanceof HTMLElement && (target.isContentEditable || /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName));
}

function actionOf(playground: Playground, key: string): (() => unknown) | undefined {
  const actions: Record<string, () => unknown> = {
    " ": () => playground.setPlaying(!playground.playing),
    ".": () => playground.step(),
    r: () => playground.reset(),
    s: () => playground.setSpeed(playground.speed === 1 ? SLOW : 1),
    f: () => playground.lookAtAll(),
  };
  return actions[key.toLowerCase()];
}

function turn(playground: Playground, key: string): (() => void) | undefined {
  const { stage } = playground;
  const actions: Record<string, () => void> = {
    ArrowLeft: () => stage.turn(-TURN, 0),
    ArrowRight: () => stage.turn(TURN, 0),
    ArrowUp: () => stage.turn(0, -TURN),
    ArrowDown: () => stage.turn(0, TURN),
    "+": () => stage.turn(0, 0, 0.9),
    "-": () => stage.turn(0, 0, 1 / 0.9),
  };
  return actions[key];
}
