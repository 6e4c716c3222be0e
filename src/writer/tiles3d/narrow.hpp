// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "writer/tiles3d/detail.hpp"

namespace cloudgen::writer::tiles3d {

/// CesiumJS 1.145 keeps four times the covariances as half floats, which end at 65504 m2: it leaves out what is wider
/// than 127.9 m. A little less, which packing rounds to 127.1 m.
inline constexpr float kMostSigmaMeters = 125;

/// How many puffs of that width a puff is split into.
std::size_t narrowCount(const shape::Puff& puff);

/// Appends the puff, up to a quarter wider than kMostSigmaMeters made narrower; or, if it is wider still, several in a
/// lattice (binomial weights along each wide axis) that have its extinction and spread together. Those too faint to be
/// seen are left out; the others take what they hold.
void appendNarrow(const LitPuff& lit, std::vector<LitPuff>& out);

}  // namespace cloudgen::writer::tiles3d
