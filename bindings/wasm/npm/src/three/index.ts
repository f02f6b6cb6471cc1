// A world in three.js: `three` is a peer dependency, of this part alone.
export { DebugLines } from "./lines.js";
export { DragControls, type DragOptions } from "./drag.js";
export { WorldView, type WorldViewOptions } from "./view.js";
