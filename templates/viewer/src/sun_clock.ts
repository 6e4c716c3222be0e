// SPDX-License-Identifier: Apache-2.0
import type {SunPlace} from './pack/daylight';

const DAY = 86_400_000;
const DEGREE = Math.PI / 180;

/** Where the sun stands (Astronomical Almanac, low precision: within 0.02 degrees from 1950 to 2050), milliseconds of UTC. */
export function sunAt(milliseconds: number, longitude: number, latitude: number): SunPlace {
  const days = milliseconds / DAY + 2440587.5 - 2451545;
  const mean = (280.46 + 0.9856474 * days) * DEGREE;
  const anomaly = (357.528 + 0.9856003 * days) * DEGREE;
  const ecliptic = mean + (1.915 * Math.sin(anomaly) + 0.02 * Math.sin(2 * anomaly)) * DEGREE;
  const tilt = (23.439 - 4e-7 * days) * DEGREE;
  const ascension = Math.atan2(Math.cos(tilt) * Math.sin(ecliptic), Math.cos(ecliptic));
  const declination = Math.asin(Math.sin(tilt) * Math.sin(ecliptic));
  const sidereal = (280.46061837 + 360.98564736629 * days + longitude) * DEGREE;
  const hour = sidereal - ascension;
  const phi = latitude * DEGREE;
  const east = -Math.cos(declination) * Math.sin(hour);
  const north = Math.sin(declination) * Math.cos(phi) - Math.cos(declination) * Math.cos(hour) * Math.sin(phi);
  const up = Math.sin(declination) * Math.sin(phi) + Math.cos(declination) * Math.cos(hour) * Math.cos(phi);
  return {azimuthDegrees: (((Math.atan2(east, north) / DEGREE) % 360) + 360) % 360, elevationDegrees: Math.asin(up) / DEGREE};
}

/** The minute of the UTC day of a time, and back. */
export function minuteOfDay(milliseconds: number): number {
  return Math.round((((milliseconds % DAY) + DAY) % DAY) / 60_000) % 1440;
}

export function atMinute(milliseconds: number, minute: number): number {
  return Math.floor(milliseconds / DAY) * DAY + minute * 60_000;
}
