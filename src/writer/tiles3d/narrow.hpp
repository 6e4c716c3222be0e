// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "writer/tiles3d/detail.hpp"

namespace cloudgen::writer::tiles3d {

/// CesiumJS 1.145 keeps covariances as half floats, which end at 65504 m2: it leaves out what is wider than 255 m.
/// A little less, as packed deviations are rounded by up to 3 %.
inline constexpr float kMostSigmaMeters = 245;

/// How many puffs of that width a puff is split into.
std::size_t narrowCount(const shape::Puff& puff);

/// Appends the puff, or, if it is wider than kMostSigmaMeters, several in a lattice (binomial weights along each
/// wide axis) that have its extinction and spread together. Those too faint to be seen are left out; the others
/// take what they hold.
void appendNarrow(const LitPuff& lit, std::vector<LitPuff>& out);

}  // namespace cloudgen::writer::tiles3d
