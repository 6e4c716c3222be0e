// SPDX-License-Identifier: Apache-2.0
#include "field/cloud_water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cloudgen::field {
namespace {

constexpr double kGasConstantDryAir = 287.0597;  // J/(kg K)
constexpr double kGasConstantVapour = 461.5250;  // J/(kg K)
constexpr double kRatioOfGasConstants = kGasConstantDryAir / kGasConstantVapour;
constexpr double kFreezingK = 273.16, kAllIceK = 250.16;   // triple point, and 23 K below it
constexpr double kWaterDensity = 1000, kIceDensity = 917;  // kg/m3

double celsiusOf(double temperatureK) { return std::clamp(temperatureK, 150.0, 350.0) - 273.15; }

/// Buck 1981: e = 611.21 exp(17.502 t / (240.97 + t)) Pa over water.
double vapourPressureOverWater(double temperatureK) {
  const double t = celsiusOf(temperatureK);
  return 611.21 * std::exp(17.502 * t / (240.97 + t));
}

/// Buck 1981: e = 611.15 exp(22.452 t / (272.55 + t)) Pa over ice.
double vapourPressureOverIce(double temperatureK) {
  const double t = celsiusOf(temperatureK);
  return 611.15 * std::exp(22.452 * t / (272.55 + t));
}

struct EarthAt {
  double radiusMeters, gravityRatio;  ///< to 9.80665 m/s2
};

/// WGS84: equatorial radius and gravity, flattening, Somigliana's constants (NIMA TR8350.2, 1997).
EarthAt earthAt(double latitudeDegrees) {
  constexpr double kRadius = 6378137.0, kFlattening = 1.0 / 298.257223563, kRotation = 0.00344978650684;
  const double sine = std::sin(latitudeDegrees * std::numbers::pi / 180.0), squared = sine * sine;
  const double gravity =
      9.7803253359 * (1.0 + 0.00193185265241 * squared) / std::sqrt(1.0 - 0.00669437999013 * squared);
  return {kRadius / (1.0 + kFlattening + kRotation - 2.0 * kFlattening * squared), gravity / 9.80665};
}

}  // namespace

double airDensity(double pressurePa, double temperatureK, double specificHumidity) {
  const double q = std::clamp(specificHumidity, 0.0, 0.1);
  const double virtualTemperature =
      std::clamp(temperatureK, 150.0, 350.0) * (1.0 + (1.0 / kRatioOfGasConstants - 1.0) * q);
  return std::max(pressurePa, 0.0) / (kGasConstantDryAir * virtualTemperature);
}

double saturationVapourPressure(double temperatureK) {
  const double liquid = liquidShare(temperatureK);
  return liquid * vapourPressureOverWater(temperatureK) +
         (1.0 - liquid) * vapourPressureOverIce(temperatureK);
}

double saturationSpecificHumidity(double pressurePa, double temperatureK) {
  const double p = std::max(pressurePa, 1.0);
  // Where the vapour pressure would exceed half of the air pressure (mesosphere, nonsense), it is held there.
  const double e = std::min(saturationVapourPressure(temperatureK), 0.5 * p);
  return kRatioOfGasConstants * e / (p - (1.0 - kRatioOfGasConstants) * e);
}

double dewPoint(double temperatureK, double relativeHumidity) {
  const double e = std::clamp(relativeHumidity, 0.001, 1.0) * vapourPressureOverWater(temperatureK);
  const double logarithm = std::log(e / 611.21);
  return 273.15 + 240.97 * logarithm / (17.502 - logarithm);
}

double liquidShare(double temperatureK) {
  const double share = std::clamp((temperatureK - kAllIceK) / (kFreezingK - kAllIceK), 0.0, 1.0);
  return share * share;
}

double cloudFractionXuRandall(double relativeHumidity, double condensate, double saturationHumidity) {
  if (!(condensate > 0)) return 0;
  const double humidity = std::clamp(relativeHumidity, 0.0, 1.0);
  if (humidity >= 1.0) return 1;
  const double shortage = std::pow((1.0 - humidity) * std::max(saturationHumidity, 1e-12), 0.49);
  const double exponent = std::max(-100.0 * condensate / shortage, -6.9);
  const double fraction = std::pow(humidity, 0.25) * (1.0 - std::exp(exponent));
  return fraction < 0.01 ? 0.0 : std::min(fraction, 1.0);
}

double criticalRelativeHumidity(double pressurePa, double surfacePressurePa) {
  constexpr double kAtGround = 0.9, kAloft = 0.7;
  const double ratio = std::max(surfacePressurePa / std::max(pressurePa, 1.0), 1.0);
  return kAloft + (kAtGround - kAloft) * std::exp(1.0 - std::pow(ratio, 4));
}

double cloudFractionSundqvist(double relativeHumidity, double criticalHumidity) {
  if (!(relativeHumidity > criticalHumidity)) return 0;
  if (relativeHumidity >= 1.0) return 1;
  return 1.0 - std::sqrt((1.0 - relativeHumidity) / (1.0 - criticalHumidity));
}

double diagnosedCloudWater(double heightAboveGroundMeters, double precipitableWater) {
  constexpr double kAtGround = 0.21e-3;  // kg/m3
  const double scale = std::max(700.0 * std::log1p(std::max(precipitableWater, 0.0)), 1.0);
  return kAtGround * std::exp(-std::max(heightAboveGroundMeters, 0.0) / scale);
}

double liquidEffectiveRadius(double liquidWaterContent) {
  constexpr double kNumber = 1e8, kSpectrum = 0.77;
  const double cubed = 3.0 * std::max(liquidWaterContent, 0.0) /
                       (4.0 * std::numbers::pi * kWaterDensity * kSpectrum * kNumber);
  return std::clamp(std::cbrt(cubed), 4e-6, 30e-6);
}

double iceEffectiveRadius(double iceWaterContent, double temperatureK) {
  const double grams = std::clamp(iceWaterContent * 1e3, 1e-4, 0.3);
  const double t = std::clamp(temperatureK - 273.15, -70.0, -5.0);
  const double diameter =
      (45.8966 * std::pow(grams, 0.2214) + 0.7957 * std::pow(grams, 0.2535) * (t + 190.0)) *
      (1.2351 + 0.0105 * t) * 1e-6;
  return 3.0 * std::numbers::sqrt3 * diameter / 8.0;
}

double liquidExtinction(double liquidWaterContent) {
  if (!(liquidWaterContent > 0)) return 0;
  return 3.0 * liquidWaterContent / (2.0 * kWaterDensity * liquidEffectiveRadius(liquidWaterContent));
}

double iceExtinction(double iceWaterContent, double temperatureK) {
  if (!(iceWaterContent > 0)) return 0;
  return 3.0 * iceWaterContent / (2.0 * kIceDensity * iceEffectiveRadius(iceWaterContent, temperatureK));
}

double geometricHeight(double geopotentialMeters, double latitudeDegrees) {
  const auto [radius, gravityRatio] = earthAt(latitudeDegrees);
  return radius * geopotentialMeters / (gravityRatio * radius - geopotentialMeters);
}

double geopotentialHeight(double heightMeters, double latitudeDegrees) {
  const auto [radius, gravityRatio] = earthAt(latitudeDegrees);
  return gravityRatio * radius * heightMeters / (radius + heightMeters);
}

}  // namespace cloudgen::field
