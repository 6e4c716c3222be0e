// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "writer/tiles3d/detail.hpp"

namespace cloudgen::writer::tiles3d {

/// A Gaussian is seen as wide as so many deviations.
inline constexpr double kVisibleSigmas = 4;
/// Where so many metres of error are shown, the widest deviation of a puff is at least this share of them. Viewers
/// refine at 16 pixels of error: the puff is 2 pixels wide then. CesiumJS leaves out what is less than 0.33.
inline constexpr double kLeastSigmaOfError = 1.0 / 8;

/// One upright puff of the mean place, spread and light of these (one or more), each by what it covers. It covers what
/// they cover together if they overlap at random: their covers add up as optical depths do.
LitPuff joined(std::span<const LitPuff> puffs);

/// The puffs as one sees them from where so many metres are hardly told apart: those of less than kLeastSigmaOfError are
/// joined with such as are near them (within a quarter of the error), and made so wide, as much thinner as covers the
/// same.
std::vector<LitPuff> mergedWithin(std::vector<LitPuff> puffs, double errorMeters);

}  // namespace cloudgen::writer::tiles3d
