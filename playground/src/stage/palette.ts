// The colours of the stage, light and dark.

export type Theme = "light" | "dark";

interface StageColors {
  background: number;
  ground: number;
  grid: number;
  sky: number;
  bounce: number;
  sun: number;
  /** Strength of the sun and of the light from all around. */
  sunlight: number;
  skylight: number;
}

export const STAGE: Record<Theme, StageColors> = {
  light: {
    background: 0xe4e8ed,
    ground: 0xd3d7dc,
    grid: 0xa9b1ba,
    sky: 0xb8bdc4,
    bounce: 0xa29c96,
    sun: 0xf8f2e6,
    sunlight: 2.9,
    skylight: Math.PI,
  },
  dark: {
    background: 0x15191f,
    ground: 0x262b33,
    grid: 0x4a535f,
    sky: 0x9aa7ba,
    bounce: 0x5c544c,
    sun: 0xfff0da,
    sunlight: 2.7,
    skylight: 2.4,
  },
};

/** Colours that are told apart, also by those who see fewer: of colour classes and of lines in charts. */
export const CLASSES = [0x4e9bd1, 0xe0a458, 0x5fb08a, 0xd4708a, 0x9a86d6, 0xc9c25a, 0x58b7bd, 0xcf8154] as const;

/** A colour of the scale from blue (0) over yellow to red (1), as rgb in 0 to 1, linear. */
export function heat(value: number): [number, number, number] {
  const t = Math.min(1, Math.max(0, value));
  const stops = HEAT;
  const place = t * (stops.length - 1);
  const index = Math.min(stops.length - 2, Math.floor(place));
  const [low, high] = [stops[index] ?? BLACK, stops[index + 1] ?? BLACK];
  const share = place - index;
  return [mix(low[0], high[0], share), mix(low[1], high[1], share), mix(low[2], high[2], share)];
}

/** A colour of a class, as rgb in 0 to 1, linear. */
export function classColor(index: number): [number, number, number] {
  return linear(CLASSES[index % CLASSES.length] ?? 0);
}

type Rgb = readonly [number, number, number];
const BLACK: Rgb = [0, 0, 0];
const HEAT: readonly Rgb[] = [0x2f5fa8, 0x4fa3b8, 0xe8d67a, 0xe08a44, 0xc23b3b].map(linear);

function mix(from: number, to: number, share: number): number {
  return from + (to - from) * share;
}

/** 0xrrggbb of sRGB as linear rgb. */
export function linear(color: number): [number, number, number] {
  const channel = (shift: number) => {
    const value = ((color >> shift) & 255) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  return [channel(16), channel(8), channel(0)];
}
