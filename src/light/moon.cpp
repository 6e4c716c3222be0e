// SPDX-License-Identifier: Apache-2.0
#include "light/moon.hpp"

#include <libnova/lunar.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "light/horizontal.hpp"

namespace cloudgen::light {
namespace {

constexpr double kEarthKilometers = 6378.14;
constexpr double kStarlightLux = 0.001;
/// What a half moon gives at the zenith to clouds, display-linear: as much more than to the sky as the sun does.
const glm::vec3 kHalfMoon(0.0060f, 0.0062f, 0.0068f);

/// Of what a half moon gives, as sensation goes.
double sensation(double lux) { return std::cbrt(lux / moonIlluminanceLux(90)); }

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace

Moon moonAt(base::UtcTime time, double longitudeDegrees, double latitudeDegrees) {
  ln_equ_posn moon{};
  const double day = base::julianDay(time);
  ln_get_lunar_equ_coords(day, &moon);
  const Horizontal place = horizontalOf(moon.ra, moon.dec, day, longitudeDegrees, latitudeDegrees);
  // From the ground the moon stands lower than from the Earth's middle.
  const double parallax = std::asin(kEarthKilometers / ln_get_lunar_earth_dist(day));
  const double elevation =
      place.elevationDegrees - glm::degrees(parallax * std::cos(glm::radians(place.elevationDegrees)));
  const Sun placed = sunFrom(place.azimuthDegrees, elevation);
  return {placed.azimuthDegrees, elevation, ln_get_lunar_phase(day), placed.direction};
}

double litShare(const Moon& moon) { return 0.5 * (1 + std::cos(glm::radians(moon.phaseAngleDegrees))); }

double moonIlluminanceLux(double phaseAngleDegrees) {
  const double angle = std::abs(phaseAngleDegrees);
  const double magnitude = -12.73 + 0.026 * angle + 4e-9 * angle * angle * angle * angle;
  return 2.54e-6 * std::pow(10.0, -0.4 * magnitude);
}

float moonlightUnder(const Moon& moon) {
  const double through = luminance(sunColorAt(moon.elevationDegrees, 0));
  const double down = std::max(0.0, std::sin(glm::radians(moon.elevationDegrees)));
  return static_cast<float>(sensation(moonIlluminanceLux(moon.phaseAngleDegrees) * through * down + kStarlightLux));
}

KeyLight keyLight(const Sun& sun, const Moon& moon, double heightMeters) {
  const KeyLight bySun{sun.direction, sunColorAt(sun.elevationDegrees, heightMeters)},
      byMoon{moon.direction, static_cast<float>(sensation(moonIlluminanceLux(moon.phaseAngleDegrees))) * kHalfMoon *
                                 sunColorAt(moon.elevationDegrees, heightMeters)};
  return luminance(byMoon.color) > luminance(bySun.color) ? byMoon : bySun;
}

}  // namespace cloudgen::light
