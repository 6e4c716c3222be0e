// SPDX-License-Identifier: Apache-2.0

// Clear air: half of the contrast is gone after about 150 km at sea level, and air thins by 1/e in 8 km.
export const AIR_EXTINCTION_PER_METER = 1 / 220_000;
export const AIR_SCALE_HEIGHT_METERS = 8_000;

/** Share of a colour that comes through the air along a straight line between two heights (true ones). */
export function clarity(wayMeters: number, fromHeight: number, toHeight: number): number {
  const lower = Math.max(toHeight, 0) / AIR_SCALE_HEIGHT_METERS;
  const rise = Math.max(fromHeight, 0) / AIR_SCALE_HEIGHT_METERS - lower;
  // Mean density along a line through an exponential atmosphere; at one height it is the density there.
  const safe = Math.abs(rise) < 1e-3 ? 1e-3 : rise;
  const density = (Math.exp(-lower) * (1 - Math.exp(-safe))) / safe;
  return Math.exp(-wayMeters * AIR_EXTINCTION_PER_METER * density);
}

/** The same for shaders: `clarity(place)` of a world place, with uniforms u_eye and u_exaggeration. */
export const AIR_GLSL = `
uniform vec3 u_eye;
uniform float u_exaggeration;
float clarity(vec3 place) {
  float lower = max(place.y / u_exaggeration, 0.0) / ${AIR_SCALE_HEIGHT_METERS.toFixed(1)};
  float rise = max(u_eye.y / u_exaggeration, 0.0) / ${AIR_SCALE_HEIGHT_METERS.toFixed(1)} - lower;
  float safe = abs(rise) < 1e-3 ? 1e-3 : rise;
  float density = exp(-lower) * (1.0 - exp(-safe)) / safe;
  return exp(-distance(place, u_eye) * ${AIR_EXTINCTION_PER_METER} * density);
}
`;
