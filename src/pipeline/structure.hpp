// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "field/grid.hpp"

namespace cloudgen::pipeline {

/// Where the clouds of a layer gather: Gaussian noise on the sphere, about N(0, 1), whose power falls with
/// the wave number to the -5/3 from the outer to the inner scale (Hogan & Kew 2005; Szczap 2014). It knows no
/// cells.
class Structure {
 public:
  Structure(double outerMeters, double innerMeters, std::uint64_t seed);
  double at(const field::GeoPoint& place) const;
  /// Drawn out along a wind (m/s, east and north): streets `elongation` inner scales long; as at() for 0.
  double along(const field::GeoPoint& place, const glm::dvec2& wind, double elongation) const;

 private:
  double outerMeters_, innerMeters_;
  int octaves_;
  std::uint64_t seed_;
};

/// The share of a normal distribution below a deviate: turns structure into a rank that is even in 0..1.
double rankOf(double deviate);

}  // namespace cloudgen::pipeline
