// SPDX-License-Identifier: Apache-2.0
#include "image/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "base/noise.hpp"

namespace cloudgen::image {
namespace {

constexpr int kElevations = 64, kAzimuths = 49, kSteps = 40;
constexpr double kDuskDegrees = -7, kNightDegrees = -16;
constexpr double kPi = std::numbers::pi;
constexpr double kAirHeight = 8000, kAerosolHeight = 1300, kAtmosphere = 60000;
// Vertical optical depths at 680, 550 and 440 nm: air after Bodhaine et al. 1999, ozone of 300 DU, a clear
// day's aerosol. The first and the last are those that redden light::Sun.
const glm::dvec3 kAir(0.042, 0.098, 0.240), kOzone(0.012, 0.026, 0.001), kAerosol(0.050, 0.060, 0.080);

/// Relative air mass, Kasten & Young 1989.
double airMass(double elevationDegrees) {
  const double elevation = std::max(elevationDegrees, -1.0);
  return 1.0 / (std::sin(glm::radians(std::max(elevation, 0.0))) +
                0.50572 * std::pow(elevation + 6.07995, -1.6364));
}

/// Of the sky while the sun is just below the horizon: what ozone leaves of the light from high up.
const glm::vec3 kTwilight(0.13f, 0.21f, 0.44f);

double degreesBelow(double sunElevationDegrees) { return std::clamp(-sunElevationDegrees, 0.0, 18.0); }

/// What of the light scattered once is left when the sun is down: the Earth's shadow rises opposite to the sun and
/// overhead first.
double outOfShadow(double degreesBelow, double sine, double azimuthCosine) {
  return std::exp(-0.12 * degreesBelow * (0.7 * (1 - azimuthCosine) + 2.4 * sine));
}

double henyeyGreenstein(double cosine, double g) {
  return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace

Atmosphere::Atmosphere(const light::Sun& sun, const light::Sky& sky, double eyeHeightMeters)
    : eyeHeight_(std::clamp(eyeHeightMeters, 0.0, 30000.0)), sunElevationDegrees_(sun.elevationDegrees) {
  const double flat = std::hypot(sun.direction.x, sun.direction.z);
  if (flat > 1e-6) sunAzimuth_ = glm::dvec2(sun.direction.x, sun.direction.z) / flat;
  // As light::shadePuffs exposes: sun on a white face plus the sky's light.
  const glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
  const float exposure = 1.0f / std::max(0.02f, glm::dot(0.9f * sun.color + 0.4f * sky.ambient, luminance));
  sunlight_ = exposure * sun.color;
  // Photographs and eyes hold the sky brighter against white clouds than it is.
  // A camera set for a low sun's clouds would burn the sky about it out: less for both.
  gain_ = 2.1f * std::pow(exposure, 0.65f);
  const double below = degreesBelow(sun.elevationDegrees);
  const auto twilight = static_cast<float>((1 - base::smoothStep(-4, 1, sun.elevationDegrees)) * std::exp(-0.33 * below)),
             night = static_cast<float>(1 - base::smoothStep(-9, -5, sun.elevationDegrees));
  table_.resize(static_cast<size_t>(kElevations) * kAzimuths);
  for (int row = 0; row < kElevations; ++row)
    for (int column = 0; column < kAzimuths; ++column) {
      const double up = static_cast<double>(row) / (kElevations - 1),
                   aside = static_cast<double>(column) / (kAzimuths - 1);
      // The least light of the night, light::Sky's: dusk does not get darker than that.
      const double sine = std::max(0.004, up * up);
      const glm::vec3 ofNight = glm::mix(sky.zenith, sky.horizon, static_cast<float>(std::exp(-3.5 * sine)));
      const auto ofTwilight = static_cast<float>(0.6 + 0.4 * sine) * kTwilight;
      table_[static_cast<size_t>(row) * kAzimuths + static_cast<size_t>(column)] =
          computed(sine, kPi * aside * aside) + twilight * ofTwilight + night * ofNight;
    }
}

glm::vec3 Atmosphere::computed(double sine, double azimuthFromSun) const {
  const double sunSine = std::sin(glm::radians(sunElevationDegrees_)),
               sunFlat = std::cos(glm::radians(sunElevationDegrees_));
  const double cosine = std::sqrt(1 - sine * sine) * sunFlat * std::cos(azimuthFromSun) + sine * sunSine;
  const double air = 3.0 / (16.0 * kPi) * (1 + cosine * cosine), aerosol = henyeyGreenstein(cosine, 0.76);
  const glm::dvec3 white = glm::exp(-(kAir + kAerosol));
  const double mass = airMass(sunElevationDegrees_);
  // Slant paths are bent by the Earth: no longer than to the horizon.
  const double slant = 1.0 / std::max(sine, 0.03);
  glm::dvec3 sum(0), through(0);
  // Near the horizon rays dip into the air below the eye, as the Earth curves away.
  const double lowest = eyeHeight_ * base::smoothStep(-0.05, 0.30, sine);
  for (int i = 0; i < kSteps; ++i) {
    const double from = static_cast<double>(i) / kSteps, to = static_cast<double>(i + 1) / kSteps;
    const double lower = kAtmosphere * from * from, upper = kAtmosphere * to * to;
    const double height = lowest + 0.5 * (lower + upper);
    const double rise = upper - lower;
    const glm::dvec3 airHere = kAir * (std::exp(-height / kAirHeight) * rise / kAirHeight * slant);
    const glm::dvec3 aerosolHere =
        kAerosol * (std::exp(-height / kAerosolHeight) * rise / kAerosolHeight * slant);
    const glm::dvec3 sunPath =
        mass * (kAir * std::exp(-height / kAirHeight) + kAerosol * std::exp(-height / kAerosolHeight)) +
        std::min(mass, 12.0) * kOzone;
    const glm::dvec3 sunlight = glm::exp(-sunPath);
    // Light scattered before: the same from all sides, whiter and less reddened than the sun's.
    const glm::dvec3 again = (0.55 * std::max(0.12, sunSine + 0.10)) * glm::exp(-0.3 * sunPath) / (4 * kPi) *
                             glm::dvec3(1.0, 1.1, 1.25) * 2.0;
    const glm::dvec3 seen = glm::exp(-(through + 0.5 * (airHere + aerosolHere)));
    sum += seen * (airHere * (air * sunlight + again) + aerosolHere * (aerosol * sunlight + again));
    through += airHere + aerosolHere;
  }
  // In units of a white face under a sun at the zenith, whose own path is taken for neutral as light::Sun
  // does.
  const double day = std::clamp((sunElevationDegrees_ - kDuskDegrees) / 9.0, 0.02, 1.0) *
                     base::smoothStep(kNightDegrees, kDuskDegrees, sunElevationDegrees_);
  const double shadow = outOfShadow(degreesBelow(sunElevationDegrees_), sine, std::cos(azimuthFromSun));
  return gain_ * glm::vec3(day * kPi * shadow * sum / white);
}

glm::vec3 Atmosphere::sky(const glm::dvec3& direction) const {
  const double flat = std::hypot(direction.x, direction.z);
  const double cosine =
      flat > 1e-9 ? std::clamp((direction.x * sunAzimuth_.x + direction.z * sunAzimuth_.y) / flat, -1.0, 1.0)
                  : 0.0;
  const double v = std::clamp(std::sqrt(std::max(0.0, direction.y)), 0.0, 1.0) * (kElevations - 1),
               u = std::sqrt(std::acos(cosine) / kPi) * (kAzimuths - 1);
  const int j = std::min(static_cast<int>(v), kElevations - 2),
            i = std::min(static_cast<int>(u), kAzimuths - 2);
  const float s = static_cast<float>(u - i), t = static_cast<float>(v - j);
  const glm::vec3* row = table_.data() + static_cast<size_t>(j) * kAzimuths + static_cast<size_t>(i);
  return glm::mix(glm::mix(row[0], row[1], s), glm::mix(row[kAzimuths], row[kAzimuths + 1], s), t);
}

}  // namespace cloudgen::image
