import { memory } from "./init.js";

/**
 * A view into the engine's memory. It is made anew when what it shows has moved, or the memory has grown, which leaves
 * older views with a length of 0.
 */
export class MemoryView<T extends Float32Array | Uint8Array> {
  private view: T | undefined;

  constructor(private readonly make: (buffer: ArrayBufferLike, start: number, length: number) => T) {}

  /** The view of what is at an address; `place` is that and how many numbers there are. */
  at(place: Uint32Array): T {
    const [start = 0, length = 0] = place;
    const { buffer } = memory();
    const known = this.view;
    if (known?.buffer === buffer && known.byteOffset === start && known.length === length) return known;
    // Nothing lies at an address that may be no multiple of 4.
    this.view = this.make(buffer, length === 0 ? 0 : start, length);
    return this.view;
  }
}

export const floats = (): MemoryView<Float32Array> =>
  new MemoryView((buffer, start, length) => new Float32Array(buffer, start, length));
export const bytes = (): MemoryView<Uint8Array> =>
  new MemoryView((buffer, start, length) => new Uint8Array(buffer, start, length));
