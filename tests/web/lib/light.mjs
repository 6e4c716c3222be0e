// SPDX-License-Identifier: Apache-2.0

/** Linear light of an sRGB value, both 0..1 (IEC 61966-2-1). */
export const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);

/** Relative luminance of linear red, green and blue. */
export const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
