// SPDX-License-Identifier: Apache-2.0
#include "pipeline/unevenness.hpp"

#include <cmath>
#include <numbers>

#include "base/noise.hpp"

namespace cloudgen::pipeline {

double unevenness(const field::GeoPoint& place, double widthMeters, base::Genus genus, std::uint64_t seed) {
  const double lon = place.longitudeDegrees * std::numbers::pi / 180.0,
               lat = place.latitudeDegrees * std::numbers::pi / 180.0;
  const double scale = field::kEarthRadiusMeters / (6.0 * widthMeters);
  const glm::dvec3 point(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  return base::fractalNoise(point * scale, 4, seed * 1000003u + static_cast<std::uint64_t>(genus));
}

}  // namespace cloudgen::pipeline
