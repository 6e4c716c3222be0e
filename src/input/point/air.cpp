// SPDX-License-Identifier: Apache-2.0
#include "input/point/air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cloudgen::input {
namespace {

constexpr double kLapsePerMeter = 0.0065, kRadians = std::numbers::pi / 180.0;

/// Per metre, in the order of base::Genus.
constexpr std::array<double, base::kGenusCount> kExtinction{0.0004, 0.0008, 0.0006,  // Ci, Cc, Cs
                                                            0.012,  0.004,  0.012,   // Ac, As, Ns
                                                            0.03,   0.025,           // Sc, St
                                                            0.02,   0.01,   0.02};   // Cu, Cb, fog

double warmth(double latitudeDegrees) { return std::pow(std::cos(latitudeDegrees * kRadians), 2.0); }

/// Factor on the wind at 10 m.
double windFactor(const Air& air, double heightMeters) {
  return std::pow(std::max(1.0, (heightMeters - air.surfaceMeters) / 10.0), 1.0 / 7.0);
}

}  // namespace

double dewPointC(double temperatureC, double relativeHumidity) {
  const double x =
      std::log(std::clamp(relativeHumidity, 0.01, 1.0)) + 17.625 * temperatureC / (243.04 + temperatureC);
  return 243.04 * x / (17.625 - x);
}

double condensationMeters(double temperatureC, double dewPointC) {
  return std::clamp(125.0 * (temperatureC - dewPointC), 60.0, 4000.0);
}

double heightOfMeters(const Air& air, double temperatureC) {
  return air.surfaceMeters + (air.temperatureC - temperatureC) / kLapsePerMeter;
}

double highEtageMeters(double latitudeDegrees) { return 3500.0 + 3000.0 * warmth(latitudeDegrees); }

double tropopauseMeters(double latitudeDegrees) { return 9000.0 + 7500.0 * warmth(latitudeDegrees); }

double stormTopMeters(const Air& air, double baseMeters) {
  return std::max(baseMeters + 4000.0,
                  std::min(heightOfMeters(air, -50.0), tropopauseMeters(air.latitudeDegrees)));
}

field::StatedLayer layerOf(const Air& air, base::Genus genus, double cover, double baseMeters,
                           double topMeters) {
  const double middle = 0.5 * (baseMeters + topMeters);
  const double middleC = air.temperatureC - kLapsePerMeter * (middle - air.surfaceMeters);
  const double speed = air.windSpeed * windFactor(air, middle),
               shear = air.windSpeed * (windFactor(air, topMeters) - windFactor(air, baseMeters));
  const double towardsEast = -std::sin(air.windFromDegrees * kRadians),
               towardsNorth = -std::cos(air.windFromDegrees * kRadians);
  field::StatedLayer layer;
  layer.genus = genus;
  layer.coverFraction = static_cast<float>(std::clamp(cover, 0.0, 1.0));
  layer.baseMeters = static_cast<float>(baseMeters);
  layer.topMeters = static_cast<float>(topMeters);
  layer.opticalDepth =
      static_cast<float>(kExtinction[static_cast<std::size_t>(genus)] * (topMeters - baseMeters));
  layer.iceShare = static_cast<float>(std::clamp(-middleC / 23.0, 0.0, 1.0));
  layer.windEast = static_cast<float>(speed * towardsEast);
  layer.windNorth = static_cast<float>(speed * towardsNorth);
  layer.shearEast = static_cast<float>(shear * towardsEast);
  layer.shearNorth = static_cast<float>(shear * towardsNorth);
  return layer;
}

double sunElevationDegrees(base::UtcTime time, const field::GeoPoint& place) {
  const double days = static_cast<double>(time.seconds) / 86400.0;
  const double dayOfYear = std::fmod(days, 365.2425) + 1;  // 1970-01-01 is the first of a year
  const double declination = 23.45 * kRadians * std::sin(360.0 / 365.0 * (284.0 + dayOfYear) * kRadians);
  const double hourAngle = ((days - std::floor(days)) * 360.0 - 180.0 + place.longitudeDegrees) * kRadians;
  const double latitude = place.latitudeDegrees * kRadians;
  return std::asin(std::sin(latitude) * std::sin(declination) +
                   std::cos(latitude) * std::cos(declination) * std::cos(hourAngle)) /
         kRadians;
}

}  // namespace cloudgen::input
