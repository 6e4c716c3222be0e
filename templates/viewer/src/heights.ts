// SPDX-License-Identifier: Apache-2.0

const METERS_PER_FOOT = 0.3048;

const whole = (value: number, step: number): string => (Math.round(value / step) * step).toLocaleString('en');

export function flightLevel(meters: number): string {
  return `FL${String(Math.max(0, Math.round(meters / METERS_PER_FOOT / 100))).padStart(3, '0')}`;
}

/** "1,250 m / 4,100 ft / FL041". */
export function heightText(meters: number): string {
  return `${whole(meters, meters < 1000 ? 10 : 50)} m / ${whole(meters / METERS_PER_FOOT, 100)} ft / ${flightLevel(meters)}`;
}

export function lengthText(meters: number): string {
  return meters >= 1000 ? `${(meters / 1000).toLocaleString('en', {maximumFractionDigits: meters < 10_000 ? 1 : 0})} km` : `${Math.round(meters)} m`;
}
