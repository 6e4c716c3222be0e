// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/genus.hpp"
#include "field/grid.hpp"

namespace cloudgen::pipeline {

/// Standard deviation of unevenness().
inline constexpr double kUnevennessDeviation = 0.23;

/// Unevenness of cover that knows no cells: noise on the sphere, about six widths across, with mean 0.
double unevenness(const field::GeoPoint& place, double widthMeters, base::Genus genus, std::uint64_t seed);

}  // namespace cloudgen::pipeline
