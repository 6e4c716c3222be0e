// SPDX-License-Identifier: Apache-2.0
#include "field/hypsometry.hpp"

#include <algorithm>
#include <cmath>

#include "field/standard_atmosphere.hpp"

namespace cloudgen::field {
namespace {

double virtualFactor(double specificHumidity) {
  constexpr double kVapourExcess = 461.5250 / 287.0597 - 1.0;
  return 1.0 + kVapourExcess * (specificHumidity > 0 ? std::min(specificHumidity, 0.1) : 0.0);
}

}  // namespace

double virtualTemperature(double temperatureK, double specificHumidity) {
  return temperatureK * virtualFactor(specificHumidity);
}

double temperatureFromVirtual(double virtualTemperatureK, double specificHumidity) {
  return virtualTemperatureK / virtualFactor(specificHumidity);
}

double thickness(double lowerPa, double upperPa, double meanVirtualTemperatureK) {
  return kMetersPerKelvin * meanVirtualTemperatureK * std::log(lowerPa / upperPa);
}

double pressureAfter(double pressurePa, double rise, double meanVirtualTemperatureK) {
  return pressurePa * std::exp(-rise / (kMetersPerKelvin * meanVirtualTemperatureK));
}

double meanVirtualTemperature(double lowerPa, double upperPa, double rise) {
  return rise / (kMetersPerKelvin * std::log(lowerPa / upperPa));
}

double thicknessFromGround(double groundPa, double levelPa, double virtualTemperatureK) {
  const double first = thickness(groundPa, levelPa, virtualTemperatureK);
  return thickness(groundPa, levelPa, virtualTemperatureK + 0.5 * kStandardLapseRate * first);
}

double pressureFromGround(double groundPa, double rise, double virtualTemperatureK) {
  return pressureAfter(groundPa, rise, virtualTemperatureK + 0.5 * kStandardLapseRate * rise);
}

}  // namespace cloudgen::field
