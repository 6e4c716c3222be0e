// SPDX-License-Identifier: Apache-2.0
// The clear sky by single scattering on air and aerosol with an allowance for higher orders (Nishita et al. 1993, "Display of the
// Earth taking into account atmospheric scattering"), as src/image/atmosphere.cpp and src/runtime/gles/sky_table.cpp have it: what
// `cloudgen preview` shows.
import {displayValue} from '../color';
import {clamp, dot, mixed, smoothStep, type Vec3} from '../math';
import type {Daylight} from './daylight';

/** Rows by the square root of the sine of the elevation, columns by that of the azimuth from the sun's over pi; both from 0 to 1. */
export const SKY_COLUMNS = 33;
export const SKY_ROWS = 48;

const STEPS = 24;
const DUSK_DEGREES = -7;
const NIGHT_DEGREES = -16;
const AIR_HEIGHT = 8000;
const AEROSOL_HEIGHT = 1300;
const ATMOSPHERE = 60_000;
/** Vertical optical depths at 680, 550 and 440 nm. */
const AIR: Vec3 = [0.042, 0.098, 0.24];
const OZONE: Vec3 = [0.012, 0.026, 0.001];
const AEROSOL: Vec3 = [0.05, 0.06, 0.08];
const AEROSOL_FORWARD = 0.76;
/** Of light that was scattered before: whiter than the sun's. */
const AGAIN: Vec3 = [1, 1.1, 1.25];
/** The eye is taken to be so high: the sky above is darker the higher one is. */
const EYE_METERS = 2000;
/** Of the sky while the sun is just below the horizon: what ozone leaves of the light from high up. */
const TWILIGHT: Vec3 = [0.13, 0.21, 0.44];
const LUMINANCE: Vec3 = [0.2126, 0.7152, 0.0722];

/** Relative air mass, Kasten & Young 1989. */
function airMass(elevationDegrees: number): number {
  const elevation = Math.max(elevationDegrees, -1);
  return 1 / (Math.sin((Math.PI / 180) * Math.max(elevation, 0)) + 0.50572 * Math.pow(elevation + 6.07995, -1.6364));
}

/**
 * What of the light scattered once is left when the sun is so many degrees below the horizon: the Earth's shadow rises opposite to the
 * sun and overhead first.
 */
function outOfShadow(belowDegrees: number, sine: number, azimuthCosine: number): number {
  return Math.exp(-0.12 * belowDegrees * (0.7 * (1 - azimuthCosine) + 2.4 * sine));
}

/** Sums over a ray: what is scattered by air and by aerosol per unit of their phase functions, and what was scattered before. */
function sumsAlong(sine: number, sunSine: number, mass: number): {air: Vec3; aerosol: Vec3; again: Vec3} {
  const slant = 1 / Math.max(sine, 0.03);
  // Near the horizon rays dip into the air below the eye, as the Earth curves away.
  const lowest = EYE_METERS * smoothStep(-0.05, 0.3, sine);
  const evenly = (0.55 * Math.max(0.12, sunSine + 0.1) * 2) / (4 * Math.PI);
  const sums = {air: [0, 0, 0] as Vec3, aerosol: [0, 0, 0] as Vec3, again: [0, 0, 0] as Vec3};
  const through: Vec3 = [0, 0, 0];
  for (let i = 0; i < STEPS; ++i) {
    const lower = ATMOSPHERE * (i / STEPS) ** 2;
    const upper = ATMOSPHERE * ((i + 1) / STEPS) ** 2;
    const height = lowest + 0.5 * (lower + upper);
    const air = Math.exp(-height / AIR_HEIGHT);
    const aerosol = Math.exp(-height / AEROSOL_HEIGHT);
    for (let k = 0; k < 3; ++k) {
      const airHere = ((AIR[k] * air * (upper - lower)) / AIR_HEIGHT) * slant;
      const aerosolHere = ((AEROSOL[k] * aerosol * (upper - lower)) / AEROSOL_HEIGHT) * slant;
      const path = mass * (AIR[k] * air + AEROSOL[k] * aerosol) + Math.min(mass, 12) * OZONE[k];
      const seen = Math.exp(-(through[k] + 0.5 * (airHere + aerosolHere)));
      const sunlight = Math.exp(-path);
      sums.air[k] += seen * airHere * sunlight;
      sums.aerosol[k] += seen * aerosolHere * sunlight;
      sums.again[k] += seen * (airHere + aerosolHere) * evenly * Math.exp(-0.3 * path) * AGAIN[k];
      through[k] += airHere + aerosolHere;
    }
  }
  return sums;
}

