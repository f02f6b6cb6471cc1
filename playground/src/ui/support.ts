// What a browser has to have.

/** A module of one function, which makes a vector of 128 bits and counts the bits in it. */
const SIMD = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** What is missing here, in words; `undefined`: nothing. */
export function missing(): string | undefined {
  if (typeof WebAssembly !== "object") {
    return "This browser has no WebAssembly, which the engine runs on. A current Firefox, Chrome, Edge or Safari has it.";
  }
  if (!WebAssembly.validate(SIMD)) {
    return "This browser's WebAssembly has no SIMD, which the engine runs on. Browsers since 2023 have it.";
  }
  const canvas = document.createElement("canvas");
  if (!canvas.getContext("webgl2")) {
    return "This browser shows no WebGL 2, which draws the scene. It may be switched off in the settings, or the graphics driver may be too old.";
  }
  return undefined;
}
