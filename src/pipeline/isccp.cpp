// SPDX-License-Identifier: Apache-2.0
#include "pipeline/isccp.hpp"

namespace cloudgen::pipeline {

std::string_view isccpClass(double opticalDepth, double topPressurePa) {
  constexpr double kLowPa = 68000, kHighPa = 44000, kThin = 3.6, kThick = 23;
  constexpr std::string_view kClasses[3][3] = {{"cumulus", "stratocumulus", "stratus"},
                                               {"altocumulus", "altostratus", "nimbostratus"},
                                               {"cirrus", "cirrostratus", "deep convection"}};
  const int height = topPressurePa > kLowPa ? 0 : (topPressurePa > kHighPa ? 1 : 2);
  const int thickness = opticalDepth < kThin ? 0 : (opticalDepth < kThick ? 1 : 2);
  return kClasses[height][thickness];
}

std::map<std::string_view, std::map<base::Genus, std::uint64_t>> isccpConfusion(
    std::span<const field::Layer> layers) {
  std::map<std::string_view, std::map<base::Genus, std::uint64_t>> confusion;
  for (const field::Layer& layer : layers)
    if (layer.topPressurePa > 0)
      ++confusion[isccpClass(layer.opticalDepth(), layer.topPressurePa)][layer.genus];
  return confusion;
}

}  // namespace cloudgen::pipeline
