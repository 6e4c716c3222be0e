// SPDX-License-Identifier: Apache-2.0
#include "field/standard_atmosphere.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "field/hypsometry.hpp"

namespace cloudgen::field {
namespace {

/// A layer of constant lapse rate, from its base upwards.
struct Layer {
  double baseMeters, temperatureK, pressurePa, lapseRate;
};

constexpr std::array<Layer, 4> kLayers{{
    {0, 288.15, 101325, kStandardLapseRate},
    {11000, 216.65, 22632.06, 0},
    {20000, 216.65, 5474.889, -0.001},
    {32000, 228.65, 868.0187, -0.0028},
}};

const Layer& layerAt(double geopotentialMeters) {
  std::size_t layer = kLayers.size() - 1;
  while (layer > 0 && geopotentialMeters < kLayers[layer].baseMeters) --layer;
  return kLayers[layer];
}

}  // namespace

double standardTemperature(double geopotentialMeters) {
  const Layer& layer = layerAt(geopotentialMeters);
  return layer.temperatureK - layer.lapseRate * (geopotentialMeters - layer.baseMeters);
}

double standardPressure(double geopotentialMeters) {
  const Layer& layer = layerAt(geopotentialMeters);
  const double above = geopotentialMeters - layer.baseMeters;
  if (layer.lapseRate == 0)
    return layer.pressurePa * std::exp(-above / (kMetersPerKelvin * layer.temperatureK));
  return layer.pressurePa * std::pow(standardTemperature(geopotentialMeters) / layer.temperatureK,
                                     1.0 / (kMetersPerKelvin * layer.lapseRate));
}

double standardHeight(double pressurePa) {
  if (!(pressurePa > 0)) return std::numeric_limits<double>::quiet_NaN();
  std::size_t number = kLayers.size() - 1;
  while (number > 0 && pressurePa > kLayers[number].pressurePa) --number;
  const Layer& layer = kLayers[number];
  const double logarithm = std::log(layer.pressurePa / pressurePa);
  if (layer.lapseRate == 0) return layer.baseMeters + kMetersPerKelvin * layer.temperatureK * logarithm;
  const double warmth = std::exp(-logarithm * kMetersPerKelvin * layer.lapseRate);
  return layer.baseMeters + layer.temperatureK * (1.0 - warmth) / layer.lapseRate;
}

}  // namespace cloudgen::field
