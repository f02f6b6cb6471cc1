// The curve from light to colours: that of the engine's own pictures.

import * as THREE from "three";

/** Keeps colours as they are up to 0.76 and compresses what is brighter without turning its hue: the Khronos PBR neutral
 * tone mapper, without its toe, which would make dark floors black. */
const NEUTRAL = /* glsl */ `
vec3 CustomToneMapping( vec3 color ) {
  color *= toneMappingExposure;
  const float START = 0.76;
  float peak = max( color.r, max( color.g, color.b ) );
  if ( peak <= START ) return color;
  const float ROOM = 1.0 - START;
  float newPeak = 1.0 - ROOM * ROOM / ( peak + ROOM - START );
  float grey = 1.0 - 1.0 / ( 0.15 * ( peak - newPeak ) + 1.0 );
  return mix( color * newPeak / peak, vec3( newPeak ), grey );
}`;
const PLACE = "vec3 CustomToneMapping( vec3 color ) { return color; }";

/** Makes the curve the one that renderers call custom; before the first picture. */
export function installToneMapping(): THREE.ToneMapping {
  THREE.ShaderChunk.tonemapping_pars_fragment = THREE.ShaderChunk.tonemapping_pars_fragment.replace(PLACE, NEUTRAL);
  return THREE.CustomToneMapping;
}
