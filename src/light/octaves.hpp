// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::light {

/// Multiple scattering by octaves (Wrenninge et al. 2013: light of higher orders goes through a medium that
/// is thinned ever more). An octave that is thinned by s, in optical depths reduced by similarity,
/// tau' = (1 - g) tau, gets the weight 2 exp(-2 s) ds: with these weights, and only these, a slab reflects
/// tau' / (2 + tau') and lets 2 / (2 + tau') through, as the two-stream solution of a conservative slab
/// does (Bohren & Clothiaux 2006, chapter 5). The sum over all octaves then has a closed form.

/// Share of the sunlight that arrives, by all orders, behind a reduced optical depth: 1 at 0, falling.
constexpr float transmitted(float reducedDepth) { return 2.0f / (2.0f + reducedDepth); }

/// Share that is sent back towards the sun at a point with `before` between it and the sun and `behind`
/// beyond it: what the octaves let in, less what they let through.
constexpr float reflected(float before, float behind) {
  return transmitted(before) - transmitted(before + behind);
}

}  // namespace cloudgen::light
