// SPDX-License-Identifier: Apache-2.0
#include "light/optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cloudgen::light {

double henyeyGreenstein(double cosine, double asymmetry) { return draine(cosine, asymmetry, 0); }

ScatteredOnce scatteredOnce(double asymmetry) {
  const double back = henyeyGreenstein(-1, asymmetry) / henyeyGreenstein(0, asymmetry);
  return {static_cast<float>(0.5 * (1 + back)), static_cast<float>(2 * (1 - back))};
}

double draine(double cosine, double g, double alpha) {
  const double g2 = g * g, base = 1 + g2 - 2 * g * cosine;
  return (1 - g2) * (1 + alpha * cosine * cosine) /
         (4 * std::numbers::pi * (1 + alpha * (1 + 2 * g2) / 3) * base * std::sqrt(base));
}

double draineAsymmetry(double g, double alpha) {
  return g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
}

DropletPhase dropletPhase(double diameterMicrometers) {
  const double d = std::clamp(diameterMicrometers, 5.0, 50.0);
  return {std::exp(-0.0990567 / (d - 1.67154)), std::exp(-2.20679 / (d + 3.91029) - 0.428934),
          std::exp(3.62489 - 8.29288 / (d + 5.52825)), std::exp(-0.599085 / (d - 0.641583) - 0.665888)};
}

double phase(const DropletPhase& droplets, double cosine) {
  return (1 - droplets.draineShare) * henyeyGreenstein(cosine, droplets.peakG) +
         droplets.draineShare * draine(cosine, droplets.draineG, droplets.draineAlpha);
}

double asymmetry(const DropletPhase& droplets) {
  return (1 - droplets.draineShare) * droplets.peakG +
         droplets.draineShare * draineAsymmetry(droplets.draineG, droplets.draineAlpha);
}

}  // namespace cloudgen::light