export class SkyTable {
  /** Display values, 0..255: red, green, blue, 255 row by row from the horizon. */
  readonly colors = new Uint8Array(4 * SKY_COLUMNS * SKY_ROWS);
  /** Horizontal unit vector towards the sun: x, z. */
  readonly sunwards: [number, number] = [0, 1];

  constructor(daylight: Daylight, sun: Vec3) {
    const flat = Math.hypot(sun[0], sun[2]);
    if (flat > 1e-6) this.sunwards = [sun[0] / flat, sun[2] / flat];
    const elevation = (Math.asin(clamp(sun[1], -1, 1)) * 180) / Math.PI;
    // As clouds are exposed: sun on a white face plus the light of the sky.
    const face = dot(LUMINANCE, daylight.suns[0]) * 0.9 + dot(LUMINANCE, daylight.ambient) * 0.4;
    const gain = 2.1 * Math.pow(1 / Math.max(0.02, face), 0.65);
    const dusk = smoothStep(NIGHT_DEGREES, DUSK_DEGREES, elevation);
    const day = clamp((elevation - DUSK_DEGREES) / 9, 0.02, 1) * dusk;
    const mass = airMass(elevation);
    const below = clamp(-elevation, 0, 18);
    // The least light of the night: dusk does not get darker than that.
    const night = smoothStep(-5, -9, elevation);
    const twilight = smoothStep(1, -4, elevation) * Math.exp(-0.33 * below);
    for (let row = 0; row < SKY_ROWS; ++row) {
      const sine = Math.max(0.004, (row / (SKY_ROWS - 1)) ** 2);
      const sums = sumsAlong(sine, sun[1], mass);
      const ofNight = mixed(daylight.zenith, daylight.horizon, Math.exp(-3.5 * sine));
      for (let column = 0; column < SKY_COLUMNS; ++column) {
        const azimuth = Math.PI * (column / (SKY_COLUMNS - 1)) ** 2;
        const cosine = Math.sqrt(1 - sine * sine) * flat * Math.cos(azimuth) + sine * sun[1];
        const air = (3 / (16 * Math.PI)) * (1 + cosine * cosine);
        const g = AEROSOL_FORWARD;
        const aerosol = (1 - g * g) / (4 * Math.PI * Math.pow(1 + g * g - 2 * g * cosine, 1.5));
        const shadow = outOfShadow(below, sine, Math.cos(azimuth));
        const at = 4 * (row * SKY_COLUMNS + column);
        for (let k = 0; k < 3; ++k) {
          const scattered = sums.air[k] * air + sums.aerosol[k] * aerosol + sums.again[k];
          const white = Math.exp(-(AIR[k] + AEROSOL[k]));
          const light = (gain * day * Math.PI * scattered * shadow) / white + twilight * (0.6 + 0.4 * sine) * TWILIGHT[k] + night * ofNight[k];
          this.colors[at + k] = Math.round(255 * displayValue(light));
        }
        this.colors[at + 3] = 255;
      }
    }
  }

  /** The horizon in the direction whose cosine to `sunwards` is given, into `out`: 0..255. */
  horizonTowards(cosine: number, out: Float64Array): void {
    const place = Math.sqrt(Math.acos(clamp(cosine, -1, 1)) / Math.PI) * (SKY_COLUMNS - 1);
    const column = Math.min(SKY_COLUMNS - 2, Math.floor(place));
    const share = place - column;
    for (let k = 0; k < 3; ++k) {
      const here = this.colors[4 * column + k];
      out[k] = here + share * (this.colors[4 * column + 4 + k] - here);
    }
  }
}

/** For shaders: the sky in a direction, and what far things fade into; uniforms u_sky and u_sunwards. */
export const SKY_GLSL = `
uniform sampler2D u_sky;
uniform vec2 u_sunwards;
vec3 skyAt(vec3 way) {
  float cosine = clamp(dot(way.xz, u_sunwards) / max(length(way.xz), 1e-5), -1.0, 1.0);
  vec2 at = sqrt(vec2(acos(cosine) / ${Math.PI.toFixed(7)}, clamp(way.y, 0.0, 1.0)));
  vec2 size = vec2(${SKY_COLUMNS}.0, ${SKY_ROWS}.0);
  return textureLod(u_sky, (at * (size - 1.0) + 0.5) / size, 0.0).rgb;
}
vec3 hazeTowards(vec3 way) { return skyAt(normalize(vec3(way.x, 0.0, way.z) + vec3(1e-5, 0.0, 0.0))); }
`;
