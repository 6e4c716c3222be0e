// SPDX-License-Identifier: Apache-2.0
#include "pipeline/structure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/noise.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
/// Half the power lies an octave up where amplitudes fall by this: power over wave number to the -5/3.
const double kPersistence = std::pow(2.0, -1.0 / 3.0);
constexpr double kNoiseDeviation = 0.265;  ///< of base::gradientNoise

}  // namespace

Structure::Structure(double outerMeters, double innerMeters, std::uint64_t seed)
    : outerMeters_(outerMeters),
      innerMeters_(innerMeters),
      octaves_(std::clamp(static_cast<int>(std::lround(std::log2(outerMeters / innerMeters))) + 1, 1, 10)),
      seed_(seed) {}

double Structure::at(const field::GeoPoint& place) const {
  const double lon = place.longitudeDegrees * kRadians, lat = place.latitudeDegrees * kRadians;
  glm::dvec3 point(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  point *= field::kEarthRadiusMeters / outerMeters_;
  double sum = 0, power = 0, amplitude = 1;
  for (int octave = 0; octave < octaves_; ++octave) {
    sum += amplitude * base::gradientNoise(point, seed_ * 1000003u + static_cast<std::uint64_t>(octave));
    power += amplitude * amplitude;
    amplitude *= kPersistence;
    point *= 2.0;
  }
  return sum / (kNoiseDeviation * std::sqrt(power));
}

double Structure::along(const field::GeoPoint& place, const glm::dvec2& wind, double elongation) const {
  const double speed = std::hypot(wind.x, wind.y);
  if (elongation <= 0 || speed < 0.5) return at(place);
  constexpr int kSamples = 5;
  const double step = elongation * innerMeters_ / kSamples;
  const double north = wind.y / speed * step / field::kEarthRadiusMeters / kRadians;
  const double east = wind.x / speed * step / field::kEarthRadiusMeters / kRadians /
                      std::max(0.05, std::cos(place.latitudeDegrees * kRadians));
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double away = i - 0.5 * (kSamples - 1);
    sum += at({place.longitudeDegrees + away * east, place.latitudeDegrees + away * north});
  }
  return 1.25 * sum / kSamples;  // what the mean takes from the deviation
}

double rankOf(double deviate) { return 0.5 * std::erfc(-deviate / std::numbers::sqrt2); }

}  // namespace cloudgen::pipeline
